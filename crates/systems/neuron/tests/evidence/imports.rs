//! Imported meshes: heat in a block and in a rod, flow through a duct, labels, rejected input; the page.

use glam::DVec3;
use pompeiu_core::run::Limits;
use pompeiu_neuron::{
    CubicMesh, Drive, Ends, FlowCells, FlowOptions, FlowParameters, MeshError, NeuronMesh, Parameters, Side,
    TransportOptions, neuron_flow, read_transport_config, transport, transport_in_flow,
};
use pompeiu_volume::{HexMesh, VolumeError};

const HEAT: &str = "[transport]\ndiffusion = \"2 um^2/s\"\nspeed_plus = \"0 um/s\"\nattach_plus = \"0 /s\"\nstep = \"1 s\"\nsteps = 60\norder = 2\n[inlet]\nside = \"-x\"\nfree = 3.0\nplus = 0.0\n[tips]\nsides = [\"+x\"]\nfree = 1.0\n";

fn moved(mesh: &HexMesh, to: impl Fn(DVec3) -> DVec3) -> HexMesh {
    HexMesh::new(mesh.positions().iter().map(|p| to(*p)).collect(), mesh.cells().to_vec()).unwrap()
}

#[test]
fn heat_in_a_block_becomes_linear_between_its_sides() {
    let parameters = read_transport_config(HEAT).unwrap();
    let names: Vec<&str> = parameters.sides.iter().map(|side| side.name()).collect();
    assert_eq!(names, ["-x", "+x"]);
    let block = HexMesh::grid([10, 3, 3], [4.0, 2.0, 2.0]);
    let mesh = NeuronMesh::from_hexahedra(block, Ends::Sides(&parameters.sides), &Limits::default()).unwrap();
    assert!(mesh.report.certified && (mesh.report.min_scaled_jacobian - 1.0).abs() < 1e-12);
    assert_eq!(mesh.caps.iter().map(|cap| cap.sample).collect::<Vec<_>>(), [1, 2]);
    assert!((mesh.caps[1].normal - DVec3::X).length() < 1e-14);
    let found = transport(&mesh, &parameters, 2, &TransportOptions::default()).unwrap();
    for (cell, v) in mesh.mesh.cells().iter().zip(&found.state.frames[1].values) {
        let x = mesh.mesh.corners(*cell).iter().sum::<DVec3>().x / 8.0;
        assert!((v[0] - (3.0 - x / 2.0)).abs() < 1e-9, "{x} {}", v[0]);
    }
    assert!(found.report.mass_balance < 1e-12 && found.report.minimum >= 0.0);
    let wrong = |text: &str| read_transport_config(text).unwrap_err().to_string();
    assert!(wrong("[inlet]\nside = \"x\"\n").contains("expected a side of the box"));
    assert!(wrong("[tips]\nsides = [\"+x\"]\n").contains("the side of the inlet, too"));
}

#[test]
fn a_rod_with_labels_has_ends_whatever_stands_at_their_rims() {
    // A rod bent by a quarter turn, as in files of others: labels at vertices, at the rim those of the wall or the end.
    let rod = |p: DVec3| {
        let angle = p.z * 0.5;
        DVec3::new((5.0 + p.x) * angle.cos(), p.y, (5.0 + p.x) * angle.sin())
    };
    let grid = HexMesh::grid([3, 3, 8], [1.0, 1.0, 3.0]);
    let numbers = |at_rim: bool| -> Vec<f64> {
        grid.positions()
            .iter()
            .map(|p| {
                let wall = [p.x, p.y].iter().any(|t| *t < 1e-9 || *t > 1.0 - 1e-9);
                match p.z {
                    z if z < 1e-9 && (at_rim || !wall) => 1.0,
                    z if z > 3.0 - 1e-9 && (at_rim || !wall) => 2.0,
                    _ if wall => 0.0,
                    _ => -1.0,
                }
            })
            .collect()
    };
    let upright = moved(&grid, rod);
    for at_rim in [true, false] {
        let mesh =
            NeuronMesh::from_hexahedra(upright.clone(), Ends::Labels(&numbers(at_rim)), &Limits::default())
                .unwrap();
        let count = |label| mesh.labels.iter().filter(|l| **l == label).count();
        assert_eq!((count(0), count(1), count(2)), (96, 9, 9), "{at_rim}");
        assert!((mesh.caps[0].normal + DVec3::Z).length() < 1e-12);
    }
    let folded = NeuronMesh::from_hexahedra(
        moved(&grid, |p| rod(DVec3::new(p.y, p.x, p.z))),
        Ends::None,
        &Limits::default(),
    )
    .unwrap_err();
    assert!(matches!(folded, MeshError::Folded { .. }) && folded.to_string().contains("on its head"));
}

