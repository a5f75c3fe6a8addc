//! A model and a law from outside the crate: a film of a shear-thinning fluid down a slope. They go through the same cases,
//! diagnostics and studies as the models of the program: here a sweep over the slope and the convergence over the mesh.
//!
//! `cargo run --release --example own_model`; `docs/adding-a-model.md` walks through it.

use std::error::Error;
use std::path::Path;

use bedload::case::tables::Grid;
use bedload::cli;
use bedload::closures::{Info, Standing};
use bedload::model::{Focus, Meshes, ONE_KIND, StudyPlan, number};
use bedload::prelude::*;
use bedload::result::{Class, quantity as q};
use bedload::scene::Material;
use bedload::study::{Conducted, Observer, Settings, conduct, converge, sweep};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `[thin-film.geometry]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmGeometry {
    /// Thickness of the film.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub height: f64,
    /// Sine of the slope.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1.0))]
    pub sine: f64,
}

/// `[thin-film.closures]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmClosures {
    /// How the stress goes with the shear rate.
    pub viscosity: Viscosity,
}

/// A law of the example's own: the shear rate u' [1/s] under a stress.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Viscosity {
    /// tau = eta u' (u'/u_0)^(n - 1): thinner where it shears faster, for n below 1.
    Power {
        /// Exponent n.
        #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 2.0))]
        n: f64,
        /// Shear rate u_0 at which the viscosity is that of the fluid.
        #[schemars(extend("x-unit" = "1/s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
        rate: f64,
    },
}

/// Catalogue entry of the law.
static POWER: Info = Info {
    family: "viscosity",
    law: "power",
    equation: "τ = η u' (u'/u_0)^(n-1)",
    source: "Ostwald (1925), Kolloid-Z. 36, 99-117",
    ranges: &[],
    standing: Standing::Experimental,
};

impl Viscosity {
    /// Shear rate [1/s] under the stress `tau` [Pa] in a fluid of the viscosity `eta` [Pa s].
    fn shear_rate(self, tau: f64, eta: f64) -> f64 {
        let Self::Power { n, rate } = self;
        rate * (tau / (eta * rate)).powf(1.0 / n)
    }
}

bedload::part! {
    /// A film of a shear-thinning fluid down a slope.
    pub struct FilmTable {
        /// Geometry and drive.
        geometry: FilmGeometry,
        /// Laws.
        closures: FilmClosures,
        /// Levels of the profile.
        #[serde(default)]
        grid: Grid,
    }
}

/// Cells times the exponent n below which the velocity of the surface is wrong by more than 1 %.
const FEWEST: f64 = 2.0;
/// Fastest flow [m/s]: about a third of the velocity of sound in water.
const FASTEST: f64 = 500.0;

/// A fault of the example's own.
#[derive(Debug, thiserror::Error)]
#[error("{cells} cells do not resolve a profile this steep")]
pub struct TooCoarse {
    /// cells of the case
    pub cells: usize,
    /// fewest cells
    pub least: f64,
}

impl CaseFault for TooCoarse {
    fn code(&self) -> &'static str {
        "too-coarse"
    }

    fn allowed(&self) -> Option<String> {
        Some(format!("at least {}", self.least))
    }

    fn hint(&self) -> Option<String> {
        Some("the smaller n is, the steeper is the profile at the wall".into())
    }
}

/// A failure of the example's own.
#[derive(Debug, thiserror::Error)]
#[error("the film would flow at {velocity_m_s:.0} m/s: above {FASTEST} m/s no fluid is incompressible")]
pub struct Compressible {
    /// velocity of the surface [m/s]
    pub velocity_m_s: f64,
}

impl MethodError for Compressible {
    fn code(&self) -> &'static str {
        "compressible"
    }

    fn class(&self) -> Class {
        Class::Unphysical
    }

    fn hint(&self) -> String {
        "a thinner film (geometry.height), or a smaller geometry.sine".into()
    }
}

/// The film. All values SI.
#[derive(Clone, Copy, Debug)]
pub struct Film {
    /// density [kg/m3] and viscosity [Pa s]
    fluid: Material,
    /// thickness [m]
    height: f64,
    /// weight along the slope [Pa/m]
    pull: f64,
    law: Viscosity,
    cells: usize,
}

impl Model for Film {
    const INFO: ModelInfo = ModelInfo::new("thin-film").taking(&["fluid"]);
    type Scene = BenchmarkScene;
    type Table = FilmTable;

