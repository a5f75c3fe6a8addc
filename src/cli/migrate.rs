//! `bedload migrate`: a case of format 1 as one of format 2, key by key, with its comments and its units.

mod pieces;

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::mem::take;
use std::path::PathBuf;

use clap::Args;
use toml_edit::{Decor, DocumentMut, InlineTable, Item, Key, Table, TableLike, Value};

use super::new::write_new;
use super::{Answers, CliError, Verb, colour, say, word};
use crate::case::format1::{ACROSS, Form, HEIGHT, OF_THE_FLOW, TOP_HEIGHT};
use crate::case::printable;
use crate::model::Registry;
use pieces::{
    Refused, bare, behind, both, comments, decor_of, decorated, difference, law, line, over, packing, raw, read,
    spaced, without_gaps,
};

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
    /// Write the new file also where it does not check: what was wrong with the old case is wrong with the new one
    #[arg(long)]
    unchecked: bool,
}

impl Verb for Migrate {
    fn execute(self, registry: &Registry, _: &Answers) -> Result<(), CliError> {
        let old = read(&self.old)?;
        let text = migrated(&old.replace("\r\n", "\n")).map_err(|(problem, hint)| CliError::Usage {
            message: format!("{}: {problem}", self.old.display()),
            hint,
        })?;
        let ends = |text: &str| if old.contains("\r\n") { text.replace('\n', "\r\n") } else { text.to_owned() };
        let file = self.new.display().to_string();
        let to_file = file != "-";
        let source = if to_file { &file } else { "the new file" };
        let wrong = registry.parse("new", source, text.clone(), &[]).err();
        if !to_file {
            io::stdout().lock().write_all(ends(&printable(&text)).as_bytes())?;
            io::stdout().flush()?;
        } else if wrong.is_none() || self.unchecked {
            write_new(&self.new, &ends(&text), self.force)?;
            let next = if wrong.is_none() { "next: " } else { "mend it, then " };
            say(&format!("wrote {file}; {next}bedload check {}\n", word(&file)))?;
        }
        let Some(error) = wrong else { return Ok(()) };
        let refused = to_file && !self.unchecked;
        let (what, hint) = if refused {
            ("; nothing was written", "  --unchecked writes it all the same, to be mended in format 2\n")
        } else {
            ("", "")
        };
        let shown = error.render(colour());
        write!(io::stderr().lock(), "the new file does not check yet{what}:\n{shown}{hint}")?;
        if self.unchecked { Ok(()) } else { Err(CliError::Quiet(2)) }
    }
}

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
    let flow = old.get("flow").and_then(Item::as_table_like);
    if flow.is_some_and(|flow| flow.contains_key("height") && flow.contains_key("depth")) {
        return Err(both(text, "flow.height", "flow.depth", "a case has one of them"));
    }
    let (left, here) = (String::new(), String::new());
    Moving { text, form, new: DocumentMut::new(), left, here, from: BTreeMap::new() }.moved(&old)
}

struct Moving<'t> {
    text: &'t str,
    form: &'static Form,
    new: DocumentMut,
    /// comments of lines that are no more: the next thing that stays takes them
    left: String,
    /// the key of format 1 that is moved
    here: String,
    /// and all that were, by their new place
    from: BTreeMap<String, Vec<String>>,
}

