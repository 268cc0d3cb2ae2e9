//! Options of a simulation.

use crate::FluidError;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_operators::FaceField;

/// The discretisation of the velocity and its advection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Scheme {
    /// Vorticity at vertices and harmonic coefficients; Galerkin advection in substeps. Conserves energy, enstrophy and total
    /// vorticity in space.
    #[default]
    Vorticity,
    /// The same unknowns; semi-Lagrangian advection, stable at any step. Loses energy.
    AnyStep,
    /// Velocities on faces; semi-Lagrangian advection from their centroids with parallel transport, then projection; stable at any
    /// step. Loses the most energy.
    Faces,
    /// Velocities at midpoints of edges (Crouzeix and Raviart) for viscosity; advection by their vorticity as in
    /// [`Scheme::Vorticity`]. Rigid rotations never gain energy. Without viscosity it is that scheme.
    CrouzeixRaviart,
}

impl Scheme {
    /// All schemes.
    pub const ALL: [Self; 4] = [Self::Vorticity, Self::AnyStep, Self::Faces, Self::CrouzeixRaviart];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Vorticity => "vorticity",
            Self::AnyStep => "any-step",
            Self::Faces => "faces",
            Self::CrouzeixRaviart => "crouzeix-raviart",
        }
    }

    /// Whether the vorticity is advanced by its rates of change, in substeps.
    pub(crate) const fn is_eulerian(self) -> bool {
        matches!(self, Self::Vorticity | Self::CrouzeixRaviart)
    }
}

/// The correction of the numerical diffusion of semi-Lagrangian interpolation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Correction {
    /// Not at all: first order. [`Scheme::Faces`] then also traces in a straight line, as Stam does.
    Linear,
    /// Half the error of a step forth and back is added at the end (`MacCormack`), limited to the surrounding values.
    #[default]
    MacCormack,
    /// Half the error is added at the beginning and advected (back and forth error compensation and correction), limited to the
    /// surrounding values.
    Bfecc,
}

impl Correction {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Linear, Self::MacCormack, Self::Bfecc];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::MacCormack => "mac-cormack",
            Self::Bfecc => "bfecc",
        }
    }
}

/// The edge weights for diffusion of quantities on faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Diffusion {
    /// Those of a Laplacian: velocities diffuse by their stream function and [`ViscosityModel`], densities with the length of an
    /// edge over the distance of the adjacent centroids.
    #[default]
    Laplacian,
    /// The length of the edge alone. This is not a Laplacian: the effective viscosity depends on the size of the faces and on the
    /// unit of length, and thin faces diffuse most across their long sides. Provided for comparison.
    EdgeLength,
}

impl Diffusion {
    /// All choices.
    pub const ALL: [Self; 2] = [Self::Laplacian, Self::EdgeLength];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Laplacian => "laplacian",
            Self::EdgeLength => "edge-length",
        }
    }
}

/// Time integration of [`Scheme::Vorticity`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Integrator {
    /// The classical Runge–Kutta method of fourth order.
    #[default]
    RungeKutta,
    /// The implicit midpoint rule, solved to rounding: conserves energy and enstrophy in time as well.
    ImplicitMidpoint,
}

impl Integrator {
    /// All integrators.
    pub const ALL: [Self; 2] = [Self::RungeKutta, Self::ImplicitMidpoint];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::RungeKutta => "runge-kutta",
            Self::ImplicitMidpoint => "implicit-midpoint",
        }
    }
}

/// The Laplacian of the viscous force. On a flat surface without boundary they are the same.
///
/// On the unit sphere a divergence-free field of degree l decays at ν times l(l + 1), l(l + 1) − 1 and l(l + 1) − 2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ViscosityModel {
    /// The Hodge Laplacian: harmonic fields do not decay.
    Hodge,
    /// The connection Laplacian: only parallel fields do not decay.
    Bochner,
    /// Twice the divergence of the rate of strain: rigid motions (Killing fields) do not decay.
    #[default]
    Physical,
}

impl ViscosityModel {
    /// All models.
    pub const ALL: [Self; 3] = [Self::Hodge, Self::Bochner, Self::Physical];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hodge => "hodge",
            Self::Bochner => "bochner",
            Self::Physical => "physical",
        }
    }

    /// The multiple of the Gaussian curvature that is added to the Hodge Laplacian.
    pub(crate) const fn curvatures(self) -> f64 {
        match self {
            Self::Hodge => 0.0,
            Self::Bochner => 1.0,
            Self::Physical => 2.0,
        }
    }
}

