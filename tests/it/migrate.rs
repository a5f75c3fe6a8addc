//! `bedload migrate`: a case of format 1 as one of format 2.

use std::fs;

use crate::scenes::parsed;
use crate::support::{Scratch, files, load, project};

#[test]
fn a_migrated_case_states_the_problem_that_it_stated() {
    let scratch = Scratch::new();
    for old in files(&project("tests/format1"), "toml") {
        let name = old.file_stem().unwrap().to_str().unwrap();
        let new = format!("{name}.toml");
        scratch.bedload(["migrate", old.to_str().unwrap(), &new]).exits(0);
        scratch.bedload(["migrate", old.to_str().unwrap(), &new]).exits(2);
        let text = scratch.read(&new);
        let (_, problem) = parsed(name, &text, &[]);
        // The shipped case of this name was rewritten: both are the problem that the goldens hold.
        let (_, shipped) = load(name, &[""; 0]).unwrap();
        assert_eq!(format!("{:?}", problem.solver()), format!("{:?}", shipped.solver()), "{name}");
        // Every comment is still there.
        let comments = |text: &str| text.lines().filter(|line| line.contains("# ")).count();
        assert!(comments(&text) >= comments(&fs::read_to_string(&old).unwrap()), "{name}: {text}");
    }
    scratch.bedload(["migrate", "nowhere.toml", "-"]).exits(2);
    let err = scratch.bedload(["migrate", "sheet_1d_sumer91.toml", "-"]).exits(2).err;
    assert!(err.contains("of format 2 already"), "{err}");
}

/// Every comment that can be lost: c00 to c33.
const COMMENTED: &str = r#"# c00
format = 1 # c01
# c02
[case] # c03
title = "Creep" # c04
[fluid]
density = "1070 kg/m3"
viscosity = "0.27 Pa s"
[grains]
diameter = "2 mm"
density = "1190 kg/m3"
[bed]
# c05
level = "10 mm" # c06
phi = 0.6
[flow] # c07
# c08
height = "100 mm" # c09
pressure_gradient = "100 Pa/m"
# c10
[model] # c11
# c12
kind = "laminar" # c13
# c14
form = "mixed" # c15
# c16
[closures.friction] # c17
# c18
law = "coulomb" # c19
# c20
mu_s = 0.32 # c21
# c22
[closures.mixture_viscosity] # c23
law = "einstein" # c24
# c25
[regularisation] # c26
law = "none" # c27
# c28
[grid] # c29
cells = 40 # c30
# c31
[[check]] # c32
quantity = "yield_level_m"
expect = 0.0198687207224
tolerance = 1e-5
kind = "verification"
source = "quadrature"
# c33
"#;

#[test]
fn a_migrated_case_keeps_every_comment_its_unit_and_its_ends_of_lines() {
    let scratch = Scratch::new();
    scratch.write("old.toml", COMMENTED);
    scratch.bedload(["migrate", "old.toml", "new.toml"]).exits(0);
    let new = scratch.read("new.toml");
    for comment in (0..34).map(|i| format!("c{i:02}")) {
        assert_eq!(new.matches(&comment).count(), 1, "{comment}: {new}");
    }
    for piece in [
        "format = 2 # c01\n",
        "# c12\n# c13\n[laminar]\n# c14\nform",
        "# c25\n# c26\n[laminar.regularisation]",
        "# c22\nmixture_viscosity = \"einstein\" # c24\n",
        "depth = \"90 mm\"",
        "[[laminar.check]] # c32\n",
    ] {
        assert!(new.replace("# c23\n", "").contains(piece), "{piece}: {new}");
    }
    scratch.write("windows.toml", COMMENTED.replace('\n', "\r\n"));
    scratch.bedload(["migrate", "windows.toml", "ends.toml"]).exits(0);
    assert_eq!(scratch.read("ends.toml"), new.replace('\n', "\r\n"));
    // In two units, metres.
    scratch.write("metres.toml", COMMENTED.replace("\"100 mm\"", "\"0.1 m\""));
    let metres = scratch.bedload(["migrate", "metres.toml", "-"]).exits(0).out;
    assert!(metres.contains("depth = 0.09 "), "{metres}");
}

#[test]
fn a_migrated_case_keeps_its_model_and_the_checks_of_one_line() {
    let scratch = Scratch::new();
    let old = "format = 1\nfluid = { density = \"1000 kg/m3\", viscosity = \"1 Pa s\", yield_stress = \"10 Pa\" }\n\
        flow = { height = \"1 m\", mean_velocity = \"1 m/s\" }\ncase.title = \"Plug\"\n\
        model = { kind = \"exact\", solution = \"bingham-plane\" } # the truth\n";
    let row = "check = [ { quantity = \"bingham_number\", expect = 10.0, tolerance = 1e-12, kind = \"verification\", \
        source = \"the input\" } ]";
    scratch.write("bare.toml", old);
    let bare = scratch.bedload(["migrate", "bare.toml", "-"]).exits(0).out;
    assert!(bare.ends_with("\n# the truth\n[bingham-exact]\n"), "{bare}");
    scratch.write("row.toml", format!("{row}\n{old}"));
    scratch.bedload(["migrate", "row.toml", "new.toml"]).exits(0);
    assert!(scratch.read("new.toml").contains(&format!("[bingham-exact]\n{row}\n")));
    let out = scratch.bedload(["check", "new.toml"]).exits(0).out;
    assert!(out.contains("bingham-exact") && out.contains("1 check"), "{out}");
}

