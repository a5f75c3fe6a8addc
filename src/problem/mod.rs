//! What is solved: immutable values in SI, checked against each other. After this nothing is out of range and no unit remains.

mod bed;
mod coupled;
mod grains;
mod others;
pub mod premises;
mod section;
mod shear_cell;
mod sheet;
mod two_fluid;

pub use crate::closures::regularisation::{Regularisation, Smoothing};
pub use bed::{Drive, LaminarBed, RegularisedBed};
pub use coupled::{Coupled, FluidScheme, Surface};
pub use grains::{GrainBed, Impact, Trial};
pub use others::{BinghamDrive, BinghamPlane, GranularFilm, RegularisedPlane, RoughWall};
pub use section::{CavityFlow, Contents, DuctFlow, Method, Outline, SectionMethod};
pub use shear_cell::ShearCell;
pub use sheet::{BedReading, SheetFlow, SheetMethod};
pub use two_fluid::{FluidStress, State, TwoFluid};

use crate::case::checks::Class;
use crate::case::{Case, CaseError, Fault, Scene};
use crate::result::quantity;

/// A checked problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// stem of the case
    pub name: String,
    /// the question
    pub title: String,
    /// `kind` or `kind/solution`
    pub kind: &'static str,
    /// what is solved
    pub model: Model,
    /// number of levels of the profile, or of mobile grains
    pub cells: usize,
}

/// The models.
#[derive(Clone, Debug, PartialEq)]
pub enum Model {
    /// Newtonian fluid over a Coulomb bed, closed form
    Ouriemi(LaminarBed),
    /// Bingham fluid between two planes, closed form
    BinghamPlane(BinghamPlane),
    /// dry grains down a slope, closed form
    BagnoldFilm(GranularFilm),
    /// turbulent layer over a rough wall, closed form
    LogLaw(RoughWall),
    /// laminar flow over a bed, numerically
    Laminar(RegularisedBed),
    /// Bingham fluid between two planes, numerically
    Bingham(RegularisedPlane),
    /// two-layer sheet flow
    SheetFlow(SheetFlow),
    /// grains and fluid as two fluids
    TwoFluid(TwoFluid),
    /// grains that collide between two walls
    ShearCell(ShearCell),
    /// flow along a duct, in its cross-section
    Duct(DuctFlow),
    /// flow in a cavity under a sliding lid
    Cavity(CavityFlow),
    /// a bed of spheres, grain by grain
    Grains(GrainBed),
    /// grains in a fluid that drives them
    Coupled(Coupled),
    /// the impact of one sphere
    Impact(Impact),
    /// a few grains, held against what is known exactly
    Trial(Trial),
}

