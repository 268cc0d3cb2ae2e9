//! Truncated hierarchical cubic splines over the patches of a mesh, refined locally.

mod extraction;
mod fields;
mod level;

use crate::{BezierMesh, CORNERS_OF_64, UnstructuredSplines};
use level::{Level, Marks, Status};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

pub use level::{HierarchicalElement, MOST_LEVELS};

/// Estimated memory per function of a level, active or not: its key and its places in patches, in bytes.
pub const BYTES_PER_FUNCTION: usize = 200;

/// Spline functions over the patches of a mesh, on elements that are halved where they are marked.
///
/// # Definition
/// The functions of [`SplineSpace`](crate::SplineSpace) with `elements`, 2 `elements`, 4 `elements` … along each axis of each patch
/// are the levels of a hierarchy. A function of a level is active if its support lies in the refined elements of the coarser level,
/// but not in the refined elements of its own level. Active functions are truncated: expressed in functions of the next level, they
/// lose the terms whose support is refined; this is repeated for all finer levels. Supports extend across patches, so elements at
/// extraordinary edges are refined like any others.
///
/// Marking an element refines the elements in the supports of all its functions, and as many around them as nested levels need:
/// inside the marked element, all functions of the next level exist. Mark elements again for more levels.
/// # Accuracy
/// The functions are nonnegative, add up to one, and are linearly independent. The space contains the spaces that it was refined
/// from. Where elements were marked, its order of approximation is that of [`SplineSpace`](crate::SplineSpace) with the elements
/// there.
/// # Cost
/// Linear in the number of active elements, and in the number of elements of each level in the patches that have such elements and
/// in the adjacent patches.
/// # Limits
/// At most [`MOST_LEVELS`] levels: elements of the last one are not refined.
/// # Source
/// Active functions and their linear independence: `vuong_hierarchical_2011`. Truncation: `giannelli_thbsplines_2012`. Several
/// patches: `garau_algorithms_2018`.
#[derive(Clone, Debug)]
pub struct HierarchicalSplines {
    levels: Vec<Level>,
    elements: Vec<HierarchicalElement>,
    /// For each function an active element of its level near the middle of its support, and the index of the function among the 64
    /// there.
    homes: Vec<(u32, u8)>,
    /// The functions of each level.
    counts: Vec<usize>,
}

impl HierarchicalSplines {
    /// The unrefined space with this many elements, at least one, along each axis of each patch.
    pub fn new(mesh: &BezierMesh, elements: usize) -> Self {
        Self::build(mesh, elements, &[])
    }

    /// The space after refining the elements with these numbers. Elements that do not exist or are of the last level are skipped.
    #[must_use]
    pub fn refined(&self, mesh: &BezierMesh, marked: &[usize]) -> Self {
        Self::build(mesh, self.along(0), &self.marks(marked))
    }

    /// The number of functions of all levels, active or not, that have to be numbered for this refinement; each takes about
    /// [`BYTES_PER_FUNCTION`].
    pub fn functions_to_number(&self, mesh: &BezierMesh, marked: &[usize]) -> usize {
        let around = patches_around(mesh);
        let of = |(number, marks): (usize, &Marks)| {
            let along = self.along(0) << (number + 1);
            patches_with(mesh, marks, &around).len().saturating_mul((along + 3).pow(3))
        };
        let finer = self.marks(marked).iter().enumerate().map(of).fold(0, usize::saturating_add);
        finer.saturating_add(mesh.cells().len().saturating_mul((self.along(0) + 3).pow(3)))
    }

    /// The refined elements of each level after this refinement.
    fn marks(&self, marked: &[usize]) -> Vec<Marks> {
        let mut marks: Vec<Marks> = self.levels.iter().map(Level::refined).collect();
        for (level, marks) in self.levels.iter().zip(&mut marks).take(MOST_LEVELS - 1) {
            let of_level = marked.iter().filter_map(|&k| self.elements.get(k));
            let places = of_level.filter(|element| usize::from(element.level) == level.number);
            level.extend(places.map(|element| (element.patch, element.place.map(usize::from))), marks);
        }
        for level in (1..marks.len()).rev() {
            let (coarse, fine) = marks.split_at_mut(level);
            let along = self.along(level);
            for (&patch, cells) in &fine[0] {
                let parents =
                    coarse[level - 1].entry(patch).or_insert_with(|| vec![false; (along / 2).pow(3)]);
                for cell in (0..cells.len()).filter(|&cell| cells[cell]) {
                    let [i, j, k] = level::place(cell, along).map(|x| x / 2);
                    parents[i + along / 2 * (j + along / 2 * k)] = true;
                }
            }
        }
        marks.retain(|marks| !marks.is_empty());
        marks
    }

