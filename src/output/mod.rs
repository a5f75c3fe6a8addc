//! The output folder: what is in it, who may replace it, and how it is written so that nothing is ever half there.

mod comparison;
mod folder;
mod run;

pub use comparison::{prepare_comparison, write_comparison};
pub use folder::{CHECKPOINT, Folder, Mode, OutputError};
pub use run::{Written, read_run, redraw, write_failure, write_outcome, write_running};
