//! How far a run lies from the truth: norms of the velocity, and the numbers that a user would take from it.

use std::borrow::Cow;

use super::Row;
use crate::compare::norms::deviation;
use crate::model::{OnMesh, Problem};
use crate::models::bingham::RegularisedPlane;
use crate::models::exact::bingham::BinghamDrive;
use crate::models::laminar::RegularisedBed;
use crate::models::section::{CavityFlow, Contents, Duct, DuctBed};
use crate::result::quantity::{self as q, Quantity};
use crate::result::{Profile, Results};

/// What a study of a model measures, and in which units.
#[derive(Clone, Debug)]
pub(super) struct Focus {
    /// the velocity whose norms are taken
    pub velocity: &'static Quantity,
    /// lambda in its unit, as a formula
    pub lambda: &'static str,
    /// that unit [1/s]
    pub shear_unit: f64,
    /// unit of the root mean squares [m/s]
    pub velocity_unit: f64,
    /// the number besides the velocity, and its short name
    pub number: (&'static Quantity, &'static str),
    /// whether the velocity of the grains at the bed level is one of the measures
    pub bed: bool,
    /// meshes over which it converges
    pub meshes: Option<Meshes>,
    /// yield stress [Pa] times height over viscosity [m/s], which over a velocity is the Bingham number
    yield_velocity: f64,
    /// the Bingham number in words
    pub bingham: &'static str,
}

/// Meshes of a study, each with twice the cells of the one before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meshes {
    /// cells of the coarsest
    pub coarsest: usize,
    /// number of meshes
    pub count: u32,
    /// key that places a node or a row on the yield level
    pub node: &'static str,
}

impl Meshes {
    /// A multiple of 12, so that the cells of every layer double with the mesh.
    const PLANE: Self = Self { coarsest: 24, count: 7, node: "grid.yield_node" };
    const SECTION: Self = Self { coarsest: 12, count: 4, node: "grid.yield_row" };
}

/// Columns of the measures, in this order.
pub(super) const L2: &str = "error_velocity_l2";
const LARGEST: &str = "error_velocity_largest";
pub(super) const RMS: &str = "velocity_rms_scaled";
pub(super) const RMS_PAPER: &str = "velocity_rms_paper_scaled";
pub(super) const AT_BED: &str = "error_velocity_at_bed";

/// What a run is compared with.
pub(super) struct Truth<'a> {
    /// columns over z [m]
    pub profile: Cow<'a, Profile>,
    /// numbers [SI]
    pub results: &'a Results,
}

impl Focus {
    /// What there is to measure in `problem`; `None` for a model that is not solved numerically.
    pub fn of(problem: &Problem) -> Option<Self> {
        if let Some(OnMesh { problem: RegularisedBed { bed, .. }, .. }) = problem.get() {
            return Some(Self {
                velocity: &q::U_PARTICLE,
                lambda: "λ η/(Δρ g H)",
                shear_unit: bed.velocity_scale() / bed.h,
                velocity_unit: bed.velocity_scale(),
                number: (&q::TRANSPORT_RATE, "transport_rate"),
                bed: true,
                meshes: Some(Meshes::PLANE),
                // the yield stress of the first layer of grains, as in section 3.2 of the paper
                yield_velocity: bed.friction.mu_s * (bed.rho_p - bed.rho_f) * bed.g * bed.d * bed.h / bed.eta,
                bingham: "μ_s (ρ_p - ρ_f) g d H/(η U_m)",
            });
        }
        if let Some(OnMesh { problem: RegularisedPlane { plane, .. }, .. }) = problem.get() {
            return Some(Self {
                velocity: &q::U_MIXTURE,
                lambda: match plane.drive {
                    BinghamDrive::MeanVelocity(_) => "λ H/Uₘ",
                    BinghamDrive::PressureGradient(_) => "λ η/(G H)",
                },
                shear_unit: plane.shear_scale(),
                velocity_unit: plane.shear_scale() * plane.h,
                number: (&q::PLUG_VELOCITY, "plug_velocity"),
                bed: false,
                meshes: Some(Meshes::PLANE),
                yield_velocity: plane.tau_0 * plane.h / plane.eta,
                bingham: "τ_0 H/(η U_m)",
            });
        }
        let duct = problem.get().map(|Duct(flow)| flow);
        if let Some(OnMesh { problem: flow, .. }) = duct.or(problem.get().map(|DuctBed(flow)| flow)) {
            let (unit, number, yields, bingham) = match &flow.contents {
                Contents::Bingham { tau_0, .. } => ("λ η/(G H)", (&q::FLOW_RATE, "flow_rate"), *tau_0, "τ_0 H/(η U_m)"),
                Contents::Bed(bed) => {
                    let yields = bed.friction.mu_s * (bed.rho_p - bed.rho_f) * bed.g * bed.d;
                    let number = (&q::BED_FLUX, "bed_flux");
                    ("λ η/(Δρ g H)", number, yields, "μ_s (ρ_p - ρ_f) g d H/(η U_m)")
                }
            };
            return Some(Self {
                velocity: &q::U_MIXTURE,
                lambda: unit,
                shear_unit: flow.shear_scale(),
                velocity_unit: flow.shear_scale() * flow.h,
                number,
                bed: false,
                meshes: Some(Meshes::SECTION),
                yield_velocity: yields * flow.h / flow.viscosity(),
                bingham,
            });
        }
        // The measures are those of a bed under two planes; sheet flow and grains have none of their own yet.
        let OnMesh { problem: flow, .. }: &OnMesh<CavityFlow> = problem.get()?;
        Some(Self {
            velocity: &q::U_MIXTURE,
            lambda: "λ H/U",
            shear_unit: flow.lid / flow.h,
            velocity_unit: flow.lid,
            number: (&q::STREAM_MAX, "stream_function"),
            bed: false,
            meshes: None,
            yield_velocity: flow.tau_0 * flow.h / flow.eta,
            bingham: "τ_0 H/(η U)",
        })
    }

