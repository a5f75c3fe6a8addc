//! `calibrate`: what was put in comes out again, with the errors that are reported, and what the data do not determine is reported.

use std::fmt::Write;

use bedload::compare::data;
use bedload::numerics::least_squares::{Fit, Statistics};
use bedload::result::{ErrorReport, Profile, Quiet, quantity as q};
use bedload::runtime::rng::Stream;
use bedload::study::Observer;
use bedload::study::calibrate::{Parameters, Request, Target};
use serde_json::Value;

use super::support::Scratch;

const RUN: &str = "sheet_1d_sumer91";
/// One sigma of a measured value, over the largest value of its column.
const NOISE: f64 = 0.01;

/// Never stops, shows nothing.
struct Silent;

impl Observer for Silent {
    fn stop(&self) -> bool {
        false
    }
    fn done(&self, _: usize, _: usize) {}
}

/// A case whose parameters are known, what is measured of it, and what is fitted, with the factor by which it is off at the start.
struct Twin {
    case: &'static str,
    columns: &'static [&'static q::Quantity],
    fit: &'static [(&'static str, f64)],
    /// whether the data tell the parameters
    told: bool,
}

const U: &q::Quantity = &q::U_FLUID;
const PHI: &q::Quantity = &q::PHI;
const U_MIXTURE: &q::Quantity = &q::U_MIXTURE;

impl Twin {
    fn request(&self) -> Request {
        Request::new(self.case, "twin.csv", self.fit.iter().map(|(key, _)| (*key).into()).collect())
    }

    /// The exact parameters.
    fn exact(&self) -> Parameters {
        Parameters::of(&crate::support::REGISTRY, &self.request()).unwrap()
    }

    fn profile(&self) -> Profile {
        let exact = self.exact();
        exact.profile(&exact.start.iter().map(|p| p.ln()).collect::<Vec<_>>(), &mut Quiet).unwrap()
    }

    /// The exact profile at 40 levels from the lowest grain that moves to the top, with noise of the stream `seed`.
    fn measured(&self, exact: &Profile, seed: u64) -> String {
        let (z, u) = (exact.axis(), exact.get(self.columns[0]).unwrap());
        let largest = |of: &q::Quantity| exact.get(of).unwrap().iter().flatten().fold(0.0_f64, |m, x| m.max(*x));
        let top = z[z.len() - 1];
        let low = z
            .iter()
            .zip(u)
            .find(|(_, u)| u.is_some_and(|u| u > 1e-3 * largest(self.columns[0])))
            .map_or(0.0, |(z, _)| *z);
        let mut text = String::from("z_m");
        self.columns.iter().for_each(|c| write!(text, ",{0},{0}_err", c.name).unwrap());
        for i in 0..40_u32 {
            let level = low + (top - low) * (f64::from(i) + 0.5) / 40.0;
            let noise = Stream::new([seed, 7, u64::from(i)]).normal_pair();
            write!(text, "\n{level}").unwrap();
            for (k, column) in self.columns.iter().enumerate() {
                let sigma = NOISE * largest(column);
                write!(text, ",{},{sigma}", exact.at(column, level).unwrap() + sigma * noise[k]).unwrap();
            }
        }
        text
    }

    /// The fit to one measurement, from a start that is off.
    fn fitted(&self, exact: &Profile, seed: u64) -> (Parameters, Fit<ErrorReport>, Option<Statistics>) {
        let mut parameters = self.exact();
        for (start, (_, factor)) in parameters.start.iter_mut().zip(self.fit) {
            *start *= factor;
        }
        let data = data::parse(&self.measured(exact, seed), "twin", "twin.csv").unwrap();
        let target = Target::of(&data, exact, &[], &[], self.fit.len()).unwrap();
        let fit = parameters.fit(&target, &Silent).unwrap();
        let told = fit.jacobian.as_ref().and_then(|j| Statistics::of(&fit.residuals, j, &fit.at_bound, true));
        (parameters, fit, told)
    }

