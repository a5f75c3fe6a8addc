//! The names of format 1, which had a file for each model: what each key is called now. Files of format 1 are refused with them, and
//! `bedload migrate` moves keys by them.

use super::document::{Data, Document, Node};
use super::fault::Fault;
use super::kind::SCENE;
use super::violation::Violation;

/// The tables of a flow: a key of one of these stays there unless a rule says where it goes; all other tables are the model's.
pub(crate) const OF_THE_FLOW: [&str; 5] = ["case", "fluid", "grains", "bed", "flow"];

/// The cases of one model in format 1.
#[derive(Debug)]
#[cfg_attr(not(feature = "cli"), expect(dead_code, reason = "what was left unsaid is read by `bedload migrate`"))]
pub(crate) struct Form {
    /// `kind` or `kind/solution` in `[model]`
    pub old: &'static str,
    /// kind of flow
    pub scene: &'static str,
    /// table of the model
    pub model: &'static str,
    /// keys that have another place, old and new; a new place that begins with a dot is in the table of the model
    pub moved: &'static [(&'static str, &'static str)],
    /// what a case of format 1 left unsaid and one of format 2 says: the top of the flow
    pub top: Option<&'static str>,
    /// what was left out and has another default now: where it stood, and what it was
    pub unsaid: &'static [(&'static str, &'static str)],
    /// and what a slope without a word for it was
    pub slope: Option<&'static str>,
}

/// Results that have another name: of checks.
#[cfg(feature = "cli")]
pub(crate) const RESULTS: [(&str, &str); 1] = [("shields_turbulent", "shields_bed")];

const LEVEL: (&str, &str) = ("bed.level", "bed.thickness");
/// The height of format 1 was that of bed and flow together.
pub(crate) const HEIGHT: (&str, &str) = ("flow.height", "flow.depth");
const SHAPE: (&str, &str) = ("flow.shape", "flow.section.shape");
const SECTION_WIDTH: (&str, &str) = ("flow.width", "flow.section.width");
const FORM: (&str, &str) = ("model.form", ".form");
const METHOD: (&str, &str) = ("model.method", ".method");
const FRICTION: (&str, &str) = ("closures.contact.mu", "grains.friction");
const RESTITUTION: (&str, &str) = ("closures.contact.e_n", "grains.restitution");
const LAYERS: (&str, &str) = ("bed.layers", ".layers");
const BOTTOM: (&str, &str) = ("bed.bottom", ".bottom");
const LENGTH: (&str, &str) = ("flow.length", ".cell.length");
/// Of the flume.
pub(crate) const TOP_HEIGHT: &str = "flow.top.height";
/// Periodic without side walls; between side walls it stays `flow.width`.
pub(crate) const ACROSS: (&str, &str) = ("flow.width", ".cell.width");

