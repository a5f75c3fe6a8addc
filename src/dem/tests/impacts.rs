use super::{Which, verification};
use crate::closures::contact::Tension;
use crate::models::grains::impact::follow;
use crate::models::grains::verification::impacts::{at_angle, head_on, oblique, springs};
use crate::models::grains::verification::{Findings, found};
use crate::models::grains::{Impact, Verification};
use crate::result::{Quantity, quantity as q};

#[test]
fn head_on_impacts_meet_e_n_in_both_conventions_against_grains_walls_and_fixed_grains() {
    let all: Findings = head_on(&verification(Which::HeadOn, 0.5, 50.0)).unwrap();
    let value = |quantity: &'static Quantity| found(Ok(all.clone()), quantity);
    println!("{:?}", all.iter().map(|(q, x)| (q.name, *x)).collect::<Vec<_>>());
    assert!(value(&q::RESTITUTION_WORST) < 1e-3);
    // The force begins and ends within a step: two steps of fifty.
    assert!(value(&q::CONTACT_TIME_WORST) < 0.041);
    assert!(value(&q::RESTITUTION_ORDER) > 1.5);
}

#[test]
fn gross_slip_obeys_its_line_at_every_angle_and_spin() {
    // Without damping nothing is missing; with it the dashpot pushes at once, while the tangential spring must first be
    // stretched to its cap: a share mu 2 zeta^2 (k_n/k_s) cot(angle)/(1 + e) of the line is not reached.
    let mut elastic = verification(Which::Oblique, 1.0, 400.0);
    elastic.contact.mu = 0.1;
    let all = oblique(&elastic).unwrap();
    println!("{:?}", all.iter().map(|(q, x)| (q.name, *x)).collect::<Vec<_>>());
    let value = |quantity: &'static Quantity| found(Ok(all.clone()), quantity);
    assert!(value(&q::GROSS_SLIP_ANGLES) > 20.0);
    assert!(value(&q::GROSS_SLIP_WORST) < 2e-3, "{}", value(&q::GROSS_SLIP_WORST));
    // The arm of the friction is shorter than the radius by the overlap, at most v_n/(w R) of it.
    assert!(value(&q::SPIN_WORST) < 2e-3 + 0.1 / (4206.0 * 3e-3));
    assert!(value(&q::ENERGY_GAINED_WORST) < 1e-4, "{}", value(&q::ENERGY_GAINED_WORST));
    let damped =
        Verification { contact: crate::closures::contact::LinearSpring { e_n: 0.5, ..elastic.contact }, ..elastic };
    for degrees in 45..=89 {
        let one = at_angle(&damped, 0.5, 0.1, f64::from(degrees), 400.0).unwrap();
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        let Some(expected) = one.gross_slip else { continue };
        let change = 0.1 * 1.5 * 0.1 * cos;
        let off = (one.tangential - expected).abs();
        assert!(off < (2e-3 + 0.03 * cos / sin) * change, "{degrees}: {} {expected}", one.tangential);
    }
    let spinning = Impact {
        d: 6e-3,
        rho_p: 2500.0,
        velocity: 0.1,
        angle: 0.0,
        spin: 2000.0,
        target: crate::models::grains::case::Target::Wall,
        contact: verification(Which::HeadOn, 0.5, 50.0).contact,
        steps_per_contact: 50.0,
    };
    let one = follow(&spinning).unwrap();
    assert!((one.tangential - 0.06).abs() < 1e-4 && (one.spin - 1950.0).abs() < 50.0 * 8e-3, "{one:?}");
    assert_eq!(spinning.contact.tension, Tension::Cut);
}

#[test]
fn the_defect_of_the_spring_energy_falls_faster_than_the_time_step() {
    let all = springs(&verification(Which::Springs, 1.0, 50.0)).unwrap();
    println!("{:?}", all.iter().map(|(q, x)| (q.name, *x)).collect::<Vec<_>>());
    assert!(found(Ok(all.clone()), &q::SPRING_ORDER) > 1.5);
    assert!(found(Ok(all), &q::SPRING_DEFECT_FINE) < 5e-3);
}
