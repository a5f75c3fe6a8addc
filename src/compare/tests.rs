use super::*;
use crate::result::quantity::{BED_LEVEL, FLOW_HEIGHT, MEAN_VELOCITY, PHI, TAU_PARTICLE, TAU_VISCOUS, U_MIXTURE};

/// A bed with four levels at 0, 1/4, 1/2 and 1 m under 1 m of flow.
pub(super) fn bed(name: &str, level: f64) -> Subject {
    let mut profile = Profile::new(vec![0.0, 0.25, 0.5, 1.0]).unwrap();
    let all = |values: [f64; 4]| values.map(Some).to_vec();
    profile.push(&PHI, all([0.6, 0.6, 0.0, 0.0])).unwrap();
    profile.push(&U_MIXTURE, all([0.0, 0.0, 1.0, 0.0])).unwrap();
    profile.push(&TAU_VISCOUS, all([0.0, 3.0, 1.0, -1.0])).unwrap();
    profile.push(&TAU_PARTICLE, vec![Some(6.0), Some(0.0), None, None]).unwrap();
    let mut results = Results::default();
    results.set(&FLOW_HEIGHT, 1.0);
    results.set(&BED_LEVEL, level);
    results.set(&MEAN_VELOCITY, 0.5);
    Subject {
        name: name.into(),
        label: "a bed".into(),
        kind: Kind::Case,
        source: format!("{name}.toml"),
        notes: Vec::new(),
        profile,
        errors: None,
        results,
        regime: Vec::new(),
        validity: Vec::new(),
        solve_s: 0.0,
        work: 0.0,
        stated: None,
    }
}

#[test]
fn identical_subjects_differ_by_exactly_nothing_in_every_frame() {
    for align in [Align::Bottom, Align::Bed, Align::None] {
        for scaled in [false, true] {
            let found = compare(vec![bed("a", 0.25), bed("b", 0.25)], align, scaled).unwrap();
            assert_eq!(found.norms.len(), 4);
            for row in &found.norms {
                let d = row.deviation.unwrap();
                assert_eq!((d.l2_relative, d.linf, d.bias), (Some(0.0), 0.0, 0.0), "{}", row.quantity.name);
                assert_eq!(d.levels, if row.quantity.name == "tau_particle_Pa" { 2 } else { 4 });
            }
            assert!(found.numbers.iter().all(|n| n.differences.iter().all(|d| *d == Some(0.0))));
        }
    }
}

#[test]
fn numbers_stand_in_the_order_of_the_catalogue_relative_to_the_first_that_has_them() {
    let (a, mut b, mut c) = (bed("a", 0.25), bed("b", 0.5), bed("c", 0.0));
    b.results.set(&quantity::SHIELDS, 0.4);
    c.results.set(&quantity::SHIELDS, 0.3);
    c.results.set(&quantity::U_STAR, 0.3);
    let found = compare(vec![a, b, c], Align::Bottom, false).unwrap();
    let names: Vec<&str> = found.numbers.iter().map(|n| n.quantity.name).collect();
    assert_eq!(names, ["shields", "mean_velocity_m_s", "bed_level_m", "flow_height_m"]);
    assert_eq!(found.numbers[0].base, 1);
    assert_eq!(found.numbers[0].differences[0], None);
    approx::assert_relative_eq!(found.numbers[0].differences[2].unwrap(), -0.25, max_relative = 1e-12);
    assert_eq!(found.numbers[2].differences, [Some(0.0), Some(1.0), Some(-1.0)]);
}

#[test]
fn alignment_at_the_bed_moves_equal_shapes_onto_each_other() {
    let (a, mut b) = (bed("a", 0.25), bed("b", 0.75));
    let mut higher = Profile::new(vec![0.5, 0.75, 1.0, 1.5]).unwrap();
    higher.push(&U_MIXTURE, a.profile.get(&U_MIXTURE).unwrap().to_vec()).unwrap();
    b.profile = higher;
    let apart = compare(vec![a.clone(), b.clone()], Align::Bottom, false).unwrap();
    assert!(apart.norms[0].deviation.unwrap().linf > 0.5);
    let aligned = compare(vec![a, b], Align::Bed, false).unwrap();
    let d = aligned.norms[0].deviation.unwrap();
    assert_eq!((d.levels, d.linf), (4, 0.0));
}

#[test]
fn fewer_than_two_and_nothing_in_common_are_refused() {
    assert!(matches!(compare(vec![], Align::Bottom, false), Err(CompareError::TooFew { given: 0, .. })));
    assert!(matches!(compare(vec![bed("a", 0.1)], Align::Bottom, false), Err(CompareError::TooFew { given: 1, .. })));
    let far = data::parse("z_m,phi\n7,0.1\n8,0.1\n", "far", "far.csv").unwrap();
    let refused = compare(vec![bed("a", 0.1), far], Align::Bottom, false);
    assert!(matches!(refused, Err(CompareError::NothingShared { reference }) if reference == "a"));
}

#[test]
fn equal_names_are_told_apart() {
    let mut subjects = vec![bed("a", 0.1), bed("a", 0.2), bed("a", 0.3), bed("b", 0.1)];
    subjects[1].source = "runs/a".into();
    let found = compare(subjects, Align::Bottom, false).unwrap();
    let names: Vec<&str> = found.subjects.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["a.toml", "runs/a", "a.toml (2)", "b"]);
}

#[test]
fn a_folder_is_named_with_plain_letters() {
    let names = ["a b/../c".to_owned(), "é".to_owned()];
    let folder = |align, scaled| Comparison::folder(&names, align, scaled);
    assert_eq!(folder(Align::Bottom, false), PathBuf::from("runs/compare-a_b_.._c-_"));
    assert_eq!(folder(Align::Bed, true), PathBuf::from("runs/compare-a_b_.._c-_-bed-scaled"));
    assert!(Comparison::folder(&vec!["long".repeat(20); 9], Align::Bed, true).as_os_str().len() < 160);
}
