//! Profiles from measurements or other programs, as CSV.
//!
//! ```text
//! # Aussillous et al. (2013), run 7                  its label
//! # digitised from figure 5                          where it comes from
//! # bed_level_m = 0.0322                             a result, by its name in summary.json
//! # transport_rate_m2_s = 3.2e-5 ± 0.3e-5            with one sigma
//! z_m,u_fluid_m_s,u_fluid_m_s_err                    columns by their names in profile.csv, SI
//! 0.021,0.0004,0.0002                                an empty field is undefined
//! ```

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::{Map, json};

use super::{Kind, Subject};
use crate::case::nearest;
use crate::result::quantity::{self, COLUMNS, Quantity, RESULTS};
use crate::result::{Profile, Results, TableError, Values, codes, read_columns};

/// Ending of the header of a column of standard errors.
const SIGMA: &str = "_err";
/// Labels up to this length \[characters] stand in legends; longer ones leave that to the name of the file.
const LONGEST_NAME: usize = 32;

/// A profile CSV that cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", file.display())]
pub struct DataError {
    /// the file
    pub file: PathBuf,
    /// what is wrong with it
    pub fault: DataFault,
}

/// What is wrong with a profile CSV.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DataFault {
    /// it cannot be read, or is not text
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// a header that is not the name of a column
    #[error("unknown column \"{name}\"")]
    UnknownColumn {
        /// the header
        name: String,
        /// column that it may stand for
        nearest: Option<String>,
    },
    /// the first column is not the elevation
    #[error("the first column is \"{found}\", not z_m")]
    NoElevation {
        /// the first header
        found: String,
    },
    /// two columns of one name
    #[error("column \"{name}\" is given twice")]
    Repeated {
        /// the header
        name: String,
    },
    /// errors of nothing
    #[error("\"{name}\" has no column \"{of}\" beside it")]
    ErrorsOfNothing {
        /// the header of the errors
        name: String,
        /// the column that is missing
        of: String,
    },
    /// errors of the elevation, which no norm uses
    #[error("z_m{SIGMA} is not used: deviations are measured along the values, at given elevations")]
    ErrorsOfElevation,
    /// a standard error that is zero or negative
    #[error("\"{name}\" is {value} in row {row}: one sigma is positive, or empty where it is not known")]
    NotPositive {
        /// the header
        name: String,
        /// row of numbers, from 1
        row: usize,
        /// the value
        value: f64,
    },
    /// a row without elevation
    #[error("z_m is empty in row {row}")]
    NowhereIn {
        /// row of numbers, from 1
        row: usize,
    },
    /// no column besides the elevation, or no rows
    #[error("there are no values: {columns} columns besides z_m, {rows} rows")]
    Empty {
        /// columns besides the elevation and errors
        columns: usize,
        /// rows of numbers
        rows: usize,
    },
    /// a comment that gives a result which is not one
    #[error("unknown result \"{name}\" in a comment")]
    UnknownResult {
        /// as written
        name: String,
        /// result that it stands for
        nearest: String,
    },
    /// a comment that gives a result without a number
    #[error("{name} = \"{text}\" is not a number, or not a number ± a positive one")]
    BadResult {
        /// the result
        name: String,
        /// as written
        text: String,
    },
    /// fields that are not numbers, rows of different lengths
    #[error(transparent)]
    Table(#[from] TableError),
}

codes!(DataFault {
    Self::Unreadable(_) => "data-unreadable",
    Self::UnknownColumn { .. } => "data-unknown-column",
    Self::NoElevation { .. } => "data-no-elevation",
    Self::Repeated { .. } => "data-repeated-column",
    Self::ErrorsOfNothing { .. } => "data-errors-of-nothing",
    Self::ErrorsOfElevation => "data-errors-of-elevation",
    Self::NotPositive { .. } => "data-error-not-positive",
    Self::NowhereIn { .. } => "data-empty-elevation",
    Self::Empty { .. } => "data-empty",
    Self::UnknownResult { .. } => "data-unknown-result",
    Self::BadResult { .. } => "data-bad-result",
    Self::Table(_) => "data-malformed",
});

