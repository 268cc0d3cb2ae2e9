//! One value for each element of a mesh.

use super::{FaceId, VertexId};
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Index, IndexMut};

/// A typed index of one kind of element: faces, vertices, edges.
pub trait ElementId: Copy {
    /// The name of such an element in messages: `"face"`.
    const NAME: &'static str;

    /// The element with this index.
    fn from_index(index: usize) -> Self;

    /// The index as an array subscript.
    fn as_index(self) -> usize;
}

/// Implements [`ElementId`] for tuple structs around a `u32`: `element_ids! { FaceId: "face" }`.
#[macro_export]
#[doc(hidden)]
macro_rules! element_ids {
    ($($id:ident: $name:literal),+ $(,)?) => {$(
        impl $crate::mesh::ElementId for $id {
            const NAME: &'static str = $name;

            #[inline]
            fn from_index(index: usize) -> Self {
                Self(index as u32)
            }

            #[inline]
            fn as_index(self) -> usize {
                self.0 as usize
            }
        }
    )+};
}

element_ids! { FaceId: "face", VertexId: "vertex" }

/// One value for each element of a kind, in the order of their indices.
///
/// Only the typed index of its elements subscripts it, so that values at vertices cannot be mistaken for values on faces. It derefs
/// to the slice of its values. The number of values is fixed.
///
/// # Shapes and units
/// A vector of `T`, without any overhead; conversion from and to vectors copies nothing.
/// # Example
/// ```
/// use pompeiu_core::mesh::{FaceData, VertexData};
/// use pompeiu_core::mesh::shapes::icosphere;
/// use pompeiu_core::VertexId;
///
/// let mesh = icosphere(1.0, 1)?;
/// let heights = VertexData::from_fn(mesh.positions().len(), |v| mesh.positions()[v.index()][2]);
/// let ranges = FaceData::from_fn(mesh.faces().len(), |face| {
///     let [a, b, c] = mesh.faces()[face.index()].map(|v| heights[VertexId(v)]);
///     a.max(b).max(c) - a.min(b).min(c)
/// });
/// assert!(ranges.iter().all(|&range| range < 1.0));
/// let error = FaceData::new(mesh.faces().len(), vec![0.0; 7]).unwrap_err();
/// assert_eq!(error.to_string(), "found 7 values, expected 80, one for each face");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct ElementData<I, T> {
    values: Vec<T>,
    id: PhantomData<fn(I)>,
}

/// One value for each face.
pub type FaceData<T> = ElementData<FaceId, T>;

/// One value for each vertex.
pub type VertexData<T> = ElementData<VertexId, T>;

/// There are too many or too few values for the elements of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("found {found} values, expected {expected}, one for each {element}")]
pub struct DataLengthError {
    /// What an element is called: `"face"`.
    pub element: &'static str,
    /// How many values there are.
    pub found: usize,
    /// How many elements there are.
    pub expected: usize,
}

impl<I: ElementId, T> ElementData<I, T> {
    /// Takes ownership of one value per element.
    ///
    /// # Errors
    /// [`DataLengthError`] if there is not one value for each element.
    pub fn new(elements: usize, values: Vec<T>) -> Result<Self, DataLengthError> {
        let found = values.len();
        if found == elements {
            Ok(Self { values, id: PhantomData })
        } else {
            Err(DataLengthError { element: I::NAME, found, expected: elements })
        }
    }

    /// The value that a function gives to each element.
    pub fn from_fn(elements: usize, value: impl FnMut(I) -> T) -> Self {
        Self { values: (0..elements).map(I::from_index).map(value).collect(), id: PhantomData }
    }

    /// The value that a function gives to each element, or its first error.
    ///
    /// # Errors
    /// Those of the function.
    pub fn try_from_fn<E>(elements: usize, value: impl FnMut(I) -> Result<T, E>) -> Result<Self, E> {
        let values = (0..elements).map(I::from_index).map(value).collect::<Result<_, E>>()?;
        Ok(Self { values, id: PhantomData })
    }

    /// The same value for all elements.
    pub fn filled(elements: usize, value: T) -> Self
    where
        T: Clone,
    {
        Self { values: vec![value; elements], id: PhantomData }
    }

