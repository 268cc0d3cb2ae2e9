//! Expressions in x, y and z.

use anyhow::{Context, anyhow};
use exmex::Express;
use pompeiu::core::TriMesh;

/// The values of an expression in x, y and z at the vertices; `what` names it in errors.
pub(crate) fn values(expression: &str, what: &str, mesh: &TriMesh) -> anyhow::Result<Vec<f64>> {
    let what = || what.to_owned();
    let parsed = exmex::parse::<f64>(expression)
        .map_err(|error| anyhow!("not an expression: {error}"))
        .with_context(what)?;
    let axes = parsed
        .var_names()
        .iter()
        .map(|variable| match variable.as_str() {
            "x" => Ok(0),
            "y" => Ok(1),
            "z" => Ok(2),
            other => Err(anyhow!("unknown variable {other}, expected x, y or z")).with_context(what),
        })
        .collect::<anyhow::Result<Vec<usize>>>()?;
    mesh.positions()
        .iter()
        .enumerate()
        .map(|(v, position)| {
            let variables: Vec<f64> = axes.iter().map(|&axis| position[axis]).collect();
            let value = parsed.eval(&variables).map_err(|error| anyhow!("{error}")).with_context(what)?;
            if value.is_finite() {
                Ok(value)
            } else {
                Err(anyhow!("is {value} at vertex {v}, expected finite numbers")).with_context(what)
            }
        })
        .collect()
}
