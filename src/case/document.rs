//! A TOML document that remembers where each key and value stands, also through `--set`.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::fault::Fault;
use super::violation::{Span, Violation};

/// A value and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub data: Data,
    /// the key, or the whole value where there is none
    pub key: Span,
    pub value: Span,
}

/// TOML data.
#[derive(Clone, Debug)]
pub(super) enum Data {
    Table(Vec<(String, Node)>),
    Array(Vec<Node>),
    Text(String),
    Integer(i64),
    Float(f64),
    Boolean(bool),
    Date,
}

impl Data {
    /// The type as a reader calls it.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Table(_) => "a table",
            Self::Array(_) => "an array",
            Self::Text(_) => "a text",
            Self::Integer(_) => "a whole number",
            Self::Float(_) => "a number",
            Self::Boolean(_) => "true or false",
            Self::Date => "a date",
        }
    }
}

/// A text that can be shown with carets: its name and content.
#[derive(Clone, Debug)]
pub struct Text {
    /// file name or `--set`
    pub name: String,
    /// content
    pub content: String,
}

/// A case as text: the file, the overrides, and the tree of both.
#[derive(Clone, Debug)]
pub struct Document {
    pub(super) texts: Vec<Text>,
    pub(super) root: Node,
    /// names of the tables and keys of the file itself, which `--set` may add to
    pub(super) written: Vec<String>,
    /// offset of each line of the case file
    lines: Vec<usize>,
}

impl Document {
    /// Parses `content`; every syntax error is a violation, and what could be read is kept.
    pub(super) fn parse(name: &str, content: String) -> (Self, Vec<Violation>) {
        let (table, errors) = DeTable::parse_recoverable(&content);
        let faults = errors.iter().map(|error| {
            let bytes = error.span().unwrap_or(0..0);
            let hint = meant_line(&content, bytes.start);
            let fault = Fault::Syntax { message: error.message().trim().to_owned(), meant: hint };
            Violation::new(fault, String::new(), Span { text: 0, bytes })
        });
        let faults = faults.collect();
        let whole = Span { text: 0, bytes: 0..0 };
        let root = Node { data: table_data(table.get_ref(), 0), key: whole.clone(), value: whole };
        let written = table.get_ref().keys().map(|key| key.get_ref().clone().into_owned()).collect();
        let lines = std::iter::once(0).chain(content.match_indices('\n').map(|(i, _)| i + 1)).collect();
        let document = Self { root, written, texts: vec![Text { name: name.into(), content }], lines };
        (document, faults)
    }

    /// Applies one `--set table.key=value`; an empty value removes the key.
    pub(super) fn set(&mut self, argument: &str) -> Result<(), Violation> {
        let text = self.texts.len();
        let name = format!("--set {argument}");
        self.texts.push(Text { name, content: argument.to_owned() });
        let whole = Span { text, bytes: 0..argument.len() };
        let bad = |fault| Violation::new(fault, String::new(), whole.clone());
        let Some((path, value)) = argument.split_once('=') else {
            return Err(bad(Fault::BadSet { argument: argument.into() }));
        };
        let segments: Vec<&str> = path.trim().split('.').map(str::trim).collect();
        if segments.iter().any(|s| s.is_empty() || s.contains(['[', ']', '"', '\''])) {
            return Err(bad(Fault::BadSet { argument: argument.into() }));
        }
        let key = Span { text, bytes: 0..path.len() };
        let node = (!value.trim().is_empty()).then(|| Node {
            data: override_data(value.trim()),
            key: key.clone(),
            value: Span { text, bytes: path.len() + 1..argument.len() },
        });
        insert(&mut self.root, &segments, node, &key).map_err(|()| bad(Fault::BadSet { argument: argument.into() }))
    }

    /// The node at a path such as `flow.depth` or `check.0.quantity`.
    pub(super) fn node(&self, path: &str) -> Option<&Node> {
        path.split('.').filter(|s| !s.is_empty()).try_fold(&self.root, |node, segment| match &node.data {
            Data::Table(entries) => entries.iter().find(|(k, _)| k == segment).map(|(_, n)| n),
            Data::Array(items) => items.get(segment.parse::<usize>().ok()?),
            _ => None,
        })
    }

    /// The key at `path`, if the document has it.
    pub(super) fn key(&self, path: &str) -> Option<Span> {
        self.node(path).map(|node| node.key.clone())
    }

    /// Where to point for `path`: its value, or the nearest table above it that the document has.
    #[must_use]
    pub fn locate(&self, path: &str) -> Span {
        if let Some(node) = self.node(path) {
            return if matches!(node.data, Data::Table(_)) { node.key.clone() } else { node.value.clone() };
        }
        let mut path = path;
        while let Some((parent, _)) = path.rsplit_once('.') {
            if let Some(node) = self.node(parent) {
                return node.key.clone();
            }
            path = parent;
        }
        Span { text: 0, bytes: 0..0 }
    }

    /// The text that a span points into.
    #[must_use]
    pub fn text(&self, span: &Span) -> &Text {
        &self.texts[span.text.min(self.texts.len() - 1)]
    }

