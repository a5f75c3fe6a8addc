//! Valid forms of a case are accepted, whatever TOML they use; the shipped cases keep their form.

use std::fs;

use bedload::case::{Case, shipped};
use serde_json::Value;

use crate::support::{REGISTRY, Scratch, files, load, parse, project};

/// The resolved case of a text that must be valid.
#[track_caller]
fn resolved(text: &str) -> String {
    match parse("case", text) {
        Ok((case, _)) => case.resolved(),
        Err(error) => panic!("{}", error.render(false)),
    }
}

fn aussillous() -> String {
    shipped::find("exact_1d_aussillous").unwrap().content.to_owned()
}

#[test]
fn dotted_keys_and_inline_tables_are_the_same_case() {
    let wanted = resolved(&aussillous());
    let checks = aussillous().split_once("[[laminar-exact.check]]").unwrap().1.to_owned();
    let inline = r#"
        format = 2
        scene = "bed"
        case.title = "Laminar bedload: Aussillous et al. (2013), closed form"
        fluid = { density = "1.07 g/cm3", viscosity = 0.27 }
        grains = { diameter = 2e-3, density = 1190 }
        bed.thickness = "3.224 cm"
        bed.phi = "60 %"
        "flow".'depth' = "16.38 d"
        flow.pressure_gradient = "0.1 kPa/m"
        flow.top = { law = "plane" }
        laminar-exact.form = "mixed"
        laminar-exact.closures.friction = { law = "coulomb", mu_s = 0.32 }
        laminar-exact.closures.mixture_viscosity.law = "einstein"
    "#;
    assert_eq!(resolved(&format!("{inline}\n[[laminar-exact.check]]{checks}")), wanted);
    let windows = aussillous().replace('\n', "\r\n");
    assert_eq!(resolved(&windows), wanted);
    assert_eq!(resolved(&format!("\u{feff}{}", aussillous())), wanted);
}

#[test]
fn the_order_of_tables_does_not_matter() {
    let text = aussillous();
    let (head, tables) = text.split_once("\n[").unwrap();
    let (tables, checks) = tables.split_once("\n[[laminar-exact.check]]").unwrap();
    let mut parts: Vec<&str> = tables.split("\n[").collect();
    parts.reverse();
    let reversed = format!("{head}\n[{}\n\n[[laminar-exact.check]]{checks}", parts.join("\n["));
    assert_ne!(reversed, text);
    assert_eq!(resolved(&reversed), resolved(&text));
}

#[test]
fn overrides_change_add_and_remove_values() {
    let with = |overrides: &[&str]| load("exact_1d_aussillous", overrides).map(|(case, _)| case.resolved());
    let plain = with(&[]).unwrap();
    assert_eq!(with(&["bed.thickness=0.03224"]).unwrap(), plain);
    assert!(with(&["bed.thickness = 30 mm"]).unwrap().contains("thickness = 0.03\n"));
    let shields = with(&["flow.pressure_gradient=", "flow.shields=0.5"]).unwrap();
    assert!(shields.contains("shields = 0.5") && !shields.contains("pressure_gradient"));
    assert!(with(&["grid.cells=50"]).unwrap().contains("cells = 50"));
    assert!(with(&["check.0.expect=1.5"]).unwrap().contains("expect = 1.5"));
    for wrong in
        ["bed.thickness", "=1", "bed..level=1", "bed[0]=1", "bed.thickness.deep=1", "check.9.expect=1", "bed.lvel=1"]
    {
        let error = with(&[wrong]).unwrap_err();
        assert!(error.render(false).contains(wrong), "{wrong}: {}", error.render(false));
        assert!(error.reports().iter().all(|r| r.line.is_none()), "{wrong} points into the file");
    }
}

