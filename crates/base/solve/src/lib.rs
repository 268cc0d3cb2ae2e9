//! Sparse matrices and direct solvers whose factors are used for many right-hand sides.
//!
//! All solvers implement one small trait, [`LinearSolver`]. The library behind it, [`faer`], is not part of the interface.
//!
//! | matrix | solver |
//! |---|---|
//! | symmetric, positive definite | [`Cholesky`] |
//! | symmetric, positive semi-definite, kernel of constants | [`SemidefiniteCholesky`] |
//! | symmetric, indefinite, no pivoting needed | [`Ldlt`] |
//! | square | [`Lu`] |
//! | a sum of dense elements along a tree | [`FrontalPlan`] |
//! | close to one that has been factored | [`gmres`] |
//!
//! ```
//! use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};
//!
//! let matrix = SparseMatrix::from_triplets(2, 2, &[(0, 0, 4.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 3.0)])?;
//! let solver = Cholesky::new(&matrix)?;
//! let x = solver.solve(&[9.0, 5.0])?;
//! assert!((x[0] - 2.0).abs() < 1e-15 && (x[1] - 1.0).abs() < 1e-15);
//! # Ok::<(), pompeiu_solve::SolveError>(())
//! ```
//!
//! [`ElementPattern`] assembles matrices of one pattern repeatedly, [`SymmetricBlocks`] those of a pattern that grows. [`DenseCholesky`] is for small dense matrices, for instance
//! Gram matrices.
//!
//! This crate does not depend on meshes. A sparse matrix is factored on one thread; independent ones can be factored in parallel.
//! Results have the same bits at any number of threads.

mod assembly;
mod banded;
mod blocks;
mod cholesky;
mod dense;
mod eigen;
mod error;
mod fronts;
mod gmres;
mod ldlt;
mod lu;
mod ordering;
mod semidefinite;
mod solver;
mod sparse;

pub use assembly::{ElementPattern, FIXED};
pub use banded::Banded;
pub use blocks::SymmetricBlocks;
pub use cholesky::{Analysis, Cholesky};
pub use dense::DenseCholesky;
pub use eigen::eigenvalues;
pub use error::SolveError;
pub use fronts::{FrontalLu, FrontalPlan};
pub use gmres::gmres;
pub use ldlt::Ldlt;
pub use lu::Lu;
pub use ordering::Ordering;
pub use semidefinite::SemidefiniteCholesky;
pub use solver::LinearSolver;
pub use sparse::SparseMatrix;
