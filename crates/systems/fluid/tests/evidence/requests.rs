//! Scenes as data and as arguments of a command.

use pompeiu_fluid::request::{FluidRequest, Vortex};

#[test]
fn tables_stand_alone_or_in_lists() {
    let read = |text: &str| serde_json::from_str::<FluidRequest>(text);
    let one = r#"{"vortex": {"at": [0, 0, 1], "radius": 0.5, "circulation": 2}}"#;
    let vortex = Vortex { at: [0.0, 0.0, 1.0], radius: 0.5, circulation: 2.0 };
    assert_eq!(read(one).unwrap().vortex, [vortex]);
    assert_eq!(read(&one.replace(": {", ": [{").replace("2}}", "2}]}")).unwrap().vortex, [vortex]);
    let wrong = read(&one.replace("radius", "radious")).unwrap_err().to_string();
    assert!(wrong.contains("unknown field `radious`, expected one of"), "{wrong}");
}

#[cfg(feature = "clap")]
#[test]
fn densities_are_expressions_or_tables() {
    use clap::{Args, FromArgMatches};
    let density = |text: &str| {
        let command = FluidRequest::augment_args_for_update(clap::Command::new("fluid"));
        let matches = command.try_get_matches_from(["fluid", "--density", text])?;
        let mut request = FluidRequest::default();
        request.update_from_arg_matches(&matches).map(|()| request.density[0].clone())
    };
    assert_eq!(density("exp(-x^2)").unwrap().initial.as_deref(), Some("exp(-x^2)"));
    let dye =
        density("name = \"dye\", weight = -1, source = [{ at = [0, 0, 1], radius = 1, rate = 2 }]").unwrap();
    assert_eq!((dye.name.as_str(), dye.weight, dye.source[0].rate), ("dye", -1.0, 2.0));
    assert!(density("nam = \"dye\"").unwrap_err().to_string().contains("unknown field `nam`"));
}
