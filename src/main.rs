//! The `bedload` command: parse, call the library, exit code.

use std::panic::{self, PanicHookInfo};
use std::process::ExitCode;

use bedload::result::Provenance;

fn main() -> ExitCode {
    panic::set_hook(Box::new(explain_bug));
    panic::catch_unwind(|| bedload::cli::execute(&bedload::models::builtin())).unwrap_or(ExitCode::FAILURE)
}

/// A panic is a bug, and is reported as one.
fn explain_bug(info: &PanicHookInfo<'_>) {
    let at = info.location().map(|l| format!(" at {}:{}", l.file(), l.line())).unwrap_or_default();
    let payload = info.payload();
    let text = payload.downcast_ref::<&str>().copied().or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    eprintln!("This is a bug in bedload, please report it: {}{at}", text.unwrap_or("no message"));
    eprintln!("  command: bedload {}", arguments.join(" "));
    for line in Provenance::of_this_program().lines().into_iter().take(1) {
        eprintln!("  {line}");
    }
}
