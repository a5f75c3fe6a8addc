//! What a laminar bed reports, in SI: the profile and the numbers tell one story, whatever method solved the bed.

use approx::assert_relative_eq;

use super::{exact::ouriemi, laminar};
use crate::closures::dilatancy::PhiIv;
use crate::closures::drag::CarmanKozeny;
use crate::closures::friction::{Coulomb, MuIv};
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::regularisation::Regularisation;
use crate::models::exact::bed::{Drive, LaminarBed, Wanted};
use crate::models::laminar::RegularisedBed;
use crate::result::{Outcome, Profile, Quantity, Quiet, quantity as q};

const CELLS: usize = 400;
/// Fall of the pressure [Pa/m].
const DRIVE: f64 = 1471.5;
/// Weight of a volume of grains in the fluid [Pa/m].
const WEIGHT: f64 = (2500.0 - 1000.0) * 9.81;

fn bed(drag: Option<CarmanKozeny>) -> LaminarBed {
    LaminarBed {
        rho_f: 1000.0,
        eta: 1.0,
        rho_p: 2500.0,
        d: 1e-3,
        h_p: 0.015,
        phi: 0.55,
        h: 0.03,
        g: 9.81,
        drive: Drive::PressureGradient(DRIVE),
        friction: Coulomb { mu_s: 0.43 },
        rise: None,
        viscosity: MixtureViscosity::Einstein,
        drag,
        dilatancy: None,
    }
}

/// A bed whose grains spread where they shear.
fn spreading(drag: Option<CarmanKozeny>) -> LaminarBed {
    let rise = Some(MuIv { mu_s: 0.43, mu_2: 0.94, i_0: 0.0077 });
    LaminarBed { rise, dilatancy: Some(PhiIv { a: 1.0 }), ..bed(drag) }
}

/// Each form by each method, by name.
fn solved() -> Vec<(&'static str, LaminarBed, Outcome)> {
    let law = |phi_min: f64| Some(CarmanKozeny { k_ck: 180.0, phi_min });
    let closed = |bed: &LaminarBed| ouriemi::run(bed, CELLS, &mut Quiet).unwrap();
    let solver = |bed: &LaminarBed| {
        let problem = RegularisedBed { bed: *bed, regularisation: Regularisation::EXACT, yield_node: true };
        laminar::run(&problem, CELLS, &mut Quiet).unwrap()
    };
    vec![
        ("closed, mixed", bed(None), closed(&bed(None))),
        ("closed, two-fluid", bed(law(0.0)), closed(&bed(law(0.0)))),
        ("mixed", bed(None), solver(&bed(None))),
        ("two-fluid", bed(law(0.0)), solver(&bed(law(0.0)))),
        ("mixed, spreading", spreading(None), solver(&spreading(None))),
        ("two-fluid, spreading", spreading(law(0.3)), solver(&spreading(law(0.3)))),
    ]
}

fn column(profile: &Profile, quantity: &Quantity) -> Vec<f64> {
    profile.get(quantity).unwrap().iter().map(|value| value.unwrap_or(f64::NAN)).collect()
}

/// Trapezoidal integral of a column up to the level `top`; the last value holds for what is left, half a cell of the closed form.
fn integral(profile: &Profile, quantity: &Quantity, top: f64) -> f64 {
    let (z, values) = (profile.axis(), column(profile, quantity));
    let below = z.partition_point(|&level| level <= top);
    let whole: f64 = (1..below).map(|i| 0.5 * (z[i] - z[i - 1]) * (values[i] + values[i - 1])).sum();
    whole + (top - z[below - 1]) * values[below - 1]
}

#[test]
fn the_phases_add_up_to_the_mixture() {
    for (name, bed, outcome) in solved() {
        let profile = outcome.profile.unwrap();
        let [phi, grains, mixture, flux] =
            [&q::PHI, &q::U_PARTICLE, &q::U_MIXTURE, &q::FLUX].map(|quantity| column(&profile, quantity));
        let fluid = if bed.drag.is_some() { column(&profile, &q::U_FLUID) } else { mixture.clone() };
        for (i, z) in profile.axis().into_iter().enumerate() {
            let grains = if grains[i].is_nan() { 0.0 } else { grains[i] };
            assert_relative_eq!(flux[i], phi[i] * grains, max_relative = 1e-12);
            let sum = (1.0 - phi[i]) * fluid[i] + phi[i] * grains;
            assert!((sum - mixture[i]).abs() < 1e-12, "{name} at {z}: {sum} for {}", mixture[i]);
        }
    }
}

