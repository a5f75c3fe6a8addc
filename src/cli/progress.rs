//! Progress on standard error, animated only on a terminal, and the wish of Ctrl-C to stop.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::interrupt;
use crate::result::{Snapshot, Watch};
use crate::units::readable;

/// Work that takes less than this shows nothing.
const PATIENCE: Duration = Duration::from_millis(400);
/// Time between two lines.
const BETWEEN: Duration = Duration::from_millis(100);

/// Shows progress and listens for Ctrl-C.
#[derive(Debug)]
pub(super) struct Progress {
    visible: bool,
    drawn: bool,
    next: Instant,
}

impl Progress {
    /// Starts listening; draws only on a terminal and not if `quiet`.
    pub fn new(quiet: bool) -> Self {
        interrupt::listen();
        Self { visible: !quiet && io::stderr().is_terminal(), drawn: false, next: Instant::now() + PATIENCE }
    }
}

impl Watch for Progress {
    fn see(&mut self, snapshot: &Snapshot<'_>) -> ControlFlow<()> {
        if interrupt::asked() {
            return ControlFlow::Break(());
        }
        if self.visible && Instant::now() >= self.next {
            let quantity = snapshot.quantity.map(|(q, x)| format!("  {} {}", q.title, readable(x, q.unit)));
            // Progress that cannot be drawn is no reason to stop.
            let _ = write!(
                io::stderr(),
                "\r\u{1b}[2K{} {:3.0} %{}",
                snapshot.stage,
                100.0 * snapshot.fraction,
                quantity.unwrap_or_default()
            );
            self.drawn = true;
            self.next = Instant::now() + BETWEEN;
        }
        ControlFlow::Continue(())
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.drawn {
            let _ = write!(io::stderr(), "\r\u{1b}[2K");
        }
    }
}
