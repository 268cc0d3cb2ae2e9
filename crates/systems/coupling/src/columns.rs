//! Least squares in which columns that depend linearly on newer ones are dropped.

/// Largest number of columns.
pub(crate) const MOST_COLUMNS: usize = 50;

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(crate) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

pub(crate) fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}

/// `y += a x`
pub(crate) fn add_scaled(y: &mut [f64], a: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += a * x;
    }
}

/// The differences of inputs and of outputs of two solves.
#[derive(Clone, Debug)]
pub(crate) struct Pair {
    pub(crate) from: Vec<f64>,
    pub(crate) to: Vec<f64>,
}

/// A linear map known on the span of some columns: `to ≈ M from`.
#[derive(Debug)]
pub(crate) struct Model<'a> {
    /// Orthonormal vectors of the columns that were kept.
    pub(crate) orthonormal: Vec<Vec<f64>>,
    /// Columns of the upper triangle R: `from = Q R`.
    upper: Vec<Vec<f64>>,
    pub(crate) kept: Vec<&'a Pair>,
    /// Number of dropped columns.
    pub(crate) dropped: usize,
}

impl<'a> Model<'a> {
    /// Gram–Schmidt twice over the columns, the newest first.
    pub(crate) fn new(pairs: impl Iterator<Item = &'a Pair>, filter: f64) -> Self {
        let mut model = Self { orthonormal: Vec::new(), upper: Vec::new(), kept: Vec::new(), dropped: 0 };
        for pair in pairs.take(MOST_COLUMNS) {
            let length = norm(&pair.from);
            let mut rest = pair.from.clone();
            let mut shares = vec![0.0; model.kept.len()];
            for _ in 0..2 {
                for (share, q) in shares.iter_mut().zip(&model.orthonormal) {
                    let part = dot(q, &rest);
                    *share += part;
                    add_scaled(&mut rest, -part, q);
                }
            }
            let left = norm(&rest);
            if !(left > filter * length && left.is_finite()) || pair.to.iter().any(|x| !x.is_finite()) {
                model.dropped += 1;
                continue;
            }
            shares.push(left);
            for x in &mut rest {
                *x /= left;
            }
            model.orthonormal.push(rest);
            model.upper.push(shares);
            model.kept.push(pair);
        }
        model
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    pub(crate) fn len(&self) -> usize {
        self.kept.len()
    }

    /// The weights of the columns whose weighted sum is nearest to a vector.
    pub(crate) fn weights(&self, of: &[f64]) -> Vec<f64> {
        let mut weights: Vec<f64> = self.orthonormal.iter().map(|q| dot(q, of)).collect();
        self.back_substitute(&mut weights);
        weights
    }

    /// `R⁻¹` times coefficients of the orthonormal vectors.
    fn back_substitute(&self, weights: &mut [f64]) {
        for k in (0..weights.len()).rev() {
            weights[k] /= self.upper[k][k];
            for i in 0..k {
                weights[i] -= self.upper[k][i] * weights[k];
            }
        }
    }

    /// The weighted sum of inputs.
    pub(crate) fn from(&self, weights: &[f64], size: usize) -> Vec<f64> {
        self.sum(weights, size, |pair| &pair.from)
    }

    /// The weighted sum of outputs.
    pub(crate) fn to(&self, weights: &[f64], size: usize) -> Vec<f64> {
        self.sum(weights, size, |pair| &pair.to)
    }

    fn sum(&self, weights: &[f64], size: usize, side: impl Fn(&Pair) -> &Vec<f64>) -> Vec<f64> {
        let mut sum = vec![0.0; size];
        for (weight, pair) in weights.iter().zip(&self.kept) {
            add_scaled(&mut sum, *weight, side(pair));
        }
        sum
    }

    /// The map in the basis of the orthonormal vectors, `Qᵀ W R⁻¹`, column by column.
    pub(crate) fn projected(&self) -> Vec<f64> {
        let k = self.len();
        let mut entries = Vec::with_capacity(k * k);
        for column in 0..k {
            let mut weights = vec![0.0; k];
            weights[column] = 1.0;
            self.back_substitute(&mut weights);
            let image = self.to(&weights, self.orthonormal[0].len());
            entries.extend(self.orthonormal.iter().map(|q| dot(q, &image)));
        }
        entries
    }
}
