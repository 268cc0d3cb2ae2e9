//! Generalised winding numbers: how often a surface, closed or not, winds around a point.

use super::morton_order;
use crate::geom::{Aabb, Frame};
use crate::mesh::{FaceId, TriMesh};
use glam::DVec3;
use multiversion::multiversion;
use rayon::prelude::*;
use std::f64::consts::PI;

/// A mesh prepared for computing winding numbers at many points.
///
/// # Definition
/// `w(q) = 1/4π ∫ (x - q) . n / |x - q|^3 dx` over all faces with their normals n: the signed solid angle of the surface seen from
/// q, over 4π. For a closed surface whose faces point outwards it is 1 inside and 0 outside; for surfaces with holes and for
/// triangle soups it takes all values between.
/// # Accuracy
/// See [`WindingNumber`]. Where a point lies on a face, up to the rounding of coordinates, w jumps by one; the value on one of the
/// two sides is returned.
/// # Cost
/// O(m log m) to prepare, about 110 bytes per face; O(log m) for most points.
/// # Source
/// The definition: `jacobson_robust_2013`. Approximating distant groups of faces by the first three terms of their Taylor series:
/// `barill_fast_2018`; the error bound, and repeating with smaller groups where it is too large, are ours. The solid angle of a
/// triangle: `oosterom_solid_1983`.
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::cube;
/// use pompeiu_core::spatial::Winding;
///
/// let winding = Winding::new(&cube(2.0, 4)?);
/// assert!((winding.about([0.9, 0.0, 0.0]).value - 1.0).abs() < 0.1);
/// assert!(winding.about([0.9, 0.0, 0.0]).is_inside());
/// assert!(!winding.about([1.1, 0.0, 0.0]).is_inside());
/// # Ok::<(), pompeiu_core::mesh::shapes::ShapeError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Winding {
    frame: Frame,
    /// Corners in the frame, in spatial order, [`GROUP`] triangles at a time.
    triangles: Vec<Triangles>,
    /// Groups of [`GROUP`] triangles, then groups of [`GROUP`] groups, and so on up to one group.
    levels: Vec<Vec<Group>>,
    is_sheet: bool,
}

/// A winding number as computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindingNumber {
    /// Its value.
    pub value: f64,
    /// Bound on the error but for rounding, which is about 1e-15 for each triangle that is summed individually.
    pub error: f64,
    /// Whether it is that of a sheet, see [`Winding::is_sheet`].
    pub of_sheet: bool,
}

impl WindingNumber {
    /// Whether the surface winds around the point more than half a time, in either direction; of a sheet, whether the point is behind it: whether
    /// the number is positive.
    ///
    /// For a closed surface this is the inside, whether its faces point outwards or inwards. The error is below the distance of the
    /// value from the one that decides, unless all triangles were summed individually.
    pub fn is_inside(&self) -> bool {
        if self.of_sheet { self.value > 0.0 } else { self.value.abs() > 0.5 }
    }

    /// How far the value is from those that decide whether a point is inside.
    pub fn margin(&self) -> f64 {
        let size = self.value.abs();
        if self.of_sheet { size } else { (size - 0.5).abs() }
    }
}

/// Triangles in a group of the lowest level, and groups in one of the level above.
const GROUP: usize = 8;
/// Largest error of one group, tried in this order until it is certain whether the point is inside. No group meets the last, so every triangle is
/// then summed individually.
const ERRORS: [f64; 3] = [1e-2, 2e-4, -1.0];
/// Groups with a smaller error are not worth another sum: all triangles are summed individually.
const LEAST_ERROR: f64 = 1e-5;
/// Points of a task.
const TASK: usize = 256;
/// Faces at which is tried whether a surface encloses something, at most; how far from them, as a part of the root of their area; and the mean
/// of the numbers there up to which it is a sheet. At faces of a closed surface they are one half, at those of a plane zero.
const TRIALS: usize = 64;
const BESIDE: f64 = 1e-3;
const MOST_OF_SHEET: f64 = 0.25;

