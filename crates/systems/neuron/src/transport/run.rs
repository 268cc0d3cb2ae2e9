//! Time stepping of transport.

use super::discretisation::Discretisation;
use super::error::TransportError;
use super::flow::{FlowField, potential_flow};
use super::problem::{Parameters, TimeScheme, TransportOptions};
use super::state::{Frame, MassBalance, TransportState};
use super::step::Stepper;
use super::system::System;
use super::viscous::FlowCells;
use crate::{Cap, LinearShares, NeuronMesh};
use pompeiu_core::run::{Control, Progress, StopReason};
use std::ops::ControlFlow;

/// The result of a transport.
#[derive(Clone, Debug)]
pub struct Transport {
    /// The report.
    pub report: TransportReport,
    /// Why it ended: [`StopReason::Steps`] means all steps were done.
    pub stop: StopReason,
    /// The cap that is the inlet.
    pub inlet: u32,
    /// The state after the last step, with the history.
    pub state: TransportState,
}

/// The report of a transport.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TransportReport {
    /// Number of steps done.
    pub steps: usize,
    /// The greatest mass balance error of a step: change of mass minus net inflow through the ends, relative to the mass present
    /// plus that which has passed the ends so far.
    pub mass_balance: f64,
    /// The least concentration over all kinds, cells and steps.
    pub minimum: f64,
    /// The greatest concentration.
    pub maximum: f64,
    /// The flat ends other than the inlet, after the last step.
    pub tips: Vec<TipReport>,
    /// What the trilinear cells keep that stand for the cells of a flow in files, one for each; omitted for trilinear cells.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub linear: Option<LinearShares>,
}

/// Concentrations at a flat end.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TipReport {
    /// The number of its sample in the file.
    pub sample: i64,
    /// Free material.
    pub free: f64,
    /// Material on motors away from the inlet.
    pub plus: f64,
    /// Material on motors towards the inlet.
    pub minus: f64,
}

/// Memory of factors per cell in bytes, estimated for long branches with twenty cells per section.
const BYTES_PER_CELL: usize = 24 << 10;

/// Largest memory if no limit is given, in bytes.
const MOST_BYTES: usize = 8 << 30;

/// Computes transport through a mesh, and stores the field at this many steps, including the first and the last.
///
/// # Shapes and units
/// Micrometres, seconds; concentrations in the unit of the parameters.
/// # Definition
/// See [`Parameters`]. Motors follow the potential flow from the inlet to the tips, [`potential_flow`], at their own speeds. The
/// wall is closed. At the inlet and the tips, material on motors leaves with the concentration of the last cell.
/// # Accuracy
/// Upwind: first order in the cell length. In the time step first order (backward Euler), or second order: the two stages of
/// Alexander, L-stable; where a concentration would become negative, fluxes are blended with those of first order. Concentrations
/// are nonnegative and mass is conserved, both up to the rounding of one solve.
/// # Errors
/// [`TransportError`].
/// # Cost
/// One factorization with three unknowns per cell, then one solve per step; twice as much for second order.
/// # Source
/// Stages: `alexander_diagonally_1977`. Limited fluxes: `zalesak_fully_1979`.
pub fn transport(
    mesh: &NeuronMesh,
    parameters: &Parameters,
    frames: usize,
    options: &TransportOptions<'_>,
) -> Result<Transport, TransportError> {
    parameters.check()?;
    let inlet = inlet(mesh, parameters)?;
    check_memory(mesh.mesh.cells().len(), parameters, options)?;
    let control = Control::start(&options.limits);
    let volumes = Discretisation::new(&mesh.mesh, &mesh.faces, &mesh.labels);
    let flow = match potential_flow(&volumes, inlet, &control) {
        // No step is made then.
        Err(TransportError::Stopped(_)) => FlowField::at_rest(&volumes),
        found => found?,
    };
    let system = System { mesh: &volumes, flow: &flow, parameters, inlet };
    run(&system, &mesh.caps, frames, options, &control)
}