/// The condition for a viscous flow at walls; there is no flow through them in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Wall {
    /// No slip: the fluid has the velocity of the boundary, which may move tangentially.
    #[default]
    NoSlip,
    /// The boundary exerts no tangential force.
    FreeSlip,
}

impl Wall {
    /// All conditions.
    pub const ALL: [Self; 2] = [Self::NoSlip, Self::FreeSlip];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoSlip => "no-slip",
            Self::FreeSlip => "free-slip",
        }
    }
}

/// Choice of the time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// Constant.
    Fixed(f64),
    /// The longest step, halved until the outflow of each dual cell in a step is at most `number` times its content.
    Cfl {
        /// The bound of the Courant number of dual cells.
        number: f64,
        /// The longest step.
        longest: f64,
    },
}

/// The scheme that transports densities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Transport {
    /// Flux-corrected transport between dual cells, of second order and limited to the surrounding values: conserves mass, in
    /// substeps.
    #[default]
    FluxCorrected,
    /// Semi-Lagrangian along geodesics, with `any-step` from the points that the vorticity comes from: mass drifts.
    SemiLagrangian,
    /// Semi-Lagrangian; afterwards the missing mass is distributed where the limits allow.
    SemiLagrangianCorrected,
    /// Semi-Lagrangian on faces, from their centroids: mass drifts, and two interpolations per step add diffusion.
    Faces,
}

impl Transport {
    /// All methods.
    pub const ALL: [Self; 4] =
        [Self::FluxCorrected, Self::SemiLagrangian, Self::SemiLagrangianCorrected, Self::Faces];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::FluxCorrected => "flux-corrected",
            Self::SemiLagrangian => "semi-lagrangian",
            Self::SemiLagrangianCorrected => "semi-lagrangian-corrected",
            Self::Faces => "faces",
        }
    }
}

/// A transported density: dye, smoke, temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    /// The name.
    pub name: String,
    /// Initial values.
    pub initial: VertexData<f64>,
    /// Diffusivity, in squared length per time.
    pub diffusivity: f64,
    /// The weight: the acceleration is weight times value times gravity. Negative for buoyant densities.
    pub weight: f64,
    /// Source per time. A negative source never makes a value negative.
    pub source: Option<VertexData<f64>>,
}

impl Density {
    /// A density without diffusion or weight.
    pub fn new(name: impl Into<String>, initial: VertexData<f64>) -> Self {
        Self { name: name.into(), initial, diffusivity: 0.0, weight: 0.0, source: None }
    }
}

/// Options of a [`Simulation`](crate::Simulation). Lengths are in the unit of the surface; the unit of time is the caller's.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidOptions {
    /// The discretisation of the velocity and its advection.
    pub scheme: Scheme,
    /// Time integration.
    pub integrator: Integrator,
    /// Correction of semi-Lagrangian advection.
    pub correction: Correction,
    /// The edge weights for diffusion of quantities on faces.
    pub diffusion: Diffusion,
    /// Choice of the time step.
    pub time_step: TimeStep,
    /// Kinematic viscosity ν, squared length per time; 0 for none.
    pub viscosity: f64,
    /// The Laplacian of the viscous force.
    pub viscosity_model: ViscosityModel,
    /// The condition for a viscous flow at the boundary.
    pub wall: Wall,
    /// The velocity of the boundary along each of its edges, in the direction of its face's half-edge, for [`Wall::NoSlip`]:
    /// one value for each edge, those inside unused. At rest by default.
    pub wall_velocity: Option<pompeiu_surface::EdgeData<f64>>,
    /// The normal speed of inflow at each boundary edge, negative for outflow; one value for each edge, those inside unused. Inflow
    /// and outflow of each component must balance. Inflow carries neither vorticity nor densities; semi-Lagrangian paths that reach
    /// the boundary take the values there.
    pub inflow: Option<pompeiu_surface::EdgeData<f64>>,
    /// Tangential gravity, which acts on densities with weight; see [`tangential`](crate::tangential).
    pub gravity: Option<FaceField>,
    /// Coriolis parameter, for a rotating surface; see [`coriolis`](crate::coriolis).
    pub coriolis: Option<FaceData<f64>>,
    /// A constant acceleration.
    pub force: Option<FaceField>,
    /// The strength of vorticity confinement: the acceleration is this times the mean edge length times the vorticity,
    /// perpendicular to the gradient of its absolute value.
    pub confinement: f64,
    /// The transported densities.
    pub densities: Vec<Density>,
    /// The scheme that transports densities.
    pub transport: Transport,
}