    fn repeat(&self, repeats: u64) -> Coverage {
        let (profile, exact) = (self.profile(), self.exact().start);
        let n = exact.len();
        let mut all = Coverage { within: vec![0; n], pull: vec![0.0; n], error: vec![0.0; n], ..Coverage::default() };
        for seed in 0..repeats {
            let (_, fit, told) = self.fitted(&profile, seed);
            let Some(told) = told.filter(|_| fit.ended.is_ok()) else { continue };
            all.ended += 1;
            let mut together = true;
            for (i, exact) in exact.iter().enumerate() {
                let value = fit.x[i].exp();
                let pull = (value - exact) / (value * told.errors[i]);
                let near = pull.abs() <= 2.0;
                all.pull[i] += pull * pull / repeats as f64;
                all.within[i] += usize::from(near);
                together &= near;
                all.error[i] += told.errors[i] / repeats as f64;
            }
            all.together += usize::from(together);
            all.chi2 += told.chi2 / told.freedom as f64 / repeats as f64;
            all.correlation += told.pairs().map(|p| p.2.abs()).fold(0.0, f64::max) / repeats as f64;
            all.runs += fit.evaluations as f64 / repeats as f64;
        }
        all
    }
}

/// How often the exact parameter is within two standard errors.
#[derive(Debug, Default)]
struct Coverage {
    /// fits with a minimum
    ended: usize,
    /// of each parameter
    within: Vec<usize>,
    /// of all at once
    together: usize,
    /// mean square of the deviation over the standard error
    pull: Vec<f64>,
    /// mean relative standard error
    error: Vec<f64>,
    chi2: f64,
    correlation: f64,
    runs: f64,
}

const TWINS: &[Twin] = &[
    Twin { fit: &[("mixing_length.kappa", 1.2)], columns: &[U], ..SHEET },
    Twin { fit: &[("mu_2", 1.15), ("i_0", 0.5)], columns: &[U], ..SHEET },
    Twin { fit: &[("mu_2", 1.15), ("i_0", 0.5)], ..SHEET },
    Twin { fit: &[("mu_2", 1.1), ("dilatancy.b", 1.4)], ..SHEET },
    Twin { fit: &[("mixing_length.kappa", 1.2), ("dilatancy.b", 0.7)], ..SHEET },
    Twin { fit: &[("mu_2", 1.1), ("kappa", 1.2), ("dilatancy.b", 0.8)], ..SHEET },
    Twin { fit: &[("mu_2", 1.1), ("i_0", 1.5), ("kappa", 1.1), ("dilatancy.b", 0.8)], ..SHEET },
    Twin { case: "sheet_1d_type_a", fit: &[("mu_2", 1.1), ("i_0", 0.7)], ..SHEET },
    Twin { case: "sheet_1d_type_b", fit: &[("mu_2", 1.1), ("i_0", 0.7)], ..SHEET },
    Twin { case: "laminar_1d_muiv", columns: &[U_MIXTURE], fit: &[("mu_2", 1.1), ("i_0", 0.7)], told: false },
    FILM,
];

const SHEET: Twin = Twin { case: RUN, columns: &[U, PHI], fit: &[("mu_2", 1.15), ("i_0", 0.5)], told: true };
/// I is the same at every depth: of μ(I) the data know one number.
const FILM: Twin =
    Twin { case: "exact_1d_bagnold", columns: &[&q::U_PARTICLE], fit: &[("mu_2", 1.05), ("i_0", 0.8)], told: false };

/// `cargo test --release -- --ignored --nocapture a_hundred_twins`, the table of docs/calibrate.md
#[test]
#[ignore = "a hundred fits of each of eleven sets of parameters: two minutes"]
fn a_hundred_twins() {
    let per_cent = |x: &f64| if *x < 10.0 { format!("{:.1} %", 100.0 * x) } else { "unknown".into() };
    for twin in TWINS {
        let found = twin.repeat(100);
        let words = |of: &mut dyn Iterator<Item = String>| of.collect::<Vec<_>>().join(", ");
        println!(
            "| `{}` | {} | {} | {} | {} | {} | {} | {:.3} | {:.2} | {:.0} |",
            twin.case,
            words(&mut twin.fit.iter().map(|(key, _)| key.rsplit('.').next().unwrap().to_owned())),
            words(&mut twin.columns.iter().map(|c| c.symbol.to_owned())),
            found.ended,
            words(&mut found.within.iter().map(usize::to_string)),
            found.together,
            words(&mut found.error.iter().map(per_cent)),
            found.correlation,
            found.chi2,
            found.runs
        );
        if twin.told {
            assert!(found.ended == 100 && found.within.iter().all(|&n| n >= 90), "{found:?}");
        }
    }
}