#[test]
fn flow_through_a_square_duct_is_that_of_the_series() {
    let grid = HexMesh::grid([2, 2, 3], [1.0, 1.0, 3.0]);
    let sides = ["-z", "+z"].map(|name| Side::from_name(name).unwrap());
    let mesh = CubicMesh::from_hexahedra(&grid, Ends::Sides(&sides), &Limits::default()).unwrap();
    let parameters = FlowParameters { drive: Drive::Pressure(1.0), ..FlowParameters::default() };
    let flow = neuron_flow(&mesh, &parameters, &FlowOptions::default()).unwrap();
    // 0.035144 a⁴ Δp / (μ L): the series of Boussinesq, as far as four cells per section resolve it.
    let expected = 0.035_144_25 / (1e-3 * 3.0);
    assert!((flow.ends[1].flux / expected - 1.0).abs() < 6e-4, "{} {expected}", flow.ends[1].flux);
    assert!(flow.report.section_flux_drift < 1e-10 && flow.report.wall_leak < 1e-14);
    let cells = FlowCells::new(&flow, 1, &Limits::default()).unwrap();
    let parameters = Parameters { steps: 5, ..Parameters::default() };
    let found = transport_in_flow(&cells, &parameters, 2, &TransportOptions::default()).unwrap();
    assert!(found.report.mass_balance < 1e-12);
}

#[test]
fn what_is_no_mesh_or_end_is_refused() {
    let grid = || HexMesh::grid([2, 1, 1], [2.0, 1.0, 1.0]);
    let side = |name| Side::from_name(name).unwrap();
    let of = |ends: Ends<'_>| {
        NeuronMesh::from_hexahedra(grid(), ends, &Limits::default()).unwrap_err().to_string()
    };
    assert_eq!(of(Ends::Labels(&[1.0])), "there are 1 labels of ends for 12 vertices");
    assert_eq!(
        of(Ends::Sides(&[side("-y"), side("-y")])),
        "the side -y is no end of the mesh: it is named twice"
    );
    let roof = moved(&grid(), |p| if p.z > 0.5 { p + DVec3::Z * 0.3 * p.x * (2.0 - p.x) } else { p });
    let error = NeuronMesh::from_hexahedra(roof, Ends::Sides(&[side("+z")]), &Limits::default()).unwrap_err();
    assert!(matches!(error, MeshError::Side { side: "+z", .. }), "{error}");
    let none = NeuronMesh::from_hexahedra(HexMesh::default(), Ends::None, &Limits::default()).unwrap_err();
    assert_eq!(none, MeshError::NoCell);
    let twice = HexMesh::new(grid().positions().to_vec(), [grid().cells()[0]; 2].to_vec()).unwrap();
    let error = NeuronMesh::from_hexahedra(twice, Ends::None, &Limits::default()).unwrap_err();
    assert!(matches!(error, MeshError::Volume(VolumeError::NotConforming { .. })), "{error}");
}

#[cfg(feature = "figures")]
#[test]
fn a_page_plays_what_was_transported() {
    use pompeiu_neuron::{NeuronPage, NeuronReport, NeuronSurface};
    let parameters = read_transport_config(HEAT).unwrap();
    let block = HexMesh::grid([4, 1, 1], [4.0, 1.0, 1.0]);
    let mesh = NeuronMesh::from_hexahedra(block, Ends::Sides(&parameters.sides), &Limits::default()).unwrap();
    let found = transport(&mesh, &parameters, 5, &TransportOptions::default()).unwrap();
    let surface = NeuronSurface::new(&mesh);
    assert_eq!(surface.vertices(), 20);
    let report = NeuronReport {
        mesh: Some(mesh.report.clone()),
        transport: Some(found.report.clone()),
        ..NeuronReport::default()
    };
    let page = NeuronPage {
        path: "block.vtk",
        surface: &surface,
        caps: &mesh.caps,
        inlet: 0,
        parameters: &parameters,
        state: &found.state,
        report: &report,
        command: None,
    };
    let html = page.html().unwrap();
    // Heat is one kind of material: one scene, one chart, a line for each end.
    assert!(html.contains("ends-free") && !html.contains("ends-total"));
    assert!(html.contains("inlet 1") && html.contains("end 2"));
}
