//! The program in a folder of its own.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::LazyLock;

use bedload::case::{Case, CaseError};
use bedload::model::{Checked, Problem, Registry};
use bedload::result::Context;
use bedload::result::{Failure, Outcome, Quiet};
use serde_json::Value;
use tempfile::TempDir;

/// The models of the program.
pub static REGISTRY: LazyLock<Registry> = LazyLock::new(bedload::models::builtin);

/// A case, a file or a shipped one, with settings.
pub fn load(case: &str, set: &[impl AsRef<str>]) -> Result<Checked, CaseError> {
    let set: Vec<String> = set.iter().map(|s| s.as_ref().to_owned()).collect();
    REGISTRY.load(case, &set)
}

/// The text of a case, as a file of its name would hold it.
pub fn parse(name: &str, text: &str) -> Result<(Case, Problem), CaseError> {
    REGISTRY.parse(name, "case.toml", text.to_owned(), &[])
}

/// Solves a problem that nobody watches.
pub fn run(problem: &Problem) -> Result<Outcome, Failure> {
    problem.run(&mut Context::new(&mut Quiet))
}

/// What becomes of a case with settings.
pub fn solve(case: &str, set: &[impl AsRef<str>]) -> Result<Outcome, Failure> {
    let (_, problem) = load(case, set).unwrap_or_else(|error| panic!("{}", error.render(false)));
    run(&problem)
}

/// What a command answered.
#[derive(Debug)]
pub struct Answer {
    /// exit code; -1 if a signal ended it
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl Answer {
    /// Requires an exit code.
    #[track_caller]
    pub fn exits(self, code: i32) -> Self {
        assert_eq!(self.code, code, "\nstdout: {}\nstderr: {}", self.out, self.err);
        self
    }

    /// Standard output as JSON.
    #[track_caller]
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap_or_else(|e| panic!("{e}: {}\nstderr: {}", self.out, self.err))
    }
}

/// A scene alone that three models take.
pub const SAND: &str = r#"
format = 2
scene = "bed"
case.title = "Medium sand under a steep stream"
fluid = { density = "1000 kg/m3", viscosity = "1e-3 Pa s" }
grains = { diameter = "2 mm", density = "2650 kg/m3" }
bed.thickness = "40 mm"
flow.depth = "60 mm"
flow.slope = "1.5 deg"
"#;

/// A temporary folder in which commands run.
pub struct Scratch(TempDir);

impl Scratch {
    pub fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_bedload"));
        command.current_dir(self.0.path()).stdin(Stdio::null());
        command
    }

    pub fn bedload<S: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = S>) -> Answer {
        answer(self.command().args(arguments))
    }

    /// Runs a shell line with the program as `$BEDLOAD`.
    pub fn shell(&self, line: &str) -> Answer {
        answer(
            Command::new("sh")
                .args(["-c", line])
                .env("BEDLOAD", env!("CARGO_BIN_EXE_bedload"))
                .current_dir(self.0.path())
                .stdin(Stdio::null()),
        )
    }

    /// Names in a folder, hidden ones included, sorted.
    pub fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    pub fn summary(&self, folder: &str) -> Value {
        serde_json::from_str(&self.read(&format!("{folder}/summary.json"))).unwrap()
    }

    /// Every file under a folder with its bytes.
    pub fn snapshot(&self, folder: &str) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut files = BTreeMap::new();
        collect(&self.path(folder), &mut files);
        files
    }
}

fn answer(command: &mut Command) -> Answer {
    let output = command.output().unwrap();
    Answer {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

fn collect(folder: &Path, files: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, files);
        } else {
            files.insert(path.clone(), fs::read(&path).unwrap());
        }
    }
}

/// A file or folder of the project.
pub fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Files with an ending under a folder, sorted.
pub fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// A summary without what may differ between identical runs.
pub fn comparable(mut summary: Value) -> Value {
    let object = summary.as_object_mut().unwrap();
    object.remove("cost").unwrap();
    object.remove("provenance").unwrap();
    summary
}
