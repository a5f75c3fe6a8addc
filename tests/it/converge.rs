//! `bedload converge`: errors fall as theory says, and the rows say so.

use serde_json::Value;

use crate::support::Scratch;

const BED: &str = "bed_ouriemi-laminar";
const MIXED: [&str; 6] = ["--set", "form=mixed", "--set", "closures.drag.law=none", "--set", "closures.drag.k_ck="];
const LAWS: [&str; 3] = ["simple", "bercovier-engelman", "papanastasiou"];

#[track_caller]
fn study(scratch: &Scratch, arguments: &[&str]) -> Value {
    scratch.bedload([&["converge"], arguments, &["--json"]].concat()).exits(0).json()
}

/// The varied value and a measure of each point of a series.
fn measured(study: &Value, series: &str, key: &str, measure: &str) -> Vec<(f64, f64)> {
    let points = study["points"].as_array().unwrap().iter().filter(|p| p["series"] == series);
    let value = |p: &Value| p["values"][key].as_str().unwrap().parse::<f64>().unwrap();
    points.filter_map(|p| Some((value(p), p["measures"][measure].as_f64()?))).collect()
}

fn over_lambda(study: &Value, law: &str, measure: &str) -> Vec<(f64, f64)> {
    measured(study, law, "regularisation.lambda_scaled", measure)
}

#[test]
fn the_regularisation_error_falls_like_its_law_in_both_forms() {
    let scratch = Scratch::new();
    for form in [&[][..], &MIXED] {
        let found = study(&scratch, &[&[BED, "--over", "regularisation", "--force"], form].concat());
        assert_eq!((&found["status"], found["points"].as_array().unwrap().len()), (&"done".into(), 37));
        for law in LAWS {
            for measure in
                ["error_velocity_l2", "error_velocity_largest", "error_transport_rate", "error_velocity_at_bed"]
            {
                let errors = over_lambda(&found, law, measure);
                assert_eq!(errors.len(), 12, "{law} {measure}");
                let falling = errors.windows(2).filter(|p| p[0].0 < 2e-2 && p[0].0 > 1e-10);
                assert!(falling.clone().count() >= 8 && falling.clone().all(|p| p[1].1 < p[0].1), "{law} {measure}");
            }
            let slopes = over_lambda(&found, law, "slope_velocity_l2");
            for (lambda, slope) in slopes.iter().filter(|(lambda, _)| *lambda < 0.9e-4 && *lambda > 0.9e-10) {
                assert!((0.85..1.015).contains(slope), "{law}: {slope} at {lambda}");
            }
            // The logarithm is that of the simple law alone.
            let first = slopes.iter().find(|(lambda, _)| *lambda < 2e-5).unwrap().1;
            assert_eq!(first < 0.9, law == "simple", "{law}: {first}");
        }
        let fit = &found["facts"]["laws"]["simple"]["fit"];
        assert!(fit["within_factor"].as_f64().unwrap() < 1.6 && fit["points"].as_u64() >= Some(8), "{fit}");
    }
}

#[test]
fn the_errors_are_those_that_the_runs_report_of_themselves() {
    let scratch = Scratch::new();
    let found = study(&scratch, &[BED, "--over", "regularisation"]);
    let mut compared = 0;
    for point in found["points"].as_array().unwrap().iter().filter(|p| p["series"] != "exact yield") {
        let own = point["results"]["regularisation_error_transport_rate"]["value"].as_f64().unwrap().abs();
        let here = point["measures"]["error_transport_rate"].as_f64().unwrap();
        assert!((here / own - 1.0).abs() < 1e-5, "{here} {own}");
        let measure = |name: &str| point["measures"][name].as_f64().unwrap();
        // N levels in the bed of 101 nodes: the RMS of the paper is smaller by the root of that
        let levels = (measure("velocity_rms_scaled") / measure("velocity_rms_paper_scaled")).powi(2);
        assert!((levels - levels.round()).abs() < 1e-6 && (90.0..110.0).contains(&levels), "{levels}");
        compared += 1;
    }
    assert_eq!(compared, 36);
    // The rule: Bn on the first layer of grains and the mean velocity, and the errors between those of its neighbours.
    let rule = &found["facts"]["rule"];
    let exact = &found["points"][0]["results"];
    let bn = 0.43 * 1500.0 * 9.81 * 1e-3 * 30e-3 / exact["mean_velocity_m_s"]["value"].as_f64().unwrap();
    assert!((rule["bingham_number"].as_f64().unwrap() / bn - 1.0).abs() < 1e-12, "{rule}");
    let lambda = rule["lambda_scaled"].as_f64().unwrap();
    assert!((lambda * bn / 1e-4 - 1.0).abs() < 1e-12);
    let errors = over_lambda(&found, "simple", "error_transport_rate");
    let (above, below) =
        (errors.iter().rfind(|e| e.0 >= lambda).unwrap().1, errors.iter().find(|e| e.0 < lambda).unwrap().1);
    let bought = rule["errors"]["error_transport_rate"].as_f64().unwrap();
    assert!(below < bought && bought < above && bought > 0.05, "{below} {bought} {above}");
}