impl DataFault {
    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> String {
        let columns = || COLUMNS.iter().map(|q| q.name).collect::<Vec<_>>().join(", ");
        match self {
            Self::Unreadable(_) => "give a CSV file in UTF-8".into(),
            Self::UnknownColumn { nearest, .. } => {
                let meant = nearest.as_ref().map_or_else(String::new, |name| format!("did you mean {name}? "));
                format!("{meant}columns are {}, each with <name>{SIGMA} for one sigma", columns())
            }
            Self::NoElevation { .. } => format!("z_m comes first, then any of {}", columns()),
            Self::Repeated { .. } => "give the second measurement as a file of its own".into(),
            Self::ErrorsOfNothing { .. } => format!("<name>{SIGMA} is one sigma of the column <name>"),
            Self::ErrorsOfElevation => "leave that column out".into(),
            Self::NotPositive { .. } | Self::NowhereIn { .. } => "correct the row or leave it out".into(),
            Self::Empty { .. } => "give z_m, at least one other column and at least one row".into(),
            Self::UnknownResult { nearest, .. } => format!("did you mean {nearest}?"),
            Self::BadResult { name, .. } => format!("write # {name} = 1.5e-3 or # {name} = 1.5e-3 ± 2e-4, in SI"),
            Self::Table(_) => {
                "numbers in SI with a decimal point, fields separated by commas, as many as headers".into()
            }
        }
    }
}

/// Reads a profile CSV. Rows may come in any order.
///
/// # Errors
/// [`DataError`] with the file and what is wrong with it.
pub fn read(path: &Path) -> Result<Subject, DataError> {
    let stem = path.file_stem().map_or_else(|| "data".into(), |s| s.to_string_lossy().into_owned());
    fs::read_to_string(path)
        .map_err(DataFault::Unreadable)
        .and_then(|text| parse(&text, &stem, &path.display().to_string()))
        .map_err(|fault| DataError { file: path.into(), fault })
}

/// Reads the text of a profile CSV; `stem` labels it where no comment does, `source` is what it is called.
///
/// # Errors
/// What is wrong with it.
pub fn parse(text: &str, stem: &str, source: &str) -> Result<Subject, DataFault> {
    let text = text.trim_start_matches('\u{feff}');
    let comments = text.lines().map_while(|line| line.trim().strip_prefix('#')).map(str::trim);
    let (mut words, mut results) = (Vec::new(), Map::new());
    for comment in comments.filter(|c| !c.is_empty()) {
        match result(comment)? {
            Some((name, value)) => drop(results.insert(name.into(), value)),
            None => words.push(comment),
        }
    }
    let (profile, errors) = tables(&read_columns(text.as_bytes())?)?;
    let mut words = words.into_iter();
    let label = words.next().unwrap_or(stem);
    let name = if label.chars().count() <= LONGEST_NAME { label } else { stem };
    Ok(Subject {
        name: name.into(),
        label: label.into(),
        kind: Kind::Data,
        source: source.into(),
        notes: words.map(str::to_owned).collect(),
        profile,
        errors,
        // What `result` returns always has the form of a result.
        results: serde_json::from_value::<Results>(results.into()).unwrap_or_default(),
        regime: Vec::new(),
        validity: Vec::new(),
        solve_s: 0.0,
        work: 0.0,
        stated: None,
    })
}

