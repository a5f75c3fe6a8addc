//! Grains in a fluid as a person runs them: what a flume reports, that its numbers belong together, that it can be
//! interrupted, and that it stops when enough is known.
#![cfg(unix)]

use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

use bedload::result::Profile;
use bedload::result::quantity as q;
use serde_json::Value;

use crate::grains::written;
use crate::support::Scratch;

/// A short piece of the narrow flume.
const CASE: &[&str] =
    &["run", "flume_exp20_quick", "--set", "cell.length=150 mm", "--set", "discrete.duration=4 s", "--quiet"];

fn case(more: &[&str]) -> Vec<String> {
    CASE.iter().chain(more).map(|&word| word.to_owned()).collect()
}

fn number(summary: &Value, name: &str) -> f64 {
    summary["results"][name]["value"].as_f64().unwrap_or_else(|| panic!("{name} in {summary:#}"))
}

#[test]
fn the_numbers_of_a_flume_belong_together() {
    let scratch = Scratch::new();
    scratch.bedload(case(&["--out", "out"])).exits(0);
    let summary = scratch.summary("out");
    for name in ["transport_rate_beads_1_s", "transport_rate_m2_s", "shields_bed", "bed_level_m"] {
        let error = summary["results"][name]["stderr"].as_f64().unwrap();
        assert!(error > 0.0 && error < number(&summary, name), "{name} ± {error}");
    }
    let (d, width, pi): (f64, f64, f64) = (6e-3, 6.5e-3, std::f64::consts::PI);
    let rate = number(&summary, "transport_rate_m2_s");
    let beads = rate * width / (pi / 6.0 * d.powi(3));
    assert!((number(&summary, "transport_rate_beads_1_s") / beads - 1.0).abs() < 1e-12);
    let scale = d * (1.5 * 9.81 * d).sqrt();
    assert!((number(&summary, "transport_rate_dimensionless") * scale / rate - 1.0).abs() < 1e-6);
    for balance in summary["balances"].as_array().unwrap() {
        let relative = balance["relative"].as_f64().unwrap();
        assert!(relative.abs() < 1e-9, "{balance}");
    }
    let text = fs::read(scratch.path("out/profile.csv")).unwrap();
    let profile = Profile::read_csv(&text[..]).unwrap();
    let sum = |column: &[Option<f64>]| column.iter().flatten().sum::<f64>();
    let thickness = profile.axis()[1] - profile.axis()[0];
    // Sampled every 0.1 s here, in every period there.
    let flux = thickness * sum(profile.get(&q::FLUX).unwrap());
    assert!((flux / rate - 1.0).abs() < 0.25, "{flux} {rate}");
    let largest = profile.range(&q::TAU_REYNOLDS).unwrap().1;
    let stress = 1500.0 * 9.81 * d;
    assert!((number(&summary, "shields_bed") * stress / largest - 1.0).abs() < 1e-6);
    // All grains are in the profile.
    let volume = thickness * 0.15 * width * sum(profile.get(&q::PHI).unwrap());
    let mobile = number(&summary, "grains") * pi / 6.0 * d.powi(3);
    assert!(volume > mobile && volume < 1.15 * mobile, "{volume} {mobile}: half of the fixed grains lie above z = 0");
    let errors = profile.standard_errors().unwrap();
    let known = |column: &[Option<f64>]| column.iter().flatten().count();
    for quantity in [&q::PHI, &q::U_PARTICLE, &q::U_FLUID, &q::TAU_REYNOLDS, &q::GRANULAR_TEMPERATURE] {
        assert!(known(errors.get(quantity).unwrap()) > 100, "{}", quantity.name);
    }
}

