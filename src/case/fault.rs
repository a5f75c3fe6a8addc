//! What can be wrong with a case by itself, with the numbers that say so. What a model finds is its own fault.

use std::io;

use crate::result::codes;
use crate::units::UnitError;

/// What is wrong at one place of a case, whatever its model.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// The file cannot be read.
    #[error("cannot read {file}: {error}")]
    Unreadable {
        /// path
        file: String,
        /// what the system says
        #[source]
        error: io::Error,
    },
    /// Neither a file nor a shipped case.
    #[error("there is no file and no shipped case \"{name}\"")]
    NoSuchCase {
        /// what was asked for
        name: String,
        /// shipped case that it may stand for
        nearest: Option<String>,
    },
    /// Larger than any case file.
    #[error("the file is larger than {limit} bytes: this is not a case file")]
    TooLarge {
        /// largest accepted size
        limit: u64,
    },
    /// Not text.
    #[error("the file is not UTF-8 text: byte {offset} is not")]
    NotUtf8 {
        /// first offending byte
        offset: usize,
    },
    /// A null byte.
    #[error("the file is binary: byte {offset} is 0")]
    Binary {
        /// first null byte
        offset: usize,
    },
    /// Nothing in it.
    #[error("the case is empty")]
    Empty,
    /// `--set` without a key or a value, or into something that is no table.
    #[error("--set \"{argument}\" is not of the form table.key=value")]
    BadSet {
        /// the argument
        argument: String,
    },
    /// Not TOML.
    #[error("not valid TOML: {message}")]
    Syntax {
        /// what the parser says
        message: String,
        /// what the line probably means, and how that is written
        meant: Option<String>,
    },
    /// A table or key that no model has.
    #[error("unknown {what} \"{name}\"{place}")]
    Unknown {
        /// table or key
        what: &'static str,
        /// as written
        name: String,
        /// ` in [table]`
        place: String,
        /// valid name that it may stand for
        nearest: Option<String>,
        /// table that has a key of this name
        elsewhere: Option<String>,
        /// valid names
        allowed: Vec<String>,
    },
    /// A table or key that other models have.
    #[error("{what} \"{name}\" is not used by {model}")]
    NotUsed {
        /// table or key
        what: &'static str,
        /// as written
        name: String,
        /// the model of the case
        model: String,
        /// models that use it
        users: Vec<String>,
        /// names that are used there
        allowed: Vec<String>,
    },
    /// A top of the flow that the model does not solve.
    #[error("{model} does not solve a flow whose top is {top}")]
    Top {
        /// the top, given or the default
        top: String,
        /// the model
        model: String,
        /// models that solve it
        users: Vec<String>,
        /// tops that this one solves
        allowed: Vec<String>,
    },
    /// A value that the model cannot do without: what it is stands in the schema.
    #[error("this model needs a value that is missing")]
    Needed,
    /// A missing table or key.
    #[error("missing {what} {name}")]
    Missing {
        /// table or key
        what: &'static str,
        /// `[table]`, or `key` in `[table]`
        name: String,
        /// what it is
        description: String,
        /// what it may be
        allowed: String,
    },
    /// A case of format 1.
    #[error("this case is of format 1, which had a file for each model")]
    OldFormat {
        /// the kind of flow and the model that it has now, where they are known
        scene: Option<(&'static str, &'static str)>,
    },
    /// A key of format 1 that has another place.
    #[error("{old} is {new} now{}", if *with_bed { ", of the clear fluid: the height without the bed" } else { "" })]
    Renamed {
        /// place in format 1
        old: String,
        /// place in format 2
        new: String,
        /// whether the old one counted the bed and the new one does not
        with_bed: bool,
    },
    /// A case with several models or none, or a model that does not exist.
    #[error("{}", which_model(given.as_deref(), allowed, *alone))]
    WhichModel {
        /// the model that was asked for, if one was
        given: Option<String>,
        /// models that there are
        allowed: Vec<String>,
        /// whether the case has no table of a model
        alone: bool,
        /// model of which `--set` has a key: that is no choice
        set: Option<String>,
    },
    /// Another model than the one that the name of the case chooses.
    #[error("the name of the case chooses {named}, and --model {given}")]
    TwoModels {
        /// model of the name
        named: String,
        /// model of `--model`
        given: String,
        /// the case without its model
        file: String,
    },
    /// A model that solves another kind of flow.
    #[error("{model} does not solve a scene of the kind \"{scene}\"")]
    OtherScene {
        /// the model
        model: String,
        /// the kind of flow of the case
        scene: String,
        /// models that solve it
        allowed: Vec<String>,
    },
    /// A value of another type.
    #[error("{name} is {found}, not {expected}")]
    WrongType {
        /// key
        name: String,
        /// type as written
        found: &'static str,
        /// what it may be
        expected: String,
    },
    /// A quantity that cannot be read.
    #[error("{name}: {error}")]
    Unit {
        /// key
        name: String,
        /// why
        #[source]
        error: UnitError,
        /// SI unit of the quantity
        unit: String,
        /// whether it is a length that may be given in diameters of the grains
        diameters: bool,
        /// what to write instead, where that is known
        meant: Option<String>,
    },
    /// NaN or infinite.
    #[error("{name} is not a finite number")]
    NotFinite {
        /// key
        name: String,
        /// what it may be
        allowed: String,
    },
    /// A number out of its range.
    #[error("{name} = {value} is out of range")]
    OutOfRange {
        /// key
        name: String,
        /// in SI
        value: f64,
        /// what it may be
        allowed: String,
    },
    /// A word that is not one of the choices.
    #[error("\"{word}\" is not a {name}")]
    UnknownWord {
        /// key
        name: String,
        /// as written
        word: String,
        /// the choice that it may stand for
        nearest: Option<String>,
        /// the choices
        allowed: Vec<String>,
    },
    /// Too few drives, or too many.
    #[error("{}", drives(given))]
    Drives {
        /// drives that were given
        given: Vec<String>,
        /// drives to choose from
        allowed: Vec<String>,
    },
    /// A slope that is vertical or more.
    #[error("a slope whose {definition} is {value} is vertical or more")]
    TooSteep {
        /// tangent, sine or angle
        definition: &'static str,
        /// as given
        value: f64,
    },
    /// A law that the model cannot hold.
    #[error("closures.{family} law \"{law}\" does not go with {model}")]
    LawMismatch {
        /// closure family
        family: String,
        /// law as written
        law: String,
        /// the model
        model: String,
        /// laws that go with it
        allowed: Vec<String>,
    },
    /// A check of something that is not reported.
    #[error("there is no result \"{name}\" to check")]
    UnknownQuantity {
        /// as written
        name: String,
        /// result that it may stand for
        nearest: Option<String>,
    },
    /// A limit along something that is no key.
    #[error("\"{over}\" is not table.key=values")]
    LimitKey {
        /// as written
        over: String,
    },
    /// A limit beyond which the method holds.
    #[error("beyond a limit a method does not hold")]
    LimitHolds,
    /// A check of a column without a level, or of a result with one.
    #[error("{}", if *column { format!("the check of {name} needs `at`, the elevation") } else { format!("the check of {name} takes no `at`: it is one number") })]
    CheckLevel {
        /// the quantity
        name: String,
        /// whether it is a column
        column: bool,
    },
}