    fn build(mesh: &BezierMesh, elements: usize, marks: &[Marks]) -> Self {
        let around = if marks.is_empty() { BTreeMap::new() } else { patches_around(mesh) };
        let (mut levels, mut counts): (Vec<Level>, Vec<usize>) = (Vec::new(), Vec::new());
        let mut first = 0;
        for number in 0..=marks.len() {
            let parents = number.checked_sub(1).map(|coarser| &marks[coarser]);
            let patches: BTreeSet<u32> = match parents {
                None => (0..mesh.cells().len() as u32).collect(),
                Some(parents) => patches_with(mesh, parents, &around),
            };
            let level = Level::new(mesh, number, elements, &patches, (parents, marks.get(number)), first);
            let count = level.active();
            first += count as u32;
            counts.push(count);
            levels.push(level);
        }
        let mut found = Self { levels, elements: Vec::new(), homes: Vec::new(), counts };
        for level in &mut found.levels {
            let elements = level.number_elements(found.elements.len() as u32);
            found.elements.extend(elements);
        }
        found.homes = found.find_homes(first as usize);
        found
    }

    /// For each function the element of its level nearest to the middle of its support.
    fn find_homes(&self, functions: usize) -> Vec<(u32, u8)> {
        let mut homes = vec![(0, 0); functions];
        let mut offs = vec![u8::MAX; functions];
        for (number, element) in self.elements.iter().enumerate() {
            let level = &self.levels[usize::from(element.level)];
            for (k, function) in
                level.on(element.patch, element.place.map(usize::from)).into_iter().enumerate()
            {
                let Status::Active(function) = level.status[function as usize] else { continue };
                // In halves of an element: along an axis, the middles of the first and the last of the four functions are three
                // away from the element's.
                let off = [k % 4, k / 4 % 4, k / 16].map(|i| [3, 1, 1, 3][i]).iter().sum();
                if off < offs[function as usize] {
                    offs[function as usize] = off;
                    homes[function as usize] = (number as u32, k as u8);
                }
            }
        }
        homes
    }

    /// Elements of a level along each axis of a patch.
    fn along(&self, level: usize) -> usize {
        self.levels[level].along()
    }

    /// Number of functions.
    pub fn functions(&self) -> usize {
        self.homes.len()
    }

    /// Functions of each level, numbered consecutively from the coarsest level on.
    pub fn functions_of_levels(&self) -> &[usize] {
        &self.counts
    }

    /// The elements, ordered by level, patch and position, coarsest first.
    pub fn elements(&self) -> &[HierarchicalElement] {
        &self.elements
    }

    /// Elements of each level.
    pub fn elements_of_levels(&self) -> Vec<usize> {
        let mut counts = vec![0; self.levels.len()];
        for element in &self.elements {
            counts[usize::from(element.level)] += 1;
        }
        counts
    }

    /// The interval of an element along each axis of its patch, from 0 to 1.
    ///
    /// # Panics
    /// If the element is of a level that does not exist.
    pub fn intervals(&self, element: &HierarchicalElement) -> [[f64; 2]; 3] {
        let along = self.along(element.level.into()) as f64;
        element.place.map(|i| [f64::from(i) / along, (f64::from(i) + 1.0) / along])
    }

    /// The functions that do not vanish in each element, with their Bézier coefficients there. An element is regular if all of
    /// these functions are translates of one function.
    pub fn extraction(&self) -> UnstructuredSplines {
        let of = |element| self.splines_of(element);
        UnstructuredSplines::from_cells((0..self.elements.len()).into_par_iter().map(of).collect())
    }
}

/// Patches with marked elements, and the patches that touch them.
fn patches_with(mesh: &BezierMesh, marks: &Marks, around: &BTreeMap<u32, Vec<u32>>) -> BTreeSet<u32> {
    let corners = marks.keys().flat_map(|&patch| CORNERS_OF_64.map(|k| mesh.cells()[patch as usize][k]));
    corners.flat_map(|vertex| around.get(&vertex).into_iter().flatten().copied()).collect()
}

/// For each corner of a patch the patches around it.
fn patches_around(mesh: &BezierMesh) -> BTreeMap<u32, Vec<u32>> {
    let mut around: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (patch, cell) in mesh.cells().iter().enumerate() {
        for k in CORNERS_OF_64 {
            around.entry(cell[k]).or_default().push(patch as u32);
        }
    }
    around
}