#[test]
fn a_node_on_the_yield_level_leaves_round_off_and_without_it_the_distance_decides() {
    let scratch = Scratch::new();
    for form in [&[][..], &MIXED] {
        let found = study(&scratch, &[&[BED, "--over", "mesh", "--force"], form].concat());
        for measure in ["error_velocity_l2", "error_transport_rate"] {
            let exact = measured(&found, "node on the yield level", "grid.cells", measure);
            assert!(exact.len() == 7 && exact.iter().all(|(_, e)| *e < 1e-10), "{exact:?}");
            let off = measured(&found, "no node there", "grid.cells", measure);
            assert!(off[0].1 > 1e-4 && off[6].1 < 1e-5, "{off:?}");
        }
        let order =
            found["facts"]["orders_from_coarsest_to_finest"]["no node there"]["order_velocity"].as_f64().unwrap();
        assert!((1.2..2.5).contains(&order), "{order}");
        if form.is_empty() {
            continue;
        }
        // The mixed form: the velocity is off by B delta^2/2, delta the distance to the nearest node, as far as the level stays.
        let level = found["points"][0]["results"]["yield_level_m"]["value"].as_f64().unwrap();
        let distance = |cells: f64| {
            let place = level / 0.015 * cells / 2.0;
            (place - place.round()).abs() / cells
        };
        let off = measured(&found, "no node there", "grid.cells", "error_velocity_at_bed");
        let constants: Vec<f64> = off.iter().map(|(cells, e)| e / distance(*cells).powi(2)).collect();
        let spread = constants.iter().map(|c| (c / constants[0] - 1.0).abs()).fold(0.0, f64::max);
        assert!(spread < 5e-3, "{constants:?}");
    }
}

#[test]
fn a_bingham_plane_converges_over_both() {
    let scratch = Scratch::new();
    let plane = "bingham_1d_plane";
    let found = study(&scratch, &[plane, "--over", "regularisation", "--set", "grid.cells=48"]);
    let errors = over_lambda(&found, "simple", "error_velocity_l2");
    assert!(errors.windows(2).all(|p| p[1].1 < p[0].1), "{errors:?}");
    assert!((found["facts"]["rule"]["bingham_number"].as_f64().unwrap() - 10.0).abs() < 1e-8);
    let found = study(&scratch, &[plane, "--over", "mesh", "--reference", "finest"]);
    assert_eq!(found["options"]["reference"], "finest");
    assert_eq!(found["points"][0]["series"], "reference");
    let exact = measured(&found, "node on the yield level", "grid.cells", "error_plug_velocity");
    assert!(exact.iter().all(|(_, e)| *e < 1e-10), "{exact:?}");
}

#[test]
fn a_model_without_closed_form_is_measured_against_its_finest_mesh() {
    let scratch = Scratch::new();
    let rising = ["--set", "closures.friction={ law = \"mu-iv\", mu_s = 0.43, mu_2 = 0.82, i_0 = 0.2 }"];
    let case = [&[BED, "--over", "mesh"], &MIXED[..], &rising].concat();
    let found = study(&scratch, &case);
    assert_eq!(found["options"]["reference"], "finest");
    let order = found["facts"]["orders_from_coarsest_to_finest"]["node on the yield level"]["order_number"].as_f64();
    assert!(order.unwrap() > 1.0, "{order:?}");
    let refused = scratch.bedload([&["converge"], case.as_slice(), &["--reference", "exact", "--json"]].concat());
    assert_eq!(refused.exits(2).json()["error"]["code"], "no-closed-form");
}

