//! Moving one mesh onto the other before they are compared.

use crate::align::{AlignError, Fixed, Registration, RegistrationOptions, register};
use pompeiu_core::mesh::transform;
use pompeiu_core::run::{Limits, RunContext};
use pompeiu_core::{MeshError, TriMesh};
use pompeiu_hausdorff::{DeviationRequestError, OptionError};
use serde::{Deserialize, Serialize};

/// The alignment of B before it is compared with A.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum MovedFirst {
    /// Rotate and translate.
    Rigid,
}

/// Why two meshes cannot be compared as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// B cannot be moved onto A.
    #[error(transparent)]
    Align(#[from] AlignError),
    /// The moved mesh leaves the range of coordinates.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// An option makes no sense.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// The deviation cannot be measured as asked.
    #[error(transparent)]
    Deviation(#[from] DeviationRequestError),
}

/// B as it is compared with A: moved onto it if that is asked for. The memory of the search for the place is not limited.
///
/// # Errors
/// [`RequestError::Align`] and [`RequestError::Mesh`].
pub fn moved(
    how: Option<MovedFirst>,
    [a, b]: [&TriMesh; 2],
    context: &RunContext<'_>,
) -> Result<Option<(TriMesh, Registration)>, RequestError> {
    let Some(MovedFirst::Rigid) = how else { return Ok(None) };
    let options = RegistrationOptions {
        limits: Limits { memory: None, ..context.limits() },
        progress: context.progress(),
        ..RegistrationOptions::default()
    };
    let found = register(b, &Fixed::new(a)?, &options)?;
    Ok(Some((transform(b, &found.map())?, found)))
}