    /// The elements, in order.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = I> + use<I, T> {
        (0..self.values.len()).map(I::from_index)
    }

    /// The elements with their values, in order.
    pub fn entries(&self) -> impl ExactSizeIterator<Item = (I, &T)> {
        self.values.iter().enumerate().map(|(i, value)| (I::from_index(i), value))
    }

    /// The value of an element, `None` if it does not exist.
    pub fn value(&self, id: I) -> Option<&T> {
        self.values.get(id.as_index())
    }

    /// Applies a function to every value.
    pub fn map<U>(&self, value: impl FnMut(&T) -> U) -> ElementData<I, U> {
        ElementData { values: self.values.iter().map(value).collect(), id: PhantomData }
    }
}

impl<I, T> ElementData<I, T> {
    /// The values, in order.
    pub fn as_slice(&self) -> &[T] {
        &self.values
    }

    /// The values, in order.
    pub fn as_mut_slice(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// The values as a vector, without copying.
    pub fn into_vec(self) -> Vec<T> {
        self.values
    }
}

impl<I: ElementId, T> Index<I> for ElementData<I, T> {
    type Output = T;

    #[inline]
    fn index(&self, id: I) -> &T {
        &self.values[id.as_index()]
    }
}

impl<I: ElementId, T> IndexMut<I> for ElementData<I, T> {
    #[inline]
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.values[id.as_index()]
    }
}

impl<I, T> Deref for ElementData<I, T> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        &self.values
    }
}

impl<I, T> DerefMut for ElementData<I, T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.values
    }
}

impl<I, T> IntoIterator for ElementData<I, T> {
    type Item = T;
    type IntoIter = std::vec::IntoIter<T>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.into_iter()
    }
}

impl<'d, I, T> IntoIterator for &'d ElementData<I, T> {
    type Item = &'d T;
    type IntoIter = std::slice::Iter<'d, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.iter()
    }
}

impl<'d, I, T> IntoIterator for &'d mut ElementData<I, T> {
    type Item = &'d mut T;
    type IntoIter = std::slice::IterMut<'d, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.iter_mut()
    }
}

// Written by hand, because derived implementations would demand the traits of the index type as well.
impl<I, T: Clone> Clone for ElementData<I, T> {
    fn clone(&self) -> Self {
        Self { values: self.values.clone(), id: PhantomData }
    }
}

impl<I, T: PartialEq> PartialEq for ElementData<I, T> {
    fn eq(&self, other: &Self) -> bool {
        self.values == other.values
    }
}

impl<I, T: fmt::Debug> fmt::Debug for ElementData<I, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.values.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_of_their_elements() {
        let mut data = FaceData::from_fn(4, |face| 10 * face.0);
        assert_eq!(data[FaceId(3)], 30);
        data[FaceId(1)] += 1;
        let entries: Vec<_> = data.entries().map(|(face, &value)| (face.0, value)).collect();
        assert_eq!(entries, [(0, 0), (1, 11), (2, 20), (3, 30)]);
        assert_eq!((data.value(FaceId(2)), data.value(FaceId(4))), (Some(&20), None));
        assert_eq!(data.map(|x| x / 10).into_vec(), [0, 1, 2, 3]);
        assert_eq!(data.ids().len(), data.len());
        let values = data.clone().into_vec();
        let place = values.as_ptr();
        let again = FaceData::new(4, values).unwrap();
        assert_eq!(again, data);
        assert_eq!(again.as_ptr(), place, "nothing is copied");
    }

    #[test]
    fn the_wrong_number_of_values_is_refused() {
        let error = VertexData::new(3, vec![1.0; 4]).unwrap_err();
        assert_eq!(error, DataLengthError { element: "vertex", found: 4, expected: 3 });
        assert_eq!(VertexData::filled(2, 0.5).as_slice(), [0.5; 2]);
        let first = VertexData::try_from_fn(5, |v| if v.0 < 2 { Ok(v.0) } else { Err(v) });
        assert_eq!(first.unwrap_err(), VertexId(2));
    }
}
