//! What grains between two walls say of their studies.

use super::ShearCell;
use crate::model::{Focus, Meshes, Number, ONE_KIND, StudyPlan, number};
use crate::result::quantity as q;

pub(super) fn plan(cell: &ShearCell) -> StudyPlan {
    StudyPlan { focus: Some(focus(cell)), ..StudyPlan::default() }
}

fn focus(cell: &ShearCell) -> Focus {
    const NUMBERS: &[Number] = &[
        number(&q::WALL_PRESSURE, "wall_pressure"),
        number(&q::WALL_SHEAR, "wall_shear"),
        number(&q::WALL_HEAT, "wall_heat"),
    ];
    Focus {
        velocity: &q::U_PARTICLE,
        velocity_unit: cell.temperature[0].max(cell.temperature[1]).sqrt(),
        numbers: NUMBERS,
        bed: false,
        paper_rms: false,
        sizes: None,
        meshes: Some(Meshes {
            cells: &[25, 50, 100, 200, 400],
            reference: 800,
            changes: &[],
            kinds: ONE_KIND,
            remarks: &[],
        }),
    }
}
