//! `bedload migrate`: a case of format 1 as one of format 2, key by key, with its comments and its units.

use std::path::{Path, PathBuf};

use clap::Args;
use toml_edit::{ArrayOfTables, Decor, DocumentMut, InlineTable, Item, Key, Table, TableLike, Value};

use super::new::write_new;
use super::{Answers, CliError, Verb, say};
use crate::case::format1::{ACROSS, Form, HEIGHT, TOP_HEIGHT};
use crate::model::Registry;
use crate::units::parse_quantity;

/// Write a case of format 1 in format 2: the flow, and the table of its model. Comments, units and what was left out stay as they are.
#[derive(Clone, Debug, Args)]
pub(super) struct Migrate {
    /// File of format 1
    #[arg(value_name = "OLD")]
    old: PathBuf,
    /// File to write; `-` for standard output
    #[arg(value_name = "NEW")]
    new: PathBuf,
    /// Replace the file if it is there
    #[arg(long)]
    force: bool,
}

impl Verb for Migrate {
    fn execute(self, _: &Registry, _: &Answers) -> Result<(), CliError> {
        let text = migrated(&read(&self.old)?).map_err(|(problem, hint)| CliError::Usage {
            message: format!("{}: {problem}", self.old.display()),
            hint,
        })?;
        if self.new.as_os_str() == "-" {
            return Ok(say(&text)?);
        }
        write_new(&self.new, &text, self.force)?;
        let file = self.new.display();
        Ok(say(&format!("wrote {file}; next: bedload check {file}\n"))?)
    }
}

fn read(path: &Path) -> Result<String, CliError> {
    std::fs::read_to_string(path).map_err(|error| CliError::Usage {
        message: format!("cannot read {}: {error}", path.display()),
        hint: "OLD is a file of format 1; shipped cases are of format 2 already".into(),
    })
}

/// What is wrong with a file, and a hint.
type Refused = (String, String);

/// A case of format 1 as the text of one of format 2.
fn migrated(text: &str) -> Result<String, Refused> {
    let hint = || "docs/scenes.md says how a case of format 2 is written".to_owned();
    let old: DocumentMut = text.parse().map_err(|error: toml_edit::TomlError| {
        (format!("it is no TOML: {}", error.message()), "mend the file first".to_owned())
    })?;
    let word = |path: [&str; 2]| old.get(path[0]).and_then(|table| table.get(path[1])).and_then(Item::as_str);
    if old.get("scene").is_some() {
        return Err(("it is of format 2 already".into(), "bedload check says whether it is right".into()));
    }
    let Some(kind) = word(["model", "kind"]) else {
        return Err(("it has no kind in [model], so it is no case of format 1".into(), hint()));
    };
    let form = Form::of(kind, word(["model", "solution"]))
        .ok_or_else(|| (format!("format 1 has no model \"{kind}\" with this solution"), hint()))?;
    Ok(Moving { form, new: DocumentMut::new() }.moved(&old))
}

struct Moving {
    form: &'static Form,
    new: DocumentMut,
}

impl Moving {
    fn moved(mut self, old: &DocumentMut) -> String {
        let header = old.iter().next().and_then(|(key, _)| old.key(key)).map(|key| key.leaf_decor().clone());
        self.new.insert_formatted(&decorated("format", header), toml_edit::value(2));
        self.new.insert("scene", toml_edit::value(self.form.scene));
        // The tables of the flow come first, in their order, then the model's.
        for table in ["case", "fluid", "grains", "bed", "flow"] {
            let here = old.get(table).and_then(Item::as_table_like);
            let _ = here.is_some_and(|here| self.shell(table, &old[table], here));
        }
        let order = [
            "case",
            "fluid",
            "grains",
            "bed",
            "flow",
            "model",
            "closures",
            "regularisation",
            "grid",
            "solver",
            "discrete",
        ];
        let rank = |key: &str| order.iter().position(|known| *known == key).unwrap_or(order.len());
        let mut tables: Vec<&str> = old.iter().map(|(key, _)| key).filter(|key| *key != "format").collect();
        tables.sort_by_key(|key| rank(key));
        for table in tables {
            match &old[table] {
                Item::ArrayOfTables(rows) => self.rows(table, rows),
                item => {
                    if let Some(keys) = item.as_table_like() {
                        self.keys(table, keys);
                    }
                }
            }
        }
        self.unsaid();
        self.depth();
        self.new.retain(|_, item| item.as_table().is_none_or(|table| !table.is_empty()));
        self.new.decor_mut().set_suffix(old.trailing().as_str().unwrap_or_default());
        let mut text = self.new.to_string();
        while text.contains("\n\n\n") {
            text = text.replace("\n\n\n", "\n\n");
        }
        text
    }

