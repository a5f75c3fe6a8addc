//! Which tables each model takes: one struct per model, and the schema as their `oneOf`.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::checks::{Check, Limit};
use super::coupled::{CoupledBed, CoupledClosures, CoupledDiscrete, CoupledFlow, CoupledModel};
use super::grain_tables::{
    Discrete, GrainBed, GrainClosures, GrainFlow, GrainsModel, ImpactFlow, ImpactModel, ImpactSteps, TrialFlow,
    TrialModel,
};
use super::section::{
    BedFlow, BedModel, CavityFlow, CavityGrid, CavityModel, DuctFlow, DuctModel, SectionGrid, SectionSolver,
};
use super::shear_cell::{ShearCell as ShearCellFlow, ShearCellClosures, ShearCellModel};
use super::sheet::{SheetBed, SheetClosures, SheetFlowTable, SheetGrid, SheetModel, SheetRegularisation, SheetSolver};
use super::tables::{
    About, BagnoldModel, Bed, BedClosures, BinghamFluid, BinghamKindModel, BinghamModel, Film, FilmClosures, FilmFlow,
    Fluid, Grains, Grid, LaminarFlow, LaminarModel, LogLawModel, OuriemiModel, PlaneFlow, RegularisationTable,
    WallClosures, WallFlow, YieldGrid,
};
use super::two_fluid::{
    CollidingGrains, TwoFluidBed, TwoFluidClosures, TwoFluidFlow, TwoFluidGrid, TwoFluidModel, TwoFluidRegularisation,
    TwoFluidSolver,
};

