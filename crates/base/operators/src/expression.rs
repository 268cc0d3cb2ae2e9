//! Expressions in x, y and z.

use exmex::Express;
use pompeiu_core::VertexId;

/// Why an expression has no values.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExpressionError {
    /// The text is no expression.
    #[error("not an expression: {0}")]
    Syntax(String),
    /// A variable is none of the coordinates.
    #[error("unknown variable {0}, expected x, y or z")]
    Variable(String),
    /// A value is NaN or infinite.
    #[error("is {value} at vertex {vertex}, expected finite numbers")]
    NotFinite {
        /// The vertex.
        vertex: VertexId,
        /// The value.
        value: f64,
    },
}

/// The values of an expression such as `sin(x)*y^2` at positions.
///
/// # Errors
/// [`ExpressionError`] if the text is no expression in x, y and z, or a value is not finite.
pub fn vertex_values(expression: &str, positions: &[[f64; 3]]) -> Result<Vec<f64>, ExpressionError> {
    let parsed = exmex::parse::<f64>(expression).map_err(|e| ExpressionError::Syntax(e.to_string()))?;
    let axis = |variable: &String| match variable.as_str() {
        "x" => Ok(0),
        "y" => Ok(1),
        "z" => Ok(2),
        other => Err(ExpressionError::Variable(other.to_owned())),
    };
    let axes = parsed.var_names().iter().map(axis).collect::<Result<Vec<usize>, _>>()?;
    let value = |(v, position): (usize, &[f64; 3])| {
        let variables: Vec<f64> = axes.iter().map(|&axis| position[axis]).collect();
        let value = parsed.eval(&variables).map_err(|e| ExpressionError::Syntax(e.to_string()))?;
        let vertex = VertexId(v as u32);
        if value.is_finite() { Ok(value) } else { Err(ExpressionError::NotFinite { vertex, value }) }
    };
    positions.iter().enumerate().map(value).collect()
}