#[test]
fn it_ends_with_at_most_twelve_lines_and_a_model_without_the_setting_is_wrong_input() {
    let scratch = Scratch::new();
    let said = scratch.bedload(["converge", BED, "--over", "mesh", "--png"]).exits(0);
    assert!((6..=12).contains(&said.out.lines().count()) && said.err.is_empty(), "{}{}", said.out, said.err);
    let folder = "runs/converge-bed_ouriemi-laminar-mesh";
    assert!(said.out.contains(&format!("{folder}/report.html")), "{}", said.out);
    assert_eq!(scratch.names(folder), ["figures", "points", "points.csv", "report.html", "study.json"]);
    assert_eq!(scratch.names(&format!("{folder}/figures")), ["convergence.png"]);
    for case in ["exact_1d_bagnold", "grains_3d_bed", "flow_theta06-coupled", "impact_1d_headon"] {
        for over in ["regularisation", "mesh"] {
            let said = scratch.bedload(["converge", case, "--over", over, "--json"]).exits(2).json();
            assert_eq!(said["error"]["code"], "no-such-setting", "{said}");
            let message = said["error"]["message"].as_str().unwrap();
            for model in ["laminar", "bingham", "duct", "duct-bed", "cavity", "sheet-flow", "two-fluid"] {
                assert!(message.contains(model), "{message}");
            }
            assert_eq!(message.contains("shear-cell"), over == "mesh", "{message}");
        }
    }
    scratch.bedload(["converge", BED, "--over", "time"]).exits(2);
    scratch.bedload(["converge", BED, "--over", "mesh", "--half-decades"]).exits(2);
    scratch.bedload(["converge", BED, "--over", "mesh", "--set", "bed.phi=0.9"]).exits(2);
    assert_eq!(scratch.names("runs").len(), 1);
}

/// Observed orders, or slopes, of a measure from each point to the one before it.
fn orders(study: &Value, series: &str, key: &str, measure: &str) -> Vec<f64> {
    measured(study, series, key, measure).into_iter().map(|(_, order)| order).collect()
}

#[test]
fn a_sheet_flow_loses_its_creep_with_the_size_and_its_error_much_slower() {
    let scratch = Scratch::new();
    let key = "regularisation.lambda";
    for (case, at_1e_4) in [("sheet_1d_sumer91", 0.0192), ("sheet_1d_cowen", 0.0049)] {
        let found = study(&scratch, &[case, "--over", "regularisation"]);
        assert_eq!((&found["options"]["reference"], found["varied"][0].as_str()), (&"exact".into(), Some(key)));
        assert_eq!(found["points"][0]["series"], "exact yield");
        let of = |measure: &str| measured(&found, "simple", key, measure);
        let rates = of("error_transport_rate");
        assert_eq!(rates.len(), 10);
        assert!((rates[3].1 / at_1e_4 - 1.0).abs() < 0.02, "{rates:?}");
        // From 1e-2 1/s down the rate goes like a root and less, the creep like the size itself.
        for (lambda, slope) in of("slope_transport_rate").into_iter().filter(|(lambda, _)| *lambda < 2e-3) {
            assert!((0.25..0.5).contains(&slope), "{case}: {slope} at {lambda}");
        }
        for (lambda, slope) in of("slope_creep_velocity").into_iter().filter(|(lambda, _)| *lambda < 2e-2) {
            assert!((0.95..1.07).contains(&slope), "{case}: {slope} at {lambda}");
        }
        let velocity = of("error_velocity_l2");
        assert!(velocity.len() == 10 && velocity.windows(2).all(|p| p[1].1 < p[0].1), "{velocity:?}");
        // Where all of the bed creeps by more than 0.1 % there is no thickness.
        let thickness = of("error_sheet_thickness");
        assert!(thickness.len() >= 4 && thickness.iter().all(|(lambda, _)| *lambda < 2e-5), "{thickness:?}");
        // The rate is compared on one mesh: the error is the one that each run states.
        for point in found["points"].as_array().unwrap().iter().skip(1) {
            let stated = point["results"]["regularisation_error_transport_rate"]["value"].as_f64().unwrap();
            assert_eq!(point["measures"]["error_transport_rate"].as_f64().unwrap(), stated.abs());
        }
    }
    let half = study(&scratch, &["sheet_1d_sumer91", "--over", "regularisation", "--half-decades", "--force"]);
    assert_eq!(half["points"].as_array().unwrap().len(), 1 + 10 + 9);
    let finest = ["sheet_1d_sumer91", "--over", "regularisation", "--reference", "finest", "--force"];
    let errors = measured(&study(&scratch, &finest), "simple", key, "error_transport_rate");
    assert!(errors.len() == 9 && errors.windows(2).all(|p| p[1].1 < p[0].1), "{errors:?}");
}

