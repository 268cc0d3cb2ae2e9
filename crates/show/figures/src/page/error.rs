//! Errors in the data of a page.

/// Why data cannot be part of a page. `what` names the field.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// A number is NaN or infinite.
    #[error("{what} has the value {value} at place {index}; only finite numbers can be drawn")]
    NonFinite {
        /// The field.
        what: &'static str,
        /// The index of the number.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// An interval has a lower end above its upper end.
    #[error(
        "{what} has the ends {lower} and {upper} at place {index}; the lower one must not be above the upper one"
    )]
    Crossed {
        /// The field.
        what: &'static str,
        /// The index of the interval.
        index: usize,
        /// Its lower end.
        lower: f64,
        /// Its upper end.
        upper: f64,
    },
    /// Arrays that belong together differ in length.
    #[error("{what} has {found} entries, and {expected} are expected")]
    Length {
        /// The field.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A face does not exist in the mesh.
    #[error("{what} names face {face} at place {index}, and there are {faces} faces")]
    NoSuchFace {
        /// The field.
        what: &'static str,
        /// The index of the entry.
        index: usize,
        /// The face named.
        face: u32,
        /// How many faces there are.
        faces: usize,
    },
    /// Numbers that must increase do not.
    #[error("{what} does not increase at place {index}: {value} follows {before}")]
    NotIncreasing {
        /// The field.
        what: &'static str,
        /// The first number that does not increase.
        index: usize,
        /// Its value.
        value: f64,
        /// The number before it.
        before: f64,
    },
    /// A mesh has no triangles.
    #[error("mesh {mesh} has no triangles to draw")]
    NoTriangles {
        /// The index of the mesh, from 0.
        mesh: usize,
    },
    /// An id refers to a part that the page does not have: it came from another page.
    #[error("the page has no {what} {index}: there are {count}")]
    Unknown {
        /// The kind of part.
        what: &'static str,
        /// Its index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A part belongs to another mesh or space than the one it is shown with.
    #[error("the {what} belongs to another {of} than it is shown with")]
    Apart {
        /// The kind of part.
        what: &'static str,
        /// The kind of owner.
        of: &'static str,
    },
    /// There is nothing to show.
    #[error("there is nothing to show: no values were given")]
    NothingToShow,
}

/// Checks that all numbers are finite.
pub(super) fn check_finite<'a>(
    what: &'static str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), PageError> {
    match values.into_iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((index, &value)) => Err(PageError::NonFinite { what, index, value }),
        None => Ok(()),
    }
}

/// Checks that all intervals are valid.
pub(super) fn check_bounds<'a>(
    what: &'static str,
    bounds: impl IntoIterator<Item = &'a [f64; 2]>,
) -> Result<(), PageError> {
    for (index, &[lower, upper]) in bounds.into_iter().enumerate() {
        for value in [lower, upper] {
            if !value.is_finite() {
                return Err(PageError::NonFinite { what, index, value });
            }
        }
        if lower > upper {
            return Err(PageError::Crossed { what, index, lower, upper });
        }
    }
    Ok(())
}

/// Checks the length of an array.
pub(super) fn check_length(what: &'static str, found: usize, expected: usize) -> Result<(), PageError> {
    if found == expected { Ok(()) } else { Err(PageError::Length { what, found, expected }) }
}

/// Checks that numbers increase strictly.
pub(super) fn check_increasing(what: &'static str, values: &[f64]) -> Result<(), PageError> {
    check_finite(what, values)?;
    match values.windows(2).position(|pair| pair[0] >= pair[1]) {
        Some(i) => {
            Err(PageError::NotIncreasing { what, index: i + 1, value: values[i + 1], before: values[i] })
        }
        None => Ok(()),
    }
}

/// Checks that all faces exist.
pub(super) fn check_faces(what: &'static str, named: &[u32], faces: usize) -> Result<(), PageError> {
    match named.iter().position(|&face| face as usize >= faces) {
        Some(index) => Err(PageError::NoSuchFace { what, index, face: named[index], faces }),
        None => Ok(()),
    }
}
