//! Arrays of numpy as vectors of Rust and back.
//!
//! In: one copy, from the array's own memory straight into the vectors that the library keeps. Out: none, the vector's memory
//! becomes the array's.

use crate::errors::{ArrayError, Raise};
use numpy::ndarray::{ArrayView2, Dimension};
use numpy::{
    Element, IntoPyArray, PyArray, PyArray1, PyArray2, PyArrayDescrMethods, PyArrayMethods, PyReadonlyArray2,
    PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

/// Numbers of a kind, by the letters that numpy has for them.
#[derive(Clone, Copy)]
struct Kind {
    letters: &'static [u8],
    name: &'static str,
}

const NUMBERS: Kind = Kind { letters: b"fiu", name: "real numbers" };
const INTEGERS: Kind = Kind { letters: b"iu", name: "integers" };

/// Whatever numpy makes an array of, as an array of one of the types of numbers, aligned and in the machine's byte order.
fn array<'py>(
    object: &Bound<'py, PyAny>,
    what: &'static str,
    kind: Kind,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    static AS_ARRAY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let as_array = AS_ARRAY.import(object.py(), "numpy", "asarray")?;
    let array = as_array.call1((object,))?.cast_into::<PyUntypedArray>()?;
    let dtype = array.dtype();
    if !kind.letters.contains(&dtype.kind()) {
        let found = dtype.str()?.to_string();
        return Err(ArrayError::Kind { what, found, expected: kind.name }.raise());
    }
    if array.getattr("flags")?.getattr("aligned")?.is_truthy()? {
        return Ok(array);
    }
    Ok(array.call_method0("copy")?.cast_into::<PyUntypedArray>()?)
}

fn with_columns<const N: usize>(
    array: &Bound<'_, PyUntypedArray>,
    what: &'static str,
    expected: &'static str,
) -> PyResult<()> {
    if array.ndim() == 2 && array.shape()[1] == N {
        return Ok(());
    }
    let found = array.getattr("shape")?.str()?.to_string();
    Err(ArrayError::Shape { what, found, expected }.raise())
}

/// The rows of an array whose type of numbers is this one, made into something else each.
fn rows<T: Element + Copy, const N: usize, R>(
    array: &PyReadonlyArray2<'_, T>,
    mut row: impl FnMut(usize, [T; N]) -> PyResult<R>,
) -> PyResult<Vec<R>> {
    let view: ArrayView2<'_, T> = array.as_array();
    // The view knows whether its rows follow each other; a slice of numpy may also run down the columns.
    match view.as_slice() {
        Some(slice) => {
            slice.as_chunks::<N>().0.iter().enumerate().map(|(i, &values)| row(i, values)).collect()
        }
        None => view
            .outer_iter()
            .enumerate()
            .map(|(i, values)| row(i, std::array::from_fn(|j| values[j])))
            .collect(),
    }
}

/// Points or vectors: shape (n, N), any real numbers, each the nearest double.
pub(crate) fn vectors<const N: usize>(
    object: &Bound<'_, PyAny>,
    what: &'static str,
    expected: &'static str,
) -> PyResult<Vec<[f64; N]>> {
    let array = array(object, what, NUMBERS)?;
    with_columns::<N>(&array, what, expected)?;
    let doubles = match array.cast::<PyArray2<f64>>() {
        Ok(doubles) => doubles.try_readonly()?,
        Err(_) => array.call_method1("astype", ("float64",))?.cast_into::<PyArray2<f64>>()?.try_readonly()?,
    };
    rows(&doubles, |_, values| Ok(values))
}

/// Numbers, one for each element: shape (n,), any real numbers.
pub(crate) fn values(object: &Bound<'_, PyAny>, what: &'static str) -> PyResult<Vec<f64>> {
    let array = array(object, what, NUMBERS)?;
    if array.ndim() != 1 {
        let found = array.getattr("shape")?.str()?.to_string();
        return Err(ArrayError::Shape { what, found, expected: "(n,)" }.raise());
    }
    let column = array.call_method1("reshape", (array.len(), 1))?;
    Ok(vectors::<1>(&column, what, "(n,)")?.into_flattened())
}

/// Colours: shape (n, 3), whole numbers from 0 to 255.
pub(crate) fn colors(object: &Bound<'_, PyAny>, what: &'static str) -> PyResult<Vec<[u8; 3]>> {
    let array = array(object, what, Kind { letters: b"u", name: "uint8" })?;
    with_columns::<3>(&array, what, "(n, 3)")?;
    let Ok(bytes) = array.cast::<PyArray2<u8>>() else {
        let found = array.dtype().str()?.to_string();
        return Err(ArrayError::Kind { what, found, expected: "uint8" }.raise());
    };
    rows(&bytes.try_readonly()?, |_, values| Ok(values))
}

/// Faces: shape (m, 3), integers of any type. Indices are checked here only for what 32 bits cannot say.
pub(crate) fn faces(object: &Bound<'_, PyAny>, vertices: usize) -> PyResult<Vec<[u32; 3]>> {
    let array = array(object, "faces", INTEGERS)?;
    with_columns::<3>(&array, "faces", "(m, 3)")?;
    if let Ok(indices) = array.cast::<PyArray2<u32>>() {
        return rows(&indices.try_readonly()?, |_, face| Ok(face));
    }
    if let Ok(indices) = array.cast::<PyArray2<i32>>() {
        return indices_of(&indices.try_readonly()?, vertices);
    }
    if let Ok(indices) = array.cast::<PyArray2<u64>>() {
        return indices_of(&indices.try_readonly()?, vertices);
    }
    if let Ok(indices) = array.cast::<PyArray2<i64>>() {
        return indices_of(&indices.try_readonly()?, vertices);
    }
    let wide = array.call_method1("astype", ("int64",))?.cast_into::<PyArray2<i64>>()?;
    indices_of(&wide.try_readonly()?, vertices)
}

fn indices_of<T>(array: &PyReadonlyArray2<'_, T>, vertices: usize) -> PyResult<Vec<[u32; 3]>>
where
    T: Element + Copy + TryInto<u32> + Into<i128>,
{
    rows(array, |face, corners: [T; 3]| {
        let mut indices = [0; 3];
        for (index, corner) in indices.iter_mut().zip(corners) {
            *index = corner
                .try_into()
                .map_err(|_| ArrayError::Index { face, index: corner.into(), vertices }.raise())?;
        }
        Ok(indices)
    })
}

/// An array of shape (n, N) on the vector's memory. It is read-only: what is written to an answer, or to a copy of what a mesh holds, would reach
/// nothing.
pub(crate) fn array_of_rows<T: Element, const N: usize>(
    py: Python<'_>,
    rows: Vec<[T; N]>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let count = rows.len();
    read_only(rows.into_flattened().into_pyarray(py).reshape([count, N])?)
}

/// An array of shape (n,) on the vector's memory, read-only.
pub(crate) fn array_of<T: Element>(py: Python<'_>, values: Vec<T>) -> PyResult<Bound<'_, PyArray1<T>>> {
    read_only(values.into_pyarray(py))
}

fn read_only<T: Element, D: Dimension>(
    array: Bound<'_, PyArray<T, D>>,
) -> PyResult<Bound<'_, PyArray<T, D>>> {
    array.try_readwrite()?.make_nonwriteable();
    Ok(array)
}

/// A square array on the vector's memory, read-only.
pub(crate) fn array_of_square<T: Element>(
    py: Python<'_>,
    entries: Vec<T>,
    count: usize,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    read_only(entries.into_pyarray(py).reshape([count, count])?)
}