impl Winding {
    /// Prepares a mesh.
    pub fn new(mesh: &TriMesh) -> Self {
        let aabb = Aabb::of_faces(mesh);
        let frame = Frame::of(&aabb);
        let corners = |f: u32| mesh.corners(FaceId(f)).map(|p| DVec3::from_array(frame.map(p)));
        let triangles: Vec<[DVec3; 3]> = morton_order(mesh, &aabb).into_par_iter().map(corners).collect();
        let mut levels = Vec::new();
        let mut size = GROUP;
        let all = triangles.par_chunks(GROUP).map(Triangles::new).collect();
        loop {
            levels.push(triangles.par_chunks(size).map(Group::new).collect::<Vec<_>>());
            if size >= triangles.len() {
                break;
            }
            size *= GROUP;
        }
        let mut winding = Self { frame, triangles: all, levels, is_sheet: false };
        winding.is_sheet = winding.number_at_faces(&triangles) < MOST_OF_SHEET;
        winding
    }

    /// Whether the surface is a sheet, which encloses nothing: a plate, a relief, a scan from one side. Beside it the number is near to a half on
    /// both sides, positive behind its faces and negative in front of them.
    ///
    /// # Definition
    /// On a face the number is taken as the mean of those on both sides, one half for a closed surface. A sheet is a surface whose mean of the
    /// sizes of these numbers, by area, is less than a quarter. It is computed at up to 64 faces.
    /// # Limits
    /// Between a plate and a closed surface the choice is a convention: that of a box without a lid depends on how deep it is. Beside most faces
    /// of either both rules say the same.
    pub fn is_sheet(&self) -> bool {
        self.is_sheet
    }

    /// The mean over some faces, by area, of the size of the mean of the numbers on both sides; a half where none has an area.
    fn number_at_faces(&self, faces: &[[DVec3; 3]]) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        let mut stack = Vec::new();
        for [a, b, c] in faces.iter().step_by(faces.len().div_ceil(TRIALS).max(1)) {
            let normal = (*b - *a).cross(*c - *a);
            let area = 0.5 * normal.length();
            if area > f64::MIN_POSITIVE {
                let beside = BESIDE * area.sqrt() * (normal / (2.0 * area));
                let centre = (*a + *b + *c) * (1.0 / 3.0);
                let sides = [centre - beside, centre + beside];
                let [behind, before] = sides.map(|q| self.sum(q, ERRORS[0], &mut stack).value);
                sum += area * (0.5 * (behind + before)).abs();
                total += area;
            }
        }
        if total > 0.0 { sum / total } else { 0.5 }
    }

    /// The number at a point, in the unit of the mesh; computed accurately enough to decide whether the point is inside, where that is possible.
    pub fn about(&self, point: [f64; 3]) -> WindingNumber {
        self.about_with(point, &mut Vec::new(), 0.0)
    }

    /// The same where the number is known to vary by some amount beside the point, which is asked for as a whole: no more accurately than
    /// decides whether all numbers are on one side.
    pub fn around(&self, point: [f64; 3], variation: f64) -> WindingNumber {
        self.about_with(point, &mut Vec::new(), variation)
    }

    /// The number at a point, with an error that is no greater than this.
    pub fn within(&self, point: [f64; 3], error: f64) -> WindingNumber {
        let q = DVec3::from_array(self.frame.map(point));
        let mut stack = Vec::new();
        let mut most = ERRORS[0];
        loop {
            let number = self.sum(q, most, &mut stack);
            if number.error <= error {
                return number;
            }
            // As a rule the sum of all errors falls as fast as the greatest one.
            most = if most > LEAST_ERROR { most * 0.5 * error / number.error } else { -1.0 };
        }
    }

    /// The numbers at many points.
    pub fn about_all(&self, points: &[[f64; 3]]) -> Vec<WindingNumber> {
        let of_task = |points: &[[f64; 3]]| {
            let mut stack = Vec::new();
            points.iter().map(|p| self.about_with(*p, &mut stack, 0.0)).collect::<Vec<_>>()
        };
        points.par_chunks(TASK).flat_map_iter(of_task).collect()
    }

    fn about_with(&self, point: [f64; 3], stack: &mut Vec<(u32, u32)>, variation: f64) -> WindingNumber {
        let q = DVec3::from_array(self.frame.map(point));
        let mut number = WindingNumber { value: 0.0, error: f64::INFINITY, of_sheet: self.is_sheet };
        for most in ERRORS {
            number = self.sum(q, most, stack);
            let margin = number.margin();
            if margin > number.error + variation || margin + number.error < variation {
                break;
            }
        }
        number
    }

    /// Groups whose error is at most `most` are approximated as a whole.
    fn sum(&self, q: DVec3, most: f64, stack: &mut Vec<(u32, u32)>) -> WindingNumber {
        let (mut value, mut error) = (0.0, 0.0);
        stack.clear();
        stack.push((self.levels.len() as u32 - 1, 0));
        while let Some((level, place)) = stack.pop() {
            let group = &self.levels[level as usize][place as usize];
            let bound = group.error(q);
            if bound <= most {
                value += group.value(q);
                error += bound;
            } else if level > 0 {
                let first = place * GROUP as u32;
                let last = (first + GROUP as u32).min(self.levels[level as usize - 1].len() as u32);
                stack.extend((first..last).rev().map(|place| (level - 1, place)));
            } else {
                value += self.triangles[place as usize].solid_angle(q.to_array()) / (4.0 * PI);
            }
        }
        WindingNumber { value, error, of_sheet: self.is_sheet }
    }
}

