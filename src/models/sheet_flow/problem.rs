//! A turbulent flow over a bed that shears: the two-layer sheet flow.

use super::case::{BedLevel, SheetMethod, SheetSmoothing, SheetTable};
use super::{equations, figures, run, study};

use crate::closures::Info;
use crate::closures::dilatancy::{self, PhiI};
use crate::closures::drag::{self, Dallavalle};
use crate::closures::friction::{FrictionLaw, MuI};
use crate::closures::lid::Lid;
use crate::closures::mixing_length::{self, BelowPacked, LiSawamoto};
use crate::closures::mixture_viscosity::{MixtureViscosity, RelativeViscosity};
use crate::closures::rearrangement::Rearrangement;
use crate::closures::role::Only;
use crate::closures::suspension::{Settling, Suspension};
use crate::model::{
    COLLISIONS, Description, Effort, Faults, Flow, Model, ModelInfo, Offer, OnMesh, OwnCase, Solve, SteadyDrive,
    StudyPlan, Term, TermTest, TurbulentScene,
};
use crate::models::premises;
use crate::models::sheet_flow::SheetFlowFault;
use crate::models::{BedFault, RegularisationSize};
use crate::result::Context;
use crate::result::Premise;
use crate::result::Results;
use crate::result::quantity as q;
use crate::result::{Failure, Figure, Outcome};
use crate::scene::BedScene;
use crate::scene::Scene;
use crate::units::significant;

/// How the pseudo-time iteration steps, and when it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PseudoTime {
    /// step \[s]
    pub step: f64,
    /// relative residual at which it has converged
    pub tolerance: f64,
    /// iterations before giving up
    pub max_iterations: usize,
}

/// A sheet flow. All values SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetFlow<F = MuI> {
    /// density of the fluid [kg/m3]
    pub rho_f: f64,
    /// viscosity of the fluid [Pa s]
    pub eta: f64,
    /// density of the grains [kg/m3]
    pub rho_p: f64,
    /// diameter of the grains \[m]
    pub d: f64,
    /// gravity [m/s2]
    pub g: f64,
    /// flow height \[m]
    pub height: f64,
    /// bed level, in the flow or at rest packed at phi_max \[m]
    pub level: f64,
    /// depth of the clear fluid over the bed at rest \[m]
    pub depth: f64,
    /// what the bed level is
    pub bed_level: BedLevel,
    /// wanted fluid stress at the bed level \[Pa]
    pub tau_b: Option<f64>,
    /// sine of the slope
    pub sine: Option<f64>,
    /// top of the flow
    pub lid: Lid,
    /// friction of the grains
    pub friction: F,
    /// dilatancy of the grains
    pub dilatancy: PhiI,
    /// rearrangement time of the grains
    pub rearrangement: Rearrangement,
    /// effective viscosity of the mixture
    pub viscosity: MixtureViscosity,
    /// drag between the phases
    pub drag: Dallavalle,
    /// mixing length of the turbulence
    pub mixing_length: LiSawamoto,
    /// grains in suspension
    pub suspension: Suspension,
    /// regularisation [1/s]; 0 for the exact yield
    pub lambda: f64,
    /// solid volume under the interface without the buoyancy of the viscous stress \[m]
    pub cut: f64,
    /// whether it becomes deeper where the equations change type below it
    pub deepen_cut: bool,
    /// how it is solved
    pub method: SheetMethod,
    /// how the pseudo-time iteration steps and when it ends
    pub pseudo_time: PseudoTime,
}

impl<F: FrictionLaw> SheetFlow<F> {
    /// Stress scale (rho_p - rho_f) g d \[Pa].
    #[must_use]
    pub fn stress_scale(&self) -> f64 {
        (self.rho_p - self.rho_f) * self.g * self.d
    }

    /// Velocity scale sqrt((rho_p/rho_f - 1) g d) [m/s].
    #[must_use]
    pub fn velocity_scale(&self) -> f64 {
        (self.stress_scale() / self.rho_f).sqrt()
    }
}

