//! Reports as data for other programs, where these are not written as they are kept.

use crate::audit::{Audit, OneKind};
use serde::Serialize;

/// Dimensions of the spaces of a splitting.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "Audit"))]
pub(crate) struct Dimensions {
    /// Dimension of the harmonic fields: 2g for each closed component, 2g + b − 1 for one with b boundary loops.
    harmonic_dimension: usize,
    /// How the dimensions of fields add up.
    degrees_of_freedom: DegreesOfFreedom,
}

/// How the dimensions of fields add up, with each choice of functions for the two potentials.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct DegreesOfFreedom {
    /// Two for each face.
    total: usize,
    /// Conforming functions for one potential, nonconforming ones for the other: only the harmonic fields are left over.
    mixed: OneKind,
    /// Conforming functions for both.
    conforming: OneKind,
    /// Nonconforming functions for both.
    nonconforming: OneKind,
}

impl From<Audit> for Dimensions {
    fn from(audit: Audit) -> Self {
        Self {
            harmonic_dimension: audit.harmonic,
            degrees_of_freedom: DegreesOfFreedom {
                total: audit.degrees_of_freedom,
                mixed: audit.mixed,
                conforming: audit.conforming,
                nonconforming: audit.nonconforming,
            },
        }
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Audit {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        Dimensions::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        Dimensions::json_schema(generator)
    }
}