/// The profile and its standard errors, rows sorted by elevation.
fn tables(columns: &[(String, Values)]) -> Result<(Profile, Option<Profile>), DataFault> {
    let (levels, columns) = match columns.split_first() {
        Some(((name, levels), others)) if name == quantity::Z.name => (levels, others),
        first => {
            let found = first.map(|((name, _), _)| name.clone()).unwrap_or_default();
            return Err(DataFault::NoElevation { found });
        }
    };
    finite(&quantity::Z, levels)?;
    let mut z = Vec::with_capacity(levels.len());
    for (row, level) in levels.iter().enumerate() {
        z.push(level.ok_or(DataFault::NowhereIn { row: row + 1 })?);
    }
    let mut order: Vec<usize> = (0..z.len()).collect();
    order.sort_by(|&i, &j| z[i].total_cmp(&z[j]));
    let sorted: Vec<f64> = order.iter().map(|&i| z[i]).collect();
    let (mut profile, mut errors, mut has_errors) = (Profile::new(sorted.clone())?, Profile::new(sorted)?, false);
    for (name, values) in columns {
        let of = name.strip_suffix(SIGMA).unwrap_or(name);
        let Some(quantity) = quantity::find(COLUMNS, of) else {
            let nearest = nearest(of, COLUMNS.iter().map(|q| q.name));
            return Err(DataFault::UnknownColumn { name: name.clone(), nearest });
        };
        let is_sigma = of != name;
        if is_sigma && of == quantity::Z.name {
            return Err(DataFault::ErrorsOfElevation);
        }
        finite(quantity, values)?;
        if is_sigma && !columns.iter().any(|(other, _)| other == of) {
            return Err(DataFault::ErrorsOfNothing { name: name.clone(), of: of.into() });
        }
        if let Some(row) = values.iter().position(|v| is_sigma && v.is_some_and(|v| v <= 0.0)) {
            let value = values[row].unwrap_or_default();
            return Err(DataFault::NotPositive { name: name.clone(), row: row + 1, value });
        }
        let table = if is_sigma { &mut errors } else { &mut profile };
        if table.get(quantity).is_some() {
            return Err(DataFault::Repeated { name: name.clone() });
        }
        has_errors |= is_sigma;
        table.push(quantity, order.iter().map(|&i| values[i]).collect())?;
    }
    let count = profile.quantities().count() - 1;
    if count == 0 || profile.rows() == 0 {
        return Err(DataFault::Empty { columns: count, rows: profile.rows() });
    }
    Ok((profile, has_errors.then_some(errors)))
}

/// Refuses NaN and infinities while the rows are still in the order of the file.
fn finite(quantity: &'static Quantity, values: &[Option<f64>]) -> Result<(), TableError> {
    match values.iter().position(|v| v.is_some_and(|x| !x.is_finite())) {
        Some(row) => Err(TableError::NotFinite { column: quantity.name, row }),
        None => Ok(()),
    }
}