    fn build(scene: &BenchmarkScene, table: &FilmTable, faults: &mut Faults) -> Option<Self> {
        let (fluid, FilmTable { geometry: flow, closures, grid, .. }) = (faults.needed("fluid", scene.fluid)?, table);
        let Viscosity::Power { n, .. } = closures.viscosity;
        if grid.cells as f64 * n < FEWEST {
            faults.push(("grid.cells", TooCoarse { cells: grid.cells, least: (FEWEST / n).ceil() }));
        }
        let pull = 9.81 * fluid.density * flow.sine;
        Some(Self { fluid, height: flow.height, pull, law: closures.viscosity, cells: grid.cells })
    }
}

impl Solve for Film {
    /// u' by the law under the stress in the middle of each cell: order 2.
    fn solve(&self, _: &mut Context<'_>) -> Result<Outcome, Failure> {
        let dz = self.height / self.cells as f64;
        let (mut z, mut u) = (vec![0.0], vec![0.0]);
        for k in 0..self.cells {
            let tau = self.pull * (self.height - (k as f64 + 0.5) * dz);
            u.push(u[k] + dz * self.law.shear_rate(tau, self.fluid.viscosity));
            z.push((k + 1) as f64 * dz);
        }
        if u[self.cells] > FASTEST {
            return Err(Compressible { velocity_m_s: u[self.cells] }.into());
        }
        let discharge: f64 = u.windows(2).map(|pair| 0.5 * dz * (pair[0] + pair[1])).sum();
        let mut outcome = Outcome::stopped();
        outcome.status = Status::Done;
        outcome.results.set(&q::DISCHARGE, discharge);
        outcome.results.set(&q::SURFACE_VELOCITY, u[self.cells]);
        let mut profile = Profile::new(z)?;
        profile.push(&q::U_MIXTURE, u.into_iter().map(Some).collect())?;
        outcome.profile = Some(profile);
        Ok(outcome)
    }

    fn describe(&self) -> Description {
        let equations = format!("0 = dτ/dz + {} Pa/m;  {}\n", self.pull, POWER.equation);
        Description::new(equations, vec![&POWER])
    }

    fn cells(&self) -> usize {
        self.cells
    }

    fn study(&self) -> StudyPlan {
        const NUMBERS: &[bedload::model::Number] = &[number(&q::DISCHARGE, "discharge")];
        let meshes = Meshes { cells: &[20, 40, 80, 160], reference: 640, changes: &[], kinds: ONE_KIND, remarks: &[] };
        let unit = self.height * self.law.shear_rate(self.pull * self.height, self.fluid.viscosity);
        Focus::on_meshes(&q::U_MIXTURE, unit, NUMBERS, meshes).into()
    }
}

/// A case of the film.
pub const CASE: &str = r#"
format = 2
scene = "benchmark"
case.title = "A shear-thinning film"
fluid = { density = "1000 kg/m3", viscosity = "0.1 Pa s" }
[thin-film]
geometry = { height = "10 mm", sine = 0.05 }
closures.viscosity = { law = "power", n = 0.5, rate = "1 1/s" }
"#;

/// The models of the program and the film.
pub fn registry() -> Registry {
    builtin().with(Entry::of::<Film>())
}

/// Who waits for no study.
pub struct Nobody;

impl Observer for Nobody {
    fn stop(&self) -> bool {
        false
    }

    fn done(&self, _: usize, _: usize) {}
}

/// Sweeps the slope and converges over the mesh, in `folder`.
pub fn studies(folder: &Path) -> Result<[Conducted; 2], Box<dyn Error>> {
    let (registry, file) = (registry(), folder.join("film.toml"));
    std::fs::write(&file, CASE)?;
    let case = file.display().to_string();
    let settings = |name: &str| {
        let mut settings = Settings::new(&registry, "own_model", &Nobody);
        (settings.out, settings.threads) = (Some(folder.join(name)), 1);
        settings
    };
    let (plan, assess) = sweep::plan(&case, &[], &["geometry.sine=0.02,0.04,0.08".into()])?;
    let swept = conduct(&plan, &settings("sweep"), Box::new(|_, _| (Vec::new(), assess)))?;
    let (plan, assess) = converge::plan(&registry, &converge::Request::new(&case, converge::Over::Mesh))?;
    let converged = conduct(&plan, &settings("converge"), Box::new(|_, _| (Vec::new(), assess)))?;
    Ok([swept, converged])
}

/// Without arguments the two studies; with them the command line with one model more.
#[allow(dead_code, reason = "a test includes this file as a module")]
fn main() -> Result<(), Box<dyn Error>> {
    if std::env::args().len() > 1 {
        std::process::exit(i32::from(cli::execute(&registry()) != std::process::ExitCode::SUCCESS));
    }
    for study in studies(&std::env::temp_dir())? {
        for (label, text) in study.assessment.findings {
            println!("{label}: {text}");
        }
    }
    Ok(())
}
