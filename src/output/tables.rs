//! Tables of a run, read back from its folder.

use std::fs;
use std::io::BufReader;
use std::path::Path;

use super::error::OutputError;
use crate::result::{Field, Series};

/// The residuals or the time series of a run, if its folder has them.
#[must_use]
pub fn read_series(folder: &Path) -> Option<Series> {
    Series::read_csv(BufReader::new(fs::File::open(folder.join("series.csv")).ok()?)).ok()
}

/// The field of a run over its section, if its folder has one.
///
/// # Errors
/// [`OutputError::NotARun`] if that file is none.
pub fn read_field(folder: &Path) -> Result<Option<Field>, OutputError> {
    let Ok(file) = fs::File::open(folder.join("section.csv")) else { return Ok(None) };
    let wrong = |error| OutputError::NotARun { folder: folder.into(), reason: format!("section.csv: {error}") };
    Field::read(BufReader::new(file)).map_err(wrong)
}
