//! Sediment transport from several models of the same flow, with what each one costs and how far it can be trusted.
//!
//! ```text
//!  cases/*.toml ─► case ─► model ─► models/<one> ─► result ─► output, plot, compare
//!    (text)      (places) (trait,   (SI, laws,                ─► study, advise, validate: call it many times
//!                         registry)  solvers)
//! ```
//!
//! The drawing shows the data. A test holds every `crate::` path against the list of who may name whom (`docs/design.md`).
//!
//! | modules | what they know |
//! |---|---|
//! | [`units`], [`numerics`], [`runtime`] | quantities as text; methods that know no physics; cost and interruption |
//! | [`closures`], [`result`] | laws; profiles, series, summaries |
//! | [`case`] | case files: text, places in it, schema, diagnostics. The only module that knows TOML, and no model |
//! | [`scene`] | the physical flow, whatever solves it, and its numbers |
//! | [`mod@column`], [`dem`] | the fluid of one dimension among whatever grains; grains one by one |
//! | [`model`] | what a model is: the trait, the registry, the checked problem |
//! | [`models`] | the models, one folder each |
//! | `plot`, `compare`, `output` | figures and pages; runs and measured profiles side by side; folders |
//! | `study` | one case at many points: `converge`, `sweep`, `chart`, `stability`, `calibrate` |
//! | [`advise`], `validate` | the least model that a flow needs; what the cases claim, run again |
//! | [`prelude`] | what a user of the library writes with |
//! | `cli` | the command line, one file per verb |
//!
//! `--no-default-features` leaves the solvers: no figures, folders and studies (feature `plot`), no command line (feature `cli`).
//!
//! ```
//! use bedload::prelude::*;
//!
//! // A shipped case or a file, with changes as after `--set`: every violation is reported at once, with its place.
//! let (case, problem) = builtin().load("exact_1d_aussillous", &["flow.pressure_gradient=80 Pa/m".into()])?;
//! println!("{}\n{}", case.about().title, problem.describe().equations);
//! let outcome = Simulation::new(&problem).threads(2).run()?;
//! let rate = outcome.results.get("transport_rate_m2_s").ok_or("no rate")?;
//! assert!((rate / 1.3425e-5 - 1.0).abs() < 1e-4, "{rate}");
//! let profile = outcome.profile.ok_or("no profile")?;
//! for (z, u) in profile.axis().iter().zip(profile.get(&quantity::U_MIXTURE).ok_or("no velocity")?) {
//!     assert!(*z >= 0.0 && u.is_some_and(f64::is_finite));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod advise;
pub mod case;
#[cfg(feature = "cli")]
pub mod cli;
pub mod closures;
pub mod column;
#[cfg(feature = "plot")]
pub mod compare;
pub mod dem;
pub mod model;
pub mod models;
pub mod numerics;
#[cfg(feature = "plot")]
pub mod output;
#[cfg(feature = "plot")]
pub mod plot;
pub mod prelude;
pub mod result;
pub mod runtime;
pub mod scene;
#[cfg(feature = "plot")]
pub mod study;
pub mod units;
#[cfg(feature = "plot")]
pub mod validate;