/// The winding number of a mesh about one point, in the unit of the mesh, without preparation: all triangles are summed individually, in chunks
/// of a fixed size.
///
/// # Cost
/// O(m): quicker than [`Winding::new`] for a few points.
pub fn winding_number(mesh: &TriMesh, point: [f64; 3]) -> f64 {
    const CHUNK: usize = 1 << 12;
    let frame = Frame::of(&Aabb::of_faces(mesh));
    let q = DVec3::from_array(frame.map(point));
    let of_face = |face: &[u32; 3]| face.map(|v| DVec3::from_array(frame.map(mesh.positions()[v as usize])));
    let of_chunk = |faces: &[[u32; 3]]| faces.iter().map(|face| solid_angle(q, &of_face(face))).sum::<f64>();
    let chunks: Vec<f64> = mesh.faces().par_chunks(CHUNK).map(of_chunk).collect();
    chunks.iter().sum::<f64>() / (4.0 * PI)
}

/// The signed solid angle of a triangle seen from a point, positive from behind.
fn solid_angle(q: DVec3, triangle: &[DVec3; 3]) -> f64 {
    let [a, b, c] = triangle.map(|p| p - q);
    let [x, y, z] = [a, b, c].map(DVec3::length);
    let across = a.dot(b.cross(c));
    let along = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
    2.0 * libm::atan2(across, along)
}

/// Coordinates of the corners of [`GROUP`] triangles: for each corner, each axis. Places that are left over repeat a point, which subtends
/// no angle.
#[derive(Clone, Debug)]
struct Triangles([[[f64; GROUP]; 3]; 3]);

/// Directions whose angles are half of the solid angles of triangles: adjacent and opposite sides, not all longer than 1.
type Directions = [[f64; GROUP]; 2];

/// Sides shorter than this are not scaled to about 1, for reciprocals of shorter ones may overflow.
const SHORT: f64 = 1e-300;

impl Triangles {
    fn new(triangles: &[[DVec3; 3]]) -> Self {
        let corner = |i: usize, k: usize| triangles.get(i).map_or(triangles[0][0], |triangle| triangle[k]);
        Self([0, 1, 2].map(|k| [0, 1, 2].map(|axis| std::array::from_fn(|i| corner(i, k).to_array()[axis]))))
    }

    /// The signed solid angle of all seen from a point, positive from behind.
    ///
    /// Angles add up where directions are multiplied as complex numbers. A product of two in the same half of the plane that is in the other half
    /// has gone past the negative axis: a turn is lost, and is counted.
    fn solid_angle(&self, q: [f64; 3]) -> f64 {
        let [mut along, mut across] = directions(&self.0, q);
        if along.iter().zip(&across).any(|(x, y)| x.abs() + y.abs() < SHORT) {
            return 2.0 * along.iter().zip(&across).map(|(x, y)| libm::atan2(*y, *x)).sum::<f64>();
        }
        let mut turns = 0.0;
        let mut left = GROUP;
        while left > 1 {
            left /= 2;
            for i in 0..left {
                let ([a, b], [c, d]) = ([along[i], across[i]], [along[i + left], across[i + left]]);
                let y = a * d + b * c;
                let is_same = b.is_sign_negative() == d.is_sign_negative();
                let is_past = is_same && y.is_sign_negative() != b.is_sign_negative();
                turns += if is_past { 1.0_f64.copysign(b) } else { 0.0 };
                (along[i], across[i]) = (a * c - b * d, y);
            }
        }
        2.0 * (libm::atan2(across[0], along[0]) + 2.0 * PI * turns)
    }
}

