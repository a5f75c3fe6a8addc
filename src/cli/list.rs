//! `bedload list`: what there is.

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::{Answers, CliError, Verb, say};
use crate::case::{Case, schema, shipped};
use crate::closures::{Standing, catalogue};
use crate::model::Registry;

/// List models, shipped cases and closures.
#[derive(Clone, Debug, Args)]
pub(super) struct List {
    /// What to list; everything if left out
    #[arg(value_enum)]
    what: Option<What>,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum What {
    Models,
    Cases,
    Closures,
}

impl Verb for List {
    fn json(&self) -> bool {
        self.json
    }

    fn execute(self, registry: &Registry, answers: &Answers) -> Result<(), CliError> {
        let wanted = |what| self.what.is_none_or(|w| w == what);
        let mut sections: Vec<(&str, Vec<(String, String)>)> = Vec::new();
        if wanted(What::Models) {
            sections.push((
                "models",
                schema::models(registry.kinds())
                    .map(|(name, scene, about)| (name.into(), format!("{about} Scene: {scene}.")))
                    .collect(),
            ));
        }
        if wanted(What::Cases) {
            let about = |name: &str| {
                Case::load(registry.kinds(), name, &[]).map(|c| c.about().title.clone()).unwrap_or_default()
            };
            sections.push(("cases", shipped::names().map(|name| (name.to_owned(), about(name))).collect()));
        }
        if wanted(What::Closures) {
            let standing = |s| if s == Standing::Validated { "" } else { "  (experimental)" };
            let row = |i: &crate::closures::Info| {
                (format!("{}/{}", i.family, i.law), format!("{}{}", i.equation, standing(i.standing)))
            };
            sections.push(("closures", catalogue().map(row).collect()));
        }
        if self.json {
            let object = |(title, rows): &(&str, Vec<(String, String)>)| {
                let rows: Vec<Value> =
                    rows.iter().map(|(name, about)| json!({ "name": name, "about": about })).collect();
                ((*title).to_owned(), Value::from(rows))
            };
            return Ok(answers.give(&Value::Object(sections.iter().map(object).collect()))?);
        }
        let mut text = String::new();
        for (title, rows) in &sections {
            let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
            text += &format!("{title}\n");
            for (name, about) in rows {
                text += &format!("  {name:<width$}  {about}\n");
            }
        }
        Ok(say(&text)?)
    }
}
