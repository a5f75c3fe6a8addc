//! The kinds of case: for each model its tables, their schema, and how a checked document becomes them.
//!
//! The case knows no model. Whoever knows them hands in [`Kinds`]; a model declares its tables with [`tables!`](crate::tables).

use std::fmt::Debug;

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::checks::{Check, Limit};
use super::tables::About;

/// The tables of a case: what the model itself needs, and what every case has.
pub trait Tables: Clone + Debug + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static {
    /// What the case is about.
    fn about(&self) -> &About;
    /// Numbers that the case must give.
    fn checks(&self) -> &[Check];
    /// Where the method of the case ends.
    fn limit(&self) -> Option<&Limit>;
}

/// Declares the tables of a model: a struct with these tables and those of every case.
///
/// A law may be open, `pub struct Mine<F: Role = Usual>`. The doc line of the struct is the description of the model in `list models`, schema and reference.
#[macro_export]
macro_rules! tables {
    ($(#[$doc:meta])* pub struct $name:ident $(<$law:ident: $role:ident = $usual:ty>)? { $($(#[$attribute:meta])* $table:ident: $type:ty,)* }) => {
        #[derive(Clone, Debug, PartialEq, ::serde::Serialize, ::serde::Deserialize, ::schemars::JsonSchema)]
        #[serde(bound = "")]
        #[schemars(bound = "")]
        $(#[$doc])*
        pub struct $name $(<$law: $role = $usual>)? {
            /// Version of the file format.
            #[schemars(extend("minimum" = 1, "maximum" = 1))]
            pub format: u32,
            /// What the case is about.
            pub case: $crate::case::tables::About,
            $($(#[$attribute])* pub $table: $type,)*
            /// Numbers that the case must give.
            #[serde(default, skip_serializing_if = "Vec::is_empty")]
            pub check: Vec<$crate::case::checks::Check>,
            /// Where the method ends.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub limit: Option<$crate::case::checks::Limit>,
        }

        impl $(<$law: $role>)? $crate::case::Tables for $name $(<$law>)? {
            fn about(&self) -> &$crate::case::tables::About {
                &self.case
            }

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
    /// `kind` or `kind/solution`
    pub name: &'static str,
    /// its JSON Schema
    pub(super) schema: Value,
    pub(super) read: fn(Value) -> Result<Content, serde_json::Error>,
}

impl Kind {
    /// The cases with the tables `T`, of a model called `name`.
    #[must_use]
    pub fn of<T: Tables>(name: &'static str) -> Self {
        let settings = SchemaSettings::draft2020_12().with(|s| {
            s.inline_subschemas = true;
            s.meta_schema = None;
        });
        let mut schema = settings.into_generator().into_root_schema_for::<T>().to_value();
        close(&mut schema);
        Self { name, schema, read: read::<T> }
    }

    /// `kind` and, if there is one, `solution`.
    pub(super) fn tags(&self) -> (&'static str, Option<&'static str>) {
        self.name.split_once('/').map_or((self.name, None), |(kind, solution)| (kind, Some(solution)))
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
            object.values_mut().for_each(close);
        }
        Value::Array(items) => items.iter_mut().for_each(close),
        _ => {}
    }
}

/// A checked document as tables, and back with every default filled in.
fn read<T: Tables>(document: Value) -> Result<Content, serde_json::Error> {
    let tables: T = serde_json::from_value(document)?;
    let values = serde_json::to_value(&tables)?;
    Ok(Content {
        resolved: text(values.clone()),
        about: tables.about().clone(),
        checks: tables.checks().to_vec(),
        limit: tables.limit().cloned(),
        tables: values,
    })
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

/// All kinds of case that a program knows, in the order of its models.
#[derive(Clone, Debug, Default)]
pub struct Kinds(pub(super) Vec<Kind>);

impl Kinds {
    /// These kinds.
    #[must_use]
    pub fn new(kinds: Vec<Kind>) -> Self {
        Self(kinds)
    }

    /// One more kind, in place of one of the same name.
    pub fn push(&mut self, kind: Kind) {
        self.0.retain(|known| known.name != kind.name);
        self.0.push(kind);
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Kind> {
        self.0.iter()
    }

    pub(super) fn first(&self) -> Option<&Kind> {
        self.0.first()
    }
}
