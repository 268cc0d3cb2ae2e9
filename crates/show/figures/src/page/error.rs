//! Why data do not make a page.

/// What is wrong with the data of a page. `what` names the field.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// A number that is none, or infinite.
    #[error("{what} has the value {value} at place {index}; only finite numbers can be drawn")]
    NonFinite {
        /// The field.
        what: &'static str,
        /// Which of its numbers.
        index: usize,
        /// What it is.
        value: f64,
    },
    /// A lower end above its upper end.
    #[error(
        "{what} has the ends {lower} and {upper} at place {index}; the lower one must not be above the upper one"
    )]
    Crossed {
        /// The field.
        what: &'static str,
        /// Which of its intervals.
        index: usize,
        /// Its lower end.
        lower: f64,
        /// Its upper end.
        upper: f64,
    },
    /// Arrays that belong together and differ in length.
    #[error("{what} has {found} entries, and {expected} are expected")]
    Length {
        /// The field.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A face that the mesh does not have.
    #[error("{what} names face {face} at place {index}, and there are {faces} faces")]
    NoSuchFace {
        /// The field.
        what: &'static str,
        /// Which of its entries.
        index: usize,
        /// The face named.
        face: u32,
        /// How many faces there are.
        faces: usize,
    },
    /// Places that must increase and do not.
    #[error("{what} does not increase at place {index}: {value} follows {before}")]
    NotIncreasing {
        /// The field.
        what: &'static str,
        /// The first place that is too low.
        index: usize,
        /// The value there.
        value: f64,
        /// The value before it.
        before: f64,
    },
    /// A mesh without triangles.
    #[error("mesh {mesh} has no triangles to draw")]
    NoTriangles {
        /// 0 for the first.
        mesh: usize,
    },
    /// Something that the page does not have: its id came from another page.
    #[error("the page has no {what} {index}: there are {count}")]
    Unknown {
        /// What it is.
        what: &'static str,
        /// Which one.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// Something that belongs to another mesh or space than what it is shown on.
    #[error("the {what} belongs to another {of} than it is shown with")]
    Apart {
        /// What it is.
        what: &'static str,
        /// What it does not belong to.
        of: &'static str,
    },
    /// Nothing was measured.
    #[error("there is nothing to show: no values were given")]
    NothingToShow,
}

/// That all of these are finite.
pub(super) fn check_finite<'a>(
    what: &'static str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), PageError> {
    match values.into_iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((index, &value)) => Err(PageError::NonFinite { what, index, value }),
        None => Ok(()),
    }
}

/// That all of these are intervals.
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

/// That there are as many as expected.
pub(super) fn check_length(what: &'static str, found: usize, expected: usize) -> Result<(), PageError> {
    if found == expected { Ok(()) } else { Err(PageError::Length { what, found, expected }) }
}

/// That each is above the one before it.
pub(super) fn check_increasing(what: &'static str, values: &[f64]) -> Result<(), PageError> {
    check_finite(what, values)?;
    match values.windows(2).position(|pair| pair[0] >= pair[1]) {
        Some(i) => {
            Err(PageError::NotIncreasing { what, index: i + 1, value: values[i + 1], before: values[i] })
        }
        None => Ok(()),
    }
}

/// That there are such faces.
pub(super) fn check_faces(what: &'static str, named: &[u32], faces: usize) -> Result<(), PageError> {
    match named.iter().position(|&face| face as usize >= faces) {
        Some(index) => Err(PageError::NoSuchFace { what, index, face: named[index], faces }),
        None => Ok(()),
    }
}
