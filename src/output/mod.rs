//! The output folder: what is in it, who may replace it, and how it is written so that nothing is ever half there.

mod folder;
mod run;

pub use folder::{Folder, Mode, OutputError};
pub use run::{Written, redraw, write_failure, write_outcome, write_running};
