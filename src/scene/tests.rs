use approx::assert_relative_eq;
use serde_json::json;

use super::*;
use crate::case::tables::{Fluid, SlopeDefinition};

/// Glass beads of 6 mm in water, 12 d deep on a slope of 0.05: a Shields number of 0.4 by hand.
fn beads() -> BedScene {
    BedScene {
        fluid: Fluid { density: 1000.0, viscosity: 1e-3 },
        grains: Grains::new(6e-3, 2500.0),
        bed: Bed { thickness: Some(75e-3), phi: Some(0.6) },
        flow: BedFlow {
            depth: Some(72e-3),
            slope: Some(0.05),
            slope_definition: Some(SlopeDefinition::Sine),
            ..BedFlow::new(Top::FreeSurface, 9.81)
        },
    }
}

fn number(scene: &Scene, name: &str) -> Option<f64> {
    scene.numbers().into_iter().find(|number| number.name == name).map(|number| number.value)
}

#[test]
fn numbers_of_a_flow_over_beads_are_those_by_hand() {
    let scene = Scene::Bed(beads());
    let of = |name| number(&scene, name).unwrap();
    assert_relative_eq!(of("shields_drive"), 0.4, max_relative = 1e-14);
    assert_relative_eq!(of("submergence"), 12.0, max_relative = 1e-14);
    assert_relative_eq!(of("density_ratio"), 2.5);
    assert_relative_eq!(of("u_star_drive_m_s"), (9.81_f64 * 0.072 * 0.05).sqrt(), max_relative = 1e-14);
    assert_relative_eq!(of("reynolds_grain"), 1127.56, max_relative = 1e-5);
    assert_relative_eq!(of("galileo"), 1782.81, max_relative = 1e-5);
    assert_relative_eq!(of("bagnold"), 9.0 * of("stokes"), max_relative = 1e-14);
    assert_relative_eq!(of("rouse"), of("suspension") / 0.41, max_relative = 1e-14);
    assert_relative_eq!(scene.solid_volume().unwrap(), 0.045, max_relative = 1e-14);
}

#[test]
fn a_settling_velocity_is_derived_unless_it_is_given() {
    let Given::Derived(w) = beads().settling_velocity() else { panic!("nothing was given") };
    assert_relative_eq!(w, 0.537, max_relative = 1e-3);
    let mut cylinders = beads();
    cylinders.grains.settling_velocity = Some(0.072);
    assert_eq!(cylinders.settling_velocity(), Given::Given(0.072));
}

#[test]
fn a_drive_whose_stress_is_an_outcome_has_no_shields_number() {
    let mut scene = beads();
    scene.flow.top = Top::Plane;
    assert_eq!((scene.shields_drive(), scene.u_star_drive()), (None, None));
    scene.flow.shields = Some(0.3);
    assert_eq!(scene.shields_drive(), Some(0.3));
    scene.flow.shields = None;
    scene.flow.u_star = Some(0.1);
    assert_relative_eq!(scene.shields_drive().unwrap(), 1000.0 * 0.01 / (1500.0 * 9.81 * 6e-3), max_relative = 1e-14);
    // A slope beyond the vertical has no sine.
    let mut steep = beads();
    steep.flow.slope = Some(1.5);
    assert_eq!(steep.shields_drive(), None);
    assert!(steep.flow.sine().is_err());
}

#[test]
fn scenes_differ_in_the_inputs_that_differ() {
    let (first, mut second) = (beads(), beads());
    second.flow.depth = Some(72e-3 * (1.0 + 1e-15));
    let record = |scene: &BedScene| Scene::Bed(scene.clone()).record();
    assert_eq!(record(&first).differences(&record(&second)), []);
    second.bed.thickness = Some(87.6e-3);
    second.grains.friction = Some(0.4);
    let found = record(&first).differences(&record(&second));
    let expected = [("bed.thickness", json!(75e-3), json!(87.6e-3)), ("grains.friction", json!(null), json!(0.4))];
    assert_eq!(found.len(), expected.len());
    for (difference, (path, first, second)) in found.iter().zip(expected) {
        assert_eq!(difference.path, path);
        assert_eq!(difference.first.clone().unwrap_or_default(), first);
        assert_eq!(difference.second.clone().unwrap_or_default(), second);
    }
    assert_eq!(record(&first).solid_volume_m, Some(0.6 * 75e-3));
    assert_eq!(record(&first).kind, "bed");
}

#[test]
fn what_is_no_number_is_not_reported() {
    let mut still = beads();
    still.flow.slope = Some(0.0);
    let scene = Scene::Bed(still);
    assert_eq!(number(&scene, "shields_drive"), Some(0.0));
    assert_eq!(number(&scene, "rouse"), None);
}