codes!(Fault {
    Self::Unreadable { .. } => "unreadable",
    Self::NoSuchCase { .. } => "no-such-case",
    Self::TooLarge { .. } => "too-large",
    Self::NotUtf8 { .. } => "not-utf8",
    Self::Binary { .. } => "binary",
    Self::Empty => "empty",
    Self::BadSet { .. } => "bad-set",
    Self::Syntax { .. } => "syntax",
    Self::Unknown { what: "table", .. } => "unknown-table",
    Self::Unknown { .. } => "unknown-key",
    Self::NotUsed { .. } | Self::Top { .. } => "not-used",
    Self::Needed => "missing-key",
    Self::Missing { what: "table", .. } => "missing-table",
    Self::Missing { .. } => "missing-key",
    Self::WrongType { .. } => "wrong-type",
    Self::Unit { error: UnitError::WrongDimension { .. }, .. } => "wrong-dimension",
    Self::Unit { error: UnitError::UnknownUnit { .. }, .. } => "unknown-unit",
    Self::Unit { error: UnitError::NotFinite { .. }, .. } | Self::NotFinite { .. } => "not-finite",
    Self::Unit { .. } => "bad-quantity",
    Self::OutOfRange { .. } => "out-of-range",
    Self::UnknownWord { .. } => "unknown-word",
    Self::OldFormat { .. } => "old-format",
    Self::Renamed { .. } => "renamed",
    Self::WhichModel { .. } | Self::TwoModels { .. } => "which-model",
    Self::OtherScene { .. } => "other-scene",
    Self::Drives { .. } => "drives",
    Self::TooSteep { .. } => "too-steep",
    Self::LawMismatch { .. } => "law-mismatch",
    Self::UnknownQuantity { .. } => "unknown-quantity",
    Self::LimitKey { .. } => "limit-key",
    Self::LimitHolds => "limit-holds",
    Self::CheckLevel { .. } => "check-level",
});

fn drives(given: &[String]) -> String {
    match given {
        [] => "the flow has no drive".into(),
        [one] => format!("{one} alone does not drive the flow"),
        several => format!("the flow has {} drives: {}", several.len(), several.join(", ")),
    }
}

fn which_model(given: Option<&str>, allowed: &[String], alone: bool) -> String {
    if let Some(given) = given {
        return format!("there is no model \"{given}\"");
    }
    match allowed.len() {
        n if alone => format!("a scene alone does not say which of {n} models solves it"),
        0 => "no model solves this kind of flow".into(),
        n => format!("the case does not say which of {n} models solves it"),
    }
}
