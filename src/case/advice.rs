//! What to do about a fault: what would be allowed, and a hint.

use super::diagnose::nearest;
use super::fault::Fault;
use super::violation::CaseFault;
use crate::units::UnitError;

impl CaseFault for Fault {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn allowed(&self) -> Option<String> {
        match self {
            Self::Unknown { allowed, .. }
            | Self::NotUsed { allowed, .. }
            | Self::Top { allowed, .. }
            | Self::UnknownWord { allowed, .. }
            | Self::LawMismatch { allowed, .. }
            | Self::WhichModel { allowed, .. }
            | Self::OtherScene { allowed, .. }
            | Self::Drives { allowed, .. } => Some(allowed.join(", ")),
            Self::Missing { allowed, .. } | Self::NotFinite { allowed, .. } | Self::OutOfRange { allowed, .. } => {
                Some(allowed.clone())
            }
            Self::WrongType { expected, .. } => Some(expected.clone()),
            Self::OldFormat { scene: Some((scene, model)) } => {
                Some(format!("format = 2 with scene = \"{scene}\" and a table [{model}]"))
            }
            Self::OldFormat { scene: None } => Some("format = 2 with a scene and the tables of its models".into()),
            Self::Unit { unit, .. } if unit == "1" => Some("a pure number".into()),
            Self::Unit { diameters: true, .. } => {
                Some("a number in m, or a text such as \"1 m\" or, in diameters of the grains, \"1 d\"".into())
            }
            Self::Unit { unit, .. } => Some(format!("a number in {unit}, or a text such as \"1 {unit}\"")),
            Self::TooSteep { definition: "sine", .. } => Some("less than 1".into()),
            Self::TooSteep { .. } => Some("less than 90 deg".into()),
            Self::TooLarge { limit } => Some(format!("at most {limit} bytes")),
            _ => None,
        }
    }

    fn hint(&self) -> Option<String> {
        let meant = |nearest: &Option<String>| nearest.as_ref().map(|n| format!("did you mean \"{n}\"?"));
        match self {
            Self::NoSuchCase { nearest, .. } => {
                Some(meant(nearest).unwrap_or_else(|| "`bedload list cases` shows the shipped ones".into()))
            }
            Self::UnknownWord { nearest, .. } | Self::UnknownQuantity { nearest, .. } => meant(nearest),
            Self::Unknown { nearest, elsewhere, .. } => {
                elsewhere.as_ref().map(|table| format!("it belongs to {table}")).or_else(|| meant(nearest))
            }
            Self::NotUsed { users, .. } if users.is_empty() => Some("remove it".into()),
            Self::NotUsed { users, .. } => Some(format!("remove it; used by {}", users.join(", "))),
            Self::Top { users, allowed, .. } => {
                let other = allowed.first().map(|top| format!("top = \"{top}\"")).unwrap_or_default();
                let users = if users.is_empty() { String::new() } else { format!("; solved by {}", users.join(", ")) };
                Some(other + &users)
            }
            Self::Missing { description, .. } if !description.is_empty() => Some(description.clone()),
            Self::Syntax { meant: Some(text), .. } | Self::Unit { meant: Some(text), .. } => Some(text.clone()),
            Self::Unit { error: UnitError::UnknownUnit { nearest: Some(n), .. }, .. } => {
                Some(format!("did you mean \"{n}\"?"))
            }
            Self::Unit { error: UnitError::NoUnit { text }, unit, diameters, .. } => {
                let grains =
                    if *diameters { format!(", or \"{text} d\" in diameters of the grains") } else { String::new() };
                Some(format!("write {text} without quotes if it is in {unit}, or \"{text} {unit}\"{grains}"))
            }
            Self::Drives { given, allowed } if given.len() > 1 => {
                let pairs = allowed.iter().any(|drives| drives.contains(" and "));
                let keep = if pairs { "keep one of these pairs" } else { "keep one" };
                Some(format!("{keep}; `--set flow.KEY=` (an empty value) removes a key"))
            }
            Self::Drives { .. } => Some("give one of these".into()),
            Self::BadSet { .. } => {
                Some("for example --set flow.depth=\"65 mm\"; an empty value removes the key".into())
            }
            Self::Empty | Self::Binary { .. } | Self::NotUtf8 { .. } => {
                Some("`bedload new` writes a case to start from".into())
            }
            Self::OldFormat { .. } => Some("`bedload migrate OLD.toml NEW.toml` writes it in format 2".into()),
            Self::WhichModel { given: Some(given), allowed, .. } => nearest(given, allowed.iter().map(String::as_str))
                .map(|model| format!("did you mean \"{model}\"?"))
                .or_else(|| Some("`bedload list models` shows what each one solves".into())),
            Self::WhichModel { set: Some(model), .. } => {
                Some(format!("--set changes a value and chooses no model: add --model {model}"))
            }
            Self::WhichModel { .. } => Some("give the table of one model, or choose one with --model".into()),
            Self::TwoModels { named, given, file } => {
                Some(format!("leave out --model for {named}, or give {file} --model {given}"))
            }
            Self::OtherScene { .. } => Some("`bedload list models` shows what each one solves".into()),
            Self::LawMismatch { .. } => Some("`bedload list closures` shows all laws".into()),
            Self::LimitKey { .. } => Some("for example over = \"flow.slope=0.01:0.05:9\"".into()),
            Self::CheckLevel { column: true, .. } => Some("for example at = \"10 mm\"".into()),
            Self::CheckLevel { .. } => Some("remove it".into()),
            _ => None,
        }
    }
}
