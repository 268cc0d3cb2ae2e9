//! What a simulation is asked for.

use crate::FluidError;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_operators::FaceField;

/// How the velocity is stored and advected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Scheme {
    /// Vorticity at vertices and harmonic coefficients; Galerkin advection in substeps. Conserves energy, enstrophy and total
    /// vorticity in space.
    #[default]
    Vorticity,
    /// The same unknowns; semi-Lagrangian advection, stable at any step. Loses energy.
    AnyStep,
    /// Velocities on faces, traced back from their centroids with parallel transport, then projected; stable at any step. Loses the
    /// most energy.
    Faces,
    /// Velocities at midpoints of edges (Crouzeix and Raviart) for viscosity, advected by their vorticity as [`Scheme::Vorticity`]
    /// does. Rigid rotations never gain energy. Without viscosity it is that scheme.
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

    /// Whether the vorticity moves on by its rates of change, in substeps.
    pub(crate) const fn is_eulerian(self) -> bool {
        matches!(self, Self::Vorticity | Self::CrouzeixRaviart)
    }

    /// The scheme of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scheme| scheme.name() == name)
    }
}

/// What is done about the blur of values that are traced back and interpolated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Correction {
    /// Nothing: of first order. [`Scheme::Faces`] then walks straight back as well, as Stam does.
    Linear,
    /// Half of what a step forth and back misses is added at the end (`MacCormack`), within the values around.
    #[default]
    MacCormack,
    /// It is added at the beginning, and carried along (back and forth error compensation and correction), within the values around.
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

    /// The one of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }
}

/// By which weights of edges what is stored on faces diffuses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Diffusion {
    /// Of a Laplacian: velocities by their stream function and [`ViscosityModel`], densities by the length of an edge over the
    /// distance of the centroids beside it.
    #[default]
    Laplacian,
    /// The length of the edge alone. This is no Laplacian: how viscous a flow is depends on the size of the faces and on the unit of
    /// length, and thin faces diffuse most across their long sides. Kept to show it.
    EdgeLength,
}

impl Diffusion {
    /// Both of them.
    pub const ALL: [Self; 2] = [Self::Laplacian, Self::EdgeLength];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Laplacian => "laplacian",
            Self::EdgeLength => "edge-length",
        }
    }

    /// The one of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }
}

/// How [`Scheme::Vorticity`] moves on in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Integrator {
    /// The classical Runge–Kutta method of fourth order.
    #[default]
    RungeKutta,
    /// The implicit midpoint rule, solved to rounding: conserves energy and enstrophy in time as well.
    ImplicitMidpoint,
}

impl Integrator {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::RungeKutta, Self::ImplicitMidpoint];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::RungeKutta => "runge-kutta",
            Self::ImplicitMidpoint => "implicit-midpoint",
        }
    }

    /// The one of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }
}

/// Which Laplacian makes the viscous force. On a flat surface without boundary they are the same.
///
/// On the unit sphere a divergence-free field of degree l decays at ν times l(l + 1), l(l + 1) − 1 and l(l + 1) − 2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
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

    /// The model of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|model| model.name() == name)
    }

    /// How often the Gaussian curvature is added to the Hodge Laplacian.
    pub(crate) const fn curvatures(self) -> f64 {
        match self {
            Self::Hodge => 0.0,
            Self::Bochner => 1.0,
            Self::Physical => 2.0,
        }
    }
}

/// What a viscous flow does at the boundary; nothing flows through it in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Wall {
    /// It sticks to the boundary, which may move along itself.
    #[default]
    NoSlip,
    /// The boundary exerts no tangential force.
    FreeSlip,
}

impl Wall {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::NoSlip, Self::FreeSlip];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoSlip => "no-slip",
            Self::FreeSlip => "free-slip",
        }
    }

    /// The one of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }
}

/// How long steps are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// All alike.
    Fixed(f64),
    /// The longest halved until no more than `number` times what a dual cell holds flows out of it in a step.
    Cfl {
        /// The bound of the Courant number of dual cells.
        number: f64,
        /// The longest step.
        longest: f64,
    },
}

/// How densities are carried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Transport {
    /// Fluxes between dual cells, of second order, corrected to stay within the values around: conserves mass, in substeps.
    #[default]
    FluxCorrected,
    /// Traced back along geodesics: mass drifts.
    SemiLagrangian,
    /// The same; then what mass is missing is distributed where values have room.
    SemiLagrangianCorrected,
    /// Stored on faces and traced back from their centroids: mass drifts, and interpolating twice blurs.
    Faces,
}

impl Transport {
    /// All of them.
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

    /// The one of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }
}

/// Something the flow carries: dye, smoke, temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    /// What it is called.
    pub name: String,
    /// Its values at first.
    pub initial: VertexData<f64>,
    /// The constant of its diffusion, squared length per time.
    pub diffusivity: f64,
    /// How heavy it is: the acceleration is this times its value times the gravity. Below zero for what rises.
    pub weight: f64,
    /// What is added per time. Where it is below zero, no value falls below zero by it.
    pub source: Option<VertexData<f64>>,
}

impl Density {
    /// A density that neither diffuses nor weighs anything.
    pub fn new(name: impl Into<String>, initial: VertexData<f64>) -> Self {
        Self { name: name.into(), initial, diffusivity: 0.0, weight: 0.0, source: None }
    }
}

/// Options of a [`Simulation`](crate::Simulation). Lengths are in the unit of the surface; a unit of time is the caller's.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidOptions {
    /// How the velocity is stored and advected.
    pub scheme: Scheme,
    /// How it moves on in time.
    pub integrator: Integrator,
    /// What is done about the blur of whatever is traced back.
    pub correction: Correction,
    /// By which weights what is stored on faces diffuses.
    pub diffusion: Diffusion,
    /// How long steps are.
    pub time_step: TimeStep,
    /// Kinematic viscosity ν, squared length per time; 0 for none.
    pub viscosity: f64,
    /// Which Laplacian it goes with.
    pub viscosity_model: ViscosityModel,
    /// What a viscous flow does at the boundary.
    pub wall: Wall,
    /// The velocity of the boundary along each of its edges, in the direction of its face's half-edge, for [`Wall::NoSlip`]:
    /// one value for each edge, those inside unused. At rest by default.
    pub wall_velocity: Option<pompeiu_surface::EdgeData<f64>>,
    /// The speed at which the fluid flows in through each boundary edge, across it, below zero where it flows out; one value for each
    /// edge, those inside unused. As much must flow into each component as out of it. What flows in brings no vorticity and no
    /// density along; what is traced back to the boundary takes what is there.
    pub inflow: Option<pompeiu_surface::EdgeData<f64>>,
    /// The gravity along the surface, felt by densities that weigh something; see [`tangential`](crate::tangential).
    pub gravity: Option<FaceField>,
    /// Twice the normal component of a rotation of the whole surface; see [`coriolis`](crate::coriolis).
    pub coriolis: Option<FaceData<f64>>,
    /// An acceleration that is always there.
    pub force: Option<FaceField>,
    /// The strength of vorticity confinement: the acceleration is this times the mean edge length times the vorticity, towards its
    /// maxima.
    pub confinement: f64,
    /// What the flow carries.
    pub densities: Vec<Density>,
    /// How it is carried.
    pub transport: Transport,
}

impl FluidOptions {
    /// An inviscid flow without forces that carries nothing, with this step.
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

    /// Whether anything is stored on faces.
    pub(crate) fn on_faces(&self) -> bool {
        self.scheme == Scheme::Faces || self.transport == Transport::Faces
    }

    /// Whether anything is traced back.
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

    /// Checks numbers and lengths.
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