    /// The table of the flow that will take keys, with the comment over it.
    fn shell(&mut self, name: &str, item: &Item, _: &dyn TableLike) -> bool {
        let mut table = Table::new();
        *table.decor_mut() = item.as_table().map_or_else(|| Decor::new("\n", ""), |table| spaced(table.decor()));
        self.new.insert(name, Item::Table(table)).is_none()
    }

    /// Rows of checks.
    fn rows(&mut self, name: &str, rows: &ArrayOfTables) {
        let mut moved = ArrayOfTables::new();
        for row in rows {
            let mut table = Table::new();
            *table.decor_mut() = spaced(row.decor());
            for (key, item) in row.iter() {
                table.insert_formatted(&decorated(key, row.key(key).map(|key| key.leaf_decor().clone())), item.clone());
            }
            moved.push(table);
        }
        self.model().insert(name, Item::ArrayOfTables(moved));
    }

    fn keys(&mut self, path: &str, table: &dyn TableLike) {
        for (key, item) in table.iter() {
            let here = format!("{path}.{key}");
            let decor = table.key(key).map(|key| key.leaf_decor().clone());
            match here.as_str() {
                "model.kind" | "model.solution" => {}
                "closures.lid" => self.put("flow.top", decor, law(item)),
                "flow.side_walls" => {}
                path if path == ACROSS.0 && self.form.moved.contains(&ACROSS) => {
                    let walls = table.get("side_walls").and_then(Item::as_bool) == Some(true);
                    let place = if walls { "flow.width".to_owned() } else { self.form.place(path) };
                    self.put(&place, decor, item.clone());
                }
                // The height over the fixed grains was the top of the flow.
                "flow.height" if self.form.place("flow.height") == TOP_HEIGHT => {
                    let mut top = InlineTable::new();
                    top.insert("law", "over-fixed-grains".into());
                    top.extend(item.as_value().map(|height| (Key::new("height"), bare(height))));
                    self.put("flow.top", decor, Item::Value(Value::InlineTable(top)));
                }
                "bed.reading" => {
                    let word = if item.as_str() == Some("initial") { "at-rest" } else { "in-flow" };
                    let mut value = Value::from(word);
                    if let Some(old) = item.as_value() {
                        *value.decor_mut() = old.decor().clone();
                    }
                    self.put(&self.form.place("bed.reading"), decor, Item::Value(value));
                }
                "limit.over" => {
                    let over = item.as_str().and_then(|over| over.split_once('='));
                    let place = |key: &str| {
                        let place = self.form.place(key);
                        place
                            .strip_prefix(self.form.model)
                            .and_then(|own| own.strip_prefix('.'))
                            .unwrap_or(&place)
                            .to_owned()
                    };
                    let moved = over.map(|(key, values)| toml_edit::value(format!("{}={values}", place(key))));
                    self.put(&self.form.place("limit.over"), decor, moved.unwrap_or_else(|| item.clone()));
                }
                path => match item.as_table_like() {
                    // A law goes on one line unless a comment would be lost; what moves out of it goes first.
                    Some(keys) if keys.get("law").is_some() && path.starts_with("closures.") => {
                        let (stays, goes): (Vec<_>, Vec<_>) = keys.iter().partition(|(key, _)| {
                            !self.form.moved.iter().any(|(old, _)| *old == format!("{path}.{key}"))
                        });
                        for (key, item) in goes {
                            let decor = keys.key(key).map(|key| key.leaf_decor().clone());
                            self.put(&self.form.place(&format!("{path}.{key}")), decor, item.clone());
                        }
                        let mut rest = Table::new();
                        for (key, item) in stays {
                            let decor = keys.key(key).map(|key| key.leaf_decor().clone());
                            rest.insert_formatted(&decorated(key, decor), item.clone());
                        }
                        self.put(&self.form.place(path), None, law(&Item::Table(rest)));
                    }
                    Some(keys) if item.is_table() => self.keys(path, keys),
                    _ => self.put(&self.form.place(path), decor, item.clone()),
                },
            }
        }
    }

