//! Requests: ends and lengths as text.

use pompeiu_core::run::RunContext;
use pompeiu_flow::{FlowError, FlowRequest, Scheme, Until};
use std::num::NonZeroUsize;

#[test]
fn ends_are_read_and_written() {
    assert_eq!("stationary".parse(), Ok(Until::STATIONARY));
    assert_eq!("stationary:1e-6".parse(), Ok(Until::Stationary(1e-6)));
    assert_eq!("time:0.5".parse(), Ok(Until::Time(0.5)));
    assert_eq!("steps:7".parse(), Ok(Until::Steps(7)));
    for wrong in ["", "time", "steps:1.5", "time:x", "never"] {
        assert!(wrong.parse::<Until>().is_err(), "{wrong}");
    }
    for text in ["stationary", "stationary:1e-6", "time:0.5", "steps:7"] {
        assert_eq!(text.parse::<Until>().unwrap().to_string(), text);
    }
}

#[test]
fn lengths_of_edges_have_units() {
    let tube = pompeiu_core::mesh::shapes::catenoid(0.8, 1.0, 24, 6).unwrap();
    let run = |length: &str, unit: &str| {
        let until = Until::Steps(2);
        let remesh = Some(length.parse().unwrap());
        let unit = unit.to_owned();
        let request = FlowRequest {
            until,
            remesh,
            unit,
            remesh_every: NonZeroUsize::MIN,
            scheme: Some(Scheme::Implicit),
            ..FlowRequest::default()
        };
        request.run(&tube, &RunContext::default(), None)
    };
    let faces = |length: &str, unit: &str| run(length, unit).unwrap().mesh.faces().len();
    assert_eq!(faces("0.2mm", "mm"), faces("0.2", ""));
    assert_eq!(faces("200um", "mm"), faces("0.2", ""));
    assert!(matches!(run("0.2mm", ""), Err(FlowError::Unit(_))));
}
