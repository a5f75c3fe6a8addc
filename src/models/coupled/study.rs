//! What grains in a fluid say of their studies.

use super::Coupled;
use crate::model::{Rung, StudyPlan};

/// Shorter runs, smaller cells, softer and harder grains, older fluids, a frozen deep bed: from the case itself, one at a time.
pub(super) fn plan(flow: &Coupled) -> StudyPlan {
    let (duration, [length, width]) = (flow.bed.discrete.duration, flow.bed.size);
    let rung = |series, setting, changes| Rung { series, setting, changes };
    let lasting = |share: f64| format!("discrete.duration={}", share * duration);
    let mut rungs: Vec<Rung> = [0.125, 0.25, 0.5, 1.0]
        .iter()
        .map(|&share| rung("duration", format!("{} s", share * duration), vec![lasting(share)]))
        .collect();
    for share in [0.25, 0.5] {
        let mut changes = vec![format!("cell.length={}", share * length)];
        let mut words = format!("{} mm long", 1e3 * share * length);
        if !flow.bed.side_walls {
            changes.push(format!("cell.width={}", share * width));
            words += &format!(", {} mm wide", 1e3 * share * width);
        }
        rungs.push(rung("smaller cell", words, changes));
    }
    for stiffness in ["2.5e3", "1e4"] {
        let set = ["k_n", "k_s"].map(|k| format!("closures.contact.{k}={stiffness}"));
        rungs.push(rung("other stiffness", format!("k_n = k_s = {stiffness} N/m"), set.to_vec()));
    }
    for period in ["0.03 s", "0.1 s"] {
        rungs.push(rung("coupling period", period.into(), vec![format!("discrete.coupling_period={period}")]));
    }
    for creep in ["0.003", "0.01"] {
        let words = format!("layers frozen below {creep} d in 0.2 s");
        rungs.push(rung("deep bed frozen", words, vec![format!("discrete.freeze_below={creep}")]));
    }
    StudyPlan { rungs, ..StudyPlan::default() }
}