impl FluidOptions {
    /// An inviscid flow without forces and densities, with this step.
    pub fn new(time_step: f64) -> Self {
        Self {
            scheme: Scheme::default(),
            integrator: Integrator::default(),
            correction: Correction::default(),
            diffusion: Diffusion::default(),
            time_step: TimeStep::Fixed(time_step),
            viscosity: 0.0,
            viscosity_model: ViscosityModel::default(),
            wall: Wall::default(),
            wall_velocity: None,
            inflow: None,
            gravity: None,
            coriolis: None,
            force: None,
            confinement: 0.0,
            densities: Vec::new(),
            transport: Transport::default(),
        }
    }

    /// Whether any quantity is stored on faces.
    pub(crate) fn on_faces(&self) -> bool {
        self.scheme == Scheme::Faces || self.transport == Transport::Faces
    }

    /// Whether any transport is semi-Lagrangian.
    pub(crate) fn traces_back(&self) -> bool {
        !self.scheme.is_eulerian()
            || (self.transport != Transport::FluxCorrected && !self.densities.is_empty())
    }

    /// The longest step.
    pub(crate) fn longest_step(&self) -> f64 {
        match self.time_step {
            TimeStep::Fixed(step) | TimeStep::Cfl { longest: step, .. } => step,
        }
    }

    /// Checks parameters and array lengths.
    pub(crate) fn check(&self, surface: &pompeiu_surface::SurfaceMesh) -> Result<(), FluidError> {
        let positive = |what: &'static str, value: f64| {
            let ok = value > 0.0 && value.is_finite();
            if ok { Ok(()) } else { Err(FluidError::Parameter { what, value, expected: "above 0" }) }
        };
        let not_negative = |what: &'static str, value: f64| {
            let ok = value >= 0.0 && value.is_finite();
            if ok { Ok(()) } else { Err(FluidError::Parameter { what, value, expected: "not negative" }) }
        };
        if self.diffusion == Diffusion::EdgeLength && !self.on_faces() {
            return Err(FluidError::EdgeLength);
        }
        positive("time step", self.longest_step())?;
        if let TimeStep::Cfl { number, .. } = self.time_step {
            positive("Courant number", number)?;
        }
        not_negative("viscosity", self.viscosity)?;
        not_negative("vorticity confinement", self.confinement)?;
        for field in [&self.gravity, &self.force].into_iter().flatten() {
            pompeiu_operators::check_field(surface, field)?;
        }
        let finite = |what: &'static str, element: &'static str, values: &[f64], expected: usize| {
            if values.len() != expected {
                return Err(FluidError::Length { what, element, found: values.len(), expected });
            }
            match values.iter().position(|x| !x.is_finite()) {
                Some(index) => Err(FluidError::NonFinite { what, element, index, value: values[index] }),
                None => Ok(()),
            }
        };
        if let Some(parameter) = &self.coriolis {
            finite("rotation of the surface", "face", parameter, surface.faces())?;
        }
        if let Some(velocity) = &self.wall_velocity {
            finite("velocity of the boundary", "edge", velocity, surface.edges())?;
        }
        if let Some(inflow) = &self.inflow {
            finite("inflow", "edge", inflow, surface.edges())?;
        }
        for density in &self.densities {
            not_negative("diffusivity", density.diffusivity)?;
            if !density.weight.is_finite() {
                let (what, value) = ("weight of a density", density.weight);
                return Err(FluidError::Parameter { what, value, expected: "finite" });
            }
            finite("density", "vertex", &density.initial, surface.vertices())?;
            if let Some(source) = &density.source {
                finite("source of a density", "vertex", source, surface.vertices())?;
            }
        }
        Ok(())
    }
}