/// Faults found while comparing values with each other, by path.
type Faults = Vec<(&'static str, Fault)>;

impl Problem {
    /// Loads a case, a file or a shipped one, and checks it whole: its text, and its values against each other.
    ///
    /// # Errors
    /// Every violation of both kinds, as far as the values could be read.
    pub fn load(name: &str, overrides: &[String]) -> Result<(Case, Self), CaseError> {
        Self::check(Case::load(name, overrides))
    }

    /// Checks a case that was just read; one that is wrong already is checked as far as its values could be read.
    ///
    /// # Errors
    /// Every violation.
    pub fn check(case: Result<Case, CaseError>) -> Result<(Case, Self), CaseError> {
        match case {
            Ok(case) => Self::new(&case).map(|problem| (case, problem)),
            Err(error) => Err(match error.draft().map(Self::new) {
                Some(Err(more)) => error.and(more),
                _ => error,
            }),
        }
    }

    /// Checks what no schema can: values against each other, laws against the model, checks against the results.
    ///
    /// # Errors
    /// Every violation, with its place in the case.
    pub fn new(case: &Case) -> Result<Self, CaseError> {
        let mut faults = Faults::new();
        let (model, cells) = match &case.scene {
            Scene::Ouriemi(scene) => {
                (bed::ouriemi(scene, case.model, &mut faults).map(Model::Ouriemi), scene.grid.cells)
            }
            Scene::BinghamPlane(scene) => (others::bingham_plane(scene).map(Model::BinghamPlane), scene.grid.cells),
            Scene::BagnoldFilm(scene) => {
                (others::bagnold(scene, case.model, &mut faults).map(Model::BagnoldFilm), scene.grid.cells)
            }
            Scene::LogLaw(scene) => (others::log_law(scene, &mut faults).map(Model::LogLaw), scene.grid.cells),
            Scene::Laminar(scene) => {
                (bed::laminar(scene, case.model, &mut faults).map(Model::Laminar), scene.grid.cells)
            }
            Scene::Bingham(scene) => (others::bingham(scene, &mut faults).map(Model::Bingham), scene.grid.cells),
            Scene::SheetFlow(scene) => {
                (sheet::sheet_flow(scene, case.model, &mut faults).map(Model::SheetFlow), scene.grid.cells)
            }
            Scene::TwoFluid(scene) => {
                (two_fluid::two_fluid(scene, case.model, &mut faults).map(Model::TwoFluid), scene.grid.cells)
            }
            Scene::ShearCell(scene) => {
                (shear_cell::shear_cell(scene, case.model, &mut faults).map(Model::ShearCell), scene.grid.cells)
            }
            Scene::Duct(scene) => (section::duct(scene, &mut faults).map(Model::Duct), scene.grid.cells),
            Scene::DuctBed(scene) => (section::bed(scene, case.model, &mut faults).map(Model::Duct), scene.grid.cells),
            Scene::Cavity(scene) => (section::cavity(scene, &mut faults).map(Model::Cavity), scene.grid.cells),
            Scene::GrainsBed(scene) => {
                let bed = grains::bed(scene, &mut faults);
                (bed.map(Model::Grains), bed.map_or(0, |bed| bed.mobile))
            }
            Scene::Coupled(scene) => {
                let coupled = coupled::coupled(scene, case.model, &mut faults);
                (coupled.map(Model::Coupled), coupled.map_or(0, |coupled| coupled.bed.mobile))
            }
            Scene::Impact(scene) => (Some(Model::Impact(grains::impact(scene))), 1),
            Scene::Trial(scene) => (Some(Model::Trial(grains::trial(scene))), 1),
        };
        let mut faults: Vec<(String, Fault)> =
            faults.into_iter().map(|(path, fault)| (path.to_owned(), fault)).collect();
        checks(case, &mut faults);
        match model {
            Some(model) if faults.is_empty() => Ok(Self {
                name: case.name.clone(),
                title: case.scene.about().title.clone(),
                kind: case.model,
                model,
                cells,
            }),
            _ => Err(case.clone().refuse(faults)),
        }
    }

    /// The model in words, with its form where it has one.
    #[must_use]
    pub fn model_name(&self) -> String {
        match &self.model {
            Model::Ouriemi(bed) | Model::Laminar(RegularisedBed { bed, .. }) => {
                format!("{}, {}", self.kind, bed.form_name())
            }
            Model::Duct(DuctFlow { contents: Contents::Bed(bed), .. }) => {
                format!("{}, {}", self.kind, bed.form_name())
            }
            _ => self.kind.to_owned(),
        }
    }
}

/// Checks name catalogued results, or columns at a level; a limit is along a key of a table of the case.
fn checks(case: &Case, faults: &mut Vec<(String, Fault)>) {
    if let Some(limit) = case.scene.limit() {
        let key =
            limit.over.split_once('=').and_then(|(key, values)| Some((key.trim().split_once('.')?, values.trim())));
        if key.is_none_or(|((table, name), values)| table.is_empty() || name.is_empty() || values.is_empty()) {
            faults.push(("limit.over".into(), Fault::LimitKey { over: limit.over.clone() }));
        }
        if limit.beyond == Class::Holds {
            faults.push(("limit.beyond".into(), Fault::LimitHolds));
        }
    }
    for (i, check) in case.scene.checks().iter().enumerate() {
        let column = check.quantity.strip_prefix("profile.");
        let list = if column.is_some() { quantity::COLUMNS } else { quantity::RESULTS };
        let name = column.unwrap_or(&check.quantity);
        if quantity::find(list, name).is_none() {
            let nearest = crate::case::nearest(name, list.iter().map(|q| q.name));
            let prefix = if column.is_some() { "profile." } else { "" };
            let fault = Fault::UnknownQuantity {
                name: check.quantity.clone(),
                nearest: nearest.map(|n| format!("{prefix}{n}")),
            };
            faults.push((format!("check.{i}.quantity"), fault));
        } else if column.is_some() != check.at.is_some() {
            let fault = Fault::CheckLevel { name: check.quantity.clone(), column: column.is_some() };
            faults.push((format!("check.{i}.quantity"), fault));
        }
    }
}