/// For each triangle a direction whose angle is half of the solid angle seen from a point; scaled to about 1, unless it is [`SHORT`].
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn directions(corners: &[[[f64; GROUP]; 3]; 3], q: [f64; 3]) -> Directions {
    let [mut along, mut across] = [[0.0; GROUP]; 2];
    for i in 0..GROUP {
        let at = |corner: usize, axis: usize| corners[corner][axis][i] - q[axis];
        let [ax, ay, az] = [at(0, 0), at(0, 1), at(0, 2)];
        let [bx, by, bz] = [at(1, 0), at(1, 1), at(1, 2)];
        let [cx, cy, cz] = [at(2, 0), at(2, 1), at(2, 2)];
        let x = (ax * ax + ay * ay + az * az).sqrt();
        let y = (bx * bx + by * by + bz * bz).sqrt();
        let z = (cx * cx + cy * cy + cz * cz).sqrt();
        let (ab, bc, ca) =
            (ax * bx + ay * by + az * bz, bx * cx + by * cy + bz * cz, cx * ax + cy * ay + cz * az);
        let opposite = ax * (by * cz - cy * bz) + ay * (bz * cx - cz * bx) + az * (bx * cy - cx * by);
        let adjacent = x * y * z + ab * z + bc * x + ca * y;
        let size = adjacent.abs() + opposite.abs();
        let scale = if size < SHORT { 1.0 } else { 1.0 / size };
        along[i] = adjacent * scale;
        across[i] = opposite * scale;
    }
    [along, across]
}

/// Moments of a group of triangles about its centre: the coefficients of the Taylor series of the integrand, to be contracted with
/// the vector R from the point to the centre.
#[derive(Clone, Debug)]
struct Group {
    centre: DVec3,
    /// Greatest distance of a point of the triangles from the centre.
    radius: f64,
    area: f64,
    /// `∫ n`.
    normal: DVec3,
    /// The trace and the symmetric part of `∫ y n`, with y relative to the centre; the coefficients of xx, yy, zz, xy, yz, zx.
    trace: f64,
    first: [f64; 6],
    /// Traces and symmetric part of `∫ y y n`; the coefficients of xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz.
    traces: DVec3,
    second: [f64; 10],
}

impl Group {
    fn new(triangles: &[[DVec3; 3]]) -> Self {
        let (mut area, mut weighted, mut plain) = (0.0, DVec3::ZERO, DVec3::ZERO);
        for [a, b, c] in triangles {
            let of_face = 0.5 * (b - a).cross(c - a).length();
            area += of_face;
            weighted += of_face * (a + b + c);
            plain += a + b + c;
        }
        let centre =
            if area > 0.0 { weighted / (3.0 * area) } else { plain / (3.0 * triangles.len() as f64) };
        let radius = triangles.iter().flatten().fold(0.0, |r: f64, p| {
            let d = p.distance(centre);
            if d > r { d } else { r }
        });
        let mut group = Self {
            centre,
            radius,
            area,
            normal: DVec3::ZERO,
            trace: 0.0,
            first: [0.0; 6],
            traces: DVec3::ZERO,
            second: [0.0; 10],
        };
        for triangle in triangles {
            group.add(triangle);
        }
        group
    }

