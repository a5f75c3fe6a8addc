//! Details of the law, the list and the averages that no verification case would notice.

use super::{Domain, G, R, RHO, engine, floor, gas, go, grain, law};
use crate::closures::contact::Tension;
use crate::dem::GrainBed;
use crate::dem::average::Averages;
use crate::dem::body::Nothing;
use crate::dem::law::{Contact, ContactLaw};
use crate::dem::simd::scalar::One;
use crate::dem::{Engine, Grain, Settings};
use crate::model::read;

fn contact(parting: f64, spring: [f64; 3]) -> Contact<One> {
    Contact {
        overlap: One(1e-5),
        normal: [One(0.6), One(0.0), One(0.8)],
        parting: One(parting),
        sliding: [One(0.0); 3],
        spring: spring.map(One),
        inverse_mass: One(1.0 / 2.8e-4),
    }
}

#[test]
fn the_tangential_force_stays_in_the_plane_of_contact() {
    // A spring that pointed along the normal before the contact turned.
    let response = law(1.0, Tension::Cut).respond((), contact(0.0, [1e-6, 2e-6, 3e-6]), 0.0);
    let [x, y, z] = response.tangential.map(|force| force.0);
    assert!((0.6 * x + 0.8 * z).abs() < 1e-15 && y != 0.0, "{x} {y} {z}");
}

#[test]
fn a_contact_that_pulls_has_no_friction() {
    let response = law(0.5, Tension::Kept).respond((), contact(1.0, [0.0, 1e-3, 0.0]), 1e-5);
    assert!(response.normal.0 < 0.0);
    assert!(response.tangential.iter().all(|force| force.0 == 0.0), "{:?}", response.tangential);
}

#[test]
fn a_list_made_often_follows_the_same_contacts_as_one_made_once() {
    let grains = gas(200, 0.05, 0.3);
    let run = |skin: f64| {
        let settings = Settings { skin, ..Settings::new(2e-5, [0.0; 3], 2.0 * R) };
        let mut engine = Engine::new(&grains, Domain::default(), law(0.5, Tension::Cut), settings, 1).unwrap();
        go(&mut engine, 800);
        (engine.rebuilds(), engine.grains().listed())
    };
    let ((often, a), (seldom, b)) = (run(2e-4), run(0.1));
    assert!(often > 20 && seldom == 1, "{often} {seldom}");
    // The order of sums differs, and each collision multiplies what comes of it.
    let off = a.iter().zip(&b).flat_map(|(a, b)| (0..3).map(|k| (a.position[k] - b.position[k]).abs()));
    let off = off.fold(0.0, f64::max);
    assert!(off < 1e-8 * R, "{off:e}");
}

#[test]
fn after_half_a_step_a_grain_falls_along_the_exact_parabola() {
    let mut one = engine(&[grain([0.0; 3], [0.0; 3])], Domain::default(), law(0.5, Tension::Cut), 1e-3, [0.0, 0.0, -G]);
    one.half_step(&Nothing).unwrap();
    go(&mut one, 99);
    approx::assert_relative_eq!(one.grains().position(0)[2], -0.5 * G * 0.1 * 0.1, max_relative = 1e-12);
}

#[test]
fn the_weight_leans_by_the_slope_and_keeps_its_length() {
    let bed = read::<GrainBed>("grains_3d_chute", &[]).unwrap();
    let [x, y, z] = bed.gravity();
    approx::assert_relative_eq!(x / -z, 24.0_f64.to_radians().tan(), max_relative = 1e-12);
    approx::assert_relative_eq!(x.hypot(z), 9.81, max_relative = 1e-12);
    assert_eq!(y, 0.0);
}

#[test]
fn means_of_a_slice_are_those_of_its_grains() {
    // Four grains that do not touch, in one slice of the whole height.
    let velocities = [[1.0, 0.0, 0.5], [3.0, 2.0, -0.5], [1.0, -2.0, 0.5], [3.0, 0.0, -0.5]];
    let grains: Vec<Grain> =
        (0..4_u8).map(|i| grain([0.02 * f64::from(i), 0.0, 0.01], velocities[usize::from(i)])).collect();
    let engine = engine(&grains, Domain::default(), law(0.5, Tension::Cut), 1e-5, [0.0; 3]);
    let mut averages = Averages::new(0.0, 0.02, 0.02, 0.01, RHO, 1);
    averages.sample(&engine, 0, |_| [0.0; 3]);
    let profile = averages.profile();
    let phi = 4.0 * grains[0].mass() / RHO / (0.02 * 0.01);
    let value = |mean: &[Option<crate::result::Estimate>]| mean[0].unwrap().mean;
    approx::assert_relative_eq!(value(&profile.phi), phi, max_relative = 1e-12);
    approx::assert_relative_eq!(value(&profile.velocity), 2.0, max_relative = 1e-12);
    // <u'u'> = 1, <v'v'> = 2, <w'w'> = 1/4, <u'w'> = -1/2.
    approx::assert_relative_eq!(value(&profile.temperature), 3.25 / 3.0, max_relative = 1e-12);
    approx::assert_relative_eq!(value(&profile.shear), 0.5 * RHO * phi, max_relative = 1e-12);
    approx::assert_relative_eq!(value(&profile.pressure), 0.25 * RHO * phi, max_relative = 1e-12);
}

