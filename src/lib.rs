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
//! | [`column`], [`dem`] | the fluid of one dimension among whatever grains; grains one by one |
//! | [`model`] | what a model is: the trait, the registry, the checked problem |
//! | [`models`] | the models, one folder each |
//! | [`plot`], [`compare`], [`output`] | figures and pages; runs and measured profiles side by side; folders |
//! | [`study`] | one case at many points: `converge`, `sweep`, `chart`, `stability`, `calibrate` |
//! | [`advise`], [`validate`] | the least model that a flow needs; what the cases claim, run again |
//! | [`cli`] | the command line, one file per verb |
//!
//! ```
//! use bedload::{models, result::{Context, Quiet}};
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
