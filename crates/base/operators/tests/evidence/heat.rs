//! Distances against great circles and straight lines.

use crate::common::surface;
use pompeiu_core::VertexId;
use pompeiu_core::mesh::{merge, shapes};
use pompeiu_operators::{HeatMethod, OperatorError};
use pompeiu_surface::EdgeDistances;

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
    (sum / count).sqrt()
}

#[test]
fn great_circles_on_the_sphere() {
    let errors: Vec<f64> = (2..6)
        .map(|subdivisions| {
            let mesh = shapes::icosphere(1.0, subdivisions).unwrap();
            let surface = surface(&mesh);
            let distances = HeatMethod::new(&surface).unwrap().distances(&[VertexId(0)]).unwrap();
            let pole = mesh.positions()[0];
            let exact =
                |p: &[f64; 3]| (p[0] * pole[0] + p[1] * pole[1] + p[2] * pole[2]).clamp(-1.0, 1.0).acos();
            assert_eq!(distances[VertexId(0)], 0.0);
            root_mean_square(mesh.positions().iter().zip(&distances).map(|(p, d)| d - exact(p)))
        })
        .collect();
    assert!(errors.windows(2).all(|pair| pair[1] < 0.75 * pair[0]) && errors[3] < 0.02, "{errors:?}");
}

#[test]
fn the_nearest_of_several_sources_on_each_component() {
    let errors = [20_u32, 40, 80].map(|rings| {
        let disk = shapes::disk(1.0, 3 * rings, rings).unwrap();
        let sphere = shapes::icosphere(1.0, 1).unwrap();
        let both = surface(&merge(&[&disk, &sphere]).unwrap());
        let heat = HeatMethod::new(&both).unwrap();
        let n = disk.positions().len();
        let rim = 1 + 3 * rings * (rings - 1);
        let sources = [VertexId(0), VertexId(rim)];
        let distances = heat.distances(&sources).unwrap();
        let edges = EdgeDistances::from(&both, &sources).distances;
        let rim = disk.positions()[rim as usize];
        let exact = |p: &[f64; 3]| p[0].hypot(p[1]).min((p[0] - rim[0]).hypot(p[1] - rim[1]));
        assert!(distances.iter().skip(n).all(|d| *d == f64::INFINITY));
        // Along edges no way is shorter than the straight one.
        for (p, along) in disk.positions().iter().zip(&edges) {
            assert!(*along >= exact(p) - 1e-14 && *along <= 1.6 * exact(p) + 1e-14);
        }
        assert_eq!(edges[VertexId(n as u32)], f64::INFINITY);
        root_mean_square(disk.positions().iter().zip(&distances).map(|(p, d)| d - exact(p)))
    });
    assert!(errors.windows(2).all(|pair| pair[1] < 0.7 * pair[0]) && errors[2] < 0.02, "{errors:?}");
}

#[test]
fn unusable_questions_are_named() {
    let sphere = surface(&shapes::icosphere(1.0, 1).unwrap());
    let heat = HeatMethod::new(&sphere).unwrap();
    let error = heat.distances(&[VertexId(42)]).unwrap_err();
    assert_eq!(error.to_string(), "vertex 42 does not exist, there are 42 (the first is 0)");
    assert!(heat.distances(&[]).unwrap().iter().all(|d| *d == f64::INFINITY));
    for time in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(HeatMethod::with_time(&sphere, time), Err(OperatorError::Solve(_))), "{time}");
    }
}
