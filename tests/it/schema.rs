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
    let named: Vec<String> = alternatives
        .iter()
        .map(|a| {
            assert_eq!(a["additionalProperties"], false);
            let word = |key: &str| a["properties"]["model"]["properties"][key]["oneOf"][0]["const"].as_str();
            let kind = word("kind").unwrap();
            word("solution").map_or_else(|| kind.to_owned(), |solution| format!("{kind}/{solution}"))
        })
        .collect();
    let listed: Vec<&str> = models["models"].as_array().unwrap().iter().map(|m| m["name"].as_str().unwrap()).collect();
    assert_eq!(named, listed);
    let mut properties = 0;
    described(&schema, "", &mut properties);
    assert!(properties > 40, "{properties} properties");
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
        let Ok(committed) = fs::read_to_string(project(file)) else {
            println!("skipped: there is no {file}");
            continue;
        };
        let command = format!("cargo run --release -- {} > {file}", arguments.join(" "));
        assert!(committed == wanted, "{file} is out of step; write it again: {command}");
    }
}
