//! A laminar flow between two planes over a bed of grains, as its closed form, its solver and its cross-section take it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::Fault;

use crate::closures::Info;
use crate::closures::dilatancy::{self, PhiIv};
use crate::closures::drag::{self, CarmanKozeny};
use crate::closures::friction::{self, Coulomb, MuIv};
use crate::closures::mixture_viscosity::{MixtureViscosity, RelativeViscosity};
use crate::closures::role::{Only, choice};
use crate::model::{Faults, Flow, LaminarScene, Term, TermTest};
use crate::models::exact::ExactFault;
use crate::models::{BedFault, premises};
use crate::result::{Premise, Results, quantity as q};
use crate::scene::BedScene;
use crate::units::significant;

/// One velocity for fluid and grains, or two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    /// Fluid and grains share one velocity.
    #[default]
    Mixed,
    /// Two velocities, coupled by the drag: a flow through the static bed, a slip in the mobile one, a threshold of motion.
    TwoFluid,
}

/// Laws of the laminar bed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BedClosures {
    /// Friction of the grains.
    #[serde(default)]
    pub friction: Only<Coulomb>,
    /// Effective viscosity of the mixture.
    #[serde(default = "einstein")]
    pub mixture_viscosity: MixtureViscosity,
    /// Drag between the phases; only the two-fluid form has it.
    #[serde(default)]
    pub drag: BedDrag,
    /// Solid fraction of sheared grains; only with friction by mu(I_v).
    #[serde(default)]
    pub dilatancy: BedPacking,
}

pub(in crate::models) fn einstein() -> MixtureViscosity {
    MixtureViscosity::Einstein
}

impl Default for BedClosures {
    fn default() -> Self {
        Self {
            friction: Only::default(),
            mixture_viscosity: einstein(),
            drag: BedDrag::default(),
            dilatancy: BedPacking::default(),
        }
    }
}

choice! {
    /// Drag between the phases of a laminar bed.
    #[derive(Default)]
    pub enum BedDrag from drag {
        #[default]
        none::None,
        carman_kozeny::CarmanKozeny(..),
    }
}

choice! {
    /// Solid fraction of a bed that does not spread.
    #[derive(Default)]
    pub enum BedPacking from dilatancy {
        #[default]
        none::None,
    }
}

/// The laws of a laminar bed, whatever its model chooses them from.
#[derive(Clone, Copy, Debug)]
pub(in crate::models) struct BedLaws {
    pub friction: Coulomb,
    /// what the friction exceeds `mu_s` by where the grains shear
    pub rise: Option<MuIv>,
    pub viscosity: MixtureViscosity,
    pub drag: BedDrag,
    pub dilatancy: Option<PhiIv>,
}

impl From<&BedClosures> for BedLaws {
    fn from(closures: &BedClosures) -> Self {
        let BedClosures { friction, mixture_viscosity, drag, .. } = *closures;
        Self { friction: friction.0, rise: None, viscosity: mixture_viscosity, drag, dilatancy: None }
    }
}

/// What drives the flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// fall of pressure along the flow, -dp/dx [Pa/m]
    PressureGradient(f64),
    /// the pressure gradient that gives what is wanted
    Wanted(Wanted, f64),
}

/// What a drive is solved for, as the results have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Shields number
    Shields,
    /// mean velocity of fluid and grains over the whole height [m/s]
    MeanVelocity,
    /// discharge of the fluid per unit width [m2/s]
    Discharge,
}

impl Wanted {
    /// Its name among the drives of the flow.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Shields => "shields",
            Self::MeanVelocity => "mean_velocity",
            Self::Discharge => "discharge",
        }
    }

    /// What it is in a flow of these scaled numbers: stress on the bed, integral of the mixture velocity, flux of the grains.
    #[must_use]
    pub fn of(self, bed: &LaminarBed, [tau, discharge, flux]: [f64; 3]) -> f64 {
        match self {
            Self::Shields => tau * bed.h / bed.d,
            Self::MeanVelocity => discharge * bed.velocity_scale(),
            Self::Discharge => (discharge - flux) * bed.velocity_scale() * bed.h,
        }
    }

    /// The drive that is solved for, as the equations say it.
    #[must_use]
    pub fn equation(self, value: f64) -> String {
        let value = significant(value, 5);
        match self {
            Self::Shields => format!("f such that the Shields number is {value}"),
            Self::MeanVelocity => format!("f such that the mean velocity is {value} m/s"),
            Self::Discharge => format!("f such that the discharge of the fluid is {value} m²/s"),
        }
    }
}