#[test]
fn the_exact_parameters_are_within_two_standard_errors_that_are_not_too_large() {
    for twin in [&TWINS[2], &TWINS[4]] {
        let found = twin.repeat(25);
        assert!(found.ended == 25 && found.within.iter().all(|&n| n >= 21), "{found:?}");
        assert!(found.pull.iter().all(|pull| (0.65..1.35).contains(&pull.sqrt())), "{found:?}");
        assert!((found.chi2 - 1.0).abs() < 0.1, "{found:?}");
    }
}

/// The measurement of a twin in `twin.csv`, and the folder.
fn measured(twin: &Twin, seed: u64) -> Scratch {
    let scratch = Scratch::new();
    scratch.write("twin.csv", twin.measured(&twin.profile(), seed));
    scratch
}

#[track_caller]
fn calibrate(scratch: &Scratch, code: i32, case: &str, arguments: &str) -> Value {
    let words = arguments.split_whitespace();
    let all = ["calibrate", case, "--json"].into_iter().chain(words);
    scratch.bedload(all).exits(code).json()
}

fn number(found: &Value, parameter: usize, name: &str) -> f64 {
    found["facts"]["parameters"][parameter][name].as_f64().unwrap()
}

/// The elevation and the first column of a measurement.
fn without_errors(measured: &str) -> String {
    measured.lines().map(|line| line.splitn(3, ',').take(2).collect::<Vec<_>>().join(",") + "\n").collect()
}

const OFF: &str = "--to twin.csv --set closures.friction.mu_2=0.8 --set closures.friction.i_0=0.15";

#[test]
fn a_fit_is_a_study_of_the_case_before_and_after() {
    let scratch = measured(&SHEET, 3);
    let found = calibrate(&scratch, 0, RUN, &format!("{OFF} --fit mu_2=0.55:1.5 --fit i_0 --out c --png"));
    assert_eq!((&found["status"], &found["facts"]["fit"]["converged"]), (&"done".into(), &true.into()));
    for (i, exact) in [0.7, 0.3].into_iter().enumerate() {
        assert!((number(&found, i, "value") - exact).abs() < 2.5 * number(&found, i, "stderr"), "{found}");
        let (low, high) = (number(&found, i, "low"), number(&found, i, "high"));
        assert!(low < exact && exact < high, "{found}");
        assert!(((high - low) / (2.0 * 1.96 * number(&found, i, "stderr")) - 1.0).abs() < 0.02, "{found}");
    }
    assert_eq!((number(&found, 0, "start"), number(&found, 0, "upper")), (0.8, 1.5));
    let fit = &found["facts"]["fit"];
    assert!((fit["chi2_reduced"].as_f64().unwrap() - 1.0).abs() < 0.5, "{fit}");
    assert!(fit["bear_in_mind"].as_array().unwrap().is_empty() && fit["chi2_before"].as_f64().unwrap() > 1e3, "{fit}");
    let series: Vec<&str> = found["points"].as_array().unwrap().iter().map(|p| p["series"].as_str().unwrap()).collect();
    assert_eq!(series, ["start", "fitted"]);
    let table = scratch.read("c/parameters.csv");
    let rows: Vec<&str> = table.lines().filter(|line| !line.starts_with('#')).collect();
    assert!(rows.len() == 3 && rows[0].starts_with("key,start,lower,upper,fitted,stderr,"), "{table}");
    assert!(rows[2].starts_with("closures.friction.i_0,0.15,,,0."), "{table}");
    let page = scratch.read("c/report.html");
    assert!(page.contains("Parameters") && page.contains("correlation i 0") && page.contains("<svg"));
    assert!(scratch.names("c/figures").contains(&"residuals.png".to_owned()));
    // What was fitted is a case like any other.
    let folder = found["points"][1]["folder"].as_str().unwrap();
    let text = scratch.read(&format!("c/{folder}/case.toml"));
    assert!(text.contains(&format!("mu_2 = {}", number(&found, 0, "value"))), "{text}");
    let again = calibrate(&scratch, 0, RUN, &format!("{OFF} --fit mu_2=0.55:1.5 --fit i_0 --out d --threads 1"));
    assert_eq!(again["facts"], found["facts"], "threads change nothing");
}