    /// The Bingham number on the mean velocity of `results`, or the one that they have.
    pub fn bingham_number(&self, results: &Results) -> Option<f64> {
        let on_mean = results.get(q::MEAN_VELOCITY.name).filter(|u| *u > 0.0).map(|u| self.yield_velocity / u);
        on_mean.or_else(|| results.get(q::BINGHAM.name))
    }

    /// Column of the error of the number.
    pub fn number_error(&self) -> String {
        format!("error_{}", self.number.1)
    }

    /// The columns of measures, one value per row; a row without truth or profile has none.
    pub fn measures<'a>(
        &self,
        rows: &'a [Row],
        truth: impl Fn(&'a Row) -> Option<Truth<'a>>,
    ) -> Vec<(String, Vec<Option<f64>>)> {
        let mut names = vec![L2.to_owned(), LARGEST.into(), RMS.into(), RMS_PAPER.into(), self.number_error()];
        if self.bed {
            names.push(AT_BED.into());
        }
        let mut columns: Vec<(String, Vec<Option<f64>>)> = names.into_iter().map(|name| (name, Vec::new())).collect();
        for row in rows {
            let found = truth(row).and_then(|truth| self.measure(row, &truth)).unwrap_or([None; 6]);
            for ((_, values), value) in columns.iter_mut().zip(found) {
                values.push(value.filter(|x| x.is_finite()));
            }
        }
        columns
    }

    fn measure(&self, row: &Row, truth: &Truth<'_>) -> Option<[Option<f64>; 6]> {
        let run = row.profile.as_ref()?;
        let d = deviation(&truth.profile, run, self.velocity)?;
        let name = self.number.0.name;
        let relative = |(a, b): (f64, f64)| (a - b).abs() / b.abs();
        let number = row.result(name).zip(truth.results.get(name)).map(relative);
        let rms = d.rms / self.velocity_unit;
        let paper = rms / (d.levels as f64).sqrt();
        Some([d.l2_relative, d.linf_relative, Some(rms), Some(paper), number, self.at_bed(run, truth).map(relative)])
    }

    /// Grain velocity at the highest level that has one, in the run and in truth.
    fn at_bed(&self, run: &Profile, truth: &Truth<'_>) -> Option<(f64, f64)> {
        let values = run.get(self.velocity).filter(|_| self.bed)?;
        let top = values.iter().rposition(Option::is_some)?;
        let z = run.axis().get(top).copied()?;
        Some((values.get(top).copied().flatten()?, truth.profile.at(self.velocity, z)?))
    }
}

/// A column of the measures.
pub(super) fn column<'a>(measures: &'a [(String, Vec<Option<f64>>)], name: &str) -> &'a [Option<f64>] {
    measures.iter().find(|(n, _)| n == name).map_or(&[], |(_, values)| values)
}
