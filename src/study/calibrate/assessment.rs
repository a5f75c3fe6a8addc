//! What a fit reports: each parameter with its error, the pairs that cannot be told apart, table and figures.

use serde_json::{Value, json};

use super::{ALIKE, Parameters, Target, Unfit, report};
use crate::compare::{Subject, percent};
use crate::numerics::least_squares::{Ended, Fit, Statistics};
use crate::result::ErrorReport;
use crate::study::{Assessment, Numbers, Row};
use crate::units::significant;

/// Distance of χ² from its mean, and of the correlation of neighbouring residuals from none, that is no chance any more
/// [standard deviations].
const ASTRAY: f64 = 3.0;
/// Residuals below this share of those before are those of a model that made the data.
const EXACT: f64 = 1e-6;
/// Fewest residuals of a column whose neighbours are compared.
const FEW: usize = 8;

/// Everything that is known when a fit has ended.
pub(super) struct Found {
    pub parameters: Parameters,
    pub data: Subject,
    pub target: Target,
    pub fit: Fit<ErrorReport>,
    /// `None` where the errors are not known
    pub statistics: Option<Statistics>,
}

/// A parameter as it was fitted.
struct Fitted<'a> {
    key: &'a str,
    name: &'a str,
    start: f64,
    bounds: (f64, f64),
    value: f64,
    /// the bound that holds it
    at_bound: Option<&'static str>,
    error: Option<f64>,
    interval: Option<(f64, f64)>,
}

impl Fitted<'_> {
    /// The lower bound, 0, or the upper one, 1, if it has one.
    fn bound(&self, side: usize) -> Option<f64> {
        Some([self.bounds.0, self.bounds.1][side]).filter(|bound| *bound > 0.0 && bound.is_finite())
    }
}

impl Found {
    pub fn assess(&self, rows: &[Row]) -> Assessment {
        let fitted = self.fitted();
        let known = self.target.known;
        let weights = if known {
            "each value is weighted by its standard error, and standard errors follow from these"
        } else {
            "no standard error is given: values are weighted alike, in shares of the largest of their column, and standard \
             errors follow from the residuals"
        };
        let columns: Vec<&str> = self.target.columns.iter().map(|c| c.quantity.title).collect();
        let mut assessment = Assessment {
            subtitle: format!("{} values of {}; {weights}.", self.target.count(), columns.join(", ")),
            findings: self.findings(&fitted),
            figures: self.figures(rows),
            failure: self.fit.ended.as_ref().err().map(|ended| self.failure(ended)),
            ..Assessment::default()
        };
        for (name, fact) in [("parameters", self.parameter_facts(&fitted)), ("fit", self.fit_facts())] {
            assessment.facts.insert(name.into(), fact);
        }
        assessment.parameters = Some(self.table(&fitted, weights));
        assessment
    }

