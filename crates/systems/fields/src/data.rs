//! Serialised forms of reports that differ from the structs.

use crate::{DegreesOfFreedom, Ranks};
use serde::Serialize;

/// Dimensions of the spaces of a splitting.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct Dimensions {
    /// Dimension of the harmonic fields: 2g for each closed component, 2g + b − 1 for one with b boundary loops.
    harmonic_dimension: usize,
    /// The dimensions of the spaces of fields, which add up.
    degrees_of_freedom: Counted,
}

/// Dimensions for each choice of function spaces for the two potentials.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "DegreesOfFreedom"))]
struct Counted {
    /// Two for each face.
    total: usize,
    /// Conforming functions for one potential, nonconforming ones for the other: the residual consists of the harmonic fields.
    mixed: Ranks,
    /// Conforming functions for both.
    conforming: Ranks,
    /// Nonconforming functions for both.
    nonconforming: Ranks,
}

impl From<DegreesOfFreedom> for Dimensions {
    fn from(counted: DegreesOfFreedom) -> Self {
        Self {
            harmonic_dimension: counted.harmonic,
            degrees_of_freedom: Counted {
                total: counted.total,
                mixed: counted.mixed,
                conforming: counted.conforming,
                nonconforming: counted.nonconforming,
            },
        }
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for DegreesOfFreedom {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        Dimensions::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        Dimensions::json_schema(generator)
    }
}
