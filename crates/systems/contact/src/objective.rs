//! What a step minimises: its energy, its gradient, and a positive semi-definite approximation of its second derivatives.

use crate::contact::{Contact, Slide, Support};
use crate::curvature::Curvature;
use crate::surface::Candidates;
use crate::{Bodies, ContactError, Simulation};
use glam::DVec3;
use pompeiu_solve::{LinearSolver, SolveError, SymmetricBlocks};
use rayon::prelude::*;

/// The part of the decrease that the gradient promises, and a step must keep (Armijo).
const KEPT: f64 = 1e-4;

/// Halvings of a step at most.
const MOST_HALVINGS: usize = 60;

/// Halvings after which springs to where obstacles go are made stiffer, and how often they are.
const FEW_HALVINGS: usize = 4;
const MOST_STIFFENINGS: usize = 12;

/// What a step minimises.
pub(crate) struct Objective<'a> {
    pub(crate) simulation: &'a Simulation,
    pub(crate) predicted: Vec<DVec3>,
    /// β.
    pub(crate) step: f64,
    pub(crate) start: &'a [DVec3],
    pub(crate) slides: Vec<Slide>,
    pub(crate) targets: Vec<DVec3>,
    /// Vertices of obstacles that move, and where they go.
    pub(crate) driven: Vec<(u32, DVec3)>,
    /// The stiffness of springs to where they go, by which a line search weighs their way against the energy they add to bodies.
    pub(crate) drag: f64,
    pub(crate) stiffness: f64,
}

/// The sum of terms that are computed in parallel, added in order.
pub(crate) fn sum(terms: Vec<f64>) -> f64 {
    terms.into_iter().fold(0.0, |a, b| a + b)
}

/// The elastic energy of positions of bodies.
pub(crate) fn elastic_energy(bodies: &Bodies, x: &[DVec3]) -> [f64; 3] {
    let solid =
        sum(bodies.tetrahedra.par_iter().map(|t| t.energy(&t.vertices.map(|v| x[v as usize]))).collect());
    let cloth =
        sum(bodies.membranes.par_iter().map(|t| t.energy(&t.vertices.map(|v| x[v as usize]))).collect());
    let bend = sum(bodies.hinges.par_iter().map(|t| t.energy(&t.vertices.map(|v| x[v as usize]))).collect());
    [solid, cloth, bend]
}

/// The matrix of an element with its vertices.
pub(crate) struct Element {
    pub(crate) vertices: [u32; 4],
    pub(crate) count: usize,
    pub(crate) gradient: [DVec3; 4],
    pub(crate) curvature: Curvature,
}