    /// What a case of format 1 left unsaid: planes above and below, what a slope without a word is.
    fn unsaid(&mut self) {
        if let Some(top) = self.form.top {
            self.put("flow.top", None, toml_edit::value(top));
        }
        if let Some((law, none)) = self.form.law.filter(|(law, _)| !self.has(law)) {
            self.put(&self.form.place(law), None, toml_edit::value(none));
        }
        let Some(usual) = self.form.slope else { return };
        let Some(flow) = self.new.get("flow").and_then(Item::as_table) else { return };
        let number =
            flow.get("slope").is_some_and(|slope| slope.as_float().or(slope.as_integer().map(|i| i as f64)).is_some());
        if number && !flow.contains_key("slope_definition") {
            self.put("flow.slope_definition", None, toml_edit::value(usual));
        }
    }

    /// Whether the case of format 2 has what stood at `old`.
    fn has(&self, old: &str) -> bool {
        let place = self.form.place(old);
        let mut item = Some(self.new.as_item());
        for name in place.split('.') {
            item = item.and_then(|item| item.get(name));
        }
        item.is_some()
    }

    /// Over a bed the height of format 1 counted the bed.
    fn depth(&mut self) {
        if !self.form.moved.contains(&HEIGHT) || self.form.scene != "bed" {
            return;
        }
        let value =
            |table: &str, key: &str| self.new.get(table).and_then(|table| table.get(key)).and_then(Item::as_value);
        let (Some(height), Some(level)) = (value("flow", "depth"), value("bed", "thickness")) else { return };
        let Some(mut depth) = difference(height, level) else { return };
        let whole = bare(height).to_string();
        let comment = height.decor().suffix().and_then(|suffix| suffix.as_str()).unwrap_or_default().trim();
        let what = comment.trim_start_matches('#').trim();
        let what = if what.is_empty() { String::new() } else { format!(": {what}") };
        *depth.decor_mut() = Decor::new(" ", format!("  # with the bed {}{what}", whole.trim_matches('"')));
        if let Some(place) = self.new.get_mut("flow").and_then(|flow| flow.get_mut("depth")) {
            *place = Item::Value(depth);
        }
    }

    fn model(&mut self) -> &mut Table {
        self.table(&[self.form.model])
    }

    /// The table at `path`, made where there is none.
    fn table(&mut self, path: &[&str]) -> &mut Table {
        let mut table = self.new.as_table_mut();
        for name in path {
            let entry = table.entry(name).or_insert_with(|| {
                let mut made = Table::new();
                made.set_implicit(true);
                *made.decor_mut() = Decor::new("\n", "");
                Item::Table(made)
            });
            // A table of this name that is a value cannot be: the names of the tables are ours.
            if !entry.is_table() {
                *entry = Item::Table(Table::new());
            }
            let Item::Table(next) = entry else { unreachable!("it was made a table") };
            table = next;
        }
        table
    }

    fn put(&mut self, path: &str, decor: Option<Decor>, mut item: Item) {
        let mut parts: Vec<&str> = path.split('.').collect();
        let Some(key) = parts.pop() else { return };
        if let Item::Table(table) = &mut item {
            table.set_position(None);
        }
        // A section is written on one line, with what stands in it already.
        if parts.len() == 2 && parts[1] == "section" || parts.len() == 2 && parts[1] == "cell" {
            let parent = self.table(&parts[..1]);
            let inline = parent.entry(parts[1]).or_insert_with(|| Item::Value(Value::InlineTable(InlineTable::new())));
            if let (Some(inline), Some(value)) = (inline.as_inline_table_mut(), item.as_value()) {
                inline.insert(key, bare(value));
            }
            return;
        }
        self.table(&parts).insert_formatted(&decorated(key, decor), item);
    }
}

