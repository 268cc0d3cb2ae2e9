//! One level of a hierarchy: the functions and elements of one size.

use crate::knots::OpenKnots;
use crate::{BezierMesh, CORNERS_OF_64, Refinement};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

/// Largest number of levels in a hierarchy.
pub const MOST_LEVELS: usize = 6;

/// An element that is not refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HierarchicalElement {
    /// How often it was halved.
    pub level: u8,
    /// The patch.
    pub patch: u32,
    /// Its position among the elements of the level in the patch.
    pub place: [u16; 3],
}

/// The refined elements of a level, for each patch that has some.
pub(super) type Marks = BTreeMap<u32, Vec<bool>>;

/// The status of a function of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Status {
    /// Its support is not contained in the refined elements of the coarser level.
    Outside,
    /// It is active, with this number in the hierarchy.
    Active(u32),
    /// All elements of its support are refined.
    Covered,
}

#[derive(Clone, Debug)]
pub(super) struct Level {
    pub(super) number: usize,
    pub(super) knots: OpenKnots,
    pub(super) status: Vec<Status>,
    /// Patches with elements of the level, and the patches around them.
    patches: BTreeMap<u32, Patch>,
}

#[derive(Clone, Debug)]
struct Patch {
    /// Numbers of the level's functions, the first axis fastest.
    functions: Vec<u32>,
    /// For each element, whether the coarser element that contains it is refined.
    is_inside: Vec<bool>,
    /// For each element, whether it is refined itself; empty if none is.
    is_refined: Vec<bool>,
    /// For each active element, its number in the hierarchy.
    numbers: Vec<u32>,
}

/// Marks an element without a number.
pub(super) const NONE: u32 = u32::MAX;

/// The position along each axis of an element, with `along` elements on each.
pub(super) fn place(element: usize, along: usize) -> [usize; 3] {
    [element % along, element / along % along, element / along / along]
}

/// The elements along an axis in which a function does not vanish.
fn support(function: usize, along: usize) -> RangeInclusive<usize> {
    function.saturating_sub(3)..=function.min(along - 1)
}

impl Level {
    /// The level with this number in some patches; `first` is the number of its first active function.
    pub(super) fn new(
        mesh: &BezierMesh,
        number: usize,
        elements: usize,
        patches: &BTreeSet<u32>,
        (parents, refined): (Option<&Marks>, Option<&Marks>),
        first: u32,
    ) -> Self {
        let knots = OpenKnots::new(elements.max(1) << number);
        let along = knots.elements();
        let mut lattice = Refinement::new(along + 2);
        let of = |&patch: &u32| {
            let functions = lattice.lattice(CORNERS_OF_64.map(|k| mesh.cells()[patch as usize][k]));
            let parents = parents.map(|parents| parents.get(&patch));
            let is_inside = (0..along.pow(3)).map(|element| {
                let [i, j, k] = place(element, along).map(|x| x / 2);
                let half = along / 2;
                parents.is_none_or(|flags| flags.is_some_and(|flags| flags[i + half * (j + half * k)]))
            });
            let is_inside = is_inside.collect();
            let is_refined = refined.and_then(|refined| refined.get(&patch)).cloned().unwrap_or_default();
            (patch, Patch { functions, is_inside, is_refined, numbers: Vec::new() })
        };
        let patches = patches.iter().map(of).collect();
        let mut level = Self { number, knots, status: Vec::new(), patches };
        level.status = level.statuses(lattice.keys().len(), first);
        level
    }

    /// Elements along each axis of a patch.
    pub(super) fn along(&self) -> usize {
        self.knots.elements()
    }

    fn statuses(&self, functions: usize, first: u32) -> Vec<Status> {
        let (mut is_inside, mut is_covered) = (vec![true; functions], vec![true; functions]);
        for patch in self.patches.values() {
            for (at, &function) in patch.functions.iter().enumerate() {
                let function = function as usize;
                let mut support = self.support(at);
                is_inside[function] &= support.clone().all(|element| patch.is_inside[element]);
                is_covered[function] &=
                    !patch.is_refined.is_empty() && support.all(|element| patch.is_refined[element]);
            }
        }
        let mut next = first;
        let status = |(is_inside, is_covered): (bool, bool)| match (is_inside, is_covered) {
            (false, _) => Status::Outside,
            (true, true) => Status::Covered,
            (true, false) => {
                next += 1;
                Status::Active(next - 1)
            }
        };
        is_inside.into_iter().zip(is_covered).map(status).collect()
    }

    /// The elements of a patch in which a function does not vanish; the function is given by its position in the patch.
    fn support(&self, function: usize) -> impl Iterator<Item = usize> + Clone + use<> {
        let along = self.along();
        let [a, b, c] = place(function, along + 3).map(|i| support(i, along));
        c.flat_map(move |k| {
            let a = a.clone();
            b.clone().flat_map(move |j| a.clone().map(move |i| i + along * (j + along * k)))
        })
    }

    /// Number of active functions.
    pub(super) fn active(&self) -> usize {
        self.status.iter().filter(|status| matches!(status, Status::Active(_))).count()
    }

    /// The elements that are refined.
    pub(super) fn refined(&self) -> Marks {
        let patches = self.patches.iter().filter(|(_, patch)| !patch.is_refined.is_empty());
        patches.map(|(&number, patch)| (number, patch.is_refined.clone())).collect()
    }

    /// Marks the supports of all functions of some elements as refined.
    pub(super) fn extend(&self, elements: impl Iterator<Item = (u32, [usize; 3])>, marks: &mut Marks) {
        let mut is_touched = vec![false; self.status.len()];
        let mut any = false;
        for (patch, place) in elements {
            any = true;
            for function in self.on(patch, place) {
                is_touched[function as usize] = true;
            }
        }
        if !any {
            return;
        }
        for (&number, patch) in &self.patches {
            let touched = patch.functions.iter().enumerate().filter(|(_, f)| is_touched[**f as usize]);
            for (at, _) in touched {
                let marks = marks.entry(number).or_insert_with(|| vec![false; self.along().pow(3)]);
                self.support(at).for_each(|element| marks[element] = true);
            }
        }
    }

    /// Numbers the active elements and returns them.
    pub(super) fn number_elements(&mut self, next: u32) -> Vec<HierarchicalElement> {
        let (along, level) = (self.along(), self.number as u8);
        let mut list = Vec::new();
        for (&number, patch) in &mut self.patches {
            patch.numbers = vec![NONE; along.pow(3)];
            for (element, number_of) in patch.numbers.iter_mut().enumerate() {
                let is_refined = patch.is_refined.get(element).copied().unwrap_or(false);
                if patch.is_inside[element] && !is_refined {
                    *number_of = next + list.len() as u32;
                    let place = place(element, along).map(|i| i as u16);
                    list.push(HierarchicalElement { level, patch: number, place });
                }
            }
        }
        list
    }

    /// The number of an active element.
    pub(super) fn element(&self, patch: u32, [i, j, k]: [usize; 3]) -> Option<u32> {
        let along = self.along();
        let number = self.patches.get(&patch)?.numbers.get(i + along * (j + along * k))?;
        Some(*number).filter(|number| *number != NONE)
    }

    /// The functions of the level in an element, the first axis fastest.
    pub(super) fn on(&self, patch: u32, [i, j, k]: [usize; 3]) -> [u32; 64] {
        let m = self.along() + 3;
        let functions = &self.patches[&patch].functions;
        std::array::from_fn(|l| functions[i + l % 4 + m * (j + l / 4 % 4 + m * (k + l / 16))])
    }
}