/// Largest deviation from the grains, 20 to 25.2 % more transport at Shields numbers from 0.2 to 1 (docs/kinetic.md).
const ERROR: f64 = 0.26;

impl<F: FrictionLaw> Model for OnMesh<SheetFlow<F>> {
    const INFO: ModelInfo = ModelInfo::new("sheet-flow").taking(&["slope", "shields", "u_star"]).under(&[
        "free-surface",
        "stress",
        "solved",
        "colebrook-white",
    ]);
    type Scene = BedScene;
    type Table = SheetTable<F>;

    fn build(scene: &BedScene, table: &SheetTable<F>, faults: &mut Faults) -> Option<Self> {
        let BedScene { fluid, grains, flow, .. } = scene;
        let SheetTable { closures, regularisation, solver, .. } = table;
        let thickness = faults.needed("bed.thickness", scene.bed.thickness);
        let depth = faults.needed("flow.depth", scene.depth());
        let (thickness, depth) = (thickness?, depth?);
        let height = thickness + depth;
        if let Some(fault) = BedFault::no_depth(depth, thickness) {
            faults.push(("flow.depth", fault));
        }
        if thickness < grains.diameter {
            let fault = BedFault::ThinnerThanAGrain { level: thickness, diameter: grains.diameter };
            faults.push(("bed.thickness", fault));
        }
        if grains.density <= fluid.density {
            faults.push(("grains.density", BedFault::Floating { grains: grains.density, fluid: fluid.density }));
        }
        let (Only(friction), Only(dilatancy)) = (closures.friction, closures.dilatancy);
        let (Only(drag), Only(mixing_length)) = (closures.drag, closures.mixing_length);
        // The grains of the bed of the scene, at rest as this model packs them.
        let level = match table.bed_level {
            BedLevel::AtRest => thickness * (scene.bed.phi().value() / dilatancy.phi_max),
            BedLevel::InFlow => thickness,
        };
        let phi_max = closures.mixture_viscosity.phi_max();
        if phi_max < dilatancy.phi_max {
            let fault = SheetFlowFault::PackedBeyond { law: "the viscosity", phi_max, bed: dilatancy.phi_max };
            faults.push(("closures.mixture_viscosity.phi_max", fault));
        }
        let lid = flow.top.lid()?;
        // Over a bed whose grains are given the level follows: the slope of the flow is what is the same for every model.
        let slope = scene.slope().filter(|_| table.bed_level == BedLevel::AtRest && flow.slope.is_none());
        let sine = slope.map_or_else(|| flow.sine().ok(), |slope| Some(Some(slope.sin())));
        let (mu_s, mu_2) = (friction.least(), friction.most());
        if mu_2 <= mu_s {
            faults.push(("closures.friction.mu_2", BedFault::FrictionFalls { mu_s, mu_2 }));
        }
        if mixing_length.phi_max < dilatancy.phi_max || mixing_length.below_packed == BelowPacked::Zero {
            let (phi_max, bed) = (mixing_length.phi_max, dilatancy.phi_max);
            faults.push((
                "closures.mixing_length.phi_max",
                SheetFlowFault::PackedBeyond { law: "the mixing length", phi_max, bed },
            ));
        }
        let lambda = match (regularisation.law, regularisation.lambda) {
            (SheetSmoothing::None, None) => Some(0.0),
            (SheetSmoothing::Simple, Some(lambda)) => Some(lambda),
            (law, given) => {
                let exact = law == SheetSmoothing::None;
                let given = usize::from(given.is_some());
                faults.push(("regularisation", RegularisationSize { given, exact, keys: &["lambda"] }));
                None
            }
        };
        if table.method == SheetMethod::Iteration && lambda == Some(0.0) {
            faults.push(("method", SheetFlowFault::IterationNeedsCreep));
        }
        let (lambda, sine) = (lambda?, sine?);
        let drive = sine.map(|sine| fluid.density * flow.gravity * sine * depth);
        if let (Lid::Stress(law), Some(drive)) = (lid, drive)
            && flow.shields.is_none()
            && flow.u_star.is_none()
            && depth > 0.0
            && law.stress >= drive
        {
            faults.push(("flow.top", SheetFlowFault::LidTakesAll { stress: law.stress, drive }));
        }
        let problem = SheetFlow {
            rho_f: fluid.density,
            eta: fluid.viscosity,
            rho_p: grains.density,
            d: grains.diameter,
            g: flow.gravity,
            height,
            level,
            depth,
            bed_level: table.bed_level,
            // Where the depth follows from the stress, depth and slope are the drive, as for every model of this scene.
            tau_b: match (flow.shields, flow.u_star) {
                _ if flow.depth.is_none() => None,
                _ if slope.is_some() => None,
                (Some(shields), _) => Some(shields * (grains.density - fluid.density) * flow.gravity * grains.diameter),
                (None, Some(u_star)) => Some(fluid.density * u_star * u_star),
                (None, None) => None,
            },
            sine,
            lid,
            friction,
            dilatancy,
            rearrangement: closures.rearrangement,
            viscosity: closures.mixture_viscosity,
            drag,
            mixing_length,
            suspension: closures.suspension.settling_at(scene.settling_velocity().value()),
            lambda,
            cut: regularisation.interface_cut * grains.diameter,
            deepen_cut: regularisation.deepen_cut,
            method: table.method,
            pseudo_time: PseudoTime {
                step: solver.time_step,
                tolerance: solver.tolerance,
                max_iterations: solver.max_iterations,
            },
        };
        Some(Self { problem, cells: table.grid.cells })
    }