    fn add(&mut self, triangle: &[DVec3; 3]) {
        let [a, b, c] = triangle.map(|p| p - self.centre);
        let n = 0.5 * (b - a).cross(c - a);
        let m = (a + b + c) / 3.0;
        self.normal += n;
        self.trace += m.dot(n);
        let first = [
            m.x * n.x,
            m.y * n.y,
            m.z * n.z,
            m.x * n.y + m.y * n.x,
            m.y * n.z + m.z * n.y,
            m.z * n.x + m.x * n.z,
        ];
        for (sum, term) in self.first.iter_mut().zip(first) {
            *sum += term;
        }
        // The mean of y y over a triangle.
        let of = |i: usize, j: usize| (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + 9.0 * m[i] * m[j]) / 12.0;
        let (xx, yy, zz, xy, yz, zx) = (of(0, 0), of(1, 1), of(2, 2), of(0, 1), of(1, 2), of(2, 0));
        let rows = [DVec3::new(xx, xy, zx), DVec3::new(xy, yy, yz), DVec3::new(zx, yz, zz)];
        self.traces += 2.0 * DVec3::new(rows[0].dot(n), rows[1].dot(n), rows[2].dot(n)) + (xx + yy + zz) * n;
        let second = [
            xx * n.x,
            2.0 * xy * n.x + xx * n.y,
            2.0 * zx * n.x + xx * n.z,
            2.0 * xy * n.y + yy * n.x,
            2.0 * (xy * n.z + yz * n.x + zx * n.y),
            2.0 * zx * n.z + zz * n.x,
            yy * n.y,
            2.0 * yz * n.y + yy * n.z,
            2.0 * yz * n.z + zz * n.y,
            zz * n.z,
        ];
        for (sum, term) in self.second.iter_mut().zip(second) {
            *sum += term;
        }
    }

    /// Bound on the error of [`Group::value`]; infinite within the radius.
    ///
    /// The remainder of the Taylor series is at most `area r^3 / 3!` times the third derivative of `ρ / 4π |ρ|^3`. That is the
    /// fourth derivative of `1 / 4π |ρ|`, at most `4! / 4π |ρ|^5` in any directions; `|ρ|` is at least the distance to the sphere.
    fn error(&self, q: DVec3) -> f64 {
        let away = q.distance(self.centre) - self.radius;
        if away <= 0.0 {
            return if self.area > 0.0 { f64::INFINITY } else { 0.0 };
        }
        let ratio = self.radius / away;
        self.area * ratio * ratio * ratio / (PI * away * away)
    }

