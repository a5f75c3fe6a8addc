//! The published schema: one alternative per model, in step with the committed files.

use std::fs;

use serde_json::Value;

use crate::support::{Scratch, project};

#[test]
fn the_schema_is_one_of_the_models() {
    let scratch = Scratch::new();
    let schema = scratch.bedload(["schema"]).exits(0).json();
    let alternatives = schema["oneOf"].as_array().unwrap();
    let models = scratch.bedload(["list", "models", "--json"]).exits(0).json();
    let named: usize = alternatives
        .iter()
        .map(|a| {
            assert_eq!(a["additionalProperties"], false);
            let scene = a["properties"]["scene"]["const"].as_str().unwrap();
            let of = |model: &&Value| model["about"].as_str().unwrap().ends_with(&format!("Scene: {scene}."));
            let models = models["models"].as_array().unwrap().iter().filter(of);
            models.map(|m| m["name"].as_str().unwrap()).filter(|name| a["properties"].get(name).is_some()).count()
        })
        .sum();
    assert_eq!((alternatives.len(), named), (4, models["models"].as_array().unwrap().len()));
    let mut properties = 0;
    described(&schema, "", &mut properties);
    assert!(properties > 40, "{properties} properties");
}

#[test]
fn a_slope_with_a_unit_needs_no_definition_and_a_number_does() {
    let scratch = Scratch::new();
    let schema = scratch.bedload(["schema"]).exits(0).json();
    let flows = schema["oneOf"].as_array().unwrap().iter().map(|model| &model["properties"]["flow"]);
    let slopes: Vec<&Value> = flows.filter(|flow| flow["properties"]["slope"].is_object()).collect();
    assert_eq!(slopes.len(), 2, "bed and granular");
    for flow in slopes {
        let required = flow["required"].as_array();
        assert!(required.is_none_or(|keys| keys.iter().all(|key| key != "slope_definition")), "{flow}");
        assert_eq!(flow["if"]["required"][0], "slope");
        let pattern = flow["if"]["properties"]["slope"]["pattern"].as_str().unwrap();
        assert!(pattern.contains("deg|rad"), "{pattern}");
        assert_eq!(flow["then"]["properties"]["slope_definition"]["const"], "angle");
        assert_eq!(flow["else"]["then"]["required"][0], "slope_definition", "a number says nothing without one");
    }
}

/// Every property says what it is.
fn described(schema: &Value, path: &str, count: &mut usize) {
    for (name, property) in schema["properties"].as_object().into_iter().flatten() {
        let path = format!("{path}.{name}");
        // The tag of a law is described by its table.
        let said = property.get("const").is_some() || property["description"].as_str().is_some_and(|d| d.len() > 3);
        assert!(said, "{path} says nothing of itself");
        *count += 1;
        described(property, &path, count);
        described(&property["items"], &path, count);
    }
    for alternative in schema["oneOf"].as_array().into_iter().flatten() {
        described(alternative, path, count);
    }
}

#[test]
fn committed_files_are_in_step() {
    let scratch = Scratch::new();
    for (file, arguments) in
        [("docs/case.schema.json", &["schema"] as &[&str]), ("docs/case-reference.md", &["schema", "--reference"])]
    {
        let wanted = scratch.bedload(arguments).exits(0).out;
        assert!(wanted.len() > 1000);
        let committed = fs::read_to_string(project(file)).unwrap_or_default();
        let command = format!("cargo run --release -- {} > {file}", arguments.join(" "));
        assert!(committed == wanted, "{file} is out of step; write it again: {command}");
    }
}