impl Objective<'_> {
    fn energy(&self, x: &[DVec3], (contacts, supports): &(Vec<Contact>, Vec<Support>)) -> f64 {
        let Simulation { bodies, options, unknowns, .. } = self.simulation;
        let (d, squared) = (options.distance, self.step * self.step);
        let inertia: f64 = (0..x.len())
            .filter(|&i| unknowns[i].is_some())
            .map(|i| 0.5 * bodies.mass[i] * (x[i] - self.predicted[i]).length_squared())
            .sum();
        let springs: f64 = bodies
            .handles
            .iter()
            .zip(&self.targets)
            .map(|(handle, target)| {
                let v = handle.vertex as usize;
                0.5 * handle.stiffness * bodies.mass[v] * (x[v] - *target).length_squared()
            })
            .sum();
        let [solid, cloth, bend] = elastic_energy(bodies, x);
        let pairs = sum(contacts.par_iter().map(|contact| contact.energy(x, d)).collect());
        let support: f64 = supports.iter().map(|support| support.energy(x, d)).sum();
        let moved = self.moved(x);
        let epsilon = self.epsilon();
        let slides = sum(self.slides.par_iter().map(|slide| slide.energy(&moved, epsilon)).collect());
        let left: f64 = self.driven.iter().map(|(v, to)| (*to - x[*v as usize]).length_squared()).sum();
        let inertia = inertia + 0.5 * self.drag * left;
        inertia + squared * (springs + solid + cloth + bend + self.stiffness * (pairs + support) + slides)
    }

    /// The distance below which surfaces stick.
    fn epsilon(&self) -> f64 {
        self.simulation.options.sticking_speed * self.simulation.options.time_step
    }

    fn moved(&self, x: &[DVec3]) -> Vec<DVec3> {
        if self.slides.is_empty() {
            return Vec::new();
        }
        x.iter().zip(self.start).map(|(x, start)| *x - *start).collect()
    }

    /// The force of barriers of what is fixed on what moves.
    pub(crate) fn support(&self, x: &[DVec3], (contacts, supports): &(Vec<Contact>, Vec<Support>)) -> DVec3 {
        let Simulation { options, unknowns, .. } = self.simulation;
        let is_free = |v: u32| unknowns[v as usize].is_some();
        let mut force = DVec3::ZERO;
        for contact in contacts.iter().filter(|c| !c.vertices.iter().all(|&v| is_free(v))) {
            let (gradient, _) = contact.derivatives(x, options.distance, crate::Projection::Normal);
            for (v, g) in contact.vertices.iter().zip(gradient) {
                if is_free(*v) {
                    force -= g * self.stiffness;
                }
            }
        }
        for support in supports {
            force -= support.derivatives(x, options.distance).0 * self.stiffness;
        }
        force
    }

    /// Elements with gradients and positive semi-definite second derivatives, in order.
    fn elements(&self, x: &[DVec3], (contacts, supports): &(Vec<Contact>, Vec<Support>)) -> Vec<Element> {
        let Simulation { bodies, options, .. } = self.simulation;
        let squared = self.step * self.step;
        let kappa = squared * self.stiffness;
        let mut elements = Vec::new();
        let full = |block: &dyn Fn(usize, usize) -> f64, scale: f64| {
            Curvature::Full(Box::new(std::array::from_fn(|i| std::array::from_fn(|j| scale * block(i, j)))))
        };
        elements.par_extend(bodies.tetrahedra.par_iter().map(|t| {
            let (gradient, hessian) = t.derivatives(&t.vertices.map(|v| x[v as usize]));
            let curvature = full(&|i, j| hessian[i][j], squared);
            Element { vertices: t.vertices, count: 4, gradient: gradient.map(|g| g * squared), curvature }
        }));
        elements.par_extend(bodies.membranes.par_iter().map(|t| {
            let (gradient, hessian) = t.derivatives(&t.vertices.map(|v| x[v as usize]));
            let [a, b, c] = t.vertices;
            let curvature = full(&|i, j| if i < 9 && j < 9 { hessian[i][j] } else { 0.0 }, squared);
            let [p, q, r] = gradient.map(|g| g * squared);
            Element { vertices: [a, b, c, a], count: 3, gradient: [p, q, r, DVec3::ZERO], curvature }
        }));
        elements.par_extend(bodies.hinges.par_iter().map(|t| {
            let (gradient, angle, factor) = t.derivatives(&t.vertices.map(|v| x[v as usize]));
            let curvature = Curvature::Rank1(factor * squared, angle);
            Element { vertices: t.vertices, count: 4, gradient: gradient.map(|g| g * squared), curvature }
        }));
        elements.par_extend(contacts.par_iter().map(|contact| {
            let (gradient, curvature) = contact.derivatives(x, options.distance, options.projection);
            let curvature = match curvature {
                Curvature::Rank1(factor, vector) => Curvature::Rank1(factor * kappa, vector),
                Curvature::Full(entries) => full(&|i, j| entries[i][j], kappa),
            };
            let count = contact.kind.count();
            Element { vertices: contact.vertices, count, gradient: gradient.map(|g| g * kappa), curvature }
        }));
        elements.extend(supports.iter().map(|support| {
            let (gradient, normal, along) = support.derivatives(x, options.distance);
            let mut vector = [0.0; 12];
            vector[..3].copy_from_slice(&normal.to_array());
            let z = DVec3::ZERO;
            let gradient = [gradient * kappa, z, z, z];
            let vertices = [support.vertex; 4];
            Element { vertices, count: 1, gradient, curvature: Curvature::Rank1(along * kappa, vector) }
        }));
        let (moved, epsilon) = (self.moved(x), self.epsilon());
        elements.par_extend(self.slides.par_iter().map(|slide| {
            let (gradient, hessian) = slide.derivatives(&moved, epsilon);
            let curvature = full(&|i, j| hessian[i][j], squared);
            let gradient = gradient.map(|g| g * squared);
            Element { vertices: slide.vertices(), count: 4, gradient, curvature }
        }));
        elements
    }

    /// A Newton step for all vertices, and the slope of the objective along it. The matrix of the iteration before lends its pattern.
    ///
    /// Obstacles go all of their way that is left, and bodies as they are pushed then.
    pub(crate) fn newton(
        &mut self,
        x: &[DVec3],
        active: &(Vec<Contact>, Vec<Support>),
        matrix: &mut SymmetricBlocks,
    ) -> Result<(Vec<DVec3>, f64), ContactError> {
        let Simulation { bodies, unknowns, .. } = self.simulation;
        let count = 3 * unknowns.iter().flatten().count();
        let (mut gradient, mut diagonal) = (vec![0.0; count], vec![0.0; count]);
        let mut add = |v: usize, g: DVec3, stiffness: f64| {
            if let Some(unknown) = unknowns[v] {
                for k in 0..3 {
                    gradient[3 * unknown as usize + k] += g[k];
                    diagonal[3 * unknown as usize + k] += stiffness;
                }
            }
        };
        for v in 0..x.len() {
            add(v, (x[v] - self.predicted[v]) * bodies.mass[v], bodies.mass[v]);
        }
        let squared = self.step * self.step;
        for (handle, target) in bodies.handles.iter().zip(&self.targets) {
            let v = handle.vertex as usize;
            let stiffness = squared * handle.stiffness * bodies.mass[v];
            add(v, (x[v] - *target) * stiffness, stiffness);
        }
        let elements = self.elements(x, active);
        for element in &elements {
            for k in 0..element.count {
                add(element.vertices[k] as usize, element.gradient[k], 0.0);
            }
        }
        assemble(matrix, &diagonal, &elements, unknowns)?;
        let mut step: Vec<f64> = gradient.iter().map(|g| -g).collect();
        let way = self.way(x);
        let mut of_way = 0.0;
        if !self.driven.is_empty() {
            for element in &elements {
                of_way += element.push(&way, unknowns, &mut step);
            }
        }
        matrix.factor()?.solve_in_place(&mut step)?;
        let slope: f64 = step.iter().zip(&gradient).map(|(p, g)| p * g).sum();
        let slope = self.with_drag(slope + of_way, &way);
        let of = |(v, unknown): (usize, &Option<u32>)| match unknown {
            Some(u) => DVec3::from_slice(&step[3 * *u as usize..3 * *u as usize + 3]),
            None => way.get(v).copied().unwrap_or_default(),
        };
        Ok((unknowns.iter().enumerate().map(of).collect(), slope))
    }

    /// What is left of the way of each vertex of obstacles; nothing where none moves.
    fn way(&self, x: &[DVec3]) -> Vec<DVec3> {
        let mut way = vec![DVec3::ZERO; if self.driven.is_empty() { 0 } else { x.len() }];
        for (v, to) in &self.driven {
            way[*v as usize] = *to - x[*v as usize];
        }
        way
    }

    /// The slope of the objective from that of the energy: springs to where obstacles go are so stiff that their way lowers it.
    fn with_drag(&mut self, slope: f64, way: &[DVec3]) -> f64 {
        let square: f64 = way.iter().map(|p| p.length_squared()).sum();
        if square > 0.0 {
            let needed = 2.0 * slope.abs() / square;
            self.drag = if needed > self.drag { needed } else { self.drag };
        }
        slope - self.drag * square
    }

    /// The first of a step and its halves that lowers the objective enough. Where obstacles move, springs to where they go are made stiffer
    /// until one of the first few does.
    pub(crate) fn line_search(
        &mut self,
        x: &[DVec3],
        p: &[DVec3],
        slope: f64,
        free: f64,
        candidates: &Candidates,
    ) -> Option<Vec<DVec3>> {
        let way: f64 = self.driven.iter().map(|(v, _)| p[*v as usize].length_squared()).sum();
        if way > 0.0 {
            let mut slope = slope;
            for _ in 0..MOST_STIFFENINGS {
                let found = self.halved(x, p, slope, free, candidates, FEW_HALVINGS);
                if found.is_some() {
                    return found;
                }
                slope -= 9.0 * self.drag * way;
                self.drag *= 10.0;
            }
        }
        self.halved(x, p, slope, free, candidates, MOST_HALVINGS)
    }

    fn halved(
        &self,
        x: &[DVec3],
        p: &[DVec3],
        slope: f64,
        free: f64,
        candidates: &Candidates,
        halvings: usize,
    ) -> Option<Vec<DVec3>> {
        let simulation = self.simulation;
        let start = self.energy(x, &simulation.contacts(x, candidates));
        let mut part = free;
        for _ in 0..halvings {
            let next: Vec<DVec3> = x.iter().zip(p).map(|(x, p)| *x + *p * part).collect();
            let energy = self.energy(&next, &simulation.contacts(&next, candidates));
            if energy <= start + KEPT * part * slope {
                return Some(next);
            }
            part *= 0.5;
        }
        None
    }
}

