//! Disjoint sets.

/// Disjoint sets of the numbers below a bound, at first one for each; path halving, linked towards the lesser root.
#[derive(Clone, Debug)]
pub struct UnionFind {
    parents: Vec<usize>,
}

impl UnionFind {
    /// One set for each of the numbers below a bound.
    pub fn new(count: usize) -> Self {
        Self { parents: (0..count).collect() }
    }

    /// The least member of the set that holds `x`.
    ///
    /// # Panics
    /// If `x` is not below the bound.
    pub fn find(&mut self, mut x: usize) -> usize {
        while self.parents[x] != x {
            self.parents[x] = self.parents[self.parents[x]];
            x = self.parents[x];
        }
        x
    }

    /// Joins the sets that hold `a` and `b`; returns whether they were different.
    ///
    /// # Panics
    /// If one of them is not below the bound.
    pub fn union(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.parents[a.max(b)] = a.min(b);
        a != b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_grow_and_keep_their_least_member() {
        let mut sets = UnionFind::new(6);
        assert!(sets.union(4, 2) && sets.union(5, 4) && sets.union(0, 1));
        assert!(!sets.union(2, 5));
        let roots = [0, 1, 2, 3, 4, 5].map(|x| sets.find(x));
        assert_eq!(roots, [0, 0, 2, 3, 2, 2]);
    }
}