#[test]
fn the_numbers_follow_from_the_profile() {
    for (_, bed, outcome) in solved() {
        let (profile, results) = (outcome.profile.unwrap(), outcome.results);
        let result = |quantity: &Quantity| results.get(quantity.name).unwrap();
        let rate = result(&q::TRANSPORT_RATE);
        assert_relative_eq!(rate, integral(&profile, &q::FLUX, bed.h_p), max_relative = 6e-3);
        let discharge = integral(&profile, &q::U_MIXTURE, bed.h);
        assert_relative_eq!(result(&q::FLUID_DISCHARGE), discharge - rate, max_relative = 1e-3);
        assert_relative_eq!(result(&q::MEAN_VELOCITY), discharge / bed.h, max_relative = 1e-3);
        assert_relative_eq!(result(&q::TRANSPORT_RATE_MASS), 2500.0 * rate, max_relative = 1e-14);
        assert_relative_eq!(0.55 * result(&q::TRANSPORT_RATE_BULK), rate, max_relative = 1e-14);
        // In units of d sqrt((rho_p/rho_f - 1) g d).
        assert_relative_eq!(
            result(&q::TRANSPORT_RATE_DIMENSIONLESS),
            rate / (1e-3 * (1.5 * 9.81e-3_f64).sqrt()),
            max_relative = 1e-12
        );
        // The stress on the bed is the one just above it.
        let above = profile.axis().into_iter().find(|z| *z > bed.h_p).unwrap();
        let tau = profile.at(&q::TAU_VISCOUS, above).unwrap() + DRIVE * (above - bed.h_p);
        assert_relative_eq!(result(&q::SHIELDS), tau / (WEIGHT * 1e-3), max_relative = 1e-9);
        assert_relative_eq!(result(&q::U_STAR), (tau / 1000.0).sqrt(), max_relative = 1e-9);
        if bed.drag.is_some() && bed.dilatancy.is_none() {
            // The slip is the same wherever these grains move; Re_p is that of one grain in the fluid around it.
            let last = column(&profile, &q::U_PARTICLE).iter().rposition(|u| !u.is_nan()).unwrap();
            let slip = column(&profile, &q::U_FLUID)[last] - column(&profile, &q::U_PARTICLE)[last];
            assert_relative_eq!(result(&q::REYNOLDS_PARTICLE), 1000.0 * slip * 1e-3 / 1.0, max_relative = 1e-9);
        }
    }
}

#[test]
fn grains_weigh_what_the_fluid_leaves_of_them() {
    for (name, bed, outcome) in solved() {
        let profile = outcome.profile.unwrap();
        let pressure = column(&profile, &q::P_PARTICLE);
        let weight = WEIGHT * integral(&profile, &q::PHI, bed.h_p);
        assert_relative_eq!(pressure[0], weight, max_relative = 5e-3);
        if bed.dilatancy.is_none() {
            assert_relative_eq!(pressure[0], 0.55 * WEIGHT * 0.015, max_relative = 1e-12);
        } else {
            assert!(pressure[0] < 0.55 * WEIGHT * 0.015, "{name}: grains that spread weigh less");
        }
        if bed.rise.is_none() {
            // Moving grains carry mu_s P_p, the others less.
            let (stress, shear) = (column(&profile, &q::TAU_PARTICLE), column(&profile, &q::SHEAR_RATE));
            for i in 0..pressure.len() {
                let most = 0.43 * pressure[i];
                assert!(stress[i] <= most + 1e-9, "{name}: {} over {most}", stress[i]);
                let at_rest = shear[i] <= 1e-9 || shear[i].is_nan();
                assert!(at_rest || (stress[i] - most).abs() < 1e-9, "{name}: {} for {most}", stress[i]);
            }
        }
    }
}

#[test]
fn the_stress_of_both_phases_falls_by_the_drive() {
    for (name, _, outcome) in solved() {
        let profile = outcome.profile.unwrap();
        let (fluid, grains) = (column(&profile, &q::TAU_VISCOUS), column(&profile, &q::TAU_PARTICLE));
        let z = profile.axis();
        let total: Vec<f64> = (0..z.len()).map(|i| fluid[i] + grains[i] + DRIVE * z[i]).collect();
        for (z, sum) in z.iter().zip(&total) {
            assert!((sum - total[0]).abs() < 1e-8, "{name} at {z}: {sum} for {}", total[0]);
        }
    }
}

#[test]
fn grains_drift_through_the_fluid_as_darcy_says_of_their_packing() {
    // Where grains move, -dtau_p/dz = eta (U - u_p)/K with the permeability of the solid fraction at that level.
    for (name, bed, outcome) in solved() {
        let Some(law) = bed.drag else { continue };
        let profile = outcome.profile.unwrap();
        let [phi, mixture, grains, stress, shear] =
            [&q::PHI, &q::U_MIXTURE, &q::U_PARTICLE, &q::TAU_PARTICLE, &q::SHEAR_RATE]
                .map(|quantity| column(&profile, quantity));
        let z = profile.axis();
        let moving: Vec<usize> = (0..z.len()).filter(|&i| z[i] <= bed.h_p && shear[i] > 1e-6).collect();
        assert!(moving.len() > 40, "{name}");
        // Away from the corners, where the slip takes a few grains to settle.
        for &i in &moving[moving.len() / 4..moving.len() - 4] {
            let force = -(stress[i + 1] - stress[i - 1]) / (z[i + 1] - z[i - 1]);
            let drag = bed.eta * (mixture[i] - grains[i]) / law.permeability(phi[i], bed.d);
            assert!((drag / force - 1.0).abs() < 0.02, "{name} at {}: {drag} for {force}", z[i]);
        }
    }
}

#[test]
fn a_wanted_shields_number_is_the_one_that_results() {
    for drag in [None, Some(CarmanKozeny { k_ck: 180.0, phi_min: 0.0 })] {
        let bed = LaminarBed { drive: Drive::Wanted(Wanted::Shields, 0.5), ..bed(drag) };
        let problem = RegularisedBed { bed, regularisation: Regularisation::EXACT, yield_node: true };
        let closed = ouriemi::run(&bed, CELLS, &mut Quiet).unwrap();
        let solver = laminar::run(&problem, CELLS, &mut Quiet).unwrap();
        for outcome in [closed, solver] {
            assert_relative_eq!(outcome.results.get(q::SHIELDS.name).unwrap(), 0.5, max_relative = 1e-9);
        }
    }
}