#[test]
fn a_sheet_flow_converges_with_its_mesh_at_the_exact_yield_whatever_the_case_says() {
    let scratch = Scratch::new();
    let iterated = ["method=iteration", "regularisation.law=simple", "regularisation.lambda=1e-3"];
    let iterated: Vec<&str> = iterated.iter().flat_map(|set| ["--set", set]).collect();
    let mut first = None;
    for settings in [&[][..], &iterated] {
        let found = study(&scratch, &[&["sheet_1d_sumer91", "--over", "mesh", "--force"], settings].concat());
        assert_eq!(found["options"]["reference"], "finest");
        let of = |measure: &str| measured(&found, "mesh", "grid.cells", measure);
        // The velocity falls with order 2; the rate follows the interface, with a zero of its error near 300 cells.
        let (velocity, rate) = (of("error_velocity_l2"), of("error_transport_rate"));
        assert_eq!((velocity.len(), velocity[0].0, velocity[5].0), (6, 40.0, 1280.0));
        assert!(orders(&found, "mesh", "grid.cells", "order_velocity_l2").iter().all(|o| *o > 1.9), "{velocity:?}");
        assert!(velocity[5].1 < 3e-6 && rate[2].1 < 7e-4 && rate[3..].iter().all(|(_, e)| *e < 3e-5), "{rate:?}");
        let all = &found["facts"]["orders_from_coarsest_to_finest"]["mesh"];
        for (name, least) in
            [("order_transport_rate", 2.0), ("order_sheet_thickness", 1.7), ("order_phi_interface", 1.7)]
        {
            assert!(all[name].as_f64().unwrap() > least, "{all}");
        }
        let same = first.get_or_insert_with(|| rate.clone());
        assert_eq!(*same, rate);
    }
}

#[test]
fn two_fluids_and_a_shear_cell_converge_with_order_two() {
    let scratch = Scratch::new();
    let found = study(&scratch, &["flow_theta06-two-fluid", "--over", "mesh"]);
    for kind in ["cells as in the case", "cells of equal height"] {
        let orders = orders(&found, kind, "grid.cells", "order_velocity_l2");
        assert!(orders.len() == 3 && orders.iter().all(|o| (1.8..2.5).contains(o)), "{kind}: {orders:?}");
        let whole = &found["facts"]["orders_from_coarsest_to_finest"][kind]["order_transport_rate"];
        assert!(whole.as_f64().unwrap() > 1.8, "{kind}: {whole}");
    }
    // Cells that are fine where the grains move are worth twice as many.
    let error = |kind: &str| measured(&found, kind, "grid.cells", "error_velocity_l2");
    let (graded, equal) = (error("cells as in the case"), error("cells of equal height"));
    assert!(graded.iter().zip(&equal).all(|(a, b)| a.1 < 0.5 * b.1), "{graded:?} {equal:?}");
    let found = study(&scratch, &["kinetic_1d_shear", "--over", "mesh"]);
    for measure in ["velocity_l2", "wall_pressure", "wall_shear", "wall_heat"] {
        let orders = orders(&found, "mesh", "grid.cells", &format!("order_{measure}"));
        // Against a mesh of twice the finest the last order is log2(5) for a method of order 2.
        assert!(orders.len() == 4 && orders[..3].iter().all(|o| (1.95..2.1).contains(o)), "{measure}: {orders:?}");
        assert!((orders[3] - 5.0_f64.log2()).abs() < 0.02, "{measure}: {orders:?}");
    }
}

#[test]
fn the_creep_of_contacts_of_two_fluids_costs_what_its_size_says() {
    let scratch = Scratch::new();
    let case = ["flow_theta06-two-fluid", "--over", "regularisation", "--set", "grid.cells=60"];
    let found = study(&scratch, &case);
    assert_eq!(found["options"]["reference"], "finest");
    let key = "regularisation.shear_rate";
    for measure in ["velocity_l2", "transport_rate"] {
        let slopes = measured(&found, "bercovier-engelman", key, &format!("slope_{measure}"));
        let inside: Vec<_> = slopes.iter().filter(|(size, _)| *size < 2e-2 && *size > 5e-8).collect();
        assert!(inside.len() >= 5 && inside.iter().all(|(_, s)| (0.95..1.05).contains(s)), "{measure}: {slopes:?}");
    }
    let refused = scratch.bedload([&["converge"], &case[..], &["--reference", "exact", "--json"]].concat());
    assert_eq!(refused.exits(2).json()["error"]["code"], "no-closed-form");
}

#[test]
fn a_cavity_converges_with_its_cells() {
    let scratch = Scratch::new();
    let found = study(&scratch, &["section_2d_cavity_bn0", "--over", "mesh"]);
    let orders = &found["facts"]["orders_from_coarsest_to_finest"]["mesh"];
    for name in ["order_velocity", "order_stream_function"] {
        assert!(orders[name].as_f64().unwrap() > 1.9, "{orders}");
    }
}