#[test]
fn a_migrated_bed_keeps_its_grains() {
    let scratch = Scratch::new();
    let old = fs::read_to_string(project("tests/format1/sheet_1d_sumer91.toml")).unwrap();
    let reading = "reading = \"final\"";
    assert!(old.contains(reading));
    scratch.write("rest.toml", old.replace(reading, "reading = \"initial\""));
    let rest = scratch.bedload(["migrate", "rest.toml", "-"]).exits(0).out;
    assert!(rest.contains("bed_level = \"at-rest\"") && rest.contains("\nphi = 0.62\n"), "{rest}");
    // What was left out was the level in the flow, and is another thing now.
    scratch.write("flow.toml", old.lines().filter(|line| !line.starts_with(reading)).collect::<Vec<_>>().join("\n"));
    let flow = scratch.bedload(["migrate", "flow.toml", "-"]).exits(0).out;
    assert!(flow.contains("bed_level = \"in-flow\"") && !flow.contains("\nphi = 0.62\n"), "{flow}");
}

#[test]
fn a_case_that_cannot_be_migrated_is_not_and_one_that_does_not_check_is_named() {
    let scratch = Scratch::new();
    let height = "height = \"100 mm\"";
    for (from, to, words) in [
        (height, "depth = \"90 mm\"\nheight = \"100 mm\"", "flow.height and flow.depth are both there"),
        (height, "height = \"9 mm\"", "line 18: flow.height = \"9 mm\" over bed.level = \"10 mm\" leaves no depth"),
        (height, "height = \"nan mm\"", "leaves no depth"),
        ("phi = 0.6", "thickness = \"1 mm\"\nphi = 0.6", "line 15: bed.level and bed.thickness are both there"),
    ] {
        scratch.write("old.toml", COMMENTED.replacen(from, to, 1));
        let err = scratch.bedload(["migrate", "old.toml", "new.toml"]).exits(2).err;
        assert!(err.contains(words), "{words}: {err}");
        assert!(!scratch.path("new.toml").exists(), "{words}");
    }
    scratch.write("old.toml", COMMENTED.replacen("phi = 0.6", "phi = 7", 1));
    let answer = scratch.bedload(["migrate", "old.toml", "new.toml"]).exits(2);
    assert!(answer.err.starts_with("the new file does not check yet; nothing was written:\n"), "{}", answer.err);
    assert!(answer.err.contains("bed.phi = 7 is out of range") && answer.err.contains("--unchecked"), "{}", answer.err);
    assert!(answer.out.is_empty() && !scratch.path("new.toml").exists(), "{}", answer.out);
    // Shown all the same, and written where it is asked for.
    let shown = scratch.bedload(["migrate", "old.toml", "-"]).exits(2);
    assert!(shown.out.contains("phi = 7\n") && shown.err.contains("out of range"), "{}", shown.err);
    let answer = scratch.bedload(["migrate", "old.toml", "new.toml", "--unchecked"]).exits(0);
    assert!(answer.err.starts_with("the new file does not check yet:\n"), "{}", answer.err);
    assert!(answer.err.contains("bed.phi = 7 is out of range"), "{}", answer.err);
    assert_eq!(answer.out, "wrote new.toml; mend it, then bedload check new.toml\n");
    assert_eq!(scratch.read("new.toml"), shown.out);
    assert!(scratch.read("new.toml").contains("phi = 7\n"));
}

#[test]
fn texts_of_several_lines_are_migrated_byte_for_byte() {
    let scratch = Scratch::new();
    let title = "\"\"\"\nCreep\n\n\n  in # no comment\n\n\n\n[no.table]\n \n\n\"\"\"";
    let source = "'''by\n\n\nquadrature'''";
    let old = COMMENTED.replacen("\"Creep\"", title, 1).replacen("\"quadrature\"", source, 1);
    scratch.write("old.toml", old.replacen("\n[fluid]", "\n\n\n\n[fluid]", 1));
    scratch.bedload(["migrate", "old.toml", "new.toml"]).exits(0);
    let new = scratch.read("new.toml");
    assert!(new.contains(&format!("title = {title}")) && new.contains(&format!("source = {source}")), "{new}");
    // Between the lines of the file one empty line is enough.
    let gaps = new.replace(title, "").replace(source, "");
    assert!(!gaps.contains("\n\n\n"), "{new}");
}
