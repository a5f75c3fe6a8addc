//! The table of what runs say of the premises of their models: each premise of each model held once, and broken once, or doubtful where
//! it has no broken side.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use bedload::result::Verdict::{self, Broken, Doubtful, Holds};

use crate::support::{REGISTRY, Scratch, files, load, project, run};

const LAMINAR: &str = "the flow is laminar";
const DARCY: &str = "the drag between the phases is viscous";
const SLOW: &str = "inertia is small";
const SHEET: &str = "the bed moves as a sheet";
const LAYER: &str = "a layer of grains moves";
const MANY: &str = "the moving layer is many grains thick";
const ROUGHNESS: &str = "the roughness is small against the depth";
const ROUGH: &str = "the bed is a rough wall";
const SUSPENSION: &str = "turbulence carries no grains";
const COLLISIONS: &str = "the fluid does not damp collisions";
const SHIELDS: &str = "kinetic theory was compared with grains at this Shields number";
const RESTITUTION: &str = "kinetic theory was compared with grains of this restitution";
const FRICTION: &str = "kinetic theory was compared with grains of this friction";
const RIGID: &str = "grains are rigid";
const REST: &str = "a bed at rest lies under the moving layer";
const DEEP: &str = "the flow is deep over its grains";
const BOTTOM: &str = "the bed rests on its bottom";
const SLOPE: &str = "a bed rests on this slope";
const PACKED: &str = "grains of the bed lie on each other";
const DILATANCY: &str = "the bed is packed as closures.dilatancy says";
const WALLS: &str = "side walls without friction are far apart";
const CELL: &str = "the cell is so large that a larger one carries the same";
const SETTLED: &str = "the bed has settled";

