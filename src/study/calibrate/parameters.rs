//! What is fitted: positive numbers of a case, by their logarithms, within bounds.

use super::super::STOPPED;
use super::{Listening, MISFIT, Request, Target, Unfit, report};
use crate::case::{Case, nearest};
use crate::model::Registry;
use crate::numerics::least_squares::{self, Fit};
use crate::result::Context;
use crate::result::{ErrorReport, Profile, Snapshot, Watch};
use crate::study::{Observer, StudyError};

/// The numbers of a case that are fitted.
#[derive(Clone, Debug)]
pub struct Parameters {
    registry: Registry,
    case: String,
    overrides: Vec<String>,
    read: Case,
    /// `table.key`
    pub keys: Vec<String>,
    /// the shortest endings of the keys that tell them apart
    pub names: Vec<String>,
    /// values of the case \[SI]
    pub start: Vec<f64>,
    /// smallest and largest value \[SI]; 0 and infinity where there is no bound
    pub bounds: Vec<(f64, f64)>,
}

/// Why a `--fit` is refused, and what to give instead.
type Refused = (String, String);

impl Parameters {
    /// Finds what `request` wants to fit in its case.
    ///
    /// # Errors
    /// [`StudyError::Case`], and [`StudyError::BadFit`] for a key that holds no positive number, for bounds that are none,
    /// that the case refuses or that do not enclose its value, and for grains, whose noise hides the derivative.
    pub fn of(registry: &Registry, request: &Request) -> Result<Self, StudyError> {
        let (case, problem) = registry.load(&request.case, &request.overrides).map_err(Box::new)?;
        let bad = |key: &String, (reason, hint): Refused| StudyError::BadFit { key: key.clone(), reason, hint };
        if problem.stochastic {
            let reason = format!("{} follows single grains, whose noise hides what a small change does", problem.kind);
            let hint = "fit a continuum model of the same scene, or look at the grains with bedload sweep".to_owned();
            return Err(bad(&request.fit.join(" "), (reason, hint)));
        }
        let (mut numbers, others) = case.numbers();
        // What describes the file, the mesh or the method is no property of the scene.
        let apart =
            |key: &str| ["case.", "check.", "limit.", "grid.", "solver.", "output."].iter().any(|t| key.starts_with(t));
        numbers.retain(|(key, _)| !apart(key));
        let (name, overrides) = (request.case.clone(), request.overrides.clone());
        let (keys, names, start) = (Vec::new(), Vec::new(), Vec::new());
        let registry = registry.clone();
        let mut all = Self { registry, case: name, overrides, read: case, keys, names, start, bounds: Vec::new() };
        for argument in &request.fit {
            let (key, range) = argument.split_once('=').map_or((argument.as_str(), None), |(k, r)| (k, Some(r)));
            let (key, start) = find(key.trim(), &numbers, &others).map_err(|refused| bad(argument, refused))?;
            if all.keys.contains(&key) {
                return Err(bad(argument, (format!("{key} is given twice"), "leave one out".into())));
            }
            let bounds = range.map_or(Ok((0.0, f64::INFINITY)), |range| all.bounds(&key, start, range));
            all.bounds.push(bounds.map_err(|refused| bad(argument, refused))?);
            all.keys.push(key);
            all.start.push(start);
        }
        all.names = all.keys.iter().map(|key| short(key, &all.keys)).collect();
        Ok(all)
    }

    /// Reads `lower:upper`, numbers in SI or with a unit, as the case itself does.
    fn bounds(&self, key: &str, start: f64, range: &str) -> Result<(f64, f64), Refused> {
        let hint = || format!("give {key}=lower:upper, both positive, as --set takes them");
        let Some((lower, upper)) = range.split_once(':') else {
            return Err((format!("\"{range}\" is not lower:upper"), hint()));
        };
        let value = |side: &str, text: &str| {
            let set = format!("{key}={}", text.trim());
            let (case, _) =
                self.registry.load(&self.case, &[&self.overrides[..], &[set]].concat()).map_err(|error| {
                    let first = error.reports().into_iter().next();
                    let (message, allowed) = first.map_or_else(Default::default, |r| (r.message, r.allowed));
                    let allowed = allowed.map_or_else(hint, |allowed| format!("allowed: {allowed}"));
                    (format!("the case refuses the {side} bound {}: {message}", text.trim()), allowed)
                })?;
            let found = case.numbers().0.into_iter().find(|(known, _)| known == key).map(|(_, value)| value);
            found.filter(|x| *x > 0.0).ok_or_else(|| (format!("the {side} bound \"{text}\" is not positive"), hint()))
        };
        let (lower, upper) = (value("lower", lower)?, value("upper", upper)?);
        if lower >= upper {
            return Err((format!("the lower bound {lower} is not below the upper one {upper}"), hint()));
        }
        if !(lower..=upper).contains(&start) {
            let reason = format!("the case has {start}, which is not between {lower} and {upper}");
            return Err((reason, format!("start within: --set {key}=...")));
        }
        Ok((lower, upper))
    }

