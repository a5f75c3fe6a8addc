//! Where a result came from.

use serde::{Deserialize, Serialize};

/// Program, case and machine of a run. It may differ between identical runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Provenance {
    /// version of bedload
    pub bedload: String,
    /// commit it was built from, with `+` where the tree had changes
    pub commit: String,
    /// compiler
    pub rustc: String,
    /// operating system and architecture
    pub target: String,
    /// file or shipped case
    pub source: String,
    /// `--set` arguments
    pub overrides: Vec<String>,
    /// SHA-256 of the resolved case
    pub case_sha256: String,
    /// SHA-256 of its scene: the same for every model of the flow
    #[serde(default)]
    pub scene_sha256: String,
    /// SHA-256 of the table of its model
    #[serde(default)]
    pub model_sha256: String,
    /// start of the run, UTC
    pub started_utc: String,
    /// threads that the run may use
    pub threads: usize,
}

impl Provenance {
    /// Provenance of the running program, without a case.
    #[must_use]
    pub fn of_this_program() -> Self {
        Self {
            bedload: env!("CARGO_PKG_VERSION").into(),
            commit: env!("BEDLOAD_COMMIT").into(),
            rustc: env!("BEDLOAD_RUSTC").into(),
            target: format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
            started_utc: jiff::Timestamp::now().strftime("%Y-%m-%dT%H:%M:%SZ").to_string(),
            threads: 1,
            ..Self::default()
        }
    }

    /// The lines that head each table, one fact per line.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!("bedload {} ({}), {}, {}", self.bedload, self.commit, self.rustc, self.target),
            format!("case {} sha256 {}", self.source, self.case_sha256),
        ];
        if !self.overrides.is_empty() {
            lines.push(format!("set {}", self.overrides.join(" ")));
        }
        lines.push(format!("started {}", self.started_utc));
        lines
    }
}
