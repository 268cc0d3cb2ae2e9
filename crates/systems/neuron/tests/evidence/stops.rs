//! Stages that are ended early: immediately, and during the computation.

use crate::flows::{FORK, FORKED};
use pompeiu_core::run::{CancelToken, Control, Limits, Progress, StopReason};
use pompeiu_neuron::{
    CubicMesh, Discretisation, Ends, FlowCells, FlowError, FlowOptions, FlowParameters, MeshError,
    MeshOptions, NeuronMesh, RefineAt, RefineOptions, Skeleton, TransportError, cubic_neuron, mesh_neuron,
    neuron_flow, potential_flow, read_swc, refined_splines,
};
use pompeiu_volume::{Faces, HexMesh};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

fn skeleton() -> Skeleton {
    Skeleton::new(&read_swc(FORK.as_bytes()).unwrap()).unwrap()
}

/// The result of each stage under limits.
fn all(limits: &Limits) -> Vec<Result<(), String>> {
    let options = || MeshOptions { limits: limits.clone(), ..MeshOptions::default() };
    let mesh = |error: MeshError| error.to_string();
    let grid = HexMesh::grid([2, 1, 1], [2.0, 1.0, 1.0]);
    let at = [RefineAt::Nodes];
    let refine = RefineOptions { elements: 1, at: &at, times: 1, limits: limits.clone(), progress: None };
    let flow = FlowOptions { limits: limits.clone(), ..FlowOptions::default() };
    vec![
        mesh_neuron(&skeleton(), &options()).map(drop).map_err(mesh),
        cubic_neuron(&skeleton(), &options()).map(drop).map_err(mesh),
        NeuronMesh::from_hexahedra(grid.clone(), Ends::None, limits).map(drop).map_err(mesh),
        CubicMesh::from_hexahedra(&grid, Ends::None, limits).map(drop).map_err(mesh),
        refined_splines(&FORKED, &refine).map(drop).map_err(mesh),
        neuron_flow(&FORKED, &FlowParameters::default(), &flow).map(drop).map_err(|error| error.to_string()),
    ]
}

#[test]
fn every_stage_says_what_ended_it() {
    let token = CancelToken::default();
    token.cancel();
    let now = Limits { time: Some(Duration::ZERO), ..Limits::default() };
    for (limits, reason) in
        [(Limits { cancel: Some(token), ..Limits::default() }, "request"), (now, "the time limit")]
    {
        for (stage, found) in all(&limits).into_iter().enumerate() {
            let error = found.unwrap_err();
            assert!(error.starts_with(&format!("ended by {reason} before the ")), "{stage}: {error}");
        }
    }
}

#[test]
fn stages_end_wherever_they_are() {
    // Cancelled during the computation: either the complete result or the error, nothing in between.
    let cancelled = |work: &(dyn Fn(&Limits) + Sync)| {
        for milliseconds in [20, 100] {
            let token = CancelToken::default();
            let limits = Limits { cancel: Some(token.clone()), ..Limits::default() };
            std::thread::scope(|scope| {
                scope.spawn(|| {
                    std::thread::sleep(Duration::from_millis(milliseconds));
                    token.cancel();
                });
                work(&limits);
            });
        }
    };
    cancelled(&|limits| {
        let options = MeshOptions { limits: limits.clone(), ..MeshOptions::default() };
        if let Err(error) = cubic_neuron(&skeleton(), &options) {
            assert_eq!(error, MeshError::Stopped(StopReason::Cancelled));
        }
    });
    let mesh = &*FORKED;
    cancelled(&|limits| {
        let options = FlowOptions { limits: limits.clone(), ..FlowOptions::default() };
        if let Err(error) = neuron_flow(mesh, &FlowParameters::default(), &options) {
            assert_eq!(error, FlowError::Stopped(StopReason::Cancelled));
        }
    });
    let flow = neuron_flow(mesh, &FlowParameters::default(), &FlowOptions::default()).unwrap();
    cancelled(&|limits| {
        if let Err(error) = FlowCells::new(&flow, 8, limits) {
            assert_eq!(error, TransportError::Stopped(StopReason::Cancelled));
        }
    });
    let now = Limits { time: Some(Duration::ZERO), ..Limits::default() };
    assert_eq!(FlowCells::new(&flow, 1, &now).unwrap_err(), TransportError::Stopped(StopReason::Time));
}

#[test]
fn a_factorization_does_not_outlast_a_limit() {
    // The factors of so many cells take long beside the interval in which a limit is noticed.
    let mesh = HexMesh::grid([24; 3], [1.0; 3]);
    let faces = Faces::new(&mesh).unwrap();
    let ends =
        faces.boundary().iter().map(|face| u32::from(face.place / 2 == 0) * (1 + u32::from(face.place)));
    let volumes = Discretisation::new(&mesh, &faces, &ends.collect::<Vec<_>>());
    let control = Control::start(&Limits { time: Some(Duration::ZERO), ..Limits::default() });
    assert_eq!(potential_flow(&volumes, 0, &control).unwrap_err(), TransportError::Stopped(StopReason::Time));
}

#[test]
fn observers_end_stages() {
    let calls = AtomicUsize::new(0);
    let end = |_: &Progress<'_>| {
        calls.fetch_add(1, Ordering::Relaxed);
        ControlFlow::Break(())
    };
    let options = MeshOptions { progress: Some(&end), measure: false, ..MeshOptions::default() };
    let cancelled = MeshError::Stopped(StopReason::Cancelled);
    assert_eq!(mesh_neuron(&skeleton(), &options).unwrap_err(), cancelled);
    let at = [RefineAt::Nodes];
    let refine =
        RefineOptions { elements: 1, at: &at, times: 2, limits: Limits::default(), progress: Some(&end) };
    assert_eq!(refined_splines(&FORKED, &refine).unwrap_err(), cancelled);
    let flow = FlowOptions { progress: Some(&end), ..FlowOptions::default() };
    let error = neuron_flow(&FORKED, &FlowParameters::default(), &flow).unwrap_err();
    assert_eq!(error, FlowError::Stopped(StopReason::Cancelled));
    assert_eq!(calls.load(Ordering::Relaxed), 3);
}