/// A laminar flow between two planes, the lower part filled with grains. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaminarBed {
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
    /// what drives the flow
    pub drive: Drive,
    /// friction of the grains at vanishing shear rate
    pub friction: Coulomb,
    /// rise of the friction with the viscous number; `None` for a constant friction
    pub rise: Option<MuIv>,
    /// effective viscosity of the mixture
    pub viscosity: MixtureViscosity,
    /// drag between the phases: the two-fluid form; `None`: one velocity, the mixed form
    pub drag: Option<CarmanKozeny>,
    /// fall of the solid fraction with the viscous number; `None`: the same everywhere
    pub dilatancy: Option<PhiIv>,
}

impl LaminarBed {
    /// Stress scale (rho_p - rho_f) g H \[Pa] of Chauchat & Medale (2010).
    #[must_use]
    pub fn stress_scale(&self) -> f64 {
        (self.rho_p - self.rho_f) * self.g * self.h
    }

    /// Velocity scale (rho_p - rho_f) g H^2/eta [m/s].
    #[must_use]
    pub fn velocity_scale(&self) -> f64 {
        self.stress_scale() * self.h / self.eta
    }

    /// `mixed` or `two-fluid`.
    #[must_use]
    pub fn form_name(&self) -> &'static str {
        if self.drag.is_some() { "two-fluid" } else { "mixed" }
    }

    /// The laws of the bed.
    #[must_use]
    pub fn laws(&self) -> Vec<&'static Info> {
        let friction = if self.rise.is_some() { &friction::mu_iv::INFO } else { &friction::coulomb::INFO };
        let mut laws = vec![friction, self.viscosity.info()];
        laws.extend(self.drag.map(|_| &drag::carman_kozeny::INFO));
        laws.extend(self.dilatancy.map(|_| &dilatancy::phi_iv::INFO));
        laws
    }
}

/// Source of what a term of the bed is worth.
const CHAUCHAT: &str = "Chauchat & Medale (2010), section 3.2";

impl LaminarBed {
    /// The flow of which the model `kind` has this bed.
    #[must_use]
    pub fn scene(&self, kind: &'static str) -> Flow {
        Flow::Laminar(LaminarScene {
            kind,
            rho_f: self.rho_f,
            eta: self.eta,
            rho_p: self.rho_p,
            d: self.d,
            h_p: self.h_p,
            phi: self.phi,
            h: self.h,
            g: self.g,
            drive: match self.drive {
                Drive::PressureGradient(fall) => Some(fall),
                Drive::Wanted(..) => None,
            },
            mu_s: self.friction.mu_s,
            mu_2: self.rise.map(|rise| rise.mu_2),
            dilates: self.dilatancy.is_some(),
            viscosity: self.viscosity.relative(self.phi),
            viscosity_law: serde_json::to_value(self.viscosity)
                .ok()
                .and_then(|law| toml::Value::try_from(law).ok())
                .map(|law| law.to_string())
                .unwrap_or_default(),
            two_velocities: self.drag.is_some(),
            k_ck: self.drag.map(|drag| drag.k_ck),
            walls: false,
        })
    }

    /// What the bed takes for granted, from what was found.
    pub(in crate::models) fn premises(&self, results: &Results) -> Vec<Premise> {
        let drag = self.drag.and_then(|_| premises::DARCY.maybe(results.get(q::REYNOLDS_PARTICLE.name)));
        premises::laminar(&premises::LAMINAR, results).into_iter().chain(drag).collect()
    }

    /// The slip between the phases, if there are two velocities.
    pub(in crate::models) fn slip(&self) -> Option<Term> {
        self.drag.map(|_| Term {
            what: "slip between the phases",
            source: CHAUCHAT,
            test: TermTest::Solve {
                change: vec!["form=mixed".into(), "closures.drag=".into()],
                left: "one velocity for both",
                free: false,
            },
            dropped: Some(|flow| {
                if let Flow::Laminar(scene) = flow {
                    scene.k_ck = None;
                }
            }),
        })
    }
}