#[test]
fn what_the_data_do_not_determine_is_reported() {
    let scratch = measured(&FILM, 1);
    let words = "--to twin.csv --fit mu_2 --fit i_0 --set closures.friction.mu_2=0.7";
    let said = scratch.bedload(format!("calibrate exact_1d_bagnold {words} --out a").split(' ')).exits(0).out;
    assert!(said.contains("mu_2 and i_0 cannot be told apart") && said.contains("not determined"), "{said}");
    assert!(said.lines().count() <= 12, "{said}");
    let found = calibrate(&scratch, 0, "exact_1d_bagnold", &format!("{words} --out b"));
    let pairs = &found["facts"]["fit"]["not_told_apart"];
    assert!(pairs[0][2].as_f64().unwrap() > 0.999, "{pairs}");
    // One of them alone is determined.
    let found = calibrate(&scratch, 0, "exact_1d_bagnold", "--to twin.csv --fit i_0 --out c");
    assert!((number(&found, 0, "value") - 0.279).abs() < 2.0 * number(&found, 0, "stderr"), "{found}");
    let stated = number(&found, 0, "stderr");
    // Where the data state no errors, they are taken from the residuals.
    scratch.write("bare.csv", without_errors(&scratch.read("twin.csv")));
    let found = calibrate(&scratch, 0, "exact_1d_bagnold", "--to bare.csv --fit i_0 --out e");
    assert!((number(&found, 0, "stderr") / stated - 1.0).abs() < 0.3, "{stated} {found}");
    // A parameter at its bound has no error.
    let found =
        calibrate(&scratch, 0, "exact_1d_bagnold", "--to twin.csv --fit i_0=0.28:0.4 --set closures.friction.i_0=0.3");
    assert_eq!((&found["facts"]["parameters"][0]["held_by"], number(&found, 0, "value")), (&"lower".into(), 0.28));
    assert_eq!(found["facts"]["parameters"][0]["stderr"], Value::Null);
}

#[test]
fn a_wrong_model_is_reported() {
    let scratch = measured(&SHEET, 5);
    // The data have κ = 0.35; with κ = 0.5 no friction of the grains makes up for it.
    let arguments = "--to twin.csv --fit mu_2 --set closures.mixing_length.kappa=0.5";
    let found = calibrate(&scratch, 0, RUN, &format!("{arguments} --out a"));
    let words = found["facts"]["fit"]["bear_in_mind"].to_string();
    assert!(words.contains("further from the model") && words.contains("alike from level to level"), "{words}");
    // Without standard errors only the shape of the residuals can say so.
    scratch.write("bare.csv", without_errors(&scratch.read("twin.csv")));
    let found = calibrate(&scratch, 0, RUN, &format!("{} --out b", arguments.replace("twin", "bare")));
    let words = found["facts"]["fit"]["bear_in_mind"].to_string();
    assert!(!words.contains("further") && words.contains("alike from level to level"), "{words}");
    assert_eq!(found["facts"]["fit"]["sigma_known"], false);
}

#[test]
fn a_fit_without_a_minimum_is_exit_3_and_keeps_what_it_found() {
    let scratch = Scratch::new();
    scratch.write("fast.csv", "z_m,u_mixture_m_s\n0.03,0.5\n0.04,0.8\n0.05,0.7\n");
    let case = "exact_1d_aussillous";
    let found = calibrate(&scratch, 3, case, "--to fast.csv --fit pressure_gradient --out a");
    assert_eq!((&found["status"], &found["error"]["code"]), (&"failed".into(), &"fit-blocked".into()));
    let message = found["error"]["message"].as_str().unwrap();
    assert!(message.contains("the whole bed moves"), "{message}");
    assert!(found["facts"]["fit"]["model_runs_failed"].as_u64().unwrap() > 0, "{found}");
    assert_eq!(found["points"][1]["series"], "last");
    assert!(scratch.read("a/parameters.csv").contains("flow.pressure_gradient"));
    // A bound before that is a minimum.
    let found = calibrate(&scratch, 0, case, "--to fast.csv --fit pressure_gradient=50:110 --out b");
    assert_eq!((&found["facts"]["parameters"][0]["held_by"], number(&found, 0, "value")), (&"upper".into(), 110.0));
    let found = calibrate(&scratch, 3, case, "--to fast.csv --fit fluid.viscosity --fit grains.diameter --out c");
    assert_eq!(found["error"]["code"], "no-influence", "{found}");
    // A start that fails is what it would be alone.
    let found =
        calibrate(&scratch, 3, case, "--to fast.csv --fit fluid.viscosity --set flow.pressure_gradient=900 --out d");
    assert_eq!(found["error"]["code"], "no-static-bed");
}

