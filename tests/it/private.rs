//! What stays private: the compiler refuses it outside the crate, each for its own reason.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

use crate::support::Scratch;

/// What the compiler answers to `code` written against the library; `None` without a compiler.
fn compile(code: &str) -> Option<String> {
    let scratch = Scratch::new();
    scratch.write("outside.rs", code);
    let built = Path::new(env!("CARGO_BIN_EXE_bedload")).with_file_name("deps");
    let time = |path: &PathBuf| fs::metadata(path).and_then(|known| known.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
    let ours = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with("libbedload-") && name.ends_with(".rlib")
    };
    let library = fs::read_dir(&built).unwrap().map(|entry| entry.unwrap().path()).filter(ours).max_by_key(time)?;
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut compiler = Command::new(compiler);
    compiler.args(["--edition=2024", "--crate-type=lib", "--emit=metadata", "--error-format=short", "outside.rs"]);
    compiler.arg("-L").arg(format!("dependency={}", built.display()));
    compiler.arg("--extern").arg(format!("bedload={}", library.display()));
    let Ok(output) = compiler.current_dir(scratch.path(".")).output() else {
        println!("skipped: no rustc");
        return None;
    };
    Some(String::from_utf8(output.stderr).unwrap())
}

/// Requires that each line of `code` is refused with the error `code_of_error`.
fn refused(lines: &[&str], error: &str) {
    let Some(answer) = compile(&lines.join("\n")) else { return };
    for (i, line) in lines.iter().enumerate() {
        let place = format!("outside.rs:{}:", i + 1);
        let said = answer.lines().find(|said| said.starts_with(&place));
        assert!(said.is_some_and(|said| said.contains(error)), "{line}\n{answer}");
    }
}

#[test]
fn the_public_face_compiles() {
    let code = "#![deny(warnings)]
use bedload::dem::{Domain, Engine, GrainBed};
use bedload::model::{Model, OnMesh};
use bedload::models::{coupled::Coupled, laminar::RegularisedBed, section::Duct, sheet_flow::SheetFlow, two_fluid::TwoFluid};
use bedload::prelude::{builtin, checked, CaseError, ModelInfo};
pub type All = (Coupled, Duct, GrainBed, OnMesh<RegularisedBed>, OnMesh<SheetFlow>, OnMesh<TwoFluid>, Domain);
pub type Grains<L> = Engine<L>;
pub const INFO: ModelInfo = ModelInfo::new(\"mine\");
pub fn problem<M: Model>(scene: &M::Scene, table: &M::Table) -> Result<M, CaseError> {
    assert!(builtin().entries().count() > 10);
    checked::<M>(\"mine\", scene, table)
}
";
    assert!(compile(code).is_none_or(|answer| answer.is_empty()), "{:?}", compile(code));
}

#[test]
fn solvers_are_private() {
    let paths = [
        "use bedload::models::coupled::exchange::Exchange;",
        "use bedload::models::coupled::fluid_at_grains::FluidAtGrains;",
        "use bedload::models::grains::bed::run;",
        "use bedload::models::laminar::two_fluid::Coupled;",
        "use bedload::models::laminar::mesh::Mesh;",
        "use bedload::models::section::newton::solve;",
        "use bedload::models::section::program::Program;",
        "use bedload::models::sheet_flow::newton::Column;",
        "use bedload::models::sheet_flow::outcome::run;",
        "use bedload::models::shear_cell::flow::Flow;",
        "use bedload::models::two_fluid::system::Linear;",
        "use bedload::models::two_fluid::state::Cell;",
    ];
    refused(&paths, "error[E0603]");
}

#[test]
fn the_insides_of_the_grain_engine_are_private() {
    let paths = ["neighbours", "forces", "simd", "tile", "contacts", "integrate", "checkpoint", "engine"]
        .map(|module| format!("use bedload::dem::{module};"));
    refused(&paths.each_ref().map(String::as_str), "error[E0603]");
}

#[test]
fn fields_that_keep_a_promise_are_private() {
    let fields = [
        "pub fn a(all: &bedload::model::Registry) { let _ = &all.entries; }",
        "pub fn b(all: &bedload::model::Registry) { let _ = &all.kinds; }",
        "pub fn c(one: &bedload::model::Entry) { let _ = &one.build; }",
        "pub fn d(grains: &bedload::dem::Engine<bedload::dem::LinearSpring>) { let _ = &grains.tiles; }",
        "pub fn e(run: &bedload::model::Simulation<'_>) { let _ = &run.problem; }",
    ];
    refused(&fields, "error[E0616]");
}

#[test]
fn what_will_grow_is_made_by_its_constructor() {
    let literals = [
        "pub const A: bedload::model::ModelInfo = bedload::model::ModelInfo { name: \"mine\", stochastic: false };",
        "pub fn b() -> bedload::result::Outcome { bedload::result::Outcome { ..bedload::result::Outcome::stopped() } }",
        "pub fn c() -> bedload::output::Mode { bedload::output::Mode { force: true, resume: false } }",
    ];
    refused(&literals, "error[E0639]");
}