    /// The values with these logarithms \[SI]. A bound is met as it was given, not as the exponential of its logarithm.
    #[must_use]
    pub fn values(&self, ln: &[f64]) -> Vec<f64> {
        let value = |x: &f64, (low, high): &(f64, f64)| {
            [low, high].into_iter().find(|bound| bound.ln() == *x).copied().unwrap_or_else(|| x.exp())
        };
        ln.iter().zip(&self.bounds).map(|(x, bounds)| value(x, bounds)).collect()
    }

    /// What is set in the case for these logarithms.
    #[must_use]
    pub fn settings(&self, ln: &[f64]) -> Vec<String> {
        self.keys.iter().zip(self.values(ln)).map(|(key, value)| self.read.setting(key, value)).collect()
    }

    /// The profile of the case with these logarithms.
    ///
    /// # Errors
    /// Why the case is refused, or fails.
    pub fn profile(&self, ln: &[f64], watch: &mut dyn Watch) -> Result<Profile, ErrorReport> {
        let overrides = [&self.overrides[..], &self.settings(ln)].concat();
        let (_, problem) = self.registry.load(&self.case, &overrides).map_err(|error| {
            error.reports().into_iter().next().unwrap_or_else(|| report(Unfit::Refused.code(), error.to_string()))
        })?;
        let outcome = problem.run(&mut Context::new(watch)).map_err(|failure| ErrorReport {
            hint: Some(failure.error.hint()),
            ..report(failure.error.code(), failure.error.to_string())
        })?;
        outcome.profile.ok_or_else(|| report(Unfit::NoProfile.code(), "the model has no profile".into()))
    }

    /// Fits the parameters to `target`, from the values of the case.
    ///
    /// # Errors
    /// Why the start has no answer. Further failures are in [`Fit::ended`].
    pub fn fit(&self, target: &Target, observer: &dyn Observer) -> Result<Fit<ErrorReport>, ErrorReport> {
        let residuals = |ln: &[f64]| {
            if observer.stop() {
                return Err(report(STOPPED, "stopped by the user".into()));
            }
            target.residuals(&self.profile(ln, &mut Listening(observer))?)
        };
        let start: Vec<f64> = self.start.iter().map(|p| p.ln()).collect();
        let bounds: Vec<(f64, f64)> = self.bounds.iter().map(|(low, high)| (low.ln(), high.ln())).collect();
        let (count, first) = ((target.count() as f64).sqrt(), std::cell::Cell::new(None));
        let see = |norm: f64| {
            let before = first.get().unwrap_or(norm);
            first.set(Some(before));
            let fraction = if before > 0.0 { 1.0 - norm / before } else { 1.0 };
            observer.see(&Snapshot { stage: "fit", fraction, quantity: Some((&MISFIT, norm / count)) });
        };
        least_squares::minimise(&start, &bounds, &residuals, &see)
    }
}

/// The key that is meant by itself or by an ending that only it has, with its value.
fn find(wanted: &str, numbers: &[(String, f64)], others: &[String]) -> Result<(String, f64), Refused> {
    let known = || numbers.iter().map(|(key, _)| key.as_str());
    let all = || format!("numbers of this case: {}", known().collect::<Vec<_>>().join(", "));
    let ends = |key: &str| key == wanted || key.ends_with(&format!(".{wanted}"));
    let mut meant: Vec<&(String, f64)> = numbers.iter().filter(|(key, _)| key == wanted).collect();
    if meant.is_empty() {
        meant = numbers.iter().filter(|(key, _)| ends(key)).collect();
    }
    match meant[..] {
        [(key, value)] if *value > 0.0 => Ok((key.clone(), *value)),
        [(key, value)] => Err((
            format!("{key} is {value}, and the logarithm of a number is fitted"),
            format!("start from a positive one: --set {key}=..."),
        )),
        [] if others.iter().any(|key| ends(key)) => Err(("not a number, or a count".into(), all())),
        [] => {
            let endings = known().filter_map(|key| key.rsplit('.').next());
            let near = nearest(wanted, known()).or_else(|| nearest(wanted, endings));
            let near = near.map(|near| format!("did you mean {near}? ")).unwrap_or_default();
            Err(("the case has no such number that could be fitted".into(), near + &all()))
        }
        _ => {
            let several: Vec<&str> = meant.iter().map(|(key, _)| key.as_str()).collect();
            Err(("it may mean several numbers".into(), format!("one of {}", several.join(", "))))
        }
    }
}

/// The last segments of a key, as many as tell it from all others.
fn short(key: &str, all: &[String]) -> String {
    let ending = |key: &str, n: usize| key.rsplit('.').take(n).map(str::to_owned).collect::<Vec<_>>();
    let alone = |n: &usize| all.iter().filter(|other| ending(other, *n) == ending(key, *n)).count() <= 1;
    let mut parts = ending(key, (1..4).find(alone).unwrap_or(4));
    parts.reverse();
    parts.join(".")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_as_short_as_they_can_be() {
        let keys = ["closures.friction.mu_2", "closures.dilatancy.phi_max", "closures.mixing_length.phi_max"];
        let keys = keys.map(str::to_owned);
        let names: Vec<String> = keys.iter().map(|key| short(key, &keys)).collect();
        assert_eq!(names, ["mu_2", "dilatancy.phi_max", "mixing_length.phi_max"]);
    }
}
