use super::{Domain, G, R, RHO, engine, floor, grain, law};
use crate::closures::contact::Tension;
use crate::dem::body::Nothing;
use crate::dem::stability;
use crate::dem::{Engine, Grain, GrainError, Settings};

#[test]
fn what_cannot_go_on_is_named_with_grain_step_and_place() {
    let pressed = [grain([0.0; 3], [0.0; 3]), grain([1.2 * R, 0.0, 0.0], [0.0; 3])];
    let mut one = engine(&pressed, Domain::default(), law(0.5, Tension::Cut), 2e-5, [0.0; 3]);
    match one.step(&Nothing).unwrap_err() {
        GrainError::Overlap { place, other: Some(other), ratio, .. } => {
            assert_eq!((place.grain + other, place.step), (1, 0));
            assert!((ratio - 0.4).abs() < 1e-12);
        }
        other => panic!("{other}"),
    }
    let mut through = engine(&[grain([0.0, 0.0, 0.5 * R], [0.0; 3])], floor(), law(0.5, Tension::Cut), 2e-5, [0.0; 3]);
    let error = through.step(&Nothing).unwrap_err();
    assert!(matches!(error, GrainError::Overlap { other: None, .. }), "{error}");

    let settings = Settings { lowest: -0.1, ..Settings::new(1e-4, [0.0, 0.0, -G], 2.0 * R) };
    let one = [grain([0.0; 3], [0.0; 3])];
    let mut falling = Engine::new(&one, Domain::default(), law(0.5, Tension::Cut), settings, 1).unwrap();
    let error = (0..10_000).find_map(|_| falling.step(&Nothing).err()).unwrap();
    assert!(matches!(error, GrainError::Lost { place, .. } if place.position[2] < -0.1), "{error}");

    let wild = grain([0.0, 0.0, 0.0], [f64::MAX, f64::MAX, 0.0]);
    let mut gone = engine(&[wild], Domain::default(), law(0.5, Tension::Cut), 1e3, [0.0; 3]);
    let error = (0..9).find_map(|_| gone.step(&Nothing).err()).unwrap();
    assert!(matches!(error, GrainError::NotFinite { .. }), "{error}");
    assert!(error.to_string().contains("grain 0 at"), "{error}");

    let none = Engine::new(&[], Domain::default(), law(0.5, Tension::Cut), settings, 1).unwrap_err();
    assert!(matches!(none, GrainError::Count { count: 0, .. }));
    let short = Domain { periods: [Some(4.0 * R), None], walls: Vec::new() };
    let short = Engine::new(&one, short, law(0.5, Tension::Cut), settings, 1).unwrap_err();
    assert!(matches!(short, GrainError::PeriodTooShort { axis: 'x', .. }));
}

#[test]
fn the_limit_of_a_pair_is_exact_and_a_longer_step_is_refused() {
    let mass = Grain::at_rest([0.0; 3], R, RHO).mass();
    let undamped = law(1.0, Tension::Cut);
    let limit = stability::of_pair(&undamped, 0.5 * mass);
    // w^2 = max(2 k_n, 7 k_s)/m: here the rolling mode.
    approx::assert_relative_eq!(limit, 2.0 / (7.0 * 2.5e3 / mass).sqrt(), max_relative = 1e-12);
    approx::assert_relative_eq!(limit, 2.54e-4, max_relative = 2e-3);
    let pair = [grain([0.0; 3], [0.0; 3]), grain([2.0 * R - 1e-6, 0.0, 0.0], [0.0; 3])];
    let with = |dt| engine(&pair, Domain::default(), undamped, dt, [0.0; 3]);
    let found = stability::limit(&with(1e-5));
    approx::assert_relative_eq!(found.step, limit, max_relative = 1e-9);
    assert!(with(0.999 * limit).check_step().is_ok());
    let refused = with(1.001 * limit).check_step().unwrap_err();
    assert!(matches!(refused, GrainError::StepTooLong { contacts: 1, .. }), "{refused}");
}