/// A case, what is changed in it, and what is to be said of some of the premises.
type Input = (&'static str, &'static [&'static str], &'static [(&'static str, Verdict)]);

#[rustfmt::skip]
const CONTINUA: &[Input] = &[
    ("exact_1d_aussillous", &[], &[(LAMINAR, Holds)]),
    ("exact_1d_aussillous", &["fluid.viscosity=0.015"], &[(LAMINAR, Doubtful)]),
    ("exact_1d_aussillous", &["fluid.viscosity=1e-3"], &[(LAMINAR, Broken)]),
    ("exact_1d_ouriemi_mixed", &[], &[(LAMINAR, Holds)]),
    ("exact_1d_ouriemi_mixed", &["fluid.viscosity=0.01"], &[(LAMINAR, Broken)]),
    ("bed_ouriemi-laminar-exact", &[], &[(LAMINAR, Holds), (DARCY, Holds)]),
    ("bed_ouriemi-laminar-exact", &["fluid.viscosity=2.5e-3"], &[(DARCY, Doubtful)]),
    ("bed_ouriemi-laminar-exact", &["fluid.viscosity=9e-4"], &[(LAMINAR, Broken), (DARCY, Broken)]),
    ("laminar_1d_aussillous", &["fluid.viscosity=1e-3"], &[(LAMINAR, Broken)]),
    ("laminar_1d_muiv", &[], &[(LAMINAR, Holds)]),
    ("bed_ouriemi-laminar", &[], &[(LAMINAR, Holds), (DARCY, Holds)]),
    ("bed_ouriemi-laminar", &["fluid.viscosity=2.5e-3"], &[(DARCY, Doubtful)]),
    ("bed_ouriemi-laminar", &["fluid.viscosity=9e-4"], &[(LAMINAR, Broken), (DARCY, Broken)]),
    ("exact_1d_bingham", &[], &[(LAMINAR, Holds)]),
    ("exact_1d_bingham", &["fluid.density=2000"], &[(LAMINAR, Doubtful)]),
    ("exact_1d_bingham", &["fluid.density=3000"], &[(LAMINAR, Broken)]),
    ("bingham_1d_plane", &[], &[(LAMINAR, Holds)]),
    ("bingham_1d_plane", &["fluid.density=2000"], &[(LAMINAR, Doubtful)]),
    ("bingham_1d_plane", &["fluid.density=4000"], &[(LAMINAR, Broken)]),
    ("section_2d_square", &["grid.cells=8"], &[(LAMINAR, Holds)]),
    ("section_2d_square", &["grid.cells=8", "fluid.viscosity=1e-5"], &[(LAMINAR, Broken)]),
    ("section_2d_circle", &["grid.cells=8"], &[(LAMINAR, Holds)]),
    ("section_2d_circle", &["grid.cells=8", "fluid.viscosity=1e-6"], &[(LAMINAR, Broken)]),
    ("section_2d_square_bed", &["grid.cells=8"], &[(LAMINAR, Holds)]),
    ("section_2d_square_bed", &["grid.cells=8", "fluid.viscosity=1e-3"], &[(LAMINAR, Broken)]),
    ("section_2d_circle_bed", &["grid.cells=8", "fluid.viscosity=0.01"], &[(LAMINAR, Doubtful)]),
    ("bed_ouriemi-duct-bed", &["grid.cells=16"], &[(LAMINAR, Holds), (DARCY, Holds)]),
    ("bed_ouriemi-duct-bed", &["grid.cells=16", "fluid.viscosity=2.5e-3"], &[(DARCY, Doubtful)]),
    ("bed_ouriemi-duct-bed", &["grid.cells=16", "fluid.viscosity=9e-4"], &[(LAMINAR, Broken), (DARCY, Broken)]),
    ("section_2d_cavity_bn0", &["grid.cells=12"], &[(SLOW, Holds)]),
    ("section_2d_cavity_bn5", &["grid.cells=12", "fluid.density=50"], &[(SLOW, Doubtful)]),
    ("section_2d_cavity_bn50", &["grid.cells=12", "fluid.density=1000"], &[(SLOW, Broken)]),
    ("exact_1d_loglaw", &[], &[(ROUGH, Holds), (ROUGHNESS, Holds)]),
    ("exact_1d_loglaw", &["fluid.viscosity=0.01"], &[(ROUGH, Doubtful)]),
    ("exact_1d_loglaw", &["fluid.viscosity=0.1"], &[(ROUGH, Broken)]),
    ("exact_1d_loglaw", &["closures.wall.k_s=20 mm"], &[(ROUGHNESS, Doubtful)]),
    ("exact_1d_loglaw", &["closures.wall.k_s=40 mm"], &[(ROUGHNESS, Broken)]),
    ("exact_1d_bagnold", &[], &[]),
    ("kinetic_1d_shear", &[], &[(RESTITUTION, Holds), (FRICTION, Holds)]),
    ("kinetic_1d_shear", &["grains.restitution=0.95"], &[(RESTITUTION, Doubtful)]),
    ("kinetic_1d_shear", &["grains.friction=2"], &[(FRICTION, Doubtful)]),
];

/// No slope: it follows from depth and stress.
const STRESS: [&str; 2] = ["flow.slope=", "flow.slope_definition="];

#[rustfmt::skip]
const BEDS: &[Input] = &[
    ("sheet_1d_sumer91", &[], &[(LAYER, Holds), (SHEET, Holds), (MANY, Holds), (ROUGH, Holds)]),
    ("sheet_1d_type_a", &[], &[(DEEP, Holds), (SLOPE, Holds)]),
    ("sheet_1d_type_b", &[], &[(ROUGHNESS, Holds), (ROUGH, Doubtful), (REST, Holds)]),
    ("sheet_1d_type_b", &["flow.shields=0.14"], &[(LAYER, Broken), (SHEET, Broken)]),
    ("sheet_1d_type_b", &["flow.shields=0.155"], &[(SHEET, Broken), (MANY, Broken), (ROUGH, Broken)]),
    ("sheet_1d_limit_slope_a", &["flow.slope=0.02"], &[(SLOPE, Holds)]),
    ("flow_theta04-sheet-flow", &[], &[(SHEET, Doubtful)]),
    ("flow_theta02-sheet-flow", &[], &[(SHEET, Broken), (MANY, Broken)]),
    ("flow_theta06-sheet-flow", &[], &[(MANY, Doubtful), (DILATANCY, Holds), (REST, Holds)]),
    ("flow_theta06-sheet-flow", &["bed.phi=0.58"], &[(DILATANCY, Doubtful)]),
    ("flow_theta06-sheet-flow", &["bed.phi=0.55"], &[(DILATANCY, Broken)]),
    ("flow_theta06-sheet-flow", &["bed.thickness=9 d"], &[(REST, Doubtful)]),
    ("flow_theta06-sheet-flow", &["bed.thickness=6 d"], &[(REST, Broken)]),
    ("flow_theta06-sheet-flow", &["closures.suspension=none"], &[(SUSPENSION, Holds)]),
    ("flow_theta06-sheet-flow", &["closures.suspension=none", "grains.settling_velocity=0.1"], &[(SUSPENSION, Broken)]),
    (
        "flow_theta06-sheet-flow",
        &[STRESS[0], STRESS[1], "flow.shields=0.6", "grains.density=1100", "flow.depth=4 d", "bed.thickness=60 d"],
        &[(ROUGHNESS, Doubtful), (DEEP, Doubtful)],
    ),
    (
        "flow_theta06-sheet-flow",
        &[STRESS[0], STRESS[1], "flow.shields=0.2", "grains.density=1100", "flow.depth=1.5 d", "bed.thickness=60 d"],
        &[(SHEET, Broken), (DEEP, Broken)],
    ),
    (
        "flow_theta06-sheet-flow",
        &[STRESS[0], STRESS[1], "flow.shields=0.75", "grains.density=1100", "flow.depth=4 d", "bed.thickness=200 d"],
        &[(ROUGHNESS, Broken), (SLOPE, Doubtful)],
    ),
    (
        "flow_theta06-sheet-flow",
        &["flow.depth=", "flow.shields=0.6", "flow.slope=0.15", "bed.thickness=60 d"],
        &[(SLOPE, Doubtful)],
    ),
    (
        "flow_theta06-two-fluid",
        &[],
        &[
            (COLLISIONS, Doubtful), (SHIELDS, Holds), (RESTITUTION, Holds), (FRICTION, Holds), (REST, Holds),
            (DEEP, Holds), (SUSPENSION, Holds), (PACKED, Holds), (SLOPE, Holds), (BOTTOM, Holds),
        ],
    ),
    ("flow_theta10-two-fluid", &[], &[(SHIELDS, Holds)]),
    ("flow_theta06-two-fluid", &["fluid.viscosity=1e-4"], &[(COLLISIONS, Holds)]),
    ("flow_theta06-two-fluid", &["fluid.viscosity=0.03"], &[(COLLISIONS, Broken)]),
    ("flow_theta06-two-fluid", &["flow.depth=", "flow.shields=0.15"], &[(SHIELDS, Doubtful)]),
    ("flow_theta06-two-fluid", &["grains.restitution=0.95"], &[(RESTITUTION, Doubtful)]),
    ("flow_theta06-two-fluid", &["grains.friction=2"], &[(FRICTION, Doubtful)]),
    ("flow_theta06-two-fluid", &["bed.thickness=4 d"], &[(REST, Broken), (BOTTOM, Doubtful)]),
    ("flow_theta06-two-fluid", &["bed.thickness=2.5 d"], &[(REST, Broken), (BOTTOM, Broken)]),
    ("flow_theta06-two-fluid", &["bed.phi=0.52"], &[(PACKED, Doubtful)]),
    ("flow_theta06-two-fluid", &["bed.phi=0.49"], &[(PACKED, Broken)]),
    ("flow_theta06-two-fluid", &["grains.settling_velocity=0.1"], &[(SUSPENSION, Broken)]),
    ("flow_theta06-two-fluid", &["flow.depth=", "flow.shields=0.6", "flow.slope=0.15"], &[(SLOPE, Doubtful)]),
    (
        "flow_theta06-two-fluid",
        &[STRESS[0], STRESS[1], "flow.shields=0.6", "grains.density=1100", "flow.depth=4 d"],
        &[(DEEP, Doubtful), (REST, Doubtful)],
    ),
    (
        "flow_theta06-two-fluid",
        &[STRESS[0], STRESS[1], "flow.shields=0.3", "grains.density=1100", "flow.depth=1.5 d"],
        &[(DEEP, Broken)],
    ),
];

/// Short runs of few grains: their means are worth nothing, what decides on their premises is known.
const SHORT: [&str; 2] = ["discrete.duration=0.1", "discrete.settle=0.3"];
const SMALL: [&str; 2] = ["cell.length=4 d", "cell.width=4 d"];
const SAMPLED: [&str; 2] = ["discrete.sample_period=0.005", "discrete.coupling_period=0.005"];

#[rustfmt::skip]
const GRAINS: &[Input] = &[
    ("grains_3d_bed_quick", &["layers=4", "discrete.duration=0.01", SMALL[0], SMALL[1], "closures.contact.k_n=1e5"], &[(RIGID, Holds)]),
    ("grains_3d_bed_quick", &["layers=4", "discrete.duration=0.01", SMALL[0], SMALL[1]], &[(RIGID, Doubtful)]),
    ("grains_3d_bed_quick", &["layers=4", "discrete.duration=0.01", SMALL[0], SMALL[1], "closures.contact.k_n=1e3"], &[(RIGID, Broken)]),
    ("impact_1d_headon", &[], &[]),
    ("trial_1d_stack", &[], &[]),
    (
        "flow_theta06_quick-coupled",
        &[SHORT[0], SHORT[1], "cell.length=10 d", "cell.width=10 d", "bed.thickness=5 d", "closures.contact.k_n=2e4"],
        &[(CELL, Holds), (REST, Broken), (RIGID, Holds)],
    ),
    ("flow_theta06_quick-coupled", &[SHORT[0], SHORT[1], "cell.length=7 d", "cell.width=7 d"], &[(CELL, Doubtful), (REST, Doubtful)]),
    ("flow_theta06_quick-coupled", &[SHORT[0], SHORT[1], SMALL[0], SMALL[1]], &[(CELL, Broken), (DEEP, Holds), (SUSPENSION, Holds), (SLOPE, Holds)]),
    ("flow_theta06_quick-coupled", &[SHORT[0], SHORT[1], SMALL[0], SMALL[1], "closures.contact.k_n=2e3"], &[(RIGID, Broken)]),
    ("flow_theta06_quick-coupled", &[SHORT[0], SHORT[1], SMALL[0], SMALL[1], "bed.thickness=14 d"], &[(REST, Holds)]),
    ("flow_theta06_quick-coupled", &[SHORT[0], SHORT[1], SMALL[0], SMALL[1], "flow.depth=2 d"], &[(DEEP, Broken)]),
    ("flow_theta06_quick-coupled", &[SHORT[0], SHORT[1], SMALL[0], SMALL[1], "grains.settling_velocity=0.1"], &[(SUSPENSION, Broken)]),
    ("flow_theta06_quick-coupled", &[SHORT[0], SHORT[1], SMALL[0], SMALL[1], "flow.depth=2 d", "flow.slope=0.25"], &[(SLOPE, Broken), (REST, Broken)]),
    (
        "flow_theta06_quick-coupled",
        &["discrete.duration=0.02", "discrete.sample_period=0.01", "discrete.settle=0.1", "cell={ length = \"4 d\" }", "flow.width=30 d", "closures.side_wall=none", "flow.depth=2.9 d"],
        &[(WALLS, Holds), (CELL, Broken)],
    ),
    ("flume_exp6_quick", &[SHORT[0], SHORT[1], "cell.length=60 d", "closures.side_wall=none"], &[(WALLS, Broken), (CELL, Holds)]),
    ("flume_exp6_quick", &[SHORT[0], SHORT[1], "cell.length=30 d"], &[(CELL, Doubtful), (DEEP, Doubtful)]),
    ("flume_exp6_quick", &[SHORT[0], SHORT[1], "cell.length=25 d"], &[(CELL, Broken)]),
    // Grains that no flow moves, and a bed that is still loose.
    ("flow_theta06_quick-coupled", &["discrete.duration=1", SHORT[1], SMALL[0], SMALL[1], SAMPLED[0], SAMPLED[1], "flow.depth=10 d", "discrete.seed=2"], &[(SETTLED, Holds)]),
    ("flow_theta06_quick-coupled", &["discrete.duration=1", SHORT[1], SMALL[0], SMALL[1], SAMPLED[0], SAMPLED[1], "flow.depth=10 d", "discrete.seed=5"], &[(SETTLED, Doubtful)]),
];

/// Where a broken premise leaves no answer: the model, what is changed in `flow_theta06`, the code of the failure and the premise.
const REFUSED: &[(&str, &[&str], &str, &str)] = &[
    (
        "sheet-flow",
        &["flow.depth=", "flow.shields=0.6", "flow.slope=0.19", "bed.thickness=60 d"],
        "nothing-at-rest",
        SLOPE,
    ),
    ("two-fluid", &["flow.slope=0.2"], "nothing-at-rest", SLOPE),
];

/// What is said of the premises of an input: its model, and the verdict on each premise. Where one is broken it is run as a person runs it,
/// who reads that first.
fn said(scratch: &Scratch, &(case, set, wanted): &Input) -> (&'static str, BTreeMap<String, Verdict>) {
    let (_, problem) = load(case, set).unwrap_or_else(|error| panic!("{case} {set:?}: {}", error.render(false)));
    if wanted.iter().all(|(_, verdict)| *verdict != Broken) {
        let outcome = run(&problem).unwrap_or_else(|failure| panic!("{case} {set:?}: {failure}"));
        return (problem.kind, outcome.regime.into_iter().map(|premise| (premise.premise, premise.verdict)).collect());
    }
    let sets = set.iter().flat_map(|set| ["--set", *set]);
    let command: Vec<&str> = ["run", case, "--out", "run", "--force"].into_iter().chain(sets).collect();
    let text = scratch.bedload(command).exits(0).out;
    let first = text.lines().next().unwrap();
    let summary = scratch.summary("run");
    let regime = summary["regime"].as_array().unwrap().iter().map(|premise| {
        let verdict = serde_json::from_value(premise["verdict"].clone()).unwrap();
        (premise["premise"].as_str().unwrap().to_owned(), verdict)
    });
    let regime: BTreeMap<String, Verdict> = regime.collect();
    assert!(first.starts_with("broken premise: "), "{case} {set:?}: {first}");
    for (premise, verdict) in &regime {
        assert_eq!(*verdict == Broken, first.contains(premise.as_str()), "{case} {set:?}: {premise}: {first}");
    }
    (problem.kind, regime)
}

/// The premises that the source of the models names.
fn named() -> BTreeSet<String> {
    let mut named = BTreeSet::new();
    for file in files(&project("src/models"), "rs") {
        for rest in fs::read_to_string(file).unwrap().split("premise: \"").skip(1) {
            named.insert(rest[..rest.find('"').unwrap()].to_owned());
        }
    }
    named
}

#[test]
fn each_premise_of_each_model_holds_once_and_is_broken_once() {
    let scratch = Scratch::new();
    let mut wrong = Vec::new();
    let mut inputs = BTreeSet::new();
    let (mut reach, mut checked, mut models) = (BTreeSet::new(), BTreeMap::new(), BTreeSet::new());
    for input in [CONTINUA, BEDS, GRAINS].into_iter().flatten() {
        let (case, set, wanted) = *input;
        let (model, found) = said(&scratch, input);
        models.insert(model);
        inputs.insert((case, set));
        reach.extend(found.keys().map(|premise| (model, premise.clone())));
        for (premise, verdict) in wanted {
            if found.get(*premise) != Some(verdict) {
                wrong.push(format!("{case} {set:?}: {premise}: {:?}, not {verdict:?}", found.get(*premise)));
            }
            checked.entry((model, (*premise).to_owned())).or_insert_with(BTreeSet::new).insert(*verdict);
        }
        if wanted.is_empty() && !found.is_empty() {
            wrong.push(format!("{case} {set:?} has premises: {found:?}"));
        }
    }
    for &(model, set, code, premise) in REFUSED {
        let set: Vec<&str> = set.to_vec();
        let problem = load(&format!("flow_theta06-{model}"), &set).unwrap().1;
        match run(&problem) {
            Ok(outcome) => wrong.push(format!("{model} {set:?} is answered: {:?}", outcome.regime)),
            Err(failure) if failure.error.code() != code => wrong.push(format!("{model} {set:?}: {failure}")),
            Err(_) => {
                checked.entry((problem.kind, premise.to_owned())).or_default().insert(Broken);
            }
        }
    }
    // No premise but those of the table, and none of a model that nothing holds, or that nothing breaks though it can be broken.
    let unbreakable = [SHIELDS, RESTITUTION, FRICTION, SETTLED];
    for (model, premise) in &reach {
        let verdicts = checked.get(&(*model, premise.clone())).cloned().unwrap_or_default();
        let worst = if unbreakable.contains(&premise.as_str()) { Doubtful } else { Broken };
        for wanted in [Holds, worst] {
            if !verdicts.contains(&wanted) {
                wrong.push(format!("{model}: no input for which \"{premise}\" is {wanted:?}"));
            }
        }
    }
    let reached: BTreeSet<String> = reach.iter().map(|(_, premise)| premise.clone()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(reached, named(), "premises that no input reaches");
    let all: BTreeSet<&str> = REGISTRY.entries().map(|entry| entry.info.name).collect();
    assert_eq!(models, all, "models that no input has");
    let rows: usize = checked.values().map(BTreeSet::len).sum();
    println!("{} inputs, {} premises of {} models, {rows} verdicts", inputs.len(), reach.len(), models.len());
    assert!(inputs.len() >= 60, "{} inputs", inputs.len());
}
