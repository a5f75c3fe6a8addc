//! What a fit says: each parameter with its error, the pairs that cannot be told apart, table and figures.

use serde_json::{Value, json};

use super::{ALIKE, Parameters, Target, report};
use crate::compare::{Subject, percent};
use crate::numerics::least_squares::{Ended, Fit, Statistics};
use crate::plot::{Axis, Curve, Dash, Figure, Marker, Panel, Trace, shared_figures};
use crate::result::quantity;
use crate::result::{ErrorReport, Profile};
use crate::study::{Judgement, Numbers, Row};
use crate::units::{readable_unit, significant};

/// χ² per degree of freedom beyond which, or below whose inverse, data and errors do not go together.
const ASTRAY: f64 = 2.0;
/// Panels of one figure.
const PANELS: usize = 4;

/// Everything that is known when a fit has ended.
pub(super) struct Found {
    pub parameters: Parameters,
    pub data: Subject,
    pub target: Target,
    pub fit: Fit<ErrorReport>,
    /// `None` where nothing can be said of the errors
    pub statistics: Option<Statistics>,
}

/// A parameter as it was fitted.
struct Fitted<'a> {
    key: &'a str,
    name: &'a str,
    start: f64,
    value: f64,
    error: Option<f64>,
    interval: Option<(f64, f64)>,
}

impl Found {
    pub fn judge(&self, rows: &[Row]) -> Judgement {
        let fitted = self.fitted();
        let known = self.target.known;
        let weights = if known {
            "each value is weighted by its standard error, and standard errors follow from these"
        } else {
            "no standard error is given: values are weighted alike, in shares of the largest of their column, and standard \
             errors follow from the residuals"
        };
        let columns: Vec<&str> = self.target.columns.iter().map(|c| c.quantity.title).collect();
        let mut judgement = Judgement {
            subtitle: format!("{} values of {}; {weights}.", self.target.count(), columns.join(", ")),
            findings: self.findings(&fitted),
            figures: self.figures(rows),
            failure: self.fit.ended.as_ref().err().map(|ended| self.failure(ended)),
            ..Judgement::default()
        };
        for (name, fact) in [("parameters", self.parameter_facts(&fitted)), ("fit", self.fit_facts())] {
            judgement.facts.insert(name.into(), fact);
        }
        judgement.parameters = Some(self.table(&fitted, weights));
        judgement
    }