/// What stands over a table, after an empty line.
fn spaced(decor: &Decor) -> Decor {
    let prefix = decor.prefix().and_then(|prefix| prefix.as_str()).unwrap_or_default();
    let suffix = decor.suffix().and_then(|suffix| suffix.as_str()).unwrap_or_default();
    Decor::new(format!("\n{}", prefix.trim_start_matches('\n')), suffix)
}

fn decorated(name: &str, decor: Option<Decor>) -> Key {
    let key = Key::new(name);
    match decor {
        Some(decor) => {
            let prefix = decor.prefix().and_then(|prefix| prefix.as_str()).unwrap_or_default();
            key.with_leaf_decor(Decor::new(prefix, " "))
        }
        None => key,
    }
}

/// A value without the spaces and comments around it.
fn bare(value: &Value) -> Value {
    let mut value = value.clone();
    *value.decor_mut() = Decor::default();
    value
}

fn is_bare(decor: &Decor) -> bool {
    let blank = |text: Option<&toml_edit::RawString>| {
        text.and_then(|text| text.as_str()).is_none_or(|text| !text.contains('#'))
    };
    blank(decor.prefix()) && blank(decor.suffix())
}

/// A law as a word, or on one line with what it needs; as the table that it is where a comment would be lost.
fn law(item: &Item) -> Item {
    let Some(table) = item.as_table_like() else { return item.clone() };
    let mut line = InlineTable::new();
    let mut comment = None;
    let last = table.iter().count().saturating_sub(1);
    for (at, (key, value)) in table.iter().enumerate() {
        let Some(value) = value.as_value() else { return item.clone() };
        let own = table.key(key).is_none_or(|key| is_bare(key.leaf_decor()));
        if !own || at < last && !is_bare(value.decor()) {
            return item.clone();
        }
        if at == last && !is_bare(value.decor()) {
            comment = value.decor().suffix().cloned();
        }
        line.insert(key, bare(value));
    }
    let mut value = match (line.len(), line.get("law")) {
        (1, Some(word)) => word.clone(),
        _ => Value::InlineTable(line),
    };
    if let Some(comment) = comment {
        value.decor_mut().set_suffix(comment);
    }
    Item::Value(value)
}

/// `height - level`, in the unit that both have, with no more digits than they have; in metres where the units differ.
fn difference(height: &Value, level: &Value) -> Option<Value> {
    let parts = |value: &Value| -> Option<(f64, usize, String)> {
        let text = match value {
            Value::String(text) => text.value().clone(),
            Value::Integer(number) => number.value().to_string(),
            Value::Float(number) => number.value().to_string(),
            _ => return None,
        };
        let number = text.trim().trim_end_matches(|c: char| c.is_alphabetic() || c == ' ').to_owned();
        let unit = text.trim()[number.len()..].trim().to_owned();
        let decimals = number.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        Some((number.parse().ok()?, decimals, unit))
    };
    let metres = |value: &Value| match value {
        Value::String(text) => parse_quantity(text.value(), "m").ok(),
        Value::Integer(number) => Some(*number.value() as f64),
        Value::Float(number) => Some(*number.value()),
        _ => None,
    };
    if let (Some((h, places_h, unit)), Some((l, places_l, same))) = (parts(height), parts(level))
        && unit == same
    {
        let number = format!("{:.*}", places_h.max(places_l), h - l);
        let number = if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { &number };
        return if unit.is_empty() {
            number.parse::<f64>().ok().map(Value::from)
        } else {
            Some(format!("{number} {unit}").into())
        };
    }
    Some(Value::from(metres(height)? - metres(level)?))
}
