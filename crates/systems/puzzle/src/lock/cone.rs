//! Infinitesimal motions of one body relative to fixed ones, in integers.

/// A linear condition: its product with a motion must be nonnegative.
pub(super) type Row = [i128; 3];

/// The motions x with R x ≥ 0.
#[derive(Default)]
pub(super) struct Cone {
    rows: Vec<Row>,
}

impl Cone {
    pub(super) fn extend(&mut self, rows: impl Iterator<Item = Row>) {
        self.rows.extend(rows);
    }

    /// A nonzero motion; `None` if there is none, exactly.
    ///
    /// If the rows do not span space, there is a line of motions. Otherwise the cone is pointed. Unless it contains only the
    /// origin, it has an extreme ray, on which two independent rows vanish: the candidates are the cross products of two rows.
    ///
    /// # Accuracy
    /// Corners have at most 23 bits, so rows at most 46, products 70 and their products with rows 94.
    pub(super) fn motion(mut self) -> Option<Row> {
        for row in &mut self.rows {
            let divisor = row.iter().fold(0, |g, x| gcd(g, x.unsigned_abs())).max(1).cast_signed();
            *row = row.map(|x| x / divisor);
        }
        self.rows.sort_unstable();
        self.rows.dedup();
        self.rows.retain(|row| *row != [0; 3]);
        let rows = &self.rows;
        let Some(&first) = rows.first() else { return Some([1, 0, 0]) };
        let Some(line) = rows.iter().map(|row| cross(first, *row)).find(|line| *line != [0; 3]) else {
            // One row up to sign: anything perpendicular to it.
            let axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|axis| cross(first, axis));
            return axes.into_iter().find(|line| *line != [0; 3]);
        };
        if rows.iter().all(|row| dot(line, *row) == 0) {
            return Some(line);
        }
        // The row that excluded the last candidate, and that for its opposite, probably exclude the next ones too.
        let mut last = [0, 0];
        for (i, a) in rows.iter().enumerate() {
            for b in &rows[..i] {
                let ray = cross(*a, *b);
                if ray == [0; 3] {
                    continue;
                }
                for (ray, last) in [ray, ray.map(|x| -x)].into_iter().zip(&mut last) {
                    let excludes = |row: &Row| dot(ray, *row) < 0;
                    if excludes(&rows[*last]) {
                        continue;
                    }
                    match rows.iter().position(excludes) {
                        Some(row) => *last = row,
                        None => return Some(ray),
                    }
                }
            }
        }
        None
    }
}

fn cross(a: Row, b: Row) -> Row {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Row, b: Row) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(rows: &[Row]) -> Option<Row> {
        let mut cone = Cone::default();
        cone.extend(rows.iter().copied());
        cone.motion()
    }

    #[test]
    fn cones_of_each_kind() {
        assert!(motion(&[]).is_some());
        let line = motion(&[[1, 2, 3], [2, 4, 6]]).unwrap();
        assert_eq!(dot(line, [1, 2, 3]), 0);
        assert_eq!(
            motion(&[[1, 0, 0], [0, 1, 0], [-1, -1, 0]]).map(|x| x.map(|x| x != 0)),
            Some([false, false, true])
        );
        let octant = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
        assert!(motion(&octant).is_some());
        // A fourth row against all three closes the cone; a slightly rotated one leaves a ray.
        assert_eq!(motion(&[octant[0], octant[1], octant[2], [-1, -1, -1]]), None);
        assert!(motion(&[octant[0], octant[1], octant[2], [0, -1, -1]]).is_some());
    }
}