#[test]
fn the_stress_of_a_contact_is_its_force_along_its_branch() {
    // Two grains one on the other, pressed by 1e-5 m, within the height of the slice.
    let push = 5e3 * 1e-5;
    let branch = 2.0 * R - 1e-5;
    let pair = [grain([0.0, 0.0, 0.01], [0.0; 3]), grain([0.0, 0.0, 0.01 + branch], [0.0; 3])];
    let mut engine = engine(&pair, Domain::default(), law(1.0, Tension::Cut), 1e-5, [0.0; 3]);
    engine.forces(0.0);
    let mut averages = Averages::new(0.0, 0.04, 0.04, 0.01, RHO, 1);
    averages.sample(&engine, 0, |_| [0.0; 3]);
    let pressure = averages.profile().pressure[0].unwrap().mean;
    approx::assert_relative_eq!(pressure, push * branch / (0.04 * 0.01), max_relative = 1e-9);
}

#[test]
fn the_flux_of_fluctuation_energy_is_that_of_its_grains_and_moves_with_them() {
    // <w'v'^2>/2 by hand, and the same with a wind on top: the fluctuations do not depend on it.
    let velocities = [[1.0, 0.0, 0.5], [3.0, 2.0, -0.5], [1.0, -2.0, 1.0], [3.0, 0.0, -1.0]];
    let mean = [2.0, 0.0, 0.0];
    let by_hand: f64 = velocities
        .iter()
        .map(|v| 0.5 * v[2] * (0..3).map(|k| (v[k] - mean[k]) * (v[k] - mean[k])).sum::<f64>())
        .sum::<f64>()
        / 4.0;
    let averaged = |wind: [f64; 3]| {
        let moved = |v: [f64; 3]| std::array::from_fn(|k| v[k] + wind[k]);
        let grains: Vec<Grain> =
            (0..4_u8).map(|i| grain([0.02 * f64::from(i), 0.0, 0.01], moved(velocities[usize::from(i)]))).collect();
        let engine = engine(&grains, Domain::default(), law(0.5, Tension::Cut), 1e-5, [0.0; 3]);
        let mut averages = Averages::new(0.0, 0.02, 0.02, 0.01, RHO, 1);
        // A drag that is linear in the velocity against the mean takes twice its rate of the energy.
        let volume = grains[0].mass() / RHO;
        averages.sample(&engine, 0, |i| std::array::from_fn(|k| 7e-6 - 3.0 * volume * engine.grains().velocity(i)[k]));
        let profile = averages.profile();
        [profile.phi[0], profile.flux[0], profile.drag_loss[0], profile.temperature[0]].map(|x| x.unwrap().mean)
    };
    for wind in [[0.0; 3], [5.0, -2.0, 1.5]] {
        let [phi, flux, drag, temperature] = averaged(wind);
        approx::assert_relative_eq!(flux, RHO * phi * by_hand, max_relative = 1e-11);
        approx::assert_relative_eq!(drag, 3.0 * phi * 3.0 * temperature, max_relative = 1e-11);
    }
}

#[test]
fn contacts_take_what_their_force_does_on_the_approach_of_the_centres() {
    let branch = 2.0 * R - 1e-5;
    let at = |z: f64, v: [f64; 3]| grain([0.0, 0.0, z], v);
    let pair = |wind: f64| [at(0.01, [wind, 0.0, 0.1]), at(0.01 + branch, [wind, 0.0, -0.3])];
    for wind in [0.0, 4.0] {
        let mut engine = engine(&pair(wind), Domain::default(), law(1.0, Tension::Cut), 1e-5, [0.0; 3]);
        engine.forces(0.0);
        let force = engine.contacts().next().unwrap().force[2];
        let mut averages = Averages::new(0.0, 0.04, 0.04, 0.01, RHO, 1);
        averages.sample(&engine, 0, |_| [0.0; 3]);
        let profile = averages.profile();
        let volume = 0.04 * 0.01;
        approx::assert_relative_eq!(profile.contact_loss[0].unwrap().mean, force * 0.4 / volume, max_relative = 1e-9);
        // Both move with -0.1 in the mean, as their centre of mass: contacts carry no energy that fluctuates.
        let carried = profile.flux[0].unwrap().mean * volume;
        assert!(carried.abs() < 1e-9 * force * branch, "{carried}");
    }
}

#[test]
fn a_second_touch_knows_nothing_of_the_first() {
    // So slow along the wall that the contact sticks: where it slips, the spring forgets by itself.
    let slow = |z: f64| grain([0.0, 0.0, z], [2e-3, 0.0, 0.0]);
    let below = Grain { fixed: true, ..grain([0.0; 3], [0.0; 3]) };
    for (domain, grains) in [(floor(), vec![slow(R + 1e-5)]), (Domain::default(), vec![below, slow(2.0 * R + 1e-5)])] {
        let start = |grains: &[Grain]| engine(grains, domain.clone(), law(1.0, Tension::Cut), 1e-5, [0.0, 0.0, -G]);
        let mut whole = start(&grains);
        let touching = |e: &Engine<_>| e.found().contacts + e.found().wall_contacts > 0;
        for wanted in [true, false] {
            while touching(&whole) != wanted {
                go(&mut whole, 1);
            }
        }
        let mut fresh = start(&whole.grains().listed());
        let mut touched = false;
        for _ in 0..2000 {
            go(&mut whole, 1);
            go(&mut fresh, 1);
            touched |= touching(&whole);
        }
        assert!(touched);
        for (a, b) in whole.grains().listed().iter().zip(fresh.grains().listed()) {
            assert_eq!((a.position, a.velocity, a.spin), (b.position, b.velocity, b.spin));
        }
    }
}
