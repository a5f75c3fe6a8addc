//! Sediment transport from several models of the same flow, with what each one costs and how far it can be trusted.
//!
//! ```text
//!  cases/*.toml ─► case ─► problem ─► closures ─► continuum ─► result ─► output, plot
//!    (text)      (spans)  (SI, checked)  (laws)                      ─► study, advise, validate: call it many times
//! ```
//!
//! The drawing shows the data. Imports go only upward in this list, and a test holds every `use crate::` against it:
//!
//! | rooms | what they know |
//! |---|---|
//! | [`units`], [`numerics`], [`runtime`] | quantities as text; methods that know no physics; cost and interruption |
//! | [`closures`], [`result`] | laws; profiles, series, summaries |
//! | [`case`] | case files: text, spans, schema, diagnostics. The only room that knows TOML |
//! | [`problem`] | checked, immutable values in SI |
//! | [`column`] | the fluid of one dimension: its momentum among whatever grains |
//! | [`continuum`], [`discrete`], [`section`] | models: columns, grains one by one, cross-sections |
//! | `run` | [`run()`]: the one entry point |
//! | [`plot`] | figures and pages |
//! | [`compare`] | several runs and measured profiles side by side |
//! | [`output`] | the folder of a run, of a comparison, of a study |
//! | [`study`] | one case at many points: `converge`, `sweep`, `chart`, `stability`, `calibrate` |
//! | [`advise`] | the least model that a scene needs |
//! | [`validate`] | re-runs what the cases claim |
//! | [`cli`] | the command line, one file per verb |
//!
//! ```
//! use bedload::{model::Context, models, result::Quiet};
//!
//! let set = ["flow.pressure_gradient=80 Pa/m".to_owned()];
//! let (_, problem) = models::builtin().load("exact_1d_aussillous", &set).unwrap();
//! let outcome = problem.run(&mut Context::new(&mut Quiet)).unwrap();
//! assert!(outcome.results.get("transport_rate_m2_s").unwrap() > 0.0);
//! ```

pub mod advise;
pub mod case;
pub mod cli;
pub mod closures;
pub mod column;
pub mod compare;
pub mod dem;
pub mod model;
pub mod models;
pub mod numerics;
pub mod output;
pub mod plot;
pub mod result;
pub mod runtime;
pub mod study;
pub mod units;
pub mod validate;
