//! Named columns with units: [`Profile`] over the elevation, [`Series`] over iterations or time, and their CSV form.

use std::io::{self, BufRead, Write};

use super::quantity::{self, Quantity};

/// One column: a catalogued quantity and one value per row; `None` is undefined there, never 0 or NaN.
#[derive(Clone, Debug, PartialEq)]
struct Column {
    quantity: &'static Quantity,
    values: Vec<Option<f64>>,
}

/// Columns of equal length, each with a name that carries its unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<Column>,
}

/// Why a table cannot be made or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// a value that is neither finite nor declared undefined
    #[error("{column} is not finite in row {row}")]
    NotFinite {
        /// column name
        column: &'static str,
        /// row, from 0
        row: usize,
    },
    /// columns of different lengths
    #[error("{column} has {found} rows where the table has {expected}")]
    Length {
        /// column name
        column: &'static str,
        /// rows of this column
        found: usize,
        /// rows of the table
        expected: usize,
    },
    /// a header that the catalogue does not have
    #[error("unknown column \"{name}\"")]
    UnknownColumn {
        /// the header
        name: String,
    },
    /// a field that is not a number
    #[error("line {line}: \"{field}\" is not a number")]
    NotANumber {
        /// line in the file, from 1
        line: u64,
        /// the field
        field: String,
    },
    /// no first column, or a wrong one
    #[error("the first column is not {expected}")]
    NoAxis {
        /// the column that was expected
        expected: &'static str,
    },
    /// malformed CSV
    #[error(transparent)]
    Csv(#[from] csv::Error),
    /// the file cannot be read or written
    #[error(transparent)]
    Io(#[from] io::Error),
}

impl Table {
    /// Adds a column; `None` marks rows where the quantity is undefined.
    ///
    /// # Errors
    /// [`TableError::NotFinite`] if a defined value is NaN or infinite, [`TableError::Length`] if the rows do not match.
    pub fn push(&mut self, quantity: &'static Quantity, values: Vec<Option<f64>>) -> Result<(), TableError> {
        if let Some(first) = self.columns.first()
            && first.values.len() != values.len()
        {
            return Err(TableError::Length {
                column: quantity.name,
                found: values.len(),
                expected: first.values.len(),
            });
        }
        if let Some(row) = values.iter().position(|v| v.is_some_and(|x| !x.is_finite())) {
            return Err(TableError::NotFinite { column: quantity.name, row });
        }
        self.columns.push(Column { quantity, values });
        Ok(())
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |c| c.values.len())
    }

    /// The quantities of the columns, in order.
    pub fn quantities(&self) -> impl Iterator<Item = &'static Quantity> + '_ {
        self.columns.iter().map(|c| c.quantity)
    }

    /// The values of a column, one per row, or `None` if the table does not have it.
    #[must_use]
    pub fn get(&self, quantity: &Quantity) -> Option<&[Option<f64>]> {
        self.columns.iter().find(|c| c.quantity.name == quantity.name).map(|c| c.values.as_slice())
    }

    /// The standard errors of a column, one per row, or `None` if the table does not have them.
    #[must_use]
    pub fn errors(&self, quantity: &Quantity) -> Option<&[Option<f64>]> {
        let of = |c: &&Column| c.quantity.name.strip_suffix("_stderr") == Some(quantity.name);
        self.columns.iter().find(of).map(|c| c.values.as_slice())
    }

    /// The largest and smallest defined values of a column.
    #[must_use]
    pub fn range(&self, quantity: &Quantity) -> Option<(f64, f64)> {
        self.get(quantity)?.iter().flatten().fold(None, |range, &x| match range {
            None => Some((x, x)),
            Some((low, high)) => Some((x.min(low), x.max(high))),
        })
    }

    /// Writes `# comment` lines, the header and one line per row. An undefined value is an empty field.
    ///
    /// # Errors
    /// Whatever the writer returns.
    pub fn write_csv(&self, mut to: impl Write, comments: &[String]) -> Result<(), TableError> {
        for comment in comments {
            writeln!(to, "# {}", comment.replace(['\n', '\r'], " "))?;
        }
        let mut writer = csv::Writer::from_writer(to);
        writer.write_record(self.quantities().map(|q| q.name))?;
        for row in 0..self.rows() {
            writer.write_record(self.columns.iter().map(|c| c.values[row].map_or_else(String::new, number)))?;
        }
        writer.flush()?;
        Ok(())
    }

    /// Reads what [`Table::write_csv`] wrote; headers are looked up in `catalogue`.
    ///
    /// # Errors
    /// An unknown header, a field that is not a finite number, malformed CSV, an unreadable file.
    pub fn read_csv(from: impl BufRead, catalogue: &'static [&'static Quantity]) -> Result<Self, TableError> {
        let mut table = Self::default();
        let unknown = |name: &String| TableError::UnknownColumn { name: name.clone() };
        let known = |(name, values): (String, Values)| {
            quantity::find(catalogue, &name).map(|quantity| (quantity, values)).ok_or_else(|| unknown(&name))
        };
        for (quantity, values) in read_columns(from)?.into_iter().map(known).collect::<Result<Vec<_>, _>>()? {
            table.push(quantity, values)?;
        }
        Ok(table)
    }
}

/// One value per row, `None` where there is none.
pub type Values = Vec<Option<f64>>;

/// The columns of a CSV text under their headers, whatever these say: `#` lines are comments, an empty field is undefined.
///
/// # Errors
/// A field that is not a number, rows of different lengths, an unreadable file.
pub fn read_columns(from: impl BufRead) -> Result<Vec<(String, Values)>, TableError> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(from);
    let mut columns: Vec<(String, Values)> =
        reader.headers()?.iter().map(|name| (name.to_owned(), Vec::new())).collect();
    for record in reader.records() {
        let record = record?;
        let line = record.position().map_or(0, csv::Position::line);
        for ((_, values), field) in columns.iter_mut().zip(&record) {
            values.push(match field {
                "" => None,
                text => Some(text.parse().map_err(|_| TableError::NotANumber { line, field: text.into() })?),
            });
        }
    }
    Ok(columns)
}

