//! Everything that can be wrong with a case, with the numbers that say so.

use super::document::Span;
use crate::units::UnitError;

/// What is wrong at one place of a case.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The file cannot be read.
    #[error("cannot read {file}: {reason}")]
    Unreadable {
        /// path
        file: String,
        /// what the system says
        reason: String,
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
        error: UnitError,
        /// SI unit of the quantity
        unit: String,
        /// what to write instead, where that can be said
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
    /// Not exactly one drive.
    #[error("{}", if given.is_empty() { "the flow has no drive".to_owned() } else { format!("the flow has {} drives: {}", given.len(), given.join(", ")) })]
    Drives {
        /// drives that were given
        given: Vec<String>,
        /// drives to choose from
        allowed: Vec<String>,
    },
    /// Not exactly one free surface.
    #[error("the flow has {} free surfaces: give height or depth", given.len())]
    Surfaces {
        /// keys that were given
        given: Vec<String>,
    },
    /// A bed that fills the flow.
    #[error("the bed level {level} m is not below the flow height {height} m")]
    NoRoomForFlow {
        /// bed level \[m]
        level: f64,
        /// flow height \[m]
        height: f64,
    },
    /// Grains that float.
    #[error("the grains ({grains} kg/m3) are not denser than the fluid ({fluid} kg/m3): no bed")]
    Floating {
        /// density of the grains
        grains: f64,
        /// density of the fluid
        fluid: f64,
    },
    /// More grains than fit.
    #[error("bed.phi = {phi} is not below phi_max = {phi_max} of the viscosity law")]
    Jammed {
        /// solid fraction
        phi: f64,
        /// solid fraction at which the grains jam
        phi_max: f64,
    },
    /// A bed thinner than its grains.
    #[error("the bed is {level} m thick, less than one grain of {diameter} m")]
    ThinnerThanAGrain {
        /// bed level \[m]
        level: f64,
        /// grain diameter \[m]
        diameter: f64,
    },
    /// mu_2 below mu_s.
    #[error("mu_2 = {mu_2} is not more than mu_s = {mu_s}")]
    FrictionFalls {
        /// friction at vanishing inertial number
        mu_s: f64,
        /// friction at large inertial number
        mu_2: f64,
    },
    /// A slope that is vertical or more.
    #[error("a slope whose {definition} is {value} is vertical or more")]
    TooSteep {
        /// tangent, sine or angle
        definition: &'static str,
        /// as given
        value: f64,
    },
    /// A number of grains, or a room for them, that no run could hold.
    #[error("{name} is {value:.6}, which is not from {least:.6} to {most:.6}")]
    GrainRoom {
        /// what it is
        name: &'static str,
        /// as it follows from the case
        value: f64,
        /// smallest value
        least: f64,
        /// largest value
        most: f64,
    },
    /// A regularisation without a size, with two, or a size without a law.
    #[error("{}", match (*given, *exact) { (0, _) => "the regularisation has no size", (_, true) => "the exact yield (law = \"none\") has no size", _ => "the regularisation has two sizes" })]
    RegularisationSize {
        /// sizes that were given
        given: usize,
        /// whether the law is `none`
        exact: bool,
    },
    /// A width where the outline has none.
    #[error("only a rectangle has a width")]
    NoWidth,
    /// A section that is much wider than high, or the reverse.
    #[error("the width is {ratio} times the height: a section takes {low} to {high}")]
    Slender {
        /// width over height
        ratio: f64,
        /// smallest
        low: f64,
        /// largest
        high: f64,
    },
    /// The first-order method with a regularisation.
    #[error("the first-order method has the exact yield only")]
    DualIsExact,
    /// The whole duct for a model that has only its section.
    #[error("the whole duct has one velocity, walls on all sides and Newton's method only")]
    NotWhole,
    /// A law whose packing is looser than that of the bed.
    #[error("phi_max = {phi_max} of {law} must reach {bed}, that of the bed at rest (closures.dilatancy)")]
    PackedBeyond {
        /// the law
        law: &'static str,
        /// its phi_max
        phi_max: f64,
        /// that of the bed
        bed: f64,
    },
    /// The pseudo-time iteration with the exact yield.
    #[error("the iteration needs a regularisation: the viscosity of grains at rest is infinite")]
    IterationNeedsCreep,
    /// Waves in a steady flow.
    #[error("a steady flow has no waves")]
    NeedsTime,
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
    /// A wall rougher than the flow is high.
    #[error("the roughness length k_s/30 = {length} m is not below the flow height {height} m")]
    RoughnessAboveFlow {
        /// roughness length \[m]
        length: f64,
        /// flow height \[m]
        height: f64,
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

impl Fault {
    /// Stable identifier, as in the answer of `--json`.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => "unreadable",
            Self::NoSuchCase { .. } => "no-such-case",
            Self::TooLarge { .. } => "too-large",
            Self::NotUtf8 { .. } => "not-utf8",
            Self::Binary { .. } => "binary",
            Self::Empty => "empty",
            Self::BadSet { .. } => "bad-set",
            Self::Syntax { .. } => "syntax",
            Self::Unknown { what, .. } if *what == "table" => "unknown-table",
            Self::Unknown { .. } => "unknown-key",
            Self::NotUsed { .. } => "not-used",
            Self::Missing { what, .. } if *what == "table" => "missing-table",
            Self::Missing { .. } => "missing-key",
            Self::WrongType { .. } => "wrong-type",
            Self::Unit { error: UnitError::WrongDimension { .. }, .. } => "wrong-dimension",
            Self::Unit { error: UnitError::UnknownUnit { .. }, .. } => "unknown-unit",
            Self::Unit { error: UnitError::NotFinite { .. }, .. } | Self::NotFinite { .. } => "not-finite",
            Self::Unit { .. } => "bad-quantity",
            Self::OutOfRange { .. } => "out-of-range",
            Self::UnknownWord { .. } => "unknown-word",
            Self::Drives { .. } => "drives",
            Self::Surfaces { .. } => "surfaces",
            Self::NoRoomForFlow { .. } => "no-room-for-flow",
            Self::Floating { .. } => "floating-grains",
            Self::Jammed { .. } => "jammed",
            Self::ThinnerThanAGrain { .. } => "thinner-than-a-grain",
            Self::FrictionFalls { .. } => "friction-falls",
            Self::TooSteep { .. } => "too-steep",
            Self::GrainRoom { .. } => "grain-room",
            Self::RegularisationSize { .. } => "regularisation-size",
            Self::NoWidth => "no-width",
            Self::Slender { .. } => "slender",
            Self::DualIsExact => "dual-is-exact",
            Self::NotWhole => "not-whole",
            Self::PackedBeyond { .. } => "packed-beyond",
            Self::IterationNeedsCreep => "iteration-needs-creep",
            Self::NeedsTime => "needs-time",
            Self::LawMismatch { .. } => "law-mismatch",
            Self::RoughnessAboveFlow { .. } => "roughness-above-flow",
            Self::UnknownQuantity { .. } => "unknown-quantity",
            Self::LimitKey { .. } => "limit-key",
            Self::LimitHolds => "limit-holds",
            Self::CheckLevel { .. } => "check-level",
        }
    }
}

/// A fault, the path where it is, and the places to point at.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// what is wrong
    pub fault: Fault,
    /// dotted path in the case: `flow.height`
    pub path: String,
    /// places to point at, the main one first
    pub spans: Vec<Span>,
}

impl Violation {
    /// A fault at one place.
    #[must_use]
    pub fn new(fault: Fault, path: String, span: Span) -> Self {
        Self { fault, path, spans: vec![span] }
    }
}