#[test]
fn a_slope_in_degrees_is_the_angle_whatever_a_number_would_be() {
    let angle = "slope = \"24 deg\"";
    let radians = format!("slope = {:?}\nslope_definition = \"angle\"", 24.0 * (std::f64::consts::PI / 180.0));
    for (name, line) in [
        ("exact_1d_bagnold", "slope = \"24 deg\"\nslope_definition = \"angle\""),
        ("grains_3d_chute", "slope = \"24 deg\"\nslope_definition = \"angle\""),
        ("kinetic_1d_mu02", "slope = 0.05\nslope_definition = \"sine\""),
        ("flume_exp14_quick", "slope = 0.1\nslope_definition = \"tangent\""),
        ("sheet_1d_limit_slope_a", "slope = 0.02\nslope_definition = \"sine\""),
    ] {
        let text = shipped::find(name).unwrap().content;
        assert!(text.contains(line), "{name} has no {line}");
        let [short, long] = [angle, &radians].map(|slope| resolved(&text.replace(line, slope)));
        assert_eq!(short, long, "{name}");
        assert_eq!(resolved(&short), short, "{name}");
        // A percentage is a ratio, as ever, where a definition says which.
        let tangent = "slope = \"5 %\"\nslope_definition = \"tangent\"";
        assert!(resolved(&text.replace(line, tangent)).contains("slope = 0.05\n"), "{name}");
    }
    let with = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Case::load(REGISTRY.kinds(), "flume_exp14_quick", &sets).map(|case| case.resolved())
    };
    assert!(with(&["flow.slope=2 deg"]).is_err(), "the file says tangent");
    assert!(with(&["flow.slope=2 deg", "flow.slope_definition="]).unwrap().contains("slope_definition = \"angle\""));
}

#[test]
fn a_number_is_set_as_what_it_is_in_the_case() {
    let film = shipped::find("exact_1d_bagnold").unwrap().content.replace("slope_definition = \"angle\"\n", "");
    let case = Case::parse(REGISTRY.kinds(), "film", "film", film.clone(), &[]).unwrap();
    let set = case.setting("flow.slope", 0.4);
    assert_eq!(set, "flow.slope=4e-1 rad");
    assert_eq!(case.setting("bed.thickness", 0.02), "bed.thickness=2e-2");
    let again = Case::parse(REGISTRY.kinds(), "film", "film", film, &[set]).unwrap().resolved();
    assert!(again.contains("slope = 0.4\nslope_definition = \"angle\""), "{again}");
    let tangent = Case::load(REGISTRY.kinds(), "flume_exp14_quick", &[]).unwrap();
    assert_eq!(tangent.setting("flow.slope", 0.4), "flow.slope=4e-1");
}

#[test]
fn the_shipped_list_is_the_folder() {
    let in_folder: Vec<String> = files(&project("cases"), "toml")
        .iter()
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    assert_eq!(shipped::files().collect::<Vec<_>>(), in_folder, "src/case/shipped.rs against cases/");
    for (name, content, models) in shipped::FILES {
        let file = fs::read_to_string(project(&format!("cases/{name}.toml"))).unwrap();
        assert_eq!(*content, file, "{name}: build again");
        // The models of a file that has several are those of its list.
        let tables: toml::Table = file.parse().unwrap();
        let known = |table: &&String| REGISTRY.entries().any(|entry| entry.info.name == table.as_str());
        let found: Vec<&String> = tables.keys().filter(known).collect();
        assert!(found.len() == 1 && models.is_empty() || found == *models, "{name}: {found:?}");
    }
}

#[test]
fn shipped_cases_keep_the_order_of_tables_and_say_what_they_ask() {
    let order = "format case fluid grains bed flow";
    // The tables of models come after those of the flow.
    let rank = |table: &str| {
        let table = table.split('.').next().unwrap_or(table).to_owned();
        let model = REGISTRY.entries().any(|entry| entry.info.name == table);
        order.split(' ').position(|t| t == table).or(model.then_some(9))
    };
    for (name, text, _) in shipped::FILES {
        let header: Vec<&str> = text.lines().take_while(|l| l.starts_with('#')).collect();
        let comment = header.iter().filter(|l| l.starts_with("# ")).copied().collect::<Vec<_>>().join(" ");
        assert!(comment.contains('?'), "{name}: the header asks no question");
        assert!(comment.contains("Expected:"), "{name}: the header does not say the seconds");
        let tables = text.lines().filter(|l| l.starts_with('[')).map(|l| l.trim_matches(['[', ']']));
        let ranks: Vec<usize> = tables.map(|t| rank(t).unwrap_or_else(|| panic!("{name}: [{t}]"))).collect();
        assert!(ranks.is_sorted(), "{name}: tables out of order");
        assert!(text.lines().any(|l| l == "format = 2"), "{name}");
        assert!(text.contains(".check]]") || text.contains(".limit]"), "{name} tests nothing");
        assert!(name.contains('_'), "{name} is not <engine>_<dim>_<physics> or <flow>_<number>");
    }
}