#[test]
fn wrong_input_is_refused_and_nothing_is_written() {
    let scratch = Scratch::new();
    let twin = "z_m,u_fluid_m_s,phi\n0.06,0.2,0.4\n0.08,0.7,0.3\n0.1,1,0\n";
    scratch.write("twin.csv", twin);
    scratch.write("half.csv", "z_m,u_fluid_m_s,u_fluid_m_s_err\n0.06,0.2,0.1\n0.08,0.7,\n");
    scratch.write("other.csv", "z_m,granular_temperature_m2_s2\n0.06,0.2\n");
    scratch.write("high.csv", "z_m,u_fluid_m_s\n0.6,0.2\n0.7,0.2\n");
    scratch.write("text.csv", "z_m,u_fluid_m_s\n0.06,fast\n");
    for (arguments, code, says) in [
        ("--to twin.csv --fit mu_22", "bad-fit", "did you mean mu_2?"),
        ("--to twin.csv --fit grid.cells", "bad-fit", "closures.friction.mu_2"),
        ("--to twin.csv --fit closures.friction.law", "bad-fit", "not a number"),
        ("--to twin.csv --fit phi_max", "bad-fit", "one of closures.dilatancy.phi_max, closures.mi"),
        ("--to twin.csv --fit mu_2 --fit friction.mu_2", "bad-fit", "twice"),
        ("--to twin.csv --fit mu_2=0.9:0.6", "bad-fit", "not below"),
        ("--to twin.csv --fit mu_2=0.6", "bad-fit", "lower:upper"),
        ("--to twin.csv --fit mu_2=low:high", "bad-fit", "the lower bound low"),
        ("--to twin.csv --fit i_0=0:1", "bad-fit", "lower bound"),
        ("--to twin.csv --fit mu_2=0.6:0.65", "bad-fit", "not between"),
        ("--to twin.csv --fit mu_2=0.4:0.9", "bad-fit", "the case refuses the lower bound 0.4"),
        ("--to twin.csv --fit kappa=0.1:20", "bad-fit", "allowed: "),
        ("--to half.csv --fit mu_2", "bad-data", "have none"),
        ("--to other.csv --fit mu_2", "bad-data", "shares no column"),
        ("--to high.csv --fit mu_2", "bad-data", "shares no column"),
        ("--to twin.csv --fit mu_2 --column u_fluid_ms", "bad-data", "no column u_fluid_ms"),
        (
            "--to twin.csv --fit mu_2 --fit i_0 --fit kappa --column u_fluid_m_s",
            "bad-data",
            "3 values for 3 parameters",
        ),
        ("--to twin.csv --fit mu_2 --sigma phi=-1", "bad-sigma", "not a positive number"),
        ("--to twin.csv --fit mu_2 --sigma u=1", "bad-sigma", "no such column"),
        ("--to text.csv --fit mu_2", "data-malformed", ""),
        ("--to none.csv --fit mu_2", "data-unreadable", ""),
    ] {
        let error = &calibrate(&scratch, 2, RUN, arguments)["error"];
        let text = format!("{} {}", error["message"], error["hint"]);
        assert!(error["code"] == code && text.contains(says), "{arguments}: {error}");
    }
    let noisy = calibrate(&scratch, 2, "flume_exp20_quick", "--to twin.csv --fit mu");
    assert!(noisy["error"]["message"].as_str().unwrap().contains("noise"), "{noisy}");
    scratch.bedload(["calibrate", RUN, "--to", "twin.csv"]).exits(2);
    assert!(!scratch.path("runs").exists());
}
