//! The output folder: what is in it, who may replace it, and how it is written so that nothing is ever half there.

mod comparison;
mod error;
mod folder;
mod grains;
mod lock;
mod manual;
mod ours;
mod path;
mod run;
mod study;
mod table;
mod tables;
mod word;

pub use comparison::{Compared, prepare_comparison, write_comparison};
pub use error::{Finished, Holder, OutputError};
pub use folder::{Folder, Mode};
pub use grains::CHECKPOINT;
pub use manual::Manual;
pub use path::default_folder;
pub use run::{Written, fingerprint, read_run, redraw, write_failure, write_outcome, write_running};
pub use study::StudyFolder;
pub use table::TableFile;
pub use tables::{read_field, read_series};
pub use word::word;