/// A comment of the form `name = number` or `name = number ± sigma`, if `name` may be that of a result.
fn result(comment: &str) -> Result<Option<(&'static str, serde_json::Value)>, DataFault> {
    let Some((name, text)) = comment.split_once('=').map(|(name, text)| (name.trim(), text.trim())) else {
        return Ok(None);
    };
    if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return Ok(None);
    }
    let Some(known) = quantity::find(RESULTS, name) else {
        return match nearest(name, RESULTS.iter().map(|q| q.name)) {
            Some(nearest) => Err(DataFault::UnknownResult { name: name.into(), nearest }),
            None => Ok(None),
        };
    };
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    let parsed = match ["±", "+/-", "+-"].iter().find_map(|sign| text.split_once(sign)) {
        None => number(text).map(|value| json!({ "value": value })),
        Some((value, sigma)) => number(value)
            .zip(number(sigma).filter(|s| *s > 0.0))
            .map(|(value, sigma)| json!({ "value": value, "stderr": sigma })),
    };
    parsed
        .map(|value| Some((known.name, value)))
        .ok_or_else(|| DataFault::BadResult { name: name.into(), text: text.into() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::result::quantity::{PHI, U_FLUID};

    fn fault(text: &str) -> DataFault {
        parse(text, "stem", "stem.csv").unwrap_err()
    }

    #[test]
    fn comments_columns_errors_and_results_are_read() {
        let text = "\u{feff}# Run 7\n#digitised\n# bed_level_m = 0.03\n# transport_rate_m2_s=3e-5 +- 1e-6\n# d = 2 mm\n\
                    z_m, phi, u_fluid_m_s, u_fluid_m_s_err\n2,,0.2,0.02\n# in between\n1,0.5,0.1,\n";
        let data = parse(text, "stem", "stem.csv").unwrap();
        assert_eq!(
            (data.label.as_str(), data.notes.as_slice()),
            ("Run 7", &["digitised".into(), "d = 2 mm".into()][..])
        );
        assert_eq!(data.profile.axis(), [1.0, 2.0]);
        assert_eq!(data.profile.get(&PHI).unwrap(), [Some(0.5), None]);
        assert_eq!(data.profile.get(&U_FLUID).unwrap(), [Some(0.1), Some(0.2)]);
        assert_eq!(data.errors.unwrap().get(&U_FLUID).unwrap(), [None, Some(0.02)]);
        assert_eq!(data.results.get("bed_level_m"), Some(0.03));
        let (_, rate) = data.results.iter().find(|(name, _)| *name == "transport_rate_m2_s").unwrap();
        assert_eq!((rate.value, rate.stderr), (Some(3e-5), Some(1e-6)));
        assert_eq!(data.name, "Run 7");
        assert_eq!(parse("z_m,phi\n0,1\n", "stem", "stem.csv").unwrap().label, "stem");
        let long =
            parse("# digitised from the fourth figure of the paper\nz_m,phi\n0,1\n", "stem", "stem.csv").unwrap();
        assert_eq!((long.name.as_str(), long.label.len()), ("stem", 45));
    }

    #[test]
    fn a_wrong_header_names_the_nearest_and_all_valid_ones() {
        let wrong = fault("z_m,u_fluid_ms\n0,1\n");
        assert!(
            matches!(&wrong, DataFault::UnknownColumn { name, nearest: Some(near) } if name == "u_fluid_ms" && near == "u_fluid_m_s")
        );
        assert!(wrong.hint().starts_with("did you mean u_fluid_m_s? columns are z_m, phi, "), "{}", wrong.hint());
        assert!(matches!(fault("z_m,ufluid_m_s_err,x\n0,1,1\n"), DataFault::UnknownColumn { .. }));
        assert!(matches!(fault("phi,z_m\n0,1\n"), DataFault::NoElevation { found } if found == "phi"));
        assert!(matches!(fault(""), DataFault::NoElevation { .. }));
        assert!(matches!(fault("z_m,phi,phi\n0,1,1\n"), DataFault::Repeated { name } if name == "phi"));
        assert!(matches!(fault("z_m,phi_err\n0,1\n"), DataFault::ErrorsOfNothing { of, .. } if of == "phi"));
        assert!(matches!(fault("z_m,z_m_err,phi\n0,1,1\n"), DataFault::ErrorsOfElevation));
    }

    #[test]
    fn wrong_numbers_are_named_with_their_row() {
        let negative = fault("z_m,phi,phi_err\n0,0.1,0.1\n1,0.1,0\n");
        assert!(matches!(negative, DataFault::NotPositive { row: 2, value: 0.0, .. }));
        assert!(matches!(fault("z_m,phi\n0,1\n,1\n"), DataFault::NowhereIn { row: 2 }));
        assert!(matches!(fault("z_m,phi\n0,x\n"), DataFault::Table(TableError::NotANumber { line: 2, .. })));
        assert!(matches!(fault("z_m,phi\n0,nan\n"), DataFault::Table(TableError::NotFinite { row: 0, .. })));
        assert!(matches!(fault("z_m,phi\n0,inf\n"), DataFault::Table(TableError::NotFinite { .. })));
        assert!(matches!(fault("z_m,phi\n0,1,2\n"), DataFault::Table(TableError::Csv(_))));
        assert!(matches!(fault("z_m,phi\n"), DataFault::Empty { columns: 1, rows: 0 }));
        assert!(matches!(fault("z_m\n0\n"), DataFault::Empty { columns: 0, rows: 1 }));
        assert!(
            matches!(fault("# bed_level = 0.1\nz_m,phi\n0,1\n"), DataFault::UnknownResult { nearest, .. } if nearest == "bed_level_m")
        );
        assert!(matches!(fault("# bed_level_m = 32 mm\nz_m,phi\n0,1\n"), DataFault::BadResult { .. }));
        assert!(matches!(fault("# bed_level_m = 1 ± -1\nz_m,phi\n0,1\n"), DataFault::BadResult { .. }));
    }
}
