//! Advice on a turbulent flow over a bed: nothing, grains, two fluids or sheet flow; suspension, eddies, viscosity.

use super::flow::{PACKED, Turbulent};
use super::{Advice, AdviseError, Least, Number, Scene, Term, share};
use crate::units::significant;

const MAURIN: &str = "Maurin et al. (2015); docs/coupled.md";
const REVIL: &str = "Revil-Baudard & Chauchat (2013)";
const CHASSAGNE: &str = "Chassagne et al. (2023)";
/// Shields number at which the first grains move: intercept of Q*^(2/3), with eddies (docs/coupled.md).
const ONSET: f64 = 0.045;
/// Shields number from which eddies make no difference to grains (docs/coupled.md: from 0.1 on the rates agree).
const EDDIES: f64 = 0.1;
/// From here on grains collide, and the bed moves as a sheet.
pub(super) const COLLISIONS: f64 = 0.2;
const SHEET: f64 = 0.5;
/// Largest deviation of sheet flow from the grains, 20 to 25.2 % more transport at Shields numbers from 0.2 to 1 (docs/kinetic.md).
const SHEET_FLOW: f64 = 0.26;
/// Largest deviation of two colliding fluids from the grains, -4 to +14 % from this Shields number on, to 1 (docs/kinetic.md). Below,
/// at 0.2, they miss more than half of the transport.
const TWO_FLUIDS: (f64, f64) = (0.4, 0.15);
/// Stiffness over weight and size of a grain, k_n/((rho_p - rho_f) g d^2), of the reference flow of the grains.
const STIFFNESS: f64 = 1e4 / (1500.0 * 9.81 * 6e-3 * 6e-3);
/// Grain Reynolds number below which a flow is viscous.
const VISCOUS: f64 = 5.0;
/// Layers of a dense continuum.
const MANY: f64 = 6.0;

impl Turbulent {
    fn numbers(&self) -> Vec<Number> {
        let number = |name, value: f64, says: String| Number { name, value, says };
        let ratio = self.fall() / self.u_star();
        let mut numbers = vec![
            number("Shields number θ", self.theta, regime(self.theta).into()),
            number("fall over friction velocity w_s/u_*", ratio, {
                let says = if ratio > 1.0 {
                    "no suspension"
                } else if ratio < 0.8 {
                    "suspension"
                } else {
                    "suspension begins"
                };
                says.into()
            }),
            number("grain Reynolds number u_* d/ν", self.u_star() * self.d / self.nu, {
                let rough = self.u_star() * self.d / self.nu > 70.0;
                if rough { "rough: the viscous stress hardly matters" } else { "viscous stress matters" }.into()
            }),
            number("moving layers δ_s/d", self.layers(), {
                if self.layers() > MANY { "a dense continuum" } else { "few layers: no dense continuum" }.into()
            }),
            number("submergence h/d", self.depth / self.d, {
                let low = self.depth < 5.0 * self.d;
                if low { "low: the mixing length is that of a wake, not of a wall" } else { "deep over the grains" }
                    .into()
            }),
            number("weight along the slope", self.weight(), {
                if self.weight() < 1.0 {
                    format!("without it the moving layer is thinner by {}", share(self.weight()))
                } else {
                    "no bed rests on this slope".into()
                }
            }),
            number(
                "Stokes number ρ_p w_s d/(9 η)",
                self.rho_p * self.fall() * self.d / (9.0 * self.nu * self.rho_f),
                "impacts rebound above about 10".into(),
            ),
        ];
        if let Some(grains) = &self.grains {
            let pressure = (self.rho_p - self.rho_f) * self.g * PACKED * grains.layers * self.d;
            let rigid = grains.contact.k_n / (pressure * self.d);
            let says = if rigid >= 1e4 { "rigid grains" } else { "below 1e4: contacts are soft" };
            numbers.push(number("stiffness k_n/(P d)", rigid, says.into()));
        }
        numbers
    }