/// The models of format 1.
pub(crate) const FORMS: [Form; 16] = [
    Form {
        old: "exact/ouriemi",
        scene: "bed",
        model: "laminar-exact",
        moved: &[LEVEL, HEIGHT, FORM],
        top: Some("plane"),
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "exact/bingham-plane",
        scene: "channel",
        model: "bingham-exact",
        moved: &[HEIGHT],
        top: None,
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "exact/bagnold-film",
        scene: "granular",
        model: "bagnold-film",
        moved: &[("flow.height", "bed.thickness")],
        top: None,
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "exact/log-law",
        scene: "channel",
        model: "log-law",
        moved: &[HEIGHT],
        top: None,
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "laminar",
        scene: "bed",
        model: "laminar",
        moved: &[LEVEL, HEIGHT, FORM],
        top: Some("plane"),
        unsaid: &[],
        slope: None,
    },
    Form { old: "bingham", scene: "channel", model: "bingham", moved: &[HEIGHT], top: None, unsaid: &[], slope: None },
    Form {
        old: "section/duct",
        scene: "channel",
        model: "duct",
        moved: &[HEIGHT, SHAPE, SECTION_WIDTH, METHOD],
        top: None,
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "section/bed",
        scene: "bed",
        model: "duct-bed",
        moved: &[LEVEL, HEIGHT, SHAPE, SECTION_WIDTH, FORM, METHOD],
        top: Some("plane"),
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "section/cavity",
        scene: "benchmark",
        model: "cavity",
        moved: &[
            ("flow.height", ".geometry.height"),
            ("flow.width", ".geometry.width"),
            ("flow.lid_velocity", ".geometry.lid_velocity"),
            METHOD,
        ],
        top: None,
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "sheet-flow",
        scene: "bed",
        model: "sheet-flow",
        moved: &[
            LEVEL,
            HEIGHT,
            ("bed.reading", ".bed_level"),
            METHOD,
            ("closures.lid", "flow.top"),
            ("closures.suspension.settling_velocity", "grains.settling_velocity"),
            ("solver.turns", ".solver.max_iterations"),
        ],
        top: None,
        unsaid: &[("bed.reading", "in-flow"), ("closures.suspension", "none")],
        slope: Some("sine"),
    },
    Form {
        old: "two-fluid",
        scene: "bed",
        model: "two-fluid",
        moved: &[("bed.phi_max", ".phi_max"), ("model.state", ".state"), ("model.fluid_stress", ".fluid_stress")],
        top: None,
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "shear-cell",
        scene: "benchmark",
        model: "shear-cell",
        moved: &[
            ("flow.height", ".geometry.height"),
            ("flow.phi", ".geometry.phi"),
            ("flow.phi_max", ".geometry.phi_max"),
            ("flow.velocity_lower", ".geometry.velocity_lower"),
            ("flow.velocity_upper", ".geometry.velocity_upper"),
            ("flow.temperature_lower", ".geometry.temperature_lower"),
            ("flow.temperature_upper", ".geometry.temperature_upper"),
        ],
        top: None,
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "grains",
        scene: "granular",
        model: "dem",
        moved: &[
            LAYERS,
            BOTTOM,
            LENGTH,
            ACROSS,
            ("flow.side_walls", "flow.width"),
            ("flow.smooth_walls", ".smooth_walls"),
            FRICTION,
            RESTITUTION,
        ],
        top: None,
        unsaid: &[],
        slope: Some("tangent"),
    },
    Form {
        old: "coupled",
        scene: "bed",
        model: "coupled",
        moved: &[
            LAYERS,
            BOTTOM,
            ("bed.relief", ".relief"),
            ("bed.relief_step", ".relief_step"),
            LENGTH,
            ACROSS,
            ("flow.side_walls", "flow.width"),
            ("flow.height", TOP_HEIGHT),
            ("discrete.hold_creep", ".discrete.freeze_below"),
            ("discrete.hold_period", ".discrete.freeze_period"),
            ("discrete.hold_after", ".discrete.freeze_after"),
            FRICTION,
            RESTITUTION,
        ],
        top: None,
        unsaid: &[("closures.side_wall", "none")],
        slope: None,
    },
    Form {
        old: "impact",
        scene: "benchmark",
        model: "impact",
        moved: &[
            ("flow.velocity", ".motion.velocity"),
            ("flow.angle", ".motion.angle"),
            ("flow.spin", ".motion.spin"),
            ("flow.target", ".motion.target"),
            FRICTION,
            RESTITUTION,
        ],
        top: None,
        unsaid: &[],
        slope: None,
    },
    Form {
        old: "trial",
        scene: "benchmark",
        model: "verification",
        moved: &[
            ("flow.velocity", ".motion.velocity"),
            ("flow.gravity", ".motion.gravity"),
            ("model.trial", ".which"),
            FRICTION,
            RESTITUTION,
        ],
        top: None,
        unsaid: &[],
        slope: None,
    },
];