impl Element {
    /// Adds to the right side what the way of obstacles pushes its vertices by; gives the slope of the energy along that way.
    fn push(&self, way: &[DVec3], unknowns: &[Option<u32>], right: &mut [f64]) -> f64 {
        let mut of_way = [0.0; 12];
        let mut slope = 0.0;
        for (k, &v) in self.vertices[..self.count].iter().enumerate() {
            let moves = way[v as usize];
            of_way[3 * k..3 * k + 3].copy_from_slice(&moves.to_array());
            slope += self.gradient[k].dot(moves);
        }
        if of_way == [0.0; 12] {
            return 0.0;
        }
        let product: [f64; 12] = match &self.curvature {
            Curvature::Rank1(factor, v) => {
                let along: f64 = v.iter().zip(of_way).map(|(v, p)| v * p).sum();
                v.map(|v| factor * v * along)
            }
            Curvature::Full(entries) => entries.map(|row| row.iter().zip(of_way).map(|(h, p)| h * p).sum()),
        };
        for (k, unknown) in self.unknowns(unknowns) {
            for axis in 0..3 {
                right[3 * unknown as usize + axis] -= product[3 * k + axis];
            }
        }
        slope
    }

    /// Its vertices that can move: their index among those of the element, and their unknown.
    fn unknowns(&self, unknowns: &[Option<u32>]) -> impl Iterator<Item = (usize, u32)> {
        let vertices = self.vertices[..self.count].iter().enumerate();
        vertices.filter_map(|(i, &v)| unknowns[v as usize].map(|unknown| (i, unknown)))
    }

