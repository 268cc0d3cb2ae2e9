//! Meshes of solid cells, hexahedra or tetrahedra.

use crate::error::{FormatError, Location};

/// The solid cells of a file, of `N` corners each; only the indices are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Solids<const N: usize> {
    /// Places of vertices.
    pub positions: Vec<[f64; 3]>,
    /// Cells by their corners in the order of VTK.
    pub cells: Vec<[u32; N]>,
    /// The point data named `label`, if there is any.
    pub labels: Option<Vec<f64>>,
}

/// Hexahedra: four vertices around the bottom, counter-clockwise seen from above, and the four above them.
pub type Hexahedra = Solids<8>;

/// Tetrahedra: three vertices counter-clockwise seen from the fourth one.
pub type Tetrahedra = Solids<4>;

/// What a cell of a type of VTK is called, for sentences.
fn called(kind: u64) -> String {
    let name = match kind {
        10 => "a tetrahedron",
        11 => "a voxel",
        12 => "a hexahedron",
        13 => "a wedge",
        14 => "a pyramid",
        15 => "a pentagonal prism",
        16 => "a hexagonal prism",
        21..=23 | 34 | 69 | 70 => "a curved line or face",
        24 => "a tetrahedron of ten points",
        25 => "a hexahedron of twenty points",
        29 => "a hexahedron of twenty-seven points",
        42 => "a polyhedron",
        71 | 78 => "a tetrahedron of higher order",
        72 | 79 => "a hexahedron of higher order",
        _ => "a cell",
    };
    format!("{name} (VTK's type {kind})")
}

/// The corners of a cell of a type of VTK in the order of VTK's cell with so many corners; none for other cells.
fn order(corners: usize, kind: u64) -> Option<&'static [usize]> {
    Some(match (corners, kind) {
        (4, 10) => &[0, 1, 2, 3],
        // Voxels have their corners in lexicographic order.
        (8, 11) => &[0, 1, 3, 2, 4, 5, 7, 6],
        (8, 12) => &[0, 1, 2, 3, 4, 5, 6, 7],
        _ => return None,
    })
}

impl<const N: usize> Default for Solids<N> {
    fn default() -> Self {
        Self { positions: Vec::new(), cells: Vec::new(), labels: None }
    }
}

impl<const N: usize> Solids<N> {
    /// What its cells are called, for sentences: one, and many with their number in VTK.
    const NAMES: [&'static str; 2] =
        if N == 4 { ["tetrahedron", "tetrahedra (10)"] } else { ["hexahedron", "hexahedra (12)"] };

    /// What to do about other cells.
    const REMEDY: &'static str = if N == 4 {
        "; split the cells into tetrahedra, for example with ParaView's filter Tetrahedralize or PyVista's triangulate()"
    } else {
        ""
    };

    /// Adds the solid cells of a list; corners are relative to the points from `base` on.
    pub(crate) fn add(
        &mut self,
        base: usize,
        (corners, ends): (&[u64], &[u64]),
        types: &[u64],
    ) -> Result<(), FormatError> {
        let points = (self.positions.len() - base) as u64;
        let [name, names] = Self::NAMES;
        let mut begin = 0;
        for (cell, (&end, &kind)) in ends.iter().zip(types).enumerate() {
            let wrong = |problem: String| FormatError::new(Location::Face(cell as u64), problem);
            let list =
                usize::try_from(end).ok().and_then(|end| corners.get(begin..end)).ok_or_else(|| {
                    wrong(format!("its corners end at {end}, expected {begin} to {}", corners.len()))
                })?;
            begin += list.len();
            if kind <= 9 {
                continue;
            }
            let order = order(N, kind)
                .ok_or_else(|| wrong(format!("{}, expected {names}{}", called(kind), Self::REMEDY)))?;
            let list: [u64; N] = list
                .try_into()
                .map_err(|_| wrong(format!("a {name} with {} corners, expected {N}", list.len())))?;
            if let Some(corner) = list.iter().find(|corner| **corner >= points) {
                return Err(wrong(format!(
                    "corner {corner}, but there are {points} points (the first is 0)"
                )));
            }
            self.cells.push(std::array::from_fn(|k| (list[order[k]] + base as u64) as u32));
        }
        Ok(())
    }
}