#[test]
fn shipped_cases_are_valid_and_resolve_to_themselves() {
    let scratch = Scratch::new();
    for name in shipped::names() {
        let said = scratch.bedload(["check", name]).exits(0).out;
        assert!(said.starts_with(&format!("{name}: valid, ")), "{said}");
        let (case, problem) = load(name, &[""; 0]).unwrap();
        let once = case.resolved();
        let (again, same) = parse(name, &once).unwrap_or_else(|e| panic!("{}", e.render(false)));
        assert_eq!(again.resolved(), once, "{name}");
        assert_eq!(format!("{:?}", same.solver()), format!("{:?}", problem.solver()), "{name}");
    }
}

/// A value that `schema` allows, as it is written in TOML: numbers in the middle of their range, every key given.
fn allowed(schema: &Value) -> String {
    if let Some(choices) = schema["oneOf"].as_array() {
        let first = &choices[0];
        return first["const"].as_str().map_or_else(|| allowed(first), |word| format!("\"{word}\""));
    }
    let bound = |inclusive: &str, exclusive: &str| schema[inclusive].as_f64().or(schema[exclusive].as_f64());
    let (low, high) = (bound("minimum", "exclusiveMinimum"), bound("maximum", "exclusiveMaximum"));
    let middle = 0.5 * (low.unwrap_or(0.0) + high.unwrap_or(2.0));
    match (&schema["properties"], schema["type"].as_str()) {
        (Value::Object(keys), _) => {
            let written = |(key, of): (&String, &Value)| {
                format!("{key} = {}", of["const"].as_str().map_or_else(|| allowed(of), |word| format!("\"{word}\"")))
            };
            format!("{{ {} }}", keys.iter().map(written).collect::<Vec<_>>().join(", "))
        }
        (_, Some("boolean")) => "true".into(),
        (_, Some("integer")) => format!("{middle:.0}"),
        _ => format!("{middle:?}"),
    }
}

/// Each law that a model takes, as a setting: `closures.drag={ law = "...", ... }`, the laws within laws included.
fn laws(closures: &Value, path: &str, found: &mut Vec<String>) {
    for (role, schema) in closures["properties"].as_object().into_iter().flatten() {
        let path = format!("{path}.{role}");
        for law in schema["oneOf"].as_array().into_iter().flatten() {
            let word = law["properties"]["law"]["const"].as_str();
            let setting =
                word.map(|_| allowed(law)).or_else(|| law["const"].as_str().map(|word| format!("\"{word}\"")));
            found.extend(setting.map(|setting| format!("{path}={setting}")));
            laws(law, &path, found);
        }
    }
}

#[test]
fn every_law_of_every_model_resolves_to_itself() {
    let kinds = REGISTRY.kinds();
    let schema = bedload::case::schema::published(kinds);
    let mut tried = 0;
    for entry in REGISTRY.entries() {
        let of = |scene: &&Value| scene["properties"].get(entry.info.name).is_some();
        let schema = &schema["oneOf"].as_array().unwrap().iter().find(of).unwrap()["properties"][entry.info.name];
        let of_model = |name: &&str| Case::load(kinds, name, &[]).unwrap().model == entry.info.name;
        let name = shipped::names().find(of_model).unwrap_or_else(|| panic!("no case of {}", entry.info.name));
        let mut settings = Vec::new();
        laws(&schema["properties"]["closures"], "closures", &mut settings);
        for setting in settings {
            // A law within a law is one of the first that has it.
            let Ok(case) = Case::load(kinds, name, std::slice::from_ref(&setting)) else {
                assert!(setting.split('=').next().unwrap().matches('.').count() > 1, "{name}: {setting}");
                continue;
            };
            let once = case.resolved();
            let again = Case::parse(kinds, name, "case.toml", once.clone(), &[]);
            let again = again.unwrap_or_else(|error| panic!("{name}, {setting}: {}", error.render(false)));
            assert_eq!(again.resolved(), once, "{name}: {setting}");
            let law = setting.split('"').nth(1).unwrap();
            assert!(once.contains(&format!("\"{law}\"")), "{setting} is lost:\n{once}");
            tried += 1;
        }
    }
    assert!(tried > 60, "{tried} laws");
}
