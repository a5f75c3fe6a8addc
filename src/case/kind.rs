//! The kinds of case: for each model its tables, their schema, and how a checked document becomes them.
//!
//! The case knows no model. Whoever knows them hands in [`Kinds`]; a model declares its table with [`part!`](crate::part).

use std::fmt::Debug;

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};

use super::checks::{Check, Limit};
use super::fault::Fault;
use super::tables::About;

/// The tables of a kind of flow, whatever the model: fluid, grains, bed, flow.
pub trait FlowTables: Clone + Debug + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static {
    /// The word after `scene =`.
    const KIND: &'static str;

    /// What no schema can see: values that contradict each other, by path.
    fn faults(&self) -> Vec<(&'static str, Fault)> {
        Vec::new()
    }

    /// What is given of what not every model solves, by path.
    fn given(&self) -> Vec<&'static str> {
        Vec::new()
    }

    /// The word for what bounds the flow above, if that is a choice.
    fn top(&self) -> Option<&'static str> {
        None
    }
}

/// The table of a model: what a case says besides the flow.
pub trait Part: Clone + Debug + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static {
    /// Numbers that the model must give.
    fn checks(&self) -> &[Check];
    /// Where its method ends.
    fn limit(&self) -> Option<&Limit>;
}

/// Declares the table of a model: a struct with these keys, its checks and its limit.
///
/// The doc line of the struct is the description of the model.
#[macro_export]
macro_rules! part {
    ($(#[$doc:meta])* pub struct $name:ident $(<$law:ident: $role:ident = $usual:ty>)? { $($(#[$attribute:meta])* $key:ident: $type:ty,)* }) => {
        #[derive(Clone, Debug, PartialEq, ::serde::Serialize, ::serde::Deserialize, ::schemars::JsonSchema)]
        #[serde(bound = "")]
        #[schemars(bound = "")]
        $(#[$doc])*
        pub struct $name $(<$law: $role = $usual>)? {
            $($(#[$attribute])* pub $key: $type,)*
            /// Numbers that the model must give.
            #[serde(default, skip_serializing_if = "Vec::is_empty")]
            pub check: Vec<$crate::case::checks::Check>,
            /// Where the method ends.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub limit: Option<$crate::case::checks::Limit>,
        }

        impl $(<$law: $role>)? $crate::case::Part for $name $(<$law>)? {
            fn checks(&self) -> &[$crate::case::checks::Check] {
                &self.check
            }

            fn limit(&self) -> Option<&$crate::case::checks::Limit> {
                self.limit.as_ref()
            }
        }
    };
}

/// What a case says, whatever its model.
#[derive(Clone, Debug)]
pub(super) struct Content {
    /// every table with its defaults filled in, SI
    pub tables: Value,
    /// the same as the text of a case file
    pub resolved: String,
    /// what the case is about
    pub about: About,
    /// numbers that it must give
    pub checks: Vec<Check>,
    /// where its method ends
    pub limit: Option<Limit>,
}

/// The cases of one model.
#[derive(Clone, Debug)]
pub struct Kind {
    /// name of the model and of its table
    pub name: &'static str,
    /// the kind of flow
    pub(super) scene: &'static str,
    /// its JSON Schema
    pub(super) schema: Value,
    read: fn(&'static str, Value) -> Result<Content, serde_json::Error>,
}

impl Kind {
    /// The cases with the flow `S` and a table `T` of a model called `name`.
    #[must_use]
    pub fn of<S: FlowTables, T: Part>(name: &'static str) -> Self {
        let (flow, mut own) = (schema_of::<S>(), schema_of::<T>());
        let of = |schema: &Value, keyword: &str| schema.get(keyword).cloned().unwrap_or_default();
        let mut properties = Map::new();
        let format =
            json!({ "type": "integer", "minimum": 2, "maximum": 2, "description": "Version of the file format." });
        properties.insert("format".into(), format);
        properties.insert(SCENE.into(), json!({ "type": "string", "const": S::KIND }));
        properties.insert("case".into(), schema_of::<About>());
        properties.extend(of(&flow, "properties").as_object().cloned().unwrap_or_default());
        let description = of(&own, "description");
        let mut required = vec![json!("format"), json!(SCENE), json!("case")];
        required.extend(of(&flow, "required").as_array().cloned().unwrap_or_default());
        if own.get("required").is_some() {
            required.push(json!(name));
        }
        own["title"] = name.into();
        properties.insert(name.into(), own);
        let mut schema = json!({
            "title": name, "description": description, "type": "object", "properties": properties, "required": required,
        });
        close(&mut schema);
        Self { name, scene: S::KIND, schema, read: read::<S, T> }
    }

    /// A checked document as what it says.
    pub(super) fn content(&self, document: Value) -> Result<Content, serde_json::Error> {
        (self.read)(self.name, document)
    }
}

/// Objects take no other keys; `null` is not a TOML value.
fn close(schema: &mut Value) {
    match schema {
        Value::Object(object) => {
            if object.contains_key("properties") {
                object.insert("additionalProperties".into(), false.into());
            }
            if let Some(Value::Array(types)) = object.get_mut("type") {
                types.retain(|t| t != "null");
                if let [only] = types.as_slice() {
                    let only = only.clone();
                    object.insert("type".into(), only);
                }
            }
            // A choice that may be left out is the choice.
            if let Some(Value::Array(mut choices)) = object.shift_remove("anyOf") {
                choices.retain(|choice| choice.get("type").is_none_or(|t| t != "null"));
                if let Some(Value::Object(choice)) = choices.pop() {
                    choice.into_iter().for_each(|(keyword, value)| {
                        object.entry(keyword).or_insert(value);
                    });
                }
            }
            object.values_mut().for_each(close);
        }
        Value::Array(items) => items.iter_mut().for_each(close),
        _ => {}
    }
}

fn schema_of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| {
        s.inline_subschemas = true;
        s.meta_schema = None;
    });
    let mut schema = settings.into_generator().into_root_schema_for::<T>().to_value();
    close(&mut schema);
    schema
}

/// A checked case as tables, and back with every default filled in.
fn read<S: FlowTables, T: Part>(name: &'static str, mut document: Value) -> Result<Content, serde_json::Error> {
    let about: About = serde_json::from_value(document["case"].clone())?;
    let own = document.as_object_mut().and_then(|tables| tables.shift_remove(name)).unwrap_or_else(|| json!({}));
    let (flow, own): (S, T) = (serde_json::from_value(document)?, serde_json::from_value(own)?);
    let mut tables = Map::new();
    tables.insert("format".into(), json!(2));
    tables.insert(SCENE.into(), S::KIND.into());
    tables.insert("case".into(), serde_json::to_value(&about)?);
    tables.extend(serde_json::to_value(&flow)?.as_object().cloned().unwrap_or_default());
    tables.insert(name.into(), serde_json::to_value(&own)?);
    let tables = Value::Object(tables);
    let (checks, limit) = (own.checks().to_vec(), own.limit().cloned());
    Ok(Content { resolved: text(tables.clone()), about, checks, limit, tables })
}

/// Tables as a case file. From values rather than from each type: the compiler then makes one TOML writer, not one a type.
#[must_use]
pub fn text(mut tables: Value) -> String {
    drop_nulls(&mut tables);
    toml::to_string(&tables).unwrap_or_default()
}

/// TOML has no null: a value that is not given is left out.
fn drop_nulls(value: &mut Value) {
    match value {
        Value::Object(map) => {
            map.retain(|_, value| !value.is_null());
            map.values_mut().for_each(drop_nulls);
        }
        Value::Array(values) => values.iter_mut().for_each(drop_nulls),
        _ => {}
    }
}

/// The key that names the kind of flow.
pub(super) const SCENE: &str = "scene";
/// Tables that every model shares, and what stands beside them: what is none of these in `--set` is a key of the model.
pub(super) const SHARED: [&str; 7] = ["format", SCENE, "case", "fluid", "grains", "bed", "flow"];

/// All kinds of case that a program knows, in the order of its models.
#[derive(Clone, Debug, Default)]
pub struct Kinds {
    known: Vec<Kind>,
    /// the model of a case that has several
    pub(super) chosen: Option<String>,
    /// whether there may be tables of models that are not among these
    pub(super) partial: bool,
}

impl Kinds {
    /// These kinds.
    #[must_use]
    pub fn new(kinds: Vec<Kind>) -> Self {
        let mut all = Self::default();
        kinds.into_iter().for_each(|kind| all.push(kind));
        all
    }

    /// One more kind, in place of one of the same name.
    pub fn push(&mut self, kind: Kind) {
        self.known.retain(|known| known.name != kind.name);
        self.known.push(kind);
    }

    /// The same, where a case with several models is that of `model`.
    #[must_use]
    pub fn choosing(mut self, model: &str) -> Self {
        self.chosen = Some(model.to_owned());
        self
    }

    /// The same, where a case may have the tables of models that are not among them.
    #[must_use]
    pub fn partial(mut self) -> Self {
        self.partial = true;
        self
    }

    /// All of them.
    pub(super) fn iter(&self) -> impl Iterator<Item = &Kind> {
        self.known.iter()
    }

    /// The words after `scene =`, in the order of the models.
    pub(super) fn scenes(&self) -> Vec<&'static str> {
        let mut scenes: Vec<&str> = Vec::new();
        for kind in &self.known {
            if !scenes.contains(&kind.scene) {
                scenes.push(kind.scene);
            }
        }
        scenes
    }
}
