//! The flow behind a problem, in the terms that several models share: what advice is made from. A model says which flow its
//! problem is one model of, what in it may be dropped, and what it would need besides a given flow to answer it.

/// A flow that more than one model answers.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Flow {
    /// a laminar flow over a bed of grains
    Laminar(LaminarScene),
    /// a turbulent flow over a bed of grains
    Turbulent(TurbulentScene),
}

/// A laminar flow over a bed between two planes. All values SI.
#[derive(Clone, Debug)]
pub struct LaminarScene {
    /// model of the case that it comes from
    pub kind: &'static str,
    /// density of the fluid [kg/m3]
    pub rho_f: f64,
    /// viscosity of the fluid [Pa s]
    pub eta: f64,
    /// density of the grains [kg/m3]
    pub rho_p: f64,
    /// diameter of the grains \[m]
    pub d: f64,
    /// bed level \[m]
    pub h_p: f64,
    /// solid fraction of the bed
    pub phi: f64,
    /// flow height \[m]
    pub h: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// fall of pressure along the flow [Pa/m], where it is not solved for
    pub drive: Option<f64>,
    /// friction of the grains at vanishing shear rate
    pub mu_s: f64,
    /// friction of the grains at large shear rates, where that is more
    pub mu_2: Option<f64>,
    /// whether the grains spread where they shear
    pub dilates: bool,
    /// viscosity of the bed over that of the fluid
    pub viscosity: f64,
    /// its law, as a case has it
    pub viscosity_law: String,
    /// whether the case has two velocities
    pub two_velocities: bool,
    /// Carman-Kozeny constant of the drag between the phases; `None` where one velocity serves
    pub k_ck: Option<f64>,
    /// whether the side walls of a section bound the flow
    pub walls: bool,
}

/// Slopes, densities of grains over that of the fluid, depths over d at which the continua were measured against grains.
const MEASURED: [(f64, f64); 3] = [(0.03, 0.07), (2.0, 3.0), (5.0, f64::INFINITY)];
/// Friction of spheres that flow, at vanishing inertial number (Maurin et al. 2016).
pub const BULK_FRICTION: f64 = 0.35;
/// Solid fraction of a packed bed, and of what moves.
pub const PACKED: f64 = 0.6;
/// Shields number from which grains collide (Chassagne et al. 2023).
pub const COLLISIONS: f64 = 0.2;

/// A turbulent flow over a bed. All values SI.
#[derive(Clone, Debug)]
pub struct TurbulentScene {
    /// model of the case that it comes from
    pub kind: &'static str,
    /// density of the fluid [kg/m3]
    pub rho_f: f64,
    /// density of the grains [kg/m3]
    pub rho_p: f64,
    /// kinematic viscosity of the fluid [m2/s]
    pub nu: f64,
    /// diameter of the grains \[m]
    pub d: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// depth of the fluid \[m]
    pub depth: f64,
    /// sine of the slope
    pub sine: f64,
    /// Shields number
    pub theta: f64,
    /// friction of the bed
    pub mu_s: f64,
    /// friction and restitution coefficient of two grains, where they are known
    pub contacts: Option<(f64, f64)>,
    /// fall velocity [m/s] if the case gives it
    pub settling: Option<f64>,
    /// whether side walls bound the flow
    pub walls: bool,
    /// stiffness of contacts [N/m] and thickness of the bed over d, of grains one by one
    pub grains: Option<(f64, f64)>,
}

impl TurbulentScene {
    /// Whether what the continua are worth was measured in flows like this one.
    #[must_use]
    pub fn is_measured(&self) -> bool {
        let values = [self.sine, self.rho_p / self.rho_f, self.depth / self.d];
        values.iter().zip(MEASURED).all(|(x, (low, high))| (low..=high).contains(x))
            && (0.99 * COLLISIONS..=1.1).contains(&self.theta)
    }

    /// Whether the Shields number is that or more: thresholds are not known to the per cent.
    #[must_use]
    pub fn at_least(&self, threshold: f64) -> bool {
        self.theta >= 0.99 * threshold
    }

    /// rho_p/rho_f - 1.
    #[must_use]
    pub fn excess(&self) -> f64 {
        self.rho_p / self.rho_f - 1.0
    }

    /// Friction velocity [m/s].
    #[must_use]
    pub fn u_star(&self) -> f64 {
        (self.theta * self.excess() * self.g * self.d).sqrt()
    }

    /// Fall velocity [m/s]: that of the case, else of a sphere with the drag 0.4 + 24.4/Re.
    #[must_use]
    pub fn fall(&self) -> f64 {
        let (c, viscous) = (0.4, 24.4 * self.nu / self.d);
        let weight = 4.0 / 3.0 * self.excess() * self.g * self.d;
        self.settling.unwrap_or(((viscous * viscous + 4.0 * c * weight).sqrt() - viscous) / (2.0 * c))
    }

    /// Share of the weight of the moving bed along the slope in what drives it.
    #[must_use]
    pub fn weight(&self) -> f64 {
        (1.0 / self.excess() + PACKED) * self.sine / (self.mu_s * PACKED)
    }

    /// Thickness of the moving layer over d: Revil-Baudard & Chauchat (2013), eq. (32).
    #[must_use]
    pub fn layers(&self) -> f64 {
        self.theta / (self.mu_s * PACKED * (1.0 - self.weight())).max(1e-12)
    }

    /// Whether the turbulence carries grains.
    #[must_use]
    pub fn suspends(&self) -> bool {
        /// Grain Reynolds number below which a flow is viscous.
        const VISCOUS: f64 = 5.0;
        let turbulent = self.settling.is_some() || self.u_star() * self.d / self.nu > VISCOUS;
        turbulent && self.fall() < self.u_star()
    }
}

/// What an answer costs, in its order of magnitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Effort {
    /// a closed form
    None,
    /// milliseconds
    Milliseconds,
    /// up to seconds
    Seconds,
    /// minutes
    Minutes,
}

/// What a model that would answer a flow needs besides it.
#[derive(Clone, Debug)]
pub struct Offer {
    /// what it costs
    pub effort: Effort,
    /// why this model serves
    pub because: String,
    /// how far its transport rate lies from what is known better, in words with the source
    pub off: &'static str,
    /// its case
    pub case: OwnCase,
}

/// The case of a model that answers a flow.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum OwnCase {
    /// the same scene, with these keys of the model set
    Scene(Vec<String>),
    /// a scene of another kind, as the text of a case
    Other(String),
}

/// A term of a model, or a part of its numerics, that a flow may not need.
#[derive(Clone, Debug)]
pub struct Term {
    /// what it is
    pub what: &'static str,
    /// where its threshold comes from
    pub source: &'static str,
    /// how it is assessed
    pub test: TermTest,
    /// the flow without it, where another model may then serve
    pub dropped: Option<fn(&mut Flow)>,
}

/// How a term is assessed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum TermTest {
    /// by solving the case with and without it
    Solve {
        /// what is changed in the case to drop it
        change: Vec<String>,
        /// what is left without it, in words
        left: &'static str,
        /// whether it goes whatever that changes, since its lack is the better answer and no slower
        free: bool,
    },
    /// by a threshold that was measured elsewhere
    Known {
        /// whether the flow needs it
        keep: bool,
        /// whether the case has it
        has: bool,
        /// why
        because: String,
    },
}