/// Computes transport along a viscous flow, at the speeds of the parameters, and stores the field at this many steps, including the
/// first and the last. The inlet is that of the flow.
///
/// # Definition
/// As [`transport`], with the velocity of the flow, scaled to a mean speed of one at the inlet, times that of the motors.
/// # Errors
/// [`TransportError`].
/// # Cost
/// That of [`transport`].
pub fn transport_in_flow(
    cells: &FlowCells,
    parameters: &Parameters,
    frames: usize,
    options: &TransportOptions<'_>,
) -> Result<Transport, TransportError> {
    parameters.check()?;
    check_memory(cells.volumes.volumes.len(), parameters, options)?;
    let control = Control::start(&options.limits);
    let system = System { mesh: &cells.volumes, flow: &cells.field, parameters, inlet: cells.inlet };
    let mut found = run(&system, &cells.caps, frames, options, &control)?;
    found.report.linear = Some(cells.linear());
    Ok(found)
}

fn check_memory(
    cells: usize,
    parameters: &Parameters,
    options: &TransportOptions<'_>,
) -> Result<(), TransportError> {
    let matrices = if parameters.scheme == TimeScheme::Second { 2 } else { 1 };
    let needed = cells.saturating_mul(matrices * BYTES_PER_CELL);
    let limit = options.limits.memory.unwrap_or(MOST_BYTES);
    if needed > limit {
        return Err(TransportError::Memory { cells, needed: needed.div_ceil(1 << 20), limit: limit >> 20 });
    }
    Ok(())
}

fn run(
    system: &System<'_>,
    caps: &[Cap],
    frames: usize,
    options: &TransportOptions<'_>,
    control: &Control,
) -> Result<Transport, TransportError> {
    let (parameters, inlet) = (system.parameters, system.inlet);
    let cells = system.mesh.volumes.len();
    let keep = |step: usize| {
        let share = |step: usize| step * frames.saturating_sub(1) / parameters.steps;
        step == 0 || share(step) > share(step - 1)
    };
    let mut state = if let Some(state) = options.resume {
        state.check(cells, caps.len(), parameters.steps)?;
        let mut state = state.clone();
        // The last step of a run that ended early may not be one of those to be stored.
        state.frames.retain(|frame| keep(frame.step));
        state
    } else {
        let values = parameters.initial.repeat(cells);
        TransportState {
            step: 0,
            book: MassBalance::new(system, &values),
            ends: vec![system.at_ends(&values, caps.len())],
            frames: vec![frame(system, 0, &values)],
            values,
        }
    };
    let mut stepper = Stepper::new(system, control)?;
    for step in state.step + 1..=parameters.steps {
        if control.is_stopped() {
            break;
        }
        let Some(stepper) = &mut stepper else { break };
        let Some(stepped) = stepper.step(&state.values, control)? else { break };
        state.book.add_step(system, &stepped);
        state.values = stepped.values;
        state.step = step;
        state.ends.push(system.at_ends(&state.values, caps.len()));
        if keep(step) {
            state.frames.push(frame(system, step, &state.values));
        }
        let share = Some(step as f64 / parameters.steps as f64);
        let told =
            options.progress.map(|observer| observer.progress(&Progress { doing: "transporting", share }));
        if told == Some(ControlFlow::Break(())) {
            control.stop(StopReason::Cancelled);
        }
    }
    if state.frames.last().is_some_and(|frame| frame.step < state.step) {
        state.frames.push(frame(system, state.step, &state.values));
    }
    let last = &state.ends[state.ends.len() - 1];
    let tips = caps.iter().zip(last).enumerate().filter(|(cap, _)| *cap as u32 != inlet);
    let report = TransportReport {
        steps: state.step,
        mass_balance: state.book.error,
        minimum: state.book.range[0],
        maximum: state.book.range[1],
        tips: tips
            .map(|(_, (cap, &[free, plus, minus]))| TipReport { sample: cap.sample, free, plus, minus })
            .collect(),
        linear: None,
    };
    let done = state.step == parameters.steps;
    let stop = control.reason().filter(|_| !done).unwrap_or(StopReason::Steps);
    Ok(Transport { report, stop, inlet, state })
}

fn inlet(mesh: &NeuronMesh, parameters: &Parameters) -> Result<u32, TransportError> {
    match parameters.inlet {
        None => Cap::of_root(&mesh.caps).ok_or(TransportError::NoInlet),
        Some(sample) => Cap::at(&mesh.caps, sample).map_err(|ends| TransportError::NotAnEnd { sample, ends }),
    }
}

fn frame(system: &System<'_>, step: usize, values: &[f64]) -> Frame {
    let values = values.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect();
    Frame { step, time: step as f64 * system.parameters.step, values }
}
