//! The schemes of a flow.

/// A scheme that moves a surface towards less area.
///
/// M is the diagonal matrix of vertex areas, L the cotangent stiffness, `g = L X` the gradient of the area, δ the time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Scheme {
    /// Gradient descent X − δ M⁻¹ g, with a line search (Armijo).
    Explicit,
    /// (M₀ + δ L₀) X' = M₀ X with both matrices of the first step. It minimises the Dirichlet energy in the metric of the first
    /// surface, not the area, and its limit is no minimal surface.
    FixedLaplacian,
    /// (M + δ L) X' = M X with both matrices rebuilt at each step: backward Euler.
    Implicit,
    /// (M + δ L₀) X' = M X: conformalized mean curvature flow. It does not pinch, and is no gradient flow of the area.
    Conformalized,
    /// Newton's method for motions along vertex normals; where the Hessian is not positive definite, blended with L.
    NormalNewton,
    /// Newton's method for all coordinates; the negative in-plane part of the Hessian of each face is left out.
    Newton,
    /// Newton's method with the whole Hessian while the area falls, gradient descent where it would not.
    NewtonOrGradient,
}

impl Scheme {
    /// All schemes.
    pub const ALL: [Self; 7] = [
        Self::Explicit,
        Self::FixedLaplacian,
        Self::Implicit,
        Self::Conformalized,
        Self::NormalNewton,
        Self::Newton,
        Self::NewtonOrGradient,
    ];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Explicit => "explicit",
            Self::FixedLaplacian => "fixed-laplacian",
            Self::Implicit => "implicit",
            Self::Conformalized => "conformalized",
            Self::NormalNewton => "normal-newton",
            Self::Newton => "newton",
            Self::NewtonOrGradient => "newton-or-gradient",
        }
    }

    /// Whether it uses the stiffness of the first surface, whose faces must stay.
    pub const fn keeps_first_metric(self) -> bool {
        matches!(self, Self::FixedLaplacian | Self::Conformalized)
    }

    /// Whether its steps have a length in time.
    pub const fn is_in_time(self) -> bool {
        matches!(self, Self::Explicit | Self::FixedLaplacian | Self::Implicit | Self::Conformalized)
    }
}