    /// Line of a span, from 1, if it points into the case file.
    #[must_use]
    pub fn line(&self, span: &Span) -> Option<usize> {
        let start = span.bytes.start.min(self.texts[0].content.len());
        (span.text == 0).then(|| self.lines.partition_point(|&line| line <= start))
    }
}

fn table_data(table: &DeTable<'_>, text: usize) -> Data {
    let mut entries: Vec<(String, Node)> = Vec::with_capacity(table.len());
    for (key, value) in table.iter() {
        let node = node(value, Span { text, bytes: key.span() }, text);
        entries.push((key.get_ref().clone().into_owned(), node));
    }
    Data::Table(entries)
}

fn node(value: &Spanned<DeValue<'_>>, key: Span, text: usize) -> Node {
    let data = match value.get_ref() {
        DeValue::String(s) => Data::Text(s.clone().into_owned()),
        DeValue::Integer(i) => i64::from_str_radix(i.as_str(), i.radix())
            .map_or_else(|_| Data::Float(huge(i.as_str(), i.radix())), Data::Integer),
        DeValue::Float(f) => Data::Float(f.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(b) => Data::Boolean(*b),
        DeValue::Datetime(_) => Data::Date,
        DeValue::Array(items) => {
            let item = |v: &Spanned<DeValue<'_>>| node(v, Span { text, bytes: v.span() }, text);
            Data::Array(items.iter().map(item).collect())
        }
        DeValue::Table(table) => table_data(table, text),
    };
    Node { data, key, value: Span { text, bytes: value.span() } }
}

/// A whole number that no `i64` holds, as near as an `f64` comes.
fn huge(text: &str, radix: u32) -> f64 {
    if let (10, Ok(x)) = (radix, text.parse()) {
        return x;
    }
    let digits = text.chars().filter_map(|c| c.to_digit(radix));
    digits.fold(0.0, |sum, digit| sum * f64::from(radix) + f64::from(digit))
}

/// The value of an override: TOML if it reads as TOML, a text otherwise.
fn override_data(value: &str) -> Data {
    let line = format!("v = {value}");
    match DeTable::parse(&line) {
        Ok(table) if table.get_ref().len() == 1 => table
            .get_ref()
            .iter()
            .next()
            .map_or_else(|| Data::Text(value.into()), |(_, v)| node(v, Span { text: 0, bytes: 0..0 }, 0).data),
        _ => Data::Text(value.into()),
    }
}

/// Puts `node` at `path`, making the tables on the way, or removes what stands there.
fn insert(at: &mut Node, path: &[&str], node: Option<Node>, key: &Span) -> Result<(), ()> {
    let Some((first, rest)) = path.split_first() else { return Err(()) };
    // A law that is written as a word is the table with that law.
    if let Data::Text(word) = &at.data
        && word.chars().all(|c| c.is_ascii_lowercase() || c == '-' || c.is_ascii_digit())
        && !word.is_empty()
    {
        let word = Node { data: at.data.clone(), key: at.key.clone(), value: at.value.clone() };
        at.data = Data::Table(vec![("law".into(), word)]);
    }
    match &mut at.data {
        Data::Table(entries) => {
            let place = entries.iter().position(|(k, _)| k == first);
            match (place, rest.is_empty(), node) {
                (Some(i), true, Some(node)) => entries[i].1 = node,
                (Some(i), true, None) => {
                    entries.remove(i);
                }
                (Some(i), false, node) => insert(&mut entries[i].1, rest, node, key)?,
                (None, true, Some(node)) => entries.push(((*first).into(), node)),
                (None, false, Some(node)) => {
                    let mut table = Node { data: Data::Table(Vec::new()), key: key.clone(), value: key.clone() };
                    insert(&mut table, rest, Some(node), key)?;
                    entries.push(((*first).into(), table));
                }
                (None, _, None) => {}
            }
            Ok(())
        }
        Data::Array(items) => {
            let item = first.parse::<usize>().ok().and_then(|i| items.get_mut(i)).ok_or(())?;
            match (rest.is_empty(), node) {
                (true, Some(node)) => *item = node,
                (true, None) => return Err(()),
                (false, node) => insert(item, rest, node, key)?,
            }
            Ok(())
        }
        _ => Err(()),
    }
}

/// What the line of `at` should have been: `key = 6 mm` a quoted quantity, `key = 0,6` a number with a decimal point.
fn meant_line(content: &str, at: usize) -> Option<String> {
    let at = at.min(content.len());
    let start = content.as_bytes()[..at].iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
    let line = content.get(start..)?.lines().next()?;
    let (key, value) = line.split_once('=')?;
    let value = value.split('#').next()?.trim();
    let number = value.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit() || c == '.');
    let unit = value.contains(|c: char| c.is_alphabetic() || "%\u{b0}".contains(c));
    if number && !unit && value.matches(',').count() == 1 && !value.contains(char::is_whitespace) {
        return Some(format!("numbers have a decimal point: {} = {}", key.trim(), value.replace(',', ".")));
    }
    let quoted = || format!("a quantity with a unit is a text: {} = \"{value}\"", key.trim());
    (number && unit && value.len() < 40).then(quoted)
}