    fn offer(flow: &Flow, tolerance: f64) -> Option<Offer> {
        let Flow::Turbulent(scene) = flow else { return None };
        let suspends = scene.suspends();
        let serves = scene.is_measured() && scene.at_least(COLLISIONS) && tolerance >= ERROR;
        if scene.walls || !(suspends || serves) {
            return None;
        }
        let theta = significant(scene.theta, 3);
        let (off, because) = if suspends {
            let off = "not known for grains in suspension; profiles beside those measured by Sumer et al. (1996): docs/sheet-flow.md";
            (off, format!("θ = {theta} and grains in suspension, which no other model has"))
        } else {
            let [wanted, off] = [tolerance, ERROR].map(|share| format!("{} %", significant(100.0 * share, 2)));
            let because = format!("θ = {theta}, and {wanted} is enough: it carries up to {off} more than the grains");
            ("20 to 25 % more than the grains (docs/kinetic.md)", because)
        };
        Some(Offer { effort: Effort::Milliseconds, because, off, case: OwnCase::Scene(Vec::new()) })
    }
}

impl<F: FrictionLaw> Solve for OnMesh<SheetFlow<F>> {
    fn solve(&self, context: &mut Context<'_>) -> Result<Outcome, Failure> {
        run(&self.problem, self.cells, context.watch)
    }

    fn figures(&self, name: &str, outcome: &Outcome) -> Vec<Figure> {
        figures::figures(name, outcome)
    }

    fn describe(&self) -> Description {
        Description { form: None, equations: equations(&self.problem), laws: laws(&self.problem) }
    }

    fn study(&self) -> StudyPlan {
        study::plan(&self.problem, self.cells)
    }

    fn drive(&self) -> Option<SteadyDrive> {
        Some(SteadyDrive::of(self.problem.velocity_scale(), "another method, or more grid.cells"))
    }

    fn cells(&self) -> usize {
        self.cells
    }