pub(in crate::models) fn laminar_bed(
    scene: &BedScene,
    laws: BedLaws,
    form: Form,
    model: &str,
    faults: &mut Faults,
) -> Option<LaminarBed> {
    let BedScene { fluid, grains, bed, flow } = scene;
    let level = faults.needed("bed.thickness", bed.thickness);
    let depth = faults.needed("flow.depth", flow.depth);
    let (level, phi, depth) = (level?, bed.phi().value(), depth?);
    let height = level + depth;
    if let Some(fault) = BedFault::no_depth(depth, level) {
        faults.push(("flow.depth", fault));
    }
    if level < grains.diameter {
        faults.push(("bed.thickness", BedFault::ThinnerThanAGrain { level, diameter: grains.diameter }));
    }
    if grains.density <= fluid.density {
        faults.push(("grains.density", BedFault::Floating { grains: grains.density, fluid: fluid.density }));
    }
    let phi_max = laws.viscosity.phi_max();
    if phi >= phi_max {
        faults.push(("bed.phi", ExactFault::Jammed { phi, phi_max }));
    }
    if let Some(MuIv { mu_s, mu_2, .. }) = laws.rise
        && mu_2 <= mu_s
    {
        faults.push(("closures.friction.mu_2", BedFault::FrictionFalls { mu_s, mu_2 }));
    }
    let mismatch = |family: &str, law: &str, model, allowed: &[&Info]| Fault::LawMismatch {
        family: family.into(),
        law: law.into(),
        model,
        allowed: allowed.iter().map(|info| info.law.to_owned()).collect(),
    };
    let (form_name, other, drag) = match (form, laws.drag) {
        (Form::Mixed, BedDrag::None) => ("mixed", None, None),
        (Form::TwoFluid, BedDrag::CarmanKozeny(law)) => ("two-fluid", None, Some(law)),
        (Form::Mixed, BedDrag::CarmanKozeny(_)) => ("mixed", Some(&drag::none::INFO), None),
        (Form::TwoFluid, BedDrag::None) => ("two-fluid", Some(&drag::carman_kozeny::INFO), None),
    };
    if let Some(other) = other {
        let fault = mismatch("drag", laws.drag.info().law, format!("{model} in the {form_name} form"), &[other]);
        faults.push(("closures.drag.law", fault));
    }
    let dilatancy = laws.dilatancy.filter(|_| laws.rise.is_some());
    if laws.dilatancy.is_some() && dilatancy.is_none() {
        let model = format!("{model} unless the friction is {}", friction::mu_iv::INFO.law);
        let fault = mismatch("dilatancy", dilatancy::phi_iv::INFO.law, model, &[&dilatancy::none::INFO]);
        faults.push(("closures.dilatancy.law", fault));
    }
    if dilatancy.is_some() && drag.is_some_and(|law: CarmanKozeny| law.phi_min == 0.0) {
        let model = format!("{model} with closures.dilatancy, unless closures.drag.phi_min is more than 0");
        let law = &drag::carman_kozeny::INFO;
        faults.push(("closures.drag.law", mismatch("drag", law.law, model, &[law])));
    }
    let of = |what: Wanted, value: Option<f64>| value.map(|value| Drive::Wanted(what, value));
    let drive = (flow.pressure_gradient.map(Drive::PressureGradient))
        .or(of(Wanted::Shields, scene.shields_drive()))
        .or(of(Wanted::MeanVelocity, flow.mean_velocity))
        .or(of(Wanted::Discharge, flow.discharge))?;
    Some(LaminarBed {
        rho_f: fluid.density,
        eta: fluid.viscosity,
        rho_p: grains.density,
        d: grains.diameter,
        h_p: level,
        phi,
        h: height,
        g: flow.gravity,
        drive,
        friction: laws.friction,
        rise: laws.rise,
        viscosity: laws.viscosity,
        drag,
        dilatancy,
    })
}