/// The shortest text that reads back as the same `f64`.
fn number(x: f64) -> String {
    let size = x.abs();
    if size != 0.0 && !(1e-4..1e15).contains(&size) { format!("{x:e}") } else { format!("{x}") }
}

macro_rules! over_an_axis {
    ($(#[$doc:meta])* $name:ident, $axis:path, $catalogue:path) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name(Table);

        impl $name {
            /// A table whose first column is the axis.
            ///
            /// # Errors
            /// [`TableError::NotFinite`] if a value is NaN or infinite.
            pub fn new(axis: Vec<f64>) -> Result<Self, TableError> {
                let mut table = Table::default();
                table.push(&$axis, axis.into_iter().map(Some).collect())?;
                Ok(Self(table))
            }

            /// Adds a column.
            ///
            /// # Errors
            /// As [`Table::push`].
            pub fn push(&mut self, quantity: &'static Quantity, values: Vec<Option<f64>>) -> Result<(), TableError> {
                self.0.push(quantity, values)
            }

            /// The standard errors as a table of the quantities themselves, without those that are 0; `None` if there are none.
            #[must_use]
            pub fn standard_errors(&self) -> Option<Self> {
                let mut errors = Table::default();
                let axis = self.get(&$axis)?.to_vec();
                errors.columns.push(Column { quantity: &$axis, values: axis });
                for quantity in self.quantities() {
                    if let Some(known) = self.errors(quantity) {
                        let values = known.iter().map(|e| e.filter(|&e| e > 0.0)).collect();
                        errors.columns.push(Column { quantity, values });
                    }
                }
                (errors.columns.len() > 1).then_some(Self(errors))
            }

            /// Reads what [`Table::write_csv`] wrote.
            ///
            /// # Errors
            /// As [`Table::read_csv`], and [`TableError::NoAxis`].
            pub fn read_csv(from: impl BufRead) -> Result<Self, TableError> {
                let table = Table::read_csv(from, $catalogue)?;
                let complete = table.get(&$axis).is_some_and(|axis| !axis.is_empty() && axis.iter().all(Option::is_some));
                if complete { Ok(Self(table)) } else { Err(TableError::NoAxis { expected: $axis.name }) }
            }

            /// Values of the axis, one per row.
            #[must_use]
            pub fn axis(&self) -> Vec<f64> {
                self.0.get(&$axis).unwrap_or_default().iter().flatten().copied().collect()
            }
        }

        impl std::ops::Deref for $name {
            type Target = Table;
            fn deref(&self) -> &Table {
                &self.0
            }
        }
    };
}

over_an_axis!(
    /// Columns over the elevation z \[m], ascending: the one contact surface of results.
    Profile,
    quantity::Z,
    quantity::COLUMNS
);
over_an_axis!(
    /// Columns over iterations or time.
    Series,
    quantity::ITERATION,
    quantity::SERIES
);

impl Profile {
    /// Linear interpolation of a column at elevation `z` \[m]; `None` outside the levels or beside an undefined value.
    #[must_use]
    pub fn at(&self, quantity: &Quantity, z: f64) -> Option<f64> {
        let (levels, values) = (self.get(&quantity::Z)?, self.get(quantity)?);
        let above = levels.partition_point(|level| level.is_some_and(|level| level < z));
        if levels.get(above).copied().flatten().is_some_and(|level| level <= z) {
            return values[above];
        }
        let below = above.checked_sub(1)?;
        let (z0, z1) = (levels[below]?, (*levels.get(above)?)?);
        let (a, b) = (values[below]?, values[above]?);
        Some(a + (b - a) * (z - z0) / (z1 - z0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_round_trip_keeps_every_bit_and_every_gap() {
        let mut profile = Profile::new(vec![0.0, 0.1, 1.0 / 3.0]).unwrap();
        profile.push(&quantity::U_PARTICLE, vec![Some(1.234_567_890_123_456_7e-9), Some(-0.5), None]).unwrap();
        let mut text = Vec::new();
        profile.write_csv(&mut text, &["two\nlines".into()]).unwrap();
        assert_eq!(Profile::read_csv(text.as_slice()).unwrap(), profile);
        assert!(String::from_utf8(text).unwrap().starts_with("# two lines\nz_m,u_particle_m_s\n"));
    }

    #[test]
    fn nan_is_refused() {
        let mut profile = Profile::new(vec![0.0, 1.0]).unwrap();
        let refused = profile.push(&quantity::PHI, vec![Some(0.0), Some(f64::NAN)]);
        assert!(matches!(refused, Err(TableError::NotFinite { column: "phi", row: 1 })));
        assert!(Profile::read_csv("z_m,phi\n0,nan\n".as_bytes()).is_err());
        assert!(Profile::read_csv("phi\n0\n".as_bytes()).is_err());
    }

    #[test]
    fn interpolation_is_linear_and_does_not_extrapolate() {
        let mut profile = Profile::new(vec![0.0, 2.0]).unwrap();
        profile.push(&quantity::PHI, vec![Some(0.0), Some(1.0)]).unwrap();
        assert_eq!(profile.at(&quantity::PHI, 0.5), Some(0.25));
        assert_eq!(profile.at(&quantity::PHI, 2.0), Some(1.0));
        assert_eq!(profile.at(&quantity::PHI, 2.1), None);
        assert_eq!(profile.at(&quantity::PHI, -0.1), None);
    }
}