#[test]
fn a_flume_that_is_killed_goes_on_to_the_same_bits() {
    let scratch = Scratch::new();
    let short = ["--set", "discrete.duration=1 s"];
    scratch.bedload(case(&[&short[..], &["--out", "whole", "--checkpoint", "0"]].concat())).exits(0);
    let resumed = [&short[..], &["--out", "out", "--resume", "--checkpoint", "0.02"]].concat();
    let mut kills = 0;
    for _ in 0..4 {
        let path = scratch.path("out/checkpoint.bin");
        let before = fs::read(&path).ok();
        let mut child = scratch.command().args(case(&resumed)).stdout(Stdio::null()).spawn().unwrap();
        let begun = Instant::now();
        // A moment after the next checkpoint, or the end.
        while fs::read(&path).ok() == before && child.try_wait().unwrap().is_none() {
            assert!(begun.elapsed() < Duration::from_secs(120), "no checkpoint");
            sleep(Duration::from_millis(1));
        }
        sleep(Duration::from_millis(30));
        kills += usize::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(kills > 0, "no run was killed");
    scratch.bedload(case(&[&resumed[..], &["--threads", "2"]].concat())).exits(0);
    let (mut found, mut expected) = (written(&scratch, "out"), written(&scratch, "whole"));
    for files in [&mut found, &mut expected] {
        files.retain(|name, _| name.extension().is_some_and(|e| e == "csv") || name.ends_with("motion.json"));
    }
    assert!(expected.len() >= 4, "{:?}", expected.keys());
    assert!(found == expected, "tables differ");
}

#[test]
fn a_flume_ends_when_its_rate_is_known_well_enough() {
    let scratch = Scratch::new();
    let wanted = 0.4;
    let more = ["--set", "discrete.duration=60 s", "--set", "discrete.known_to=0.4", "--out", "out"];
    scratch.bedload(case(&more)).exits(0);
    let summary = scratch.summary("out");
    assert_eq!(summary["status"], "done");
    let made = number(&summary, "transient_s") + number(&summary, "averaged_time_s");
    assert!(made < 59.0, "{made} s");
    let rate = &summary["results"]["transport_rate_m2_s"];
    let precision = rate["stderr"].as_f64().unwrap() / rate["value"].as_f64().unwrap();
    assert!(precision <= wanted, "{precision}");
}

#[test]
fn what_few_samples_tell_has_no_error_and_ends_no_run() {
    let scratch = Scratch::new();
    let run = |more: &[&str], out: &str| {
        let words = ["run", "flume_exp14_quick", "--set", "cell.length=150 mm", "--out", out];
        scratch.bedload(words.into_iter().chain(more.iter().flat_map(|set| ["--set", *set]))).exits(0).out
    };
    for (out, duration) in [("one", "discrete.duration=0.1 s"), ("few", "discrete.duration=1 s")] {
        let reported = run(&[duration, "discrete.known_to=1"], out);
        assert!(reported.contains("error unknown: too few samples") && !reported.contains('±'), "{reported}");
        let summary = scratch.summary(out);
        for name in ["transport_rate_m2_s", "bed_level_m", "shields_bed", "shields", "u_star_m_s"] {
            let reported = &summary["results"][name];
            assert!(reported["value"].is_f64() && reported["stderr"].is_null(), "{name}: {reported}");
            assert_eq!(reported["reason"], "too few samples", "{name}: {reported}");
        }
        let page = scratch.read(&format!("{out}/report.html"));
        assert!(page.contains("error unknown: too few samples") && !page.contains('±'));
        let profile = Profile::read_csv(scratch.read(&format!("{out}/profile.csv")).as_bytes()).unwrap();
        for quantity in [&q::PHI, &q::U_PARTICLE, &q::U_FLUID, &q::TAU_REYNOLDS] {
            assert!(
                profile.errors(quantity).is_none_or(|errors| errors.iter().all(Option::is_none)),
                "{}",
                quantity.name
            );
        }
        // Even a rate that need be known to 100 % is not known.
        let made = number(&summary, "transient_s") + number(&summary, "averaged_time_s");
        let wanted = if out == "one" { 0.1 } else { 1.0 };
        assert!((made / wanted - 1.0).abs() < 0.05, "{made} s");
    }
}

#[test]
fn grains_that_give_nothing_back_fall_and_flow() {
    let scratch = Scratch::new();
    let more = ["--set", "grains.restitution=0.01", "--set", "discrete.duration=0.4 s", "--out", "out"];
    let period = ["--set", "discrete.sample_period=0.02 s"];
    scratch.bedload(case(&[&more[..], &period].concat())).exits(0);
    let step = number(&scratch.summary("out"), "time_step_s");
    // What takes ten times the step to be stable is not run at the step of lively grains.
    assert!(step < 5e-5, "{step}");
}

#[test]
fn a_deep_bed_at_rest_is_frozen_and_the_balances_close() {
    let scratch = Scratch::new();
    let run = |more: &[&str]| {
        let sets = [
            "discrete.fluid_scheme=implicit",
            "discrete.coupling_period=10 ms",
            "discrete.freeze_period=0.1 s",
            "discrete.slice=0.0333",
        ];
        let words = ["run", "coupled_3d_limit_sink", "--json", "--out", "o", "--force"];
        let sets = sets.iter().chain(more).flat_map(|set| ["--set", *set]);
        scratch.bedload(words.into_iter().chain(sets)).exits(0).json()
    };
    let number = |found: &serde_json::Value, name: &str| found["results"][name]["value"].as_f64();
    let (free, never) = (run(&[]), run(&["discrete.freeze_below=1e-12"]));
    assert_eq!(number(&free, "frozen_below_m"), None);
    assert_eq!(number(&never, "frozen_below_m"), Some(0.0));
    // To look at the layers changes nothing.
    assert_eq!(number(&free, "transport_rate_m2_s"), number(&never, "transport_rate_m2_s"));
    let frozen = run(&["discrete.freeze_below=0.5"]);
    assert!(number(&frozen, "frozen_below_m").unwrap() >= 6e-3, "{frozen}");
    assert!(number(&frozen, "transport_rate_m2_s").unwrap() > 0.0);
    for balance in frozen["balances"].as_array().unwrap() {
        assert!(balance["relative"].as_f64().unwrap().abs() < 1e-12, "{balance}");
    }
}