    fn least(&self, tolerance: f64) -> Least {
        let theta = significant(self.theta, 3);
        let least = |kind: &'static str, template: &'static str, because: String, values: Vec<String>| Least {
            kind,
            because,
            template,
            overrides: (kind != self.kind).then_some(values),
        };
        if self.theta < ONSET {
            let because =
                format!("θ = {theta} is below {ONSET}, where the first grains move: the flow over a bed at rest");
            let values = vec![
                format!("fluid.density={:?}", self.rho_f),
                format!("fluid.viscosity={:?}", self.nu * self.rho_f),
                format!("flow.height={:?}", self.depth),
                format!("flow.u_star={:?}", self.u_star()),
                format!("closures.wall.k_s={:?}", self.d),
            ];
            return least("exact/log-law", "exact_1d_loglaw", because, values);
        }
        let walls = self.grains.as_ref().is_some_and(|grains| grains.walls);
        let suspended = self.settling.is_some() && self.fall() < self.u_star()
            || self.u_star() * self.d / self.nu > VISCOUS && self.fall() < self.u_star();
        let known = !walls && self.is_measured();
        if !walls && (suspended || known && self.at_least(COLLISIONS) && tolerance >= SHEET_FLOW) {
            let because = if suspended {
                format!("θ = {theta} and grains in suspension, which no other model has")
            } else {
                let off = share(SHEET_FLOW);
                format!("θ = {theta}, and {} is enough: it carries up to {off} more than the grains", share(tolerance))
            };
            let fall = vec![format!("closures.suspension.settling_velocity={:?}", self.fall())];
            let slope = vec![format!("flow.slope={:?}", self.sine)];
            let values = [self.matter(), slope, fall, self.heights()].concat();
            return least("sheet-flow", "sheet_1d_theta06", because, values);
        }
        if known && self.at_least(TWO_FLUIDS.0) && tolerance >= TWO_FLUIDS.1 {
            let off = share(TWO_FLUIDS.1);
            let because = format!("θ = {theta}, and {} is enough: it is within {off} of the grains", share(tolerance));
            let flow = vec![
                format!("bed.thickness={:?}", 2.5 * self.layers().max(5.0) * self.d),
                format!("flow.shields={:?}", self.theta),
                format!("flow.slope={:?}", self.sine),
            ];
            let contacts =
                self.contacts.map(|(mu, e)| [format!("grains.friction={mu:?}"), format!("grains.restitution={e:?}")]);
            let flow = [flow, contacts.map(Vec::from).unwrap_or_default()].concat();
            return least("two-fluid", "kinetic_1d_theta06", because, [self.matter(), flow].concat());
        }
        let because = if walls {
            "no other model has the side walls".into()
        } else if !self.at_least(COLLISIONS) {
            format!("θ = {theta} < {COLLISIONS}: single grains move, no continuum holds")
        } else {
            format!("θ = {theta}, and no continuum is known to be within {} of the grains here", share(tolerance))
        };
        let flow = vec![
            format!("flow.depth={:?}", self.depth),
            format!("flow.slope={:?}", self.sine),
            format!("flow.length={:?}", 30.0 * self.d),
            format!("flow.width={:?}", 30.0 * self.d),
            format!("closures.contact.k_n={:?}", STIFFNESS * (self.rho_p - self.rho_f) * self.g * self.d * self.d),
        ];
        let contacts =
            self.contacts.map(|(mu, e)| [format!("closures.contact.mu={mu:?}"), format!("closures.contact.e_n={e:?}")]);
        let flow = [flow, contacts.map(Vec::from).unwrap_or_default()].concat();
        least("coupled", "coupled_3d_chassagne_quick", because, [self.matter(), flow].concat())
    }

    fn matter(&self) -> Vec<String> {
        vec![
            format!("fluid.density={:?}", self.rho_f),
            format!("fluid.viscosity={:?}", self.nu * self.rho_f),
            format!("grains.diameter={:?}", self.d),
            format!("grains.density={:?}", self.rho_p),
            format!("flow.gravity={:?}", self.g),
        ]
    }

    fn heights(&self) -> Vec<String> {
        let level = 2.5 * self.layers().max(5.0) * self.d;
        vec![format!("bed.level={level:?}"), format!("flow.height={:?}", level + self.depth)]
    }
}

/// What a Shields number says.
fn regime(theta: f64) -> &'static str {
    match theta {
        t if t < ONSET => "nothing moves",
        t if t < 0.99 * COLLISIONS => "single grains roll and jump",
        t if t < SHEET => "layers of colliding grains",
        _ => "sheet flow",
    }
}

pub(super) fn advise(scene: &Scene<'_>, flow: &Turbulent) -> Result<Advice, AdviseError> {
    let weight = flow.weight();
    if !(flow.theta.is_finite() && weight < 1.0) {
        let share = significant(weight, 3);
        let reason = format!(
            "no bed rests on this slope: what pulls grains and water down it is {share} of what friction holds"
        );
        return Err(AdviseError::NoFlow { reason });
    }
    let mut terms = Vec::new();
    if let Some((suspension, viscosity)) = flow.continuum {
        if suspension {
            let change = ["closures.suspension={ law = \"none\" }"];
            terms.extend(scene.without("suspension", &change, ("a flow without it", REVIL)));
        }
        if viscosity {
            let change = ["closures.mixture_viscosity={ law = \"clear\" }"];
            terms.extend(scene.without(
                "viscosity of the mixture",
                &change,
                ("the viscosity of the clear fluid", REVIL),
            ));
        }
        let change = ["closures.rearrangement={ law = \"free-fall\" }"];
        let dropped = ("the free-fall time alone", REVIL);
        terms.extend(scene.without("largest of three rearrangement times", &change, dropped));
    }
    if let Some(grains) = &flow.grains {
        // Walls that are as rough as the bed would leave it this share of the stress, smooth ones leave more.
        let bed = if grains.walls { 1.0 / (1.0 + 2.0 * flow.depth / grains.size[1]) } else { 1.0 };
        let keep = flow.theta * bed < EDDIES;
        let has = if grains.eddies { "" } else { "; this case has none" };
        terms.push(Term {
            what: "eddies on the grains",
            keep,
            error: None,
            because: format!(
                "θ at the bed {} {EDDIES}: near the onset they decide, beyond they change less than the error of a mean{has}",
                if keep { "may be below" } else { "is above" }
            ),
            source: MAURIN,
        });
        terms.push(Term {
            what: "side walls",
            keep: grains.walls,
            error: None,
            because: if grains.walls {
                "their friction decides the rate of a narrow flume".into()
            } else {
                "there are none".into()
            },
            source: MAURIN,
        });
        let across = grains.size[0].min(if grains.walls { grains.size[0] } else { grains.size[1] }) / flow.d;
        terms.push(Term {
            what: "large cell",
            keep: false,
            error: None,
            because: format!(
                "{} d: 10 d squared, or 100 d of a flume, is converged within the error of 25 s",
                significant(across, 3)
            ),
            source: MAURIN,
        });
        if grains.slice {
            let deep = grains.layers - flow.layers();
            terms.push(Term {
                what: "deep bed",
                keep: deep < 3.0,
                error: None,
                because: format!("{} layers lie under the moving ones", significant(deep.max(0.0), 2)),
                source: CHASSAGNE,
            });
        }
    }
    Ok(Advice { numbers: flow.numbers(), least: flow.least(scene.tolerance), terms })
}