    /// Adds its entries. Blocks above the diagonal are those below, turned over, and are left out.
    fn add_to(&self, matrix: &mut SymmetricBlocks, unknowns: &[Option<u32>]) {
        for (i, row) in self.unknowns(unknowns) {
            for (j, column) in self.unknowns(unknowns).filter(|(_, column)| *column <= row) {
                let (i, j) = (3 * i, 3 * j);
                match &self.curvature {
                    Curvature::Rank1(factor, v) => {
                        matrix.add(row, column, |a, b| factor * v[i + a] * v[j + b]);
                    }
                    Curvature::Full(entries) => {
                        matrix.add(row, column, |a, b| entries[i + a][j + b]);
                    }
                }
            }
        }
    }
}

/// Fills a matrix with values on its diagonal and with elements.
pub(crate) fn assemble(
    matrix: &mut SymmetricBlocks,
    diagonal: &[f64],
    elements: &[Element],
    unknowns: &[Option<u32>],
) -> Result<(), SolveError> {
    matrix.clear(diagonal.len() / 3, &places(elements, unknowns))?;
    for (unknown, of_vertex) in diagonal.as_chunks::<3>().0.iter().enumerate() {
        matrix.add(unknown as u32, unknown as u32, |a, b| if a == b { of_vertex[a] } else { 0.0 });
    }
    for element in elements {
        element.add_to(matrix, unknowns);
    }
    Ok(())
}

/// The pairs of unknowns that elements couple.
fn places(elements: &[Element], unknowns: &[Option<u32>]) -> Vec<(u32, u32)> {
    let mut places = Vec::with_capacity(6 * elements.len());
    for element in elements {
        for (_, row) in element.unknowns(unknowns) {
            let columns = element.unknowns(unknowns).map(|(_, column)| column);
            places.extend(columns.filter(|column| *column < row).map(|column| (row, column)));
        }
    }
    places
}