    fn fitted(&self) -> Vec<Fitted<'_>> {
        let Parameters { keys, names, start, .. } = &self.parameters;
        let of = |i: usize| {
            let value = self.fit.x[i].exp();
            let ln = self.statistics.as_ref().map(|s| s.errors[i]).filter(|e| e.is_finite());
            let quantile = self.statistics.as_ref().map_or(f64::NAN, |s| quantile(self.target.known, s.freedom));
            Fitted {
                key: &keys[i],
                name: &names[i],
                start: start[i],
                value,
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
                _ => {
                    format!("{} from {}; its error is not known", significant(one.value, 4), significant(one.start, 4))
                }
            };
            say(one.name, text);
        }
        let Some(statistics) = &self.statistics else { return findings };
        for (i, j, correlation) in statistics.pairs().filter(|p| p.2.abs() > ALIKE) {
            let left = (1.0 - correlation * correlation).max(0.0).sqrt();
            let text = format!(
                "{} and {} cannot be told apart by these data: correlation {}; fix one of them, and the error of the other falls to {} of this",
                fitted[i].name,
                fitted[j].name,
                correlation_text(correlation),
                percent(left)
            );
            say("not told apart", text);
        }
        for one in fitted.iter().filter(|one| one.error.is_none_or(|e| e > one.value)) {
            say(
                "not determined",
                format!("{}: its standard error is more than its value; leave it as it is", one.name),
            );
        }
        if fitted.len() > 1 {
            let (direction, error) = &statistics.weakest;
            let powers: Vec<String> =
                fitted.iter().zip(direction).map(|(one, power)| format!("{}^{power:.2}", one.name)).collect();
            say("known least", format!("{} within ± {}", powers.join(" "), share(*error)));
        }
        let mut text = self.quality(statistics);
        text += &format!("; {} iterations, {} runs of the model", self.fit.iterations, self.fit.evaluations);
        say("fit", text);
        let per = statistics.chi2 / statistics.freedom.max(1) as f64;
        if self.target.known && statistics.freedom > 0 && !(1.0 / ASTRAY..=ASTRAY).contains(&per) {
            let text = if per > 1.0 {
                "the data lie further from the model than their errors allow: the model or the errors are wrong, and with them the errors above"
            } else {
                "the data lie closer to the model than their errors allow: those are too large or not independent"
            };
            say("bear in mind", text.to_owned());
        }
        findings
    }

    /// How well the model fits, before and after.
    fn quality(&self, statistics: &Statistics) -> String {
        let (count, before) = (self.target.count() as f64, self.fit.before);
        if self.target.known {
            let chi2 = significant(statistics.chi2, 4);
            format!(
                "χ² {chi2} for {} degrees of freedom, {} before",
                statistics.freedom,
                significant(before * before, 4)
            )
        } else {
            let rms = |norm: f64| share(norm / count.sqrt());
            let after = rms(statistics.chi2.sqrt());
            format!(
                "residuals {after} of the largest value, {} before, {} degrees of freedom",
                rms(before),
                statistics.freedom
            )
        }
    }

    fn parameter_facts(&self, fitted: &[Fitted<'_>]) -> Value {
        let one = |(i, p): (usize, &Fitted<'_>)| {
            json!({
                "key": p.key, "start": p.start, "value": p.value, "stderr": p.error,
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
        let (chi, before) = (self.fit.residuals.iter().map(|r| r * r).sum::<f64>().sqrt(), self.fit.before);
        json!({
            "converged": self.fit.ended.is_ok(),
            "sigma_known": self.target.known,
            "chi2": chi * chi,
            "chi2_before": before * before,
            "residual_norm": chi,
            "residual_norm_before": before,
            "degrees_of_freedom": self.target.count().saturating_sub(keys.len()),
            "iterations": self.fit.iterations,
            "model_runs": self.fit.evaluations,
            "offset": Some(self.fit.offset).filter(|x| x.is_finite()),
            "singular_values": statistics.map(|s| s.singular.clone()),
            "condition": statistics.and_then(|s| Some(s.singular.first()? / s.singular.last()?)).filter(|x| x.is_finite()),
            "not_told_apart": alike.map(|(i, j, r)| json!([keys[i], keys[j], r])).collect::<Vec<_>>(),
            "columns": columns.map(|c| json!({ "name": c.quantity.name, "levels": c.levels.len(), "left_out": c.left_out })).collect::<Vec<_>>(),
        })
    }

    /// `parameters.csv`: one row per parameter, with its correlations to all.
    fn table(&self, fitted: &[Fitted<'_>], weights: &str) -> Numbers {
        let mut head: Vec<String> = ["key", "start", "fitted", "stderr", "low_95", "high_95"].map(str::to_owned).into();
        head.extend(fitted.iter().map(|one| format!("correlation {}", one.name)));
        let row = |(i, one): (usize, &Fitted<'_>)| {
            let mut values = vec![Some(one.start), Some(one.value), one.error];
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
        let (code, message, hint) = match ended {
            Ended::NoInfluence(i) => {
                let key = &self.parameters.keys[*i];
                ("no-influence", format!("no value of the data depends on {key}"), format!("leave --fit {key} out"))
            }
            Ended::Blocked(error) => (
                "fit-blocked",
                format!("the fit wants to go on to where the case has no answer: {}", error.message),
                "start elsewhere with --set, or fit fewer parameters; the best values are in the folder".into(),
            ),
            Ended::NotConverged => (
                "fit-not-converged",
                format!(
                    "the fit did not reach a minimum in {} runs of the model: {} standard errors are left",
                    self.fit.evaluations,
                    significant(self.fit.offset, 2)
                ),
                "start elsewhere with --set, or fit fewer parameters; the best values are in the folder".to_owned(),
            ),
        };
        ErrorReport { hint: Some(hint), ..report(code, message) }
    }

    /// Data and model before and after, and the residuals of both.
    fn figures(&self, rows: &[Row]) -> Vec<Figure> {
        let profiles: Vec<(&str, Profile)> = rows
            .iter()
            .filter_map(|row| Some((row.point.series.as_str(), self.reduced(row.profile.as_ref()?)?)))
            .collect();
        let Some(data) = self.reduced(&self.data.profile) else { return Vec::new() };
        let bed = rows.last().and_then(|row| row.result(quantity::BED_LEVEL.name));
        let errors = self.data.errors.clone().or_else(|| self.data.profile.standard_errors());
        let trace =
            |name, profile, measured: bool, errors| Trace { name, profile, errors, measured, bed, phi_interface: None };
        let mut traces = vec![trace(self.data.name.as_str(), &data, true, errors.as_ref())];
        traces.extend(profiles.iter().map(|(name, profile)| trace(name, profile, false, None)));
        let mut figures = shared_figures(&traces, None, None);
        let pages = self.target.columns.chunks(PANELS).enumerate();
        figures.extend(pages.map(|(i, columns)| self.residual_figure(i, columns, &profiles)));
        figures
    }

    /// The columns that are fitted, and nothing else.
    fn reduced(&self, profile: &Profile) -> Option<Profile> {
        let mut reduced = Profile::new(profile.axis()).ok()?;
        for quantity in self.target.columns.iter().map(|c| c.quantity) {
            reduced.push(quantity, profile.get(quantity)?.to_vec()).ok()?;
        }
        Some(reduced)
    }

    fn residual_figure(&self, page: usize, columns: &[super::Column], profiles: &[(&str, Profile)]) -> Figure {
        let highest = columns.iter().flat_map(|c| &c.levels).fold(0.0_f64, |m, level| m.max(level.z.abs()));
        let (factor, unit) = readable_unit(highest, quantity::Z.unit);
        let unit_of = if self.target.known { "σ" } else { "of the largest" };
        let panel = |(k, column): (usize, &super::Column)| {
            let of = |(i, (name, profile)): (usize, &(&str, Profile))| {
                let one = Target { columns: vec![column.clone()], known: self.target.known };
                let residuals = one.residuals(profile).unwrap_or_default();
                Curve {
                    name: if k == 0 { (*name).into() } else { String::new() },
                    points: residuals
                        .iter()
                        .zip(&column.levels)
                        .map(|(r, level)| Some((*r, level.z * factor)))
                        .collect(),
                    colour: i + 1,
                    marker: Some([Marker::Square, Marker::Triangle][i % 2]),
                    ..Curve::default()
                }
            };
            let zero =
                [column.levels.first(), column.levels.last()].map(|level| level.map(|level| (0.0, level.z * factor)));
            let zero = Curve { points: zero.into(), line: Some(Dash::Dotted), ..Curve::default() };
            let curves = std::iter::once(zero).chain(profiles.iter().enumerate().map(of)).collect();
            Panel { x: Axis::linear(&format!("residual of {}", column.quantity.symbol), unit_of), curves }
        };
        Figure {
            stem: if page == 0 { "residuals".into() } else { format!("residuals_{}", page + 1) },
            caption: "Model less data before the fit and after it, over the elevation z.".into(),
            y: Axis::linear("elevation z", unit),
            panels: columns.iter().enumerate().map(panel).collect(),
            levels: Vec::new(),
            tint_below: None,
        }
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