    fn fitted(&self) -> Vec<Fitted<'_>> {
        let Parameters { keys, names, start, bounds, .. } = &self.parameters;
        let values = self.parameters.values(&self.fit.x);
        let of = |i: usize| {
            let value = values[i];
            let side = if value < (bounds[i].0 * bounds[i].1).sqrt() { "lower" } else { "upper" };
            let ln = self.statistics.as_ref().map(|s| s.errors[i]).filter(|e| e.is_finite());
            let quantile = self.statistics.as_ref().map_or(f64::NAN, |s| quantile(self.target.known, s.freedom));
            Fitted {
                key: &keys[i],
                name: &names[i],
                start: start[i],
                bounds: bounds[i],
                value,
                at_bound: self.fit.at_bound[i].then_some(side),
                error: ln.map(|ln| value * ln).filter(|e| e.is_finite()),
                interval: ln
                    .map(|ln| (value * (-quantile * ln).exp(), value * (quantile * ln).exp()))
                    .filter(|(low, high)| *low > 0.0 && high.is_finite()),
            }
        };
        (0..keys.len()).map(of).collect()
    }

    fn findings(&self, fitted: &[Fitted<'_>]) -> Vec<(String, String)> {
        let mut findings: Vec<(String, String)> = Vec::new();
        let mut say = |label: &str, text: String| findings.push((label.to_owned(), text));
        for one in fitted {
            let text = match (one.error, one.interval) {
                (Some(error), Some((low, high))) => format!(
                    "{} ± {} from {}; 95 % in {} to {}",
                    significant(one.value, 4),
                    significant(error, 2),
                    significant(one.start, 4),
                    significant(low, 4),
                    significant(high, 4)
                ),
                _ => match one.at_bound {
                    Some(side) => format!(
                        "{} from {}: its {side} bound; the data want it beyond, so it has no error, and those of others take it as known",
                        significant(one.value, 4),
                        significant(one.start, 4)
                    ),
                    None => format!(
                        "{} from {}; its error is not known",
                        significant(one.value, 4),
                        significant(one.start, 4)
                    ),
                },
            };
            say(one.name, text);
        }
        if let Some(statistics) = &self.statistics {
            for (i, j, correlation) in statistics.pairs().filter(|p| p.2.abs() > ALIKE) {
                let left = (1.0 - correlation * correlation).max(0.0).sqrt();
                let text = format!(
                    "{} and {} cannot be told apart by these data: correlation {}, beyond {ALIKE}; fix one of them, and the error of the other falls to {} of this",
                    fitted[i].name,
                    fitted[j].name,
                    correlation_text(correlation),
                    percent(left)
                );
                say("not told apart", text);
            }
            for one in fitted.iter().filter(|one| one.at_bound.is_none() && one.error.is_none_or(|e| e > one.value)) {
                let text = format!("{}: its standard error is more than its value; leave it as it is", one.name);
                say("not determined", text);
            }
            if fitted.iter().filter(|one| one.at_bound.is_none()).count() > 1 {
                let (direction, error) = &statistics.weakest;
                let free = fitted.iter().zip(direction).filter(|(_, power)| power.abs() >= 0.005);
                let powers: Vec<String> = free.map(|(one, power)| format!("{}^{power:.2}", one.name)).collect();
                let combination = powers.join(" ");
                if *error < 1.0 {
                    say("known least", format!("{combination} within ± {}", percent(*error)));
                } else {
                    say("undetermined", format!("{combination}: its standard error is more than its value"));
                }
            }
        }
        let mut text = self.quality();
        text += &format!("; {} iterations, {} runs of the model", self.fit.iterations, self.fit.evaluations);
        if self.fit.refusals > 0 {
            text += &format!(", {} without an answer", self.fit.refusals);
        }
        say("fit", text);
        for text in self.misfits() {
            say("bear in mind", text);
        }
        findings
    }

    /// Where data, model and errors do not go together.
    fn misfits(&self) -> Vec<String> {
        let mut misfits = Vec::new();
        let freedom = self.freedom() as f64;
        let off = (self.chi2() - freedom) / (2.0 * freedom).sqrt();
        if self.target.known && off > ASTRAY {
            misfits.push("the data lie further from the model than their errors allow: the model or the errors are wrong, and with them the errors above".into());
        } else if self.target.known && off < -ASTRAY {
            misfits.push(
                "the data lie closer to the model than their errors allow: those are too large or not independent"
                    .into(),
            );
        }
        if self.chi2().sqrt() <= EXACT * self.fit.before {
            return misfits;
        }
        for (column, alike) in
            self.alike().filter(|(column, alike)| alike * (column.levels.len() as f64).sqrt() > ASTRAY)
        {
            misfits.push(format!(
                "the residuals of {} are alike from level to level (correlation {alike:.2}): the model has not the shape of the data, and the errors above are too small",
                column.quantity.title
            ));
        }
        misfits
    }

    /// Each column with the correlation of its neighbouring residuals.
    fn alike(&self) -> impl Iterator<Item = (&super::Column, f64)> {
        let mut rest = &self.fit.residuals[..];
        let split = self.target.columns.iter().map(move |column| {
            let (own, others) = rest.split_at(column.levels.len().min(rest.len()));
            rest = others;
            let sum = own.iter().map(|r| r * r).sum::<f64>();
            let products = own.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>();
            (column, if sum > 0.0 { products / sum } else { 0.0 })
        });
        split.filter(|(column, _)| column.levels.len() >= FEW)
    }

    fn chi2(&self) -> f64 {
        self.fit.residuals.iter().map(|r| r * r).sum()
    }

    /// Values less free parameters.
    fn freedom(&self) -> usize {
        self.target.count().saturating_sub(self.fit.at_bound.iter().filter(|at_bound| !**at_bound).count())
    }

    /// χ² per degree of freedom.
    fn reduced_chi2(&self) -> Option<f64> {
        (self.freedom() > 0).then(|| self.chi2() / self.freedom() as f64)
    }

    /// How well the model fits, before and after.
    fn quality(&self) -> String {
        let (chi2, before, freedom) = (self.chi2(), self.fit.before * self.fit.before, self.freedom());
        if self.target.known {
            let each = self.reduced_chi2().map(|x| format!(" ({} for each)", significant(x, 3))).unwrap_or_default();
            let [after, before] = [chi2, before].map(|x| significant(x, 4));
            format!("χ² {after} for {freedom} degrees of freedom{each}, {before} before")
        } else {
            let [after, before] = [chi2, before].map(|x| share((x / self.target.count() as f64).sqrt()));
            format!("residuals {after} of the largest value, {before} before, {freedom} degrees of freedom")
        }
    }

    fn parameter_facts(&self, fitted: &[Fitted<'_>]) -> Value {
        let one = |(i, p): (usize, &Fitted<'_>)| {
            json!({
                "key": p.key, "start": p.start, "value": p.value, "stderr": p.error,
                "lower": p.bound(0), "upper": p.bound(1), "held_by": p.at_bound,
                "low": p.interval.map(|x| x.0), "high": p.interval.map(|x| x.1),
                "correlations": self.statistics.as_ref().map(|s| s.correlations[i].clone()),
            })
        };
        fitted.iter().enumerate().map(one).collect()
    }

    fn fit_facts(&self) -> Value {
        let keys = &self.parameters.keys;
        let statistics = self.statistics.as_ref();
        let alike = statistics.into_iter().flat_map(|s| s.pairs().filter(|p| p.2.abs() > ALIKE));
        let columns = self.target.columns.iter();
        let before = self.fit.before;
        json!({
            "converged": self.fit.ended.is_ok(),
            "sigma_known": self.target.known,
            "chi2": self.chi2(),
            "chi2_before": before * before,
            "degrees_of_freedom": self.freedom(),
            "iterations": self.fit.iterations,
            "model_runs": self.fit.evaluations,
            "model_runs_failed": self.fit.refusals,
            "chi2_reduced": self.reduced_chi2(),
            "bear_in_mind": self.misfits(),
            "known_least": statistics.map(|s| json!({ "direction": s.weakest.0, "stderr_ln": s.weakest.1 })),
            "offset": Some(self.fit.offset).filter(|x| x.is_finite()),
            "singular_values": statistics.map(|s| s.singular.clone()),
            "condition": statistics.and_then(|s| Some(s.singular.first()? / s.singular.last()?)).filter(|x| x.is_finite()),
            "not_told_apart": alike.map(|(i, j, r)| json!([keys[i], keys[j], r])).collect::<Vec<_>>(),
            "columns": columns.map(|c| json!({ "name": c.quantity.name, "levels": c.levels.len(), "left_out": c.left_out })).collect::<Vec<_>>(),
        })
    }

    /// `parameters.csv`: one row per parameter, with its correlations to all.
    fn table(&self, fitted: &[Fitted<'_>], weights: &str) -> Numbers {
        let mut head: Vec<String> =
            ["key", "start", "lower", "upper", "fitted", "stderr", "low_95", "high_95"].map(str::to_owned).into();
        head.extend(fitted.iter().map(|one| format!("correlation {}", one.name)));
        let row = |(i, one): (usize, &Fitted<'_>)| {
            let mut values = vec![Some(one.start), one.bound(0), one.bound(1), Some(one.value), one.error];
            values.extend([one.interval.map(|x| x.0), one.interval.map(|x| x.1)]);
            let of = |j: usize| self.statistics.as_ref().map(|s| s.correlations[i][j]).filter(|x| x.is_finite());
            values.extend((0..fitted.len()).map(of));
            (one.key.to_owned(), values)
        };
        Numbers {
            heading: "Parameters",
            lead: format!("In SI; {weights}."),
            head,
            rows: fitted.iter().enumerate().map(row).collect(),
        }
    }

    fn failure(&self, ended: &Ended<ErrorReport>) -> ErrorReport {
        let (kind, message, hint) = match ended {
            Ended::NoInfluence(i) => {
                let key = &self.parameters.keys[*i];
                (Unfit::NoInfluence, format!("no value of the data depends on {key}"), format!("leave --fit {key} out"))
            }
            Ended::Blocked(error) => (
                Unfit::Blocked,
                format!("the fit wants to go on to where the case has no answer: {}", error.message),
                "start elsewhere with --set, or fit fewer parameters; the best values are in the folder".into(),
            ),
            Ended::NotConverged => (
                Unfit::NotConverged,
                format!(
                    "the fit did not reach a minimum in {} runs of the model: {} standard errors are left",
                    self.fit.evaluations,
                    significant(self.fit.offset, 2)
                ),
                "start elsewhere with --set, or fit fewer parameters; the best values are in the folder".to_owned(),
            ),
        };
        ErrorReport { hint: Some(hint), ..report(kind.code(), message) }
    }
}

/// A relative size: `3.1 %`, or a factor where per cents say nothing any more.
fn share(x: f64) -> String {
    if x < 1.0 { percent(x) } else { format!("a factor {}", significant(x.exp(), 2)) }
}

/// Enough digits to see how far from 1 it is.
fn correlation_text(r: f64) -> String {
    if r.abs() > 0.9995 { format!("{r:.6}") } else { format!("{r:.3}") }
}

/// The 97.5 % quantile of the normal distribution, or of Student's with `freedom` degrees of freedom (Cornish-Fisher, within
/// 1 % from 3 degrees on).
fn quantile(known: bool, freedom: usize) -> f64 {
    let z = 1.959_963_985_f64;
    if known {
        return z;
    }
    let n = freedom.max(1) as f64;
    let first = (z.powi(3) + z) / 4.0;
    let second = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
    let third = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
    z + first / n + second / (n * n) + third / n.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (freedom, expected) in [(3, 3.182), (5, 2.571), (10, 2.228), (100, 1.984)] {
            assert!((quantile(false, freedom) / expected - 1.0).abs() < 0.01, "{freedom}");
        }
        assert!((quantile(true, 3) - 1.96).abs() < 1e-3);
    }
}