    /// The first three terms of the Taylor series about the centre.
    fn value(&self, q: DVec3) -> f64 {
        if self.area == 0.0 {
            return 0.0;
        }
        let way = self.centre - q;
        let u = way.length().recip();
        let r = way * u;
        let (x, y, z) = (r.x, r.y, r.z);
        let [a, b, c, d, e, f] = self.first;
        let first = a * x * x + b * y * y + c * z * z + d * x * y + e * y * z + f * z * x;
        let s = &self.second;
        let second = x * x * (s[0] * x + s[1] * y + s[2] * z)
            + y * y * (s[3] * x + s[6] * y + s[7] * z)
            + z * z * (s[5] * x + s[8] * y + s[9] * z)
            + s[4] * x * y * z;
        let dipole = self.normal.dot(r);
        let quadrupole = self.trace - 3.0 * first;
        let octupole = 0.5 * (15.0 * second - 3.0 * self.traces.dot(r));
        (dipole + u * (quadrupole + u * octupole)) * u * u / (4.0 * PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::{Diagonal, cube, disk, grid, icosphere, torus};
    use crate::mesh::{Random, displace_at_random, shuffle, unweld};

    fn direct(mesh: &TriMesh, q: [f64; 3]) -> f64 {
        let q = DVec3::from_array(q);
        let of_face = |f: FaceId| solid_angle(q, &mesh.corners(f).map(DVec3::from_array));
        mesh.face_ids().map(of_face).sum::<f64>() / (4.0 * PI)
    }

    fn points(count: usize, size: f64) -> Vec<[f64; 3]> {
        let mut random = Random::new(7);
        (0..count).map(|_| [0, 1, 2].map(|_| size * random.signed_unit())).collect()
    }

    /// Plates and shallow bowls are sheets, whose sides are told by their faces; boxes without a lid and closed surfaces are not, whichever way
    /// their faces point.
    #[test]
    fn sheets_are_told_from_what_encloses_something() {
        let part = |mesh: &TriMesh, keeps: &dyn Fn([f64; 3]) -> bool| {
            let is_kept = |face: &[u32; 3]| face.iter().all(|v| keeps(mesh.positions()[*v as usize]));
            let faces = mesh.faces().iter().copied().filter(is_kept).collect();
            TriMesh::new(mesh.positions().to_vec(), faces).unwrap()
        };
        let turned = |mesh: &TriMesh| {
            let faces = mesh.faces().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
            TriMesh::new(mesh.positions().to_vec(), faces).unwrap()
        };
        let ball = icosphere(1.0, 3).unwrap();
        let bowl = part(&ball, &|p| p[2] < -0.6);
        let plate =
            displace_at_random(&grid([1.0, 1.0], [20, 20], Diagonal::Rising).unwrap(), 1e-3, 1).unwrap();
        for sheet in [&plate, &turned(&plate), &bowl, &turned(&bowl), &disk(1.0, 40, 3).unwrap()] {
            let winding = Winding::new(sheet);
            assert!(winding.is_sheet());
            for face in sheet.face_ids() {
                let [a, b, c] = sheet.corners(face).map(DVec3::from_array);
                let (centre, normal) = ((a + b + c) / 3.0, (b - a).cross(c - a).normalize());
                for height in [1e-3, 1e-2] {
                    let at = |side: f64| winding.about((centre + side * height * normal).to_array());
                    assert!(at(-1.0).is_inside() && !at(1.0).is_inside(), "{centre}");
                }
            }
        }
        let (box_, without_lid) = (cube(2.0, 4).unwrap(), part(&ball, &|p| p[2] < 0.6));
        for mesh in [&ball, &turned(&ball), &box_, &without_lid, &turned(&without_lid)] {
            let winding = Winding::new(mesh);
            assert!(!winding.is_sheet());
            assert!(
                winding.about([0.1, 0.0, -0.2]).is_inside() && !winding.about([0.0, 0.0, -1.5]).is_inside()
            );
        }
    }

    /// What is known to vary is computed no more accurately than that decides.
    #[test]
    fn numbers_around_a_point_decide_as_those_about_it() {
        let plate = grid([1.0, 1.0], [20, 20], Diagonal::Rising).unwrap();
        let winding = Winding::new(&plate);
        for q in points(200, 0.6) {
            let (exact, number) = (direct(&plate, q), winding.around(q, 0.1));
            assert!((number.value - exact).abs() <= number.error + 1e-12);
            let is_decided = number.margin() > number.error + 0.1;
            assert_eq!(is_decided, exact.abs() > 0.1, "{exact} {number:?}");
            assert!(!is_decided || number.is_inside() == (exact > 0.0));
        }
    }

    #[test]
    fn closed_surfaces_have_whole_numbers() {
        let ring = torus(1.0, 0.4, 48, 24).unwrap();
        for mesh in [
            cube(2.0, 3).unwrap(),
            icosphere(1.0, 4).unwrap(),
            ring,
            unweld(&icosphere(0.7, 3).unwrap()).unwrap(),
        ] {
            let winding = Winding::new(&mesh);
            for (q, number) in points(300, 1.5).iter().zip(winding.about_all(&points(300, 1.5))) {
                let exact = direct(&mesh, *q);
                assert!((exact - exact.round()).abs() < 1e-12);
                assert!((number.value - exact).abs() <= number.error + 1e-12, "{q:?} {exact} {number:?}");
                assert_eq!(number.is_inside(), exact.round() != 0.0, "{q:?} {exact} {number:?}");
                assert!((winding_number(&mesh, *q) - exact).abs() < 1e-12);
            }
        }
    }

    /// The error falls with the expected power of the distance only if every term of the series is right.
    #[test]
    fn the_error_of_a_group_falls_with_the_fifth_power_of_the_distance() {
        let mesh = displace_at_random(&grid([1.0, 1.0], [3, 3], Diagonal::Rising).unwrap(), 0.2, 3).unwrap();
        let triangles: Vec<_> = mesh.face_ids().map(|f| mesh.corners(f).map(DVec3::from_array)).collect();
        let group = Group::new(&triangles);
        let (mut near, mut far) = (0.0, 0.0);
        for direction in points(50, 1.0) {
            let direction = DVec3::from_array(direction).normalize();
            let off = |distance: f64| {
                let q = group.centre + distance * direction;
                let exact = triangles.iter().map(|t| solid_angle(q, t)).sum::<f64>() / (4.0 * PI);
                let off = (group.value(q) - exact).abs();
                assert!(off <= group.error(q) + 1e-15, "{off:e} {:e}", group.error(q));
                off
            };
            near = f64::max(near, off(8.0));
            far = f64::max(far, off(32.0));
        }
        assert!(far < near / 500.0, "{near:e} {far:e}");
    }

    #[test]
    fn holes_and_soups_are_as_exact_as_claimed() {
        let sphere = icosphere(1.0, 3).unwrap();
        let open: Vec<_> = sphere.faces().iter().copied().skip(300).collect();
        let open = TriMesh::new(sphere.positions().to_vec(), open).unwrap();
        let soup = displace_at_random(&unweld(&sphere).unwrap(), 0.1, 4).unwrap();
        let scattered = shuffle(&soup, 5);
        for mesh in [open, soup, scattered, disk(1.0, 20, 5).unwrap()] {
            let winding = Winding::new(&mesh);
            for q in points(300, 1.3) {
                let (number, exact) = (winding.about(q), direct(&mesh, q));
                assert!((number.value - exact).abs() <= number.error + 1e-12, "{exact} {number:?}");
                let inside = if winding.is_sheet() { exact > 0.0 } else { exact.abs() > 0.5 };
                assert_eq!(number.is_inside(), inside, "{exact} {number:?}");
            }
        }
    }

    #[test]
    fn turning_all_faces_turns_the_sign_and_not_the_inside() {
        let mesh = icosphere(1.0, 2).unwrap();
        let turned = mesh.faces().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        let turned = TriMesh::new(mesh.positions().to_vec(), turned).unwrap();
        let (there, back) = (Winding::new(&mesh), Winding::new(&turned));
        for q in points(100, 1.2) {
            let (w, v) = (there.about(q), back.about(q));
            assert!((w.value + v.value).abs() < 1e-12 && w.is_inside() == v.is_inside());
        }
        assert!(there.about([0.0; 3]).value > 0.9, "faces turn outwards");
    }

    /// Also where a point lies in the plane of triangles, on them, or at a corner, where angles of half a turn and more add up.
    #[test]
    fn angles_of_eight_triangles_add_up() {
        let mut random = Random::new(3);
        for round in 0..2000 {
            let mut coordinate =
                || if round % 2 == 0 { random.signed_unit() } else { (2.0 * random.signed_unit()).round() };
            let mut point = || DVec3::from_array([0; 3].map(|_| coordinate()));
            let count = 1 + round % GROUP;
            let triangles: Vec<[DVec3; 3]> = (0..count).map(|_| [point(), point(), point()]).collect();
            for q in [
                DVec3::ZERO,
                point(),
                triangles[0][1],
                (triangles[0][0] + triangles[0][1] + triangles[0][2]) / 3.0,
            ] {
                let found = Triangles::new(&triangles).solid_angle(q.to_array());
                let each: f64 = triangles.iter().map(|triangle| solid_angle(q, triangle)).sum();
                assert!((found - each).abs() < 1e-9, "{found} {each} {q:?} {triangles:?}");
            }
        }
    }

    #[test]
    fn any_scale_place_and_degenerate_face() {
        for (scale, shift) in [(1e-200, 0.0), (1e150, 0.0), (1.0, 1e6)] {
            let sphere = icosphere(1.0, 2).unwrap();
            let placed: Vec<_> = sphere.positions().iter().map(|p| p.map(|x| scale * x + shift)).collect();
            let mut faces = sphere.faces().to_vec();
            faces.extend([[0, 0, 0], [1, 1, 2]]);
            let winding = Winding::new(&TriMesh::new(placed, faces).unwrap());
            assert!(winding.about([shift; 3]).is_inside());
            assert!(!winding.about([2.0 * scale + shift, shift, shift]).is_inside());
        }
        let point = Winding::new(&TriMesh::new(vec![[1.0; 3]], vec![[0, 0, 0]]).unwrap());
        assert_eq!(point.about([1.0; 3]).value, 0.0);
        assert!(!point.about([0.0; 3]).is_inside());
    }

    #[test]
    fn the_same_bits_at_any_number_of_threads() {
        let mesh = displace_at_random(&torus(1.0, 0.3, 40, 30).unwrap(), 0.02, 1).unwrap();
        let bits = [1, 2, 8].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let numbers = pool.install(|| Winding::new(&mesh).about_all(&points(2000, 1.5)));
            numbers.iter().map(|n| (n.value.to_bits(), n.error.to_bits())).collect::<Vec<_>>()
        });
        assert!(bits[0] == bits[1] && bits[0] == bits[2]);
    }
}
