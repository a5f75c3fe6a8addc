//! Grains in a fluid in the terms that other models share: the flow, what it may not need, the case that answers another one.

use std::f64::consts::PI;

use super::{Coupled, Surface};
use crate::closures::fluctuation::Fluctuation;
use crate::closures::side_wall::SideWall;
use crate::dem::Bottom;
use crate::model::{BULK_FRICTION, COLLISIONS, Effort, Model, Offer, OwnCase, PACKED, Term, TermTest, TurbulentScene};
use crate::models::premises;
use crate::result::{Premise, Results, quantity as q};
use crate::scene::BedScene;
use crate::units::significant;

const MAURIN: &str = "Maurin et al. (2015); docs/coupled.md";
const CHASSAGNE: &str = "Chassagne et al. (2023)";
/// Shields number from which eddies make no difference to grains (docs/coupled.md: from 0.1 on the rates agree).
const EDDIES: f64 = 0.1;

/// Thickness of the packed bed \[m].
fn thickness(flow: &Coupled) -> f64 {
    let bed = &flow.bed;
    let across = if bed.side_walls { bed.size[1].min(bed.d) } else { bed.size[1] };
    let volume = bed.mobile as f64 * PI / 6.0 * bed.d.powi(3);
    volume / (PACKED * bed.size[0] * across.max(bed.size[1]))
}

pub(super) fn scene(flow: &Coupled) -> TurbulentScene {
    let bed = &flow.bed;
    let depth = match flow.surface {
        Surface::Depth(depth) => depth,
        Surface::Height(height) => height - thickness(flow),
    };
    TurbulentScene {
        kind: Coupled::INFO.name,
        rho_f: flow.rho_f,
        rho_p: bed.rho_p,
        nu: flow.nu(),
        d: bed.d,
        g: bed.g,
        depth,
        sine: bed.beta.sin(),
        theta: flow.rho_f * bed.g * depth * bed.beta.sin() / flow.stress_scale(),
        mu_s: BULK_FRICTION,
        contacts: Some((bed.contact.mu, bed.contact.e_n)),
        settling: None,
        walls: bed.side_walls,
        grains: Some((bed.contact.k_n, thickness(flow) / bed.d)),
    }
}

pub(super) fn terms(grains: &Coupled) -> Vec<Term> {
    let (bed, flow) = (&grains.bed, scene(grains));
    let known = |what, source, keep, has, because: String| Term {
        what,
        source,
        test: TermTest::Known { keep, has, because },
        dropped: None,
    };
    // Walls that are as rough as the bed would leave it this share of the stress, smooth ones leave more.
    let share = if flow.walls { 1.0 / (1.0 + 2.0 * flow.depth / bed.size[1]) } else { 1.0 };
    let keep = flow.theta * share < EDDIES;
    let has = grains.fluctuation != Fluctuation::None;
    let because = format!(
        "θ at the bed {} {EDDIES}: near the onset they decide, beyond they change less than the error of a mean",
        if keep { "may be below" } else { "is above" }
    );
    let mut terms = vec![known("eddies on the grains", MAURIN, keep, has, because)];
    let walls = if flow.walls { "their friction decides the rate of a narrow flume" } else { "there are none" };
    terms.push(known("side walls", MAURIN, flow.walls, flow.walls, walls.into()));
    let across = bed.size[0].min(if flow.walls { bed.size[0] } else { bed.size[1] }) / flow.d;
    let because = format!(
        "{} d: 10 d squared, or 100 d of a flume, is converged within the error of 25 s",
        significant(across, 3)
    );
    terms.push(known("large cell", MAURIN, false, true, because));
    if bed.bottom == Bottom::Slice {
        let deep = thickness(grains) / bed.d - flow.layers();
        let because = format!("{} layers lie under the moving ones", significant(deep.max(0.0), 2));
        terms.push(known("deep bed", CHASSAGNE, deep < 3.0, true, because));
    }
    terms
}

pub(super) fn offer(scene: &TurbulentScene, tolerance: f64) -> Offer {
    let theta = significant(scene.theta, 3);
    let because = if scene.walls {
        "no other model has the side walls".into()
    } else if !scene.at_least(COLLISIONS) {
        format!("θ = {theta} < {COLLISIONS}: single grains move, no continuum holds")
    } else {
        let wanted = format!("{} %", significant(100.0 * tolerance, 2));
        format!("θ = {theta}, and no continuum is known to be within {wanted} of the grains here")
    };
    let off = if scene.walls {
        "26 to 61 % more than was measured in a narrow flume (Frey 2014; docs/validation.md)"
    } else {
        "not known: it is what the continua are measured against"
    };
    Offer { effort: Effort::Minutes, because, off, case: OwnCase::Scene(Vec::new()) }
}

/// What grains in a fluid take for granted.
pub(super) fn premises(grains: &Coupled, of: &BedScene, results: &Results) -> Vec<Premise> {
    let (bed, flow) = (&grains.bed, scene(grains));
    // Across side walls there is no other cell.
    let [length, width] = bed.size.map(|extent| extent / bed.d);
    let cell = if bed.side_walls { premises::LONG_CELL.of(length) } else { premises::WIDE_CELL.of(length.min(width)) };
    let drift = results.iter().find(|(name, _)| *name == q::BED_LEVEL_DRIFT.name).and_then(|(_, drift)| {
        // A bed at rest has one level, and no error.
        let change = drift.value?.abs();
        if change > 0.0 { drift.stderr.map(|error| change / (2.0 * error)) } else { Some(0.0) }
    });
    // On a slope on which no bed rests all layers move.
    let rest = (thickness(grains) / bed.d - flow.layers()).max(0.0);
    let found = [
        premises::rigid(bed, (bed.rho_p - grains.rho_f) * bed.g),
        premises::AT_REST.maybe(Some(rest).filter(|_| bed.bottom == Bottom::Slice)),
        premises::SUBMERGED.maybe(Some(flow.depth / flow.d)),
        premises::NO_SUSPENSION.maybe(Some(of.settling_velocity().value() / flow.u_star())),
        premises::rests(of, BULK_FRICTION, PACKED),
        premises::SMOOTH_WALLS
            .maybe(Some(flow.depth / bed.size[1]).filter(|_| bed.side_walls && grains.side_wall == SideWall::None)),
        Some(cell),
        premises::SETTLED.maybe(drift),
    ];
    found.into_iter().flatten().collect()
}