impl Moving<'_> {
    fn moved(mut self, old: &DocumentMut) -> Result<String, Refused> {
        let decor = old.get("format").map(|item| decor_of(old.key("format"), item)).unwrap_or_default();
        let mut format = Value::from(2);
        format.decor_mut().set_suffix(raw(decor.suffix()));
        self.new.insert_formatted(&decorated("format", raw(decor.prefix())), Item::Value(format));
        self.new.insert("scene", toml_edit::value(self.form.scene));
        // The tables of the flow come first, in their order, then the model's.
        for name in OF_THE_FLOW {
            let Some(item) = old.get(name).filter(|item| item.is_table_like()) else { continue };
            let mut table = Table::new();
            *table.decor_mut() = match item {
                Item::Table(table) => spaced(table.decor()),
                item => Decor::new(format!("\n{}", comments(&decor_of(old.key(name), item))), ""),
            };
            self.new.insert(name, Item::Table(table));
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
            let item = &old[table];
            let decor = decor_of(old.key(table), item);
            table.clone_into(&mut self.here);
            match item.as_table_like() {
                Some(keys) => {
                    if !OF_THE_FLOW.contains(&table) {
                        self.left += &comments(&decor);
                    }
                    self.keys(table, keys);
                }
                None => self.put(&self.form.place(table), decor, item.clone()),
            }
        }
        self.here.clear();
        for (place, keys) in &self.from {
            if let [first, second, ..] = keys.as_slice() {
                return Err(both(self.text, first, second, &format!("they are {place} now")));
            }
        }
        self.unsaid();
        self.depth()?;
        self.sweep(raw(Some(old.trailing())));
        Ok(without_gaps(&self.new.to_string()))
    }

    /// Takes out the tables of the flow that hold nothing now. That of the model stays: it chooses the model.
    fn sweep(&mut self, trailing: &str) {
        let last = take(&mut self.left);
        let model = self.table(&[self.form.model]);
        let alone = model.is_empty();
        if alone {
            model.set_implicit(false);
            over(model, &last);
        }
        let mut left = String::new();
        let names: Vec<String> = self.new.iter().map(|(name, _)| name.to_owned()).collect();
        for name in names {
            let Some(Item::Table(table)) = self.new.get_mut(&name) else { continue };
            if table.is_empty() && name != self.form.model {
                left += &comments(table.decor());
                self.new.remove(&name);
            } else if !left.is_empty() && !table.is_implicit() {
                over(table, &take(&mut left));
            }
        }
        if !alone {
            left += &last;
        }
        let gap = if left.is_empty() { "" } else { "\n" };
        self.new.set_trailing(format!("{gap}{left}{trailing}"));
    }

    fn keys(&mut self, path: &str, table: &dyn TableLike) {
        for (key, item) in table.iter() {
            let here = format!("{path}.{key}");
            let decor = decor_of(table.key(key), item);
            self.here.clone_from(&here);
            match here.as_str() {
                "model.kind" | "model.solution" | "flow.side_walls" => self.left += &comments(&decor),
                "closures.lid" => self.put("flow.top", decor, law(item)),
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
                    self.put(&self.form.place("bed.reading"), decor, toml_edit::value(word));
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
                            self.here = format!("{path}.{key}");
                            self.put(&self.form.place(&self.here), decor_of(keys.key(key), item), item.clone());
                        }
                        path.clone_into(&mut self.here);
                        let mut rest = Table::new();
                        for (key, item) in stays {
                            let prefix = decor_of(keys.key(key), item);
                            rest.insert_formatted(&decorated(key, raw(prefix.prefix())), item.clone());
                        }
                        self.put(&self.form.place(path), decor, law(&Item::Table(rest)));
                    }
                    Some(keys) if item.is_table() => {
                        self.left += &comments(&decor);
                        self.keys(path, keys);
                    }
                    _ => self.put(&self.form.place(path), decor, item.clone()),
                },
            }
        }
    }

    /// What a case of format 1 left unsaid: planes above and below, what a slope without a word is.
    fn unsaid(&mut self) {
        if let Some(top) = self.form.top.filter(|_| !self.from.contains_key("flow.top")) {
            self.put("flow.top", Decor::default(), toml_edit::value(top));
        }
        let form = self.form;
        for (old, was) in form.unsaid {
            if !self.has(old) {
                self.put(&form.place(old), Decor::default(), toml_edit::value(*was));
            }
        }
        if let Some(phi) = self.new.get(form.model).and_then(packing) {
            self.put("bed.phi", Decor::default(), toml_edit::value(phi));
        }
        let Some(usual) = self.form.slope else { return };
        let Some(flow) = self.new.get("flow").and_then(Item::as_table) else { return };
        let number =
            flow.get("slope").is_some_and(|slope| slope.as_float().or(slope.as_integer().map(|i| i as f64)).is_some());
        if number && !flow.contains_key("slope_definition") {
            self.put("flow.slope_definition", Decor::default(), toml_edit::value(usual));
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
    fn depth(&mut self) -> Result<(), Refused> {
        // A depth of format 1 is that of the fluid already.
        let counted = self.from.get(HEIGHT.1).is_some_and(|keys| keys[0] == HEIGHT.0);
        if !counted || self.form.scene != "bed" {
            return Ok(());
        }
        let value =
            |table: &str, key: &str| self.new.get(table).and_then(|table| table.get(key)).and_then(Item::as_value);
        let (Some(height), Some(level)) = (value("flow", "depth"), value("bed", "thickness")) else {
            return Ok(());
        };
        let whole = bare(height).to_string();
        let Some(mut depth) = difference(height, level) else {
            let place = line(self.text, "flow.height");
            let problem = format!("{place}flow.height = {whole} over bed.level = {} leaves no depth", bare(level));
            return Err((problem, "flow.height counts the bed: it is a length, and more than bed.level".into()));
        };
        let comment = height.decor().suffix().and_then(|suffix| suffix.as_str()).unwrap_or_default().trim();
        let what = comment.trim_start_matches('#').trim();
        let what = if what.is_empty() { String::new() } else { format!(": {what}") };
        *depth.decor_mut() = Decor::new(" ", format!("  # with the bed {}{what}", whole.trim_matches('"')));
        if let Some(place) = self.new.get_mut("flow").and_then(|flow| flow.get_mut("depth")) {
            *place = Item::Value(depth);
        }
        Ok(())
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

    /// Puts `item` at `path`, with what stood before and behind it and the comments that were left.
    fn put(&mut self, path: &str, decor: Decor, mut item: Item) {
        self.from.entry(path.to_owned()).or_default().push(self.here.clone());
        let mut parts: Vec<&str> = path.split('.').collect();
        let Some(key) = parts.pop() else { return };
        let mut left = take(&mut self.left);
        // A section is written on one line, with what stands in it already.
        if let (Some(value), [table, line @ ("section" | "cell")]) = (item.as_value(), parts.as_slice()) {
            left += &comments(&decor);
            let parent = self.table(&[table]);
            let inline = parent.entry(line).or_insert_with(|| Item::Value(Value::InlineTable(InlineTable::new())));
            if let Some(inline) = inline.as_inline_table_mut() {
                inline.insert(key, bare(value));
            }
            if let Some(mut key) = parent.key_mut(line) {
                let before = raw(key.leaf_decor().prefix()).to_owned();
                *key.leaf_decor_mut() = Decor::new(before + &left, " ");
            }
            return;
        }
        let mut prefix = raw(decor.prefix()).to_owned();
        match &mut item {
            Item::Table(table) => {
                table.set_position(None);
                table.set_dotted(false);
                *table.decor_mut() = Decor::new(format!("\n{}{prefix}", take(&mut left)), raw(decor.suffix()));
                prefix.clear();
            }
            Item::ArrayOfTables(rows) => {
                for row in rows.iter_mut() {
                    row.set_position(None);
                    over(row, &take(&mut left));
                }
            }
            Item::Value(value) => prefix += &behind(value, &decor),
            Item::None => {}
        }
        // What stood over a table stands over the new one, if this is its first key.
        let first = parts.iter().try_fold(self.new.as_item(), |item, name| item.get(name)).is_none();
        let table = self.table(&parts);
        if first {
            over(table, &left);
        } else {
            prefix = left + &prefix;
        }
        if item.is_value() {
            table.insert_formatted(&decorated(key, &prefix), item);
        } else {
            table.insert(key, item);
        }
    }
}
