//! Records the commit and the compiler for the provenance of results.

use std::process::Command;

fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let run = Command::new(program).args(arguments).output().ok()?;
    run.status.success().then(|| String::from_utf8_lossy(&run.stdout).trim().to_owned())
}

fn main() {
    let commit = output("git", &["rev-parse", "--short=12", "HEAD"]).map_or_else(
        || "unknown".to_owned(),
        |hash| {
            let changed =
                output("git", &["status", "--porcelain", "--untracked-files=no"]).is_some_and(|s| !s.is_empty());
            if changed { format!("{hash}+") } else { hash }
        },
    );
    let rustc = std::env::var("RUSTC").ok().and_then(|rustc| output(&rustc, &["--version"])).unwrap_or_default();
    println!("cargo::rustc-env=BEDLOAD_COMMIT={commit}");
    println!("cargo::rustc-env=BEDLOAD_RUSTC={rustc}");
    for path in [".git/HEAD", ".git/refs/heads", "src", "cases", "build.rs", "Cargo.toml"] {
        if std::path::Path::new(path).exists() {
            println!("cargo::rerun-if-changed={path}");
        }
    }
}
