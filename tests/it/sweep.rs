//! `bedload sweep`: every point is a run, a failing one is a row.

use serde_json::Value;

use crate::support::{Scratch, comparable};

const BED: &str = "laminar_1d_aussillous";
const DRIVE: &str = "flow.pressure_gradient";

#[track_caller]
fn sweep(scratch: &Scratch, code: i32, over: &[&str], more: &[&str]) -> Value {
    let over = over.iter().flat_map(|over| ["--over", over]);
    let arguments: Vec<&str> = ["sweep", BED].into_iter().chain(over).chain(["--json"]).collect();
    scratch.bedload(arguments.iter().chain(more)).exits(code).json()
}

fn rate(point: &Value) -> Option<f64> {
    point["results"]["transport_rate_m2_s"]["value"].as_f64()
}

fn points(study: &Value) -> &[Value] {
    study["points"].as_array().unwrap()
}

#[test]
fn a_sweep_across_the_limit_of_a_static_bed_has_rows_that_say_so() {
    let scratch = Scratch::new();
    // the whole bed moves from 158.66 Pa/m on
    let found = sweep(&scratch, 0, &["flow.pressure_gradient=100:200:6 Pa/m"], &["--out", "s", "--png"]);
    let status: Vec<&str> = points(&found).iter().map(|p| p["status"].as_str().unwrap()).collect();
    assert_eq!(status, ["done", "done", "done", "failed", "failed", "failed"]);
    assert_eq!(found["status"], "done");
    let rates: Vec<f64> = points(&found).iter().filter_map(rate).collect();
    assert!(rates.len() == 3 && rates.is_sorted(), "{rates:?}");
    assert_eq!(points(&found)[3]["values"][DRIVE], "160 Pa/m");
    assert_eq!(points(&found)[3]["error"]["code"], "whole-bed-moves");
    let table = scratch.read("s/points.csv");
    let rows: Vec<&str> = table.lines().filter(|l| !l.starts_with('#')).collect();
    assert!(rows.len() == 7 && rows[0].starts_with("series,flow.pressure_gradient,status,"), "{table}");
    assert!(rows[4].contains(",failed,") && rows[4].contains("the whole bed moves"), "{}", rows[4]);
    assert!(!table.contains("NaN") && !table.contains("inf,"), "{table}");
    let page = scratch.read("s/report.html");
    assert!(page.contains("To bear in mind") && page.contains("the whole bed moves") && page.contains("<svg"));
    assert_eq!(scratch.names("s/figures"), ["sweep.png"]);
    let said =
        scratch.bedload(["sweep", BED, "--over", "flow.pressure_gradient=100:200:6 Pa/m", "--out", "s"]).exits(0);
    assert!(said.out.lines().count() <= 12 && said.out.contains("3 of 6"), "{}", said.out);
}

#[test]
fn a_point_is_what_a_run_of_it_is() {
    let scratch = Scratch::new();
    let found = sweep(&scratch, 0, &["flow.pressure_gradient=80,1.2e2 Pa/m"], &["--out", "s"]);
    for (point, value) in points(&found).iter().zip(["80 Pa/m", "1.2e2 Pa/m"]) {
        let set = format!("{DRIVE}={value}");
        scratch.bedload(["run", BED, "--set", &set, "--out", "r", "--force"]).exits(0);
        let folder = format!("s/{}", point["folder"].as_str().unwrap());
        assert_eq!(comparable(scratch.summary(&folder)), comparable(scratch.summary("r")));
        assert_eq!(scratch.read(&format!("{folder}/case.toml")), scratch.read("r/case.toml"));
        assert_eq!(point["case_sha256"], scratch.summary("r")["provenance"]["case_sha256"]);
        assert_eq!(point["results"], scratch.summary("r")["results"]);
        assert_eq!(scratch.names(&folder), scratch.names("r"));
    }
}

#[test]
fn several_keys_make_a_grid_whose_words_are_series() {
    let scratch = Scratch::new();
    let over = [
        "closures.mixture_viscosity.law=einstein,clear",
        "flow.pressure_gradient=50:100:3:log Pa/m",
        "grid.cells=50,50",
    ];
    let found = sweep(&scratch, 0, &over, &["--out", "s"]);
    assert_eq!(points(&found).len(), 12);
    assert_eq!(scratch.names("s/points").len(), 6, "equal cases are run once");
    let middle = &points(&found)[2];
    assert_eq!(middle["values"][DRIVE], "70.7106781187 Pa/m");
    assert_eq!(middle["series"], "law = einstein, cells = 50");
    assert!(rate(&points(&found)[6]) > rate(&points(&found)[0]), "a clear fluid resists less");
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let scratch = Scratch::new();
    let of = |threads: &str, out: &str| {
        let mut found =
            sweep(&scratch, 0, &["flow.pressure_gradient=60:170:9 Pa/m"], &["--threads", threads, "--out", out]);
        found.as_object_mut().unwrap().remove("out");
        for point in found["points"].as_array_mut().unwrap() {
            point.as_object_mut().unwrap().remove("cost").unwrap();
        }
        comparable(found)
    };
    assert_eq!(of("1", "a"), of("3", "b"));
}

#[test]
fn only_where_nothing_is_left_is_it_an_error() {
    let scratch = Scratch::new();
    // refused by the schema: a row like any other
    let found = sweep(&scratch, 0, &["bed.phi=0.6,0.9"], &["--out", "a"]);
    assert_eq!(points(&found)[1]["error"]["code"], "out-of-range");
    assert_eq!((&points(&found)[1]["folder"], scratch.names("a/points").len()), (&Value::Null, 1));
    let failed = sweep(&scratch, 3, &["flow.pressure_gradient=200,300 Pa/m"], &["--out", "b"]);
    assert_eq!((&failed["status"], &failed["error"]["code"]), (&"failed".into(), &"whole-bed-moves".into()));
    assert_eq!(points(&failed).len(), 2);
    let wrong = sweep(&scratch, 2, &["bed.phi=0.9,0.95"], &["--out", "c"]);
    assert_eq!(wrong["error"]["path"], "bed.phi");
    for over in ["bed.phi", "=1,2", "bed.phi=1:2", "bed.phi=1:2:3:4:5", "bed.phi=0.1:0.2:1e9"] {
        assert_eq!(sweep(&scratch, 2, &[over], &["--out", "c"])["error"]["code"], "bad-over", "{over}");
    }
    assert_eq!(sweep(&scratch, 2, &["bed.phi=0.5,0.6", "bed.phi=0.4"], &[])["error"]["code"], "bad-over");
    assert!(!scratch.path("c").exists() && !scratch.path("runs").exists());
}
