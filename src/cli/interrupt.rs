//! Ctrl-C: the first asks the run to stop and write what it has, the second leaves at once.

use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Exit code of a run that the user stopped.
pub const STOPPED: i32 = 4;

/// Listens for Ctrl-C and for the terminate signal. Without a listener the system's default holds, which ends the program.
pub fn listen() {
    // A second listener in one process is refused; the first one does the same.
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::SeqCst) {
            std::process::exit(STOPPED);
        }
    });
}

/// Whether the user has asked to stop.
#[must_use]
pub fn asked() -> bool {
    ASKED.load(Ordering::SeqCst)
}
