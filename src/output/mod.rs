//! The output folder: what is in it, who may replace it, and how it is written so that nothing is ever half there.

mod comparison;
mod folder;
mod grains;
mod run;
mod study;

pub use comparison::{prepare_comparison, write_comparison};
pub use folder::{Folder, Mode, OutputError};
pub use grains::CHECKPOINT;
pub use run::{Written, fingerprint, read_run, read_series, redraw, write_failure, write_outcome, write_running};
pub use study::StudyFolder;