macro_rules! scenes {
    ($($(#[$doc:meta])* $name:ident ($scene:literal) { $($(#[$attribute:meta])* $table:ident: $type:ty,)* })*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
            pub struct $name {
                /// Version of the file format.
                #[schemars(extend("minimum" = 1, "maximum" = 1))]
                pub format: u32,
                /// What the case is about.
                pub case: About,
                $($(#[$attribute])* pub $table: $type,)*
                /// Numbers that the case must give.
                #[serde(default, skip_serializing_if = "Vec::is_empty")]
                pub check: Vec<Check>,
                /// Where the method ends.
                #[serde(default, skip_serializing_if = "Option::is_none")]
                pub limit: Option<Limit>,
            }
        )*

        /// The tables of a case: which ones there are depends on the model.
        #[derive(Clone, Debug, PartialEq, Serialize)]
        #[serde(untagged)]
        pub enum Scene {
            $($(#[$doc])* $name($name),)*
        }

        impl Scene {
            /// Name (`kind` or `kind/solution`) and JSON Schema of each scene.
            pub(super) fn schemas() -> Vec<(&'static str, Value)> {
                vec![$(($scene, schema_of::<$name>())),*]
            }

            /// The tables of the scene `name`, from a checked and normalised document.
            ///
            /// # Errors
            /// What the checks let through and the types do not take: a defect of the schema.
            pub(super) fn build(name: &str, document: Value) -> Result<Self, serde_json::Error> {
                match name {
                    $($scene => serde_json::from_value(document).map(Self::$name),)*
                    other => Err(serde::de::Error::custom(format!("no scene {other}"))),
                }
            }

            /// Numbers that the case must give.
            #[must_use]
            pub fn checks(&self) -> &[Check] {
                match self { $(Self::$name(scene) => &scene.check),* }
            }

            /// Where the method of the case ends.
            #[must_use]
            pub fn limit(&self) -> Option<&Limit> {
                match self { $(Self::$name(scene) => scene.limit.as_ref()),* }
            }

            /// What the case is about.
            #[must_use]
            pub fn about(&self) -> &About {
                match self { $(Self::$name(scene) => &scene.case),* }
            }
        }
    };
}

scenes! {
    /// Newtonian fluid over a Coulomb bed between two planes, in closed form.
    Ouriemi ("exact/ouriemi") {
        /// The fluid.
        fluid: Fluid,
        /// The grains.
        grains: Grains,
        /// The bed.
        bed: Bed,
        /// Geometry and drive.
        flow: LaminarFlow,
        /// The model.
        model: OuriemiModel,
        /// Laws.
        closures: BedClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
    /// Bingham fluid between two planes, in closed form.
    BinghamPlane ("exact/bingham-plane") {
        /// The material.
        fluid: BinghamFluid,
        /// Geometry and drive.
        flow: PlaneFlow,
        /// The model.
        model: BinghamModel,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
    /// Dry grains down a slope, in closed form.
    BagnoldFilm ("exact/bagnold-film") {
        /// The grains.
        grains: Grains,
        /// The film.
        bed: Film,
        /// Geometry and drive.
        flow: FilmFlow,
        /// The model.
        model: BagnoldModel,
        /// Laws.
        closures: FilmClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
    /// Turbulent layer of constant stress over a rough wall, in closed form.
    LogLaw ("exact/log-law") {
        /// The fluid.
        fluid: Fluid,
        /// Geometry and drive.
        flow: WallFlow,
        /// The model.
        model: LogLawModel,
        /// Laws.
        closures: WallClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
    /// Laminar flow over a bed of grains between two planes: regularised, or with the exact yield.
    Laminar ("laminar") {
        /// The fluid.
        fluid: Fluid,
        /// The grains.
        grains: Grains,
        /// The bed.
        bed: Bed,
        /// Geometry and drive.
        flow: LaminarFlow,
        /// The model.
        model: LaminarModel,
        /// Laws.
        closures: BedClosures,
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Cells of the solver.
        #[serde(default)]
        grid: YieldGrid,
    }
    /// Bingham fluid between two planes: regularised, or with the exact yield.
    Bingham ("bingham") {
        /// The material.
        fluid: BinghamFluid,
        /// Geometry and drive.
        flow: PlaneFlow,
        /// The model.
        model: BinghamKindModel,
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Cells of the solver.
        #[serde(default)]
        grid: YieldGrid,
    }
    /// Yield-stress fluid along a duct, in its cross-section.
    Duct ("section/duct") {
        /// The material.
        fluid: BinghamFluid,
        /// Geometry and drive.
        flow: DuctFlow,
        /// The model.
        model: DuctModel,
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Elements of the section.
        #[serde(default)]
        grid: SectionGrid,
        /// The first-order method.
        #[serde(default)]
        solver: SectionSolver,
    }
    /// Laminar flow along a duct over a bed of grains, in its cross-section.
    DuctBed ("section/bed") {
        /// The fluid.
        fluid: Fluid,
        /// The grains.
        grains: Grains,
        /// The bed.
        bed: Bed,
        /// Geometry and drive.
        flow: BedFlow,
        /// The model.
        model: BedModel,
        /// Laws.
        closures: BedClosures,
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Elements of the section.
        #[serde(default)]
        grid: SectionGrid,
        /// The first-order method.
        #[serde(default)]
        solver: SectionSolver,
    }
    /// Slow flow of a yield-stress fluid in a square cavity under a sliding lid.
    Cavity ("section/cavity") {
        /// The material.
        fluid: BinghamFluid,
        /// Geometry and drive.
        flow: CavityFlow,
        /// The model.
        model: CavityModel,
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Cells of the cavity.
        #[serde(default)]
        grid: CavityGrid,
        /// The first-order method.
        #[serde(default)]
        solver: SectionSolver,
    }
    /// Turbulent flow over a bed of grains that shear as dense granular flow, with a suspension above.
    SheetFlow ("sheet-flow") {
        /// The fluid.
        fluid: Fluid,
        /// The grains.
        grains: Grains,
        /// The bed.
        bed: SheetBed,
        /// Geometry and drive.
        flow: SheetFlowTable,
        /// The model.
        model: SheetModel,
        /// Laws.
        closures: SheetClosures,
        /// Small numbers.
        #[serde(default)]
        regularisation: SheetRegularisation,
        /// Cells of the column.
        #[serde(default)]
        grid: SheetGrid,
        /// The iteration.
        #[serde(default)]
        solver: SheetSolver,
    }
    /// Grains that collide and the turbulent fluid that drives them, as two fluids of one dimension.
    TwoFluid ("two-fluid") {
        /// The fluid.
        fluid: Fluid,
        /// The grains.
        grains: CollidingGrains,
        /// The grains at rest.
        bed: TwoFluidBed,
        /// Geometry and drive.
        flow: TwoFluidFlow,
        /// The model.
        model: TwoFluidModel,
        /// Laws.
        closures: TwoFluidClosures,
        /// Small numbers.
        #[serde(default)]
        regularisation: TwoFluidRegularisation,
        /// Cells of the column.
        #[serde(default)]
        grid: TwoFluidGrid,
        /// The flow in time.
        #[serde(default)]
        solver: TwoFluidSolver,
    }
    /// Grains that collide between two walls, without fluid or gravity.
    ShearCell ("shear-cell") {
        /// The grains.
        grains: CollidingGrains,
        /// The gap between the walls, and what they do to the grains.
        flow: ShearCellFlow,
        /// The model.
        model: ShearCellModel,
        /// Laws.
        closures: ShearCellClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
    /// A bed of spheres with friction, grain by grain, at rest or down a slope.
    GrainsBed ("grains") {
        /// The grains.
        grains: Grains,
        /// The bed.
        bed: GrainBed,
        /// The channel and its tilt.
        flow: GrainFlow,
        /// The model.
        model: GrainsModel,
        /// Laws.
        closures: GrainClosures,
        /// How grains are moved and averaged.
        discrete: Discrete,
    }
    /// Grains with friction, grain by grain, in a turbulent fluid of one dimension that drives them.
    Coupled ("coupled") {
        /// The fluid.
        fluid: Fluid,
        /// The grains.
        grains: Grains,
        /// The bed.
        bed: CoupledBed,
        /// The channel, its tilt and the free surface.
        flow: CoupledFlow,
        /// The model.
        model: CoupledModel,
        /// Laws.
        closures: CoupledClosures,
        /// How grains are moved, how often the fluid is solved, and what is averaged.
        discrete: CoupledDiscrete,
    }
    /// The impact of one sphere on a wall or another sphere, next to its closed form.
    Impact ("impact") {
        /// The grains.
        grains: Grains,
        /// The impact.
        flow: ImpactFlow,
        /// The model.
        model: ImpactModel,
        /// Laws.
        closures: GrainClosures,
        /// How finely it is followed.
        #[serde(default)]
        discrete: ImpactSteps,
    }
    /// A few grains, held against a closed form or a conservation law.
    Trial ("trial") {
        /// The grains.
        grains: Grains,
        /// How they move.
        #[serde(default)]
        flow: TrialFlow,
        /// The model.
        model: TrialModel,
        /// Laws.
        closures: GrainClosures,
        /// How finely contacts are followed.
        #[serde(default)]
        discrete: ImpactSteps,
    }
}

fn schema_of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| {
        s.inline_subschemas = true;
        s.meta_schema = None;
    });
    settings.into_generator().into_root_schema_for::<T>().to_value()
}
