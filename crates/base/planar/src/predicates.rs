//! Exact predicates on doubles.

use crate::Point;
use crate::outline::coord;

/// On which side of a line a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// To the left.
    Left,
    /// To the right.
    Right,
    /// On the line.
    Straight,
}

/// On which side of the line from `a` to `b` the point `c` lies, decided exactly.
pub fn orientation(a: Point, b: Point, c: Point) -> Turn {
    let turn = robust::orient2d(coord(a), coord(b), coord(c));
    if turn > 0.0 {
        Turn::Left
    } else if turn < 0.0 {
        Turn::Right
    } else {
        Turn::Straight
    }
}

/// Whether the boxes around two segments have a point in common.
pub(crate) fn boxes_meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    (0..2).all(|k| a[k].max(b[k]) >= c[k].min(d[k]) && c[k].max(d[k]) >= a[k].min(b[k]))
}

/// Whether two closed segments have a point in common, decided exactly.
pub fn segments_meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    if !boxes_meet([a, b], [c, d]) {
        return false;
    }
    let (abc, abd) = (orientation(a, b, c), orientation(a, b, d));
    let (cda, cdb) = (orientation(c, d, a), orientation(c, d, b));
    if abc != abd && cda != cdb && [abc, abd, cda, cdb].iter().all(|t| *t != Turn::Straight) {
        return true;
    }
    let between =
        |p: Point, q: Point, r: Point| (0..2).all(|k| p[k].min(q[k]) <= r[k] && r[k] <= p[k].max(q[k]));
    (abc == Turn::Straight && between(a, b, c))
        || (abd == Turn::Straight && between(a, b, d))
        || (cda == Turn::Straight && between(c, d, a))
        || (cdb == Turn::Straight && between(c, d, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn touching_counts_and_a_hair_beside_does_not() {
        let s = [[0.0, 0.0], [3.0, 1.0]];
        assert!(segments_meet(s, [[1.0, -1.0], [1.0, 2.0]]));
        assert!(segments_meet(s, [[3.0, 1.0], [5.0, 5.0]]));
        assert!(segments_meet(s, [[1.5, 0.5], [6.0, 2.0]]), "on one line");
        assert!(!segments_meet(s, [[6.0, 2.0], [9.0, 3.0]]), "on one line, apart");
        let above = 1.0_f64.next_up();
        assert!(!segments_meet([[0.0, 0.0], [2.0, 2.0]], [[1.0, above], [0.0, 5.0]]));
    }
}