    fn flow(&self) -> Result<Option<Flow>, Failure> {
        let flow = &self.problem;
        let solved = match Context::quiet(|context| self.solve(context)) {
            Ok(outcome) => Some(outcome.results),
            Err(_) if flow.tau_b.is_some() && flow.sine.is_some() => None,
            Err(failure) => return Err(failure),
        };
        let result = |name: &str| solved.as_ref().and_then(|results| results.get(name));
        let weight = |sine: f64| flow.rho_f * flow.g * flow.depth * sine;
        let free = flow.sine.filter(|_| flow.lid == Lid::FreeSurface);
        let found = || result(q::SHIELDS_BED.name);
        let theta =
            flow.tau_b.or(free.map(weight)).map(|tau| tau / flow.stress_scale()).or_else(found).unwrap_or(f64::NAN);
        let balanced = theta * flow.stress_scale() / weight(1.0);
        Ok(Some(Flow::Turbulent(TurbulentScene {
            kind: Self::INFO.name,
            rho_f: flow.rho_f,
            rho_p: flow.rho_p,
            nu: flow.eta / flow.rho_f,
            d: flow.d,
            g: flow.g,
            depth: flow.depth,
            sine: flow.sine.or(result(q::SLOPE_SINE.name)).unwrap_or(balanced),
            theta,
            mu_s: flow.friction.least(),
            contacts: None,
            settling: flow.suspension.settling_velocity(),
            walls: false,
            grains: None,
        })))
    }

    fn premises(&self, scene: &Scene, results: &Results) -> Vec<Premise> {
        let (Scene::Bed(scene), flow) = (scene, &self.problem) else { return Vec::new() };
        let of = |quantity: &q::Quantity| results.get(quantity.name);
        let (depth, k_s) = (flow.depth, of(&q::ROUGHNESS));
        let rough = of(&q::U_STAR).zip(k_s).map(|(u_star, k_s)| u_star * k_s * flow.rho_f / flow.eta);
        let mut found = vec![
            flow.a_layer_moves(results),
            premises::SHEET.maybe(of(&q::SHIELDS)),
            premises::MANY_LAYERS.maybe(of(&q::SHEET_THICKNESS).map(|thickness| thickness / flow.d)),
            premises::SHALLOW_ROUGHNESS.maybe(k_s.map(|k_s| k_s / depth)),
            premises::SUBMERGED.maybe(Some(depth / flow.d)),
            premises::ROUGH_WALL.maybe(rough),
            premises::PACKED_AS_THE_LAW.maybe(scene.bed.phi.map(|phi| (flow.dilatancy.phi_max - phi).abs())),
            premises::AT_REST.maybe(of(&q::YIELD_LEVEL).map(|level| level / flow.d)),
        ];
        if flow.lid == Lid::FreeSurface {
            found.push(premises::rests(scene, flow.friction.least(), flow.dilatancy.phi_max));
        }
        if flow.suspension == Suspension::None {
            found.push(premises::no_suspension(scene));
        }
        found.into_iter().flatten().collect()
    }

    fn terms(&self) -> Vec<Term> {
        let solve = |what, change: &str, left| Term {
            what,
            source: "Revil-Baudard & Chauchat (2013)",
            test: TermTest::Solve { change: vec![change.into()], left, free: false },
            dropped: None,
        };
        let mut terms = Vec::new();
        if self.problem.suspension != Suspension::None {
            terms.push(solve("suspension", "closures.suspension={ law = \"none\" }", "a flow without it"));
        }
        if self.problem.viscosity != MixtureViscosity::Clear {
            let left = "the viscosity of the clear fluid";
            terms.push(solve("viscosity of the mixture", "closures.mixture_viscosity={ law = \"clear\" }", left));
        }
        let left = "the free-fall time alone";
        let change = "closures.rearrangement={ law = \"free-fall\" }";
        terms.push(solve("largest of three rearrangement times", change, left));
        terms
    }
}

fn laws<F: FrictionLaw>(flow: &SheetFlow<F>) -> Vec<&'static Info> {
    vec![
        F::INFO,
        &dilatancy::phi_i::INFO,
        flow.rearrangement.info(),
        flow.viscosity.info(),
        &drag::dallavalle::INFO,
        &mixing_length::li_sawamoto::INFO,
        flow.suspension.info(),
        flow.lid.info(),
    ]
}
