//! What is fitted: measured columns, level by level, each with its weight.

use super::{Unfit, report};
use crate::compare::Subject;
use crate::compare::norms::interpolated;
use crate::result::quantity::{COLUMNS, Quantity, find};
use crate::result::{ErrorReport, Profile};
use crate::study::StudyError;

/// A measured value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// elevation \[m]
    pub z: f64,
    /// what was measured [unit of the column]
    pub value: f64,
    /// its standard error, or the size that residuals are divided by [unit of the column]
    pub sigma: f64,
}

/// A measured column.
#[derive(Clone, Debug)]
pub struct Column {
    /// which one
    pub quantity: &'static Quantity,
    /// where the model has it, too
    pub levels: Vec<Level>,
    /// values that were left out because the model has none there
    pub left_out: usize,
}

/// The columns that are fitted.
#[derive(Clone, Debug)]
pub struct Target {
    /// at least one, each with at least one level
    pub columns: Vec<Column>,
    /// whether the sigmas are standard errors; else each is the largest magnitude of its column
    pub known: bool,
}

impl Target {
    /// What `data` and a profile of the model share: `columns`, or all; `sigma` are the arguments of that option.
    ///
    /// # Errors
    /// [`StudyError::BadData`] if nothing is shared, if it is too little for `parameters`, or if some values have a sigma
    /// and others do not; [`StudyError::BadSigma`].
    pub fn of(
        data: &Subject,
        model: &Profile,
        columns: &[String],
        sigma: &[String],
        parameters: usize,
    ) -> Result<Self, StudyError> {
        let bad = |reason: String, hint: String| StudyError::BadData { file: data.source.clone(), reason, hint };
        let names = |of: &mut dyn Iterator<Item = &'static Quantity>| of.map(|q| q.name).collect::<Vec<_>>().join(", ");
        let of_model = || names(&mut model.quantities().skip(1));
        let measured: Vec<&'static Quantity> =
            data.profile.quantities().skip(1).filter(|q| !q.name.ends_with("_stderr")).collect();
        if let Some(name) = columns.iter().find(|name| measured.iter().all(|q| q.name != name.as_str())) {
            let hint = format!("it has {}", names(&mut measured.iter().copied()));
            return Err(bad(format!("it has no column {name}"), hint));
        }
        if let Some(name) = columns.iter().find(|name| model.quantities().all(|q| q.name != name.as_str())) {
            return Err(bad(format!("the model has no column {name}"), format!("it has {}", of_model())));
        }
        let wanted = |q: &&Quantity| columns.is_empty() || columns.iter().any(|name| name == q.name);
        let shared = measured.into_iter().filter(wanted).filter(|q| model.get(q).is_some());
        let given = sigmas(sigma)?;
        let (mut fitted, mut with, mut without) = (Vec::new(), 0, 0);
        for quantity in shared {
            let errors = data.errors.as_ref().and_then(|e| e.get(quantity)).or(data.profile.errors(quantity));
            let otherwise = given.iter().rev().find(|(name, _)| name.is_none_or(|q| q.name == quantity.name));
            let mut column = Column { quantity, levels: Vec::new(), left_out: 0 };
            let values = data.profile.get(quantity).unwrap_or_default();
            for (i, (z, value)) in data.profile.axis().into_iter().zip(values).enumerate() {
                let Some(value) = *value else { continue };
                if interpolated(model, quantity, z).is_none() {
                    column.left_out += 1;
                    continue;
                }
                let own = errors.and_then(|e| *e.get(i)?).filter(|s| *s > 0.0).or(otherwise.map(|s| s.1));
                *if own.is_some() { &mut with } else { &mut without } += 1;
                column.levels.push(Level { z, value, sigma: own.unwrap_or(f64::NAN) });
            }
            if !column.levels.is_empty() {
                fitted.push(column);
            }
        }
        match (with, without) {
            (0, 0) => {
                let reason = "it shares no column with the model at a common elevation".into();
                return Err(bad(reason, format!("the model has {}", of_model())));
            }
            (0, _) => fitted.iter_mut().for_each(Column::by_largest),
            (_, 0) => {}
            (with, without) => {
                let reason = format!("{with} values have a standard error and {without} have none");
                return Err(bad(
                    reason,
                    "give --sigma for those without, or leave their column out with --column".into(),
                ));
            }
        }
        if with + without <= parameters {
            let reason = format!("{} values for {parameters} parameters", with + without);
            return Err(bad(reason, "fit fewer parameters, or give more data".into()));
        }
        Ok(Self { columns: fitted, known: with > 0 })
    }

    /// How many values are fitted.
    #[must_use]
    pub fn count(&self) -> usize {
        self.columns.iter().map(|column| column.levels.len()).sum()
    }

    /// Model less data over sigma, column by column.
    ///
    /// # Errors
    /// If the model has no value where there was one at the start.
    pub fn residuals(&self, model: &Profile) -> Result<Vec<f64>, ErrorReport> {
        let mut residuals = Vec::with_capacity(self.count());
        for column in &self.columns {
            for level in &column.levels {
                let value = nearby(model, column.quantity, level.z).ok_or_else(|| {
                    let (name, z) = (column.quantity.name, level.z);
                    report(
                        Unfit::Undefined.code(),
                        format!("{name} is no longer defined at z = {z} m, where it was measured"),
                    )
                })?;
                residuals.push((value - level.value) / level.sigma);
            }
        }
        Ok(residuals)
    }
}

impl Column {
    fn by_largest(&mut self) {
        let largest = self.levels.iter().fold(0.0_f64, |m, level| m.max(level.value.abs()));
        for level in &mut self.levels {
            level.sigma = if largest > 0.0 { largest } else { 1.0 };
        }
    }
}

/// A column of the model; beyond its ends, which move a little with the parameters, the value there.
fn nearby(model: &Profile, quantity: &Quantity, z: f64) -> Option<f64> {
    model.at(quantity, z).or_else(|| {
        let (levels, values) = (model.axis(), model.get(quantity)?);
        match (levels.first(), levels.last()) {
            (Some(low), _) if z < *low => values.first().copied().flatten(),
            (_, Some(high)) if z > *high => values.last().copied().flatten(),
            _ => None,
        }
    })
}

/// `0.01` for all columns, `phi=0.01` for one.
fn sigmas(arguments: &[String]) -> Result<Vec<(Option<&'static Quantity>, f64)>, StudyError> {
    let one = |argument: &String| {
        let bad = |reason: &str| StudyError::BadSigma { argument: argument.clone(), reason: reason.into() };
        let (name, number) = match argument.split_once('=') {
            Some((name, number)) => {
                (Some(find(COLUMNS, name.trim()).ok_or_else(|| bad("there is no such column"))?), number)
            }
            None => (None, argument.as_str()),
        };
        let sigma = number.trim().parse::<f64>().ok().filter(|x| *x > 0.0 && x.is_finite());
        Ok((name, sigma.ok_or_else(|| bad("not a positive number"))?))
    };
    arguments.iter().map(one).collect()
}