impl Form {
    /// The form of a case with this `kind` and `solution`.
    pub(crate) fn of(kind: &str, solution: Option<&str>) -> Option<&'static Self> {
        let named = |form: &&Self| match (form.old.split_once('/'), solution) {
            (Some(parts), Some(solution)) => parts == (kind, solution),
            (None, _) => form.old == kind,
            (Some(_), None) => false,
        };
        FORMS.iter().find(named)
    }

    /// Where the key `path`, `table.key` or longer, stands in format 2.
    pub(crate) fn place(&self, path: &str) -> String {
        let rest = |old: &str| path.strip_prefix(old).filter(|rest| rest.is_empty() || rest.starts_with('.'));
        if let Some((rest, new)) = self.moved.iter().find_map(|(old, new)| Some((rest(old)?, new))) {
            let model = if new.starts_with('.') { self.model } else { "" };
            return format!("{model}{new}{rest}");
        }
        let table = path.split('.').next().unwrap_or_default();
        if OF_THE_FLOW.contains(&table) { path.to_owned() } else { format!("{}.{path}", self.model) }
    }
}

/// Whether the document is a case of format 1.
pub(super) fn is_old(document: &Document) -> bool {
    let first = matches!(document.node("format").map(|node| &node.data), Some(Data::Integer(1)));
    document.node(SCENE).is_none() && (first || document.node("model.kind").is_some())
}

/// The model of a case of format 1, if it says a known one.
fn form(document: &Document) -> Option<&'static Form> {
    let word = |path: &str| match &document.node(path)?.data {
        Data::Text(word) => Some(word.as_str()),
        _ => None,
    };
    Form::of(word("model.kind")?, word("model.solution"))
}

/// Why a case of format 1 is refused: the new name of each of its keys.
pub(super) fn refused(document: &Document) -> Vec<Violation> {
    let form = form(document);
    let place = if document.node("format").is_some() { "format" } else { "model.kind" };
    let scene = form.map(|form| (form.scene, form.model));
    let mut violations = vec![Violation::new(Fault::OldFormat { scene }, place.into(), document.locate(place))];
    let (Some(form), Data::Table(tables)) = (form, &document.root.data) else { return violations };
    let mut renamed = |old: &str, node: &Node| {
        let fault = form.renamed(old);
        violations.extend(fault.map(|fault| Violation::new(fault, old.to_owned(), node.key.clone())));
    };
    for (table, node) in tables {
        if let Data::Table(keys) = &node.data
            && (OF_THE_FLOW.contains(&table.as_str()) || table == "model")
        {
            // Between side walls the width is that of the flow.
            let walls = matches!(document.node("flow.side_walls").map(|node| &node.data), Some(Data::Boolean(true)));
            let paths = keys.iter().map(|(key, node)| (format!("{table}.{key}"), node));
            paths.filter(|(path, _)| !(walls && path == ACROSS.0)).for_each(|(path, node)| renamed(&path, node));
        } else if table != "format" {
            renamed(table, node);
            let inside = form.moved.iter().filter(|(old, _)| old.starts_with(&format!("{table}.")));
            inside.filter_map(|(old, _)| Some((old, document.node(old)?))).for_each(|(old, node)| renamed(old, node));
        }
    }
    violations
}

impl Form {
    /// That the key or table `old` has another place now, if it has.
    fn renamed(&self, old: &str) -> Option<Fault> {
        let new = match old {
            // The model has both parts of the old name.
            "model.solution" => return None,
            "model.kind" => format!("the table [{}]", self.model),
            "flow.side_walls" => "the distance flow.width in place of the period cell.width".into(),
            _ if old.contains('.') => self.place(old),
            _ => format!("[{}]", self.place(old)),
        };
        let with_bed = self.scene == "bed" && (old, new.as_str()) == HEIGHT;
        (new != old).then(|| Fault::Renamed { old: old.into(), new, with_bed })
    }
}
