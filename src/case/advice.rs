//! What to do about a fault: what would be allowed, and a hint.

use super::fault::Fault;
use crate::units::UnitError;

impl Fault {
    /// What is allowed there.
    #[must_use]
    pub fn allowed(&self) -> Option<String> {
        match self {
            Self::Unknown { allowed, .. }
            | Self::NotUsed { allowed, .. }
            | Self::UnknownWord { allowed, .. }
            | Self::LawMismatch { allowed, .. }
            | Self::Drives { allowed, .. } => Some(allowed.join(", ")),
            Self::RegularisationSize { .. } => {
                Some("one of lambda, lambda_scaled with a law; neither with law = \"none\"".into())
            }
            Self::Missing { allowed, .. } | Self::NotFinite { allowed, .. } | Self::OutOfRange { allowed, .. } => {
                Some(allowed.clone())
            }
            Self::WrongType { expected, .. } => Some(expected.clone()),
            Self::Unit { unit, .. } if unit == "1" => Some("a pure number".into()),
            Self::Unit { unit, .. } => Some(format!("a number in {unit}, or a text such as \"1 {unit}\"")),
            Self::Surfaces { .. } => Some("one of height, depth".into()),
            Self::NoRoomForFlow { height, .. } => Some(format!("more than 0 and less than {height} m")),
            Self::Floating { fluid, .. } => Some(format!("more than {fluid} kg/m3")),
            Self::Jammed { phi_max, .. } => Some(format!("less than {phi_max}")),
            Self::PackedBeyond { bed, .. } => Some(format!("at least {bed}; no below_packed = \"zero\"")),
            Self::ThinnerThanAGrain { diameter, .. } => Some(format!("at least {diameter} m")),
            Self::FrictionFalls { mu_s, .. } => Some(format!("more than {mu_s}")),
            Self::TooSteep { definition: "sine", .. } => Some("less than 1".into()),
            Self::TooSteep { .. } => Some("less than 90 deg".into()),
            Self::RoughnessAboveFlow { height, .. } => Some(format!("k_s less than {} m", 30.0 * height)),
            Self::Slender { low, high, .. } => Some(format!("{low} to {high} heights")),
            Self::DualIsExact => Some("newton; first-order with regularisation.law = \"none\"".into()),
            Self::TooLarge { limit } => Some(format!("at most {limit} bytes")),
            _ => None,
        }
    }

    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        let meant = |nearest: &Option<String>| nearest.as_ref().map(|n| format!("did you mean \"{n}\"?"));
        match self {
            Self::NoSuchCase { nearest, .. } => {
                Some(meant(nearest).unwrap_or_else(|| "`bedload list cases` shows the shipped ones".into()))
            }
            Self::UnknownWord { nearest, .. } | Self::UnknownQuantity { nearest, .. } => meant(nearest),
            Self::Unknown { nearest, elsewhere, .. } => {
                elsewhere.as_ref().map(|table| format!("it belongs to {table}")).or_else(|| meant(nearest))
            }
            Self::NotUsed { users, .. } => Some(format!("remove it; used by {}", users.join(", "))),
            Self::Missing { description, .. } if !description.is_empty() => Some(description.clone()),
            Self::Syntax { meant: Some(text), .. } | Self::Unit { meant: Some(text), .. } => Some(text.clone()),
            Self::Unit { error: UnitError::UnknownUnit { nearest: Some(n), .. }, .. } => {
                Some(format!("did you mean \"{n}\"?"))
            }
            Self::Unit { error: UnitError::NoUnit { text }, unit, .. } => {
                Some(format!("write {text} without quotes if it is in {unit}, or \"{text} {unit}\""))
            }
            Self::Drives { given, .. } if given.len() > 1 => {
                Some("keep one; `--set flow.KEY=` (an empty value) removes a key".into())
            }
            Self::Drives { .. } => Some("give exactly one".into()),
            Self::BadSet { .. } => {
                Some("for example --set flow.height=\"65 mm\"; an empty value removes the key".into())
            }
            Self::Empty | Self::Binary { .. } | Self::NotUtf8 { .. } => {
                Some("`bedload new` writes a case to start from".into())
            }
            Self::Floating { .. } => Some("grains.density must exceed fluid.density".into()),
            Self::IterationNeedsCreep => Some("give [regularisation] a law and a lambda, or take newton".into()),
            Self::NotWhole => {
                Some("remove it: `--set grid.along=`; model.form = \"mixed\" and method = \"newton\" have it".into())
            }
            Self::NeedsTime => Some("remove flow.oscillation, or set model.state = \"transient\"".into()),
            Self::NoWidth => Some("remove it, or set flow.shape = \"rectangle\"".into()),
            Self::Slender { .. } => Some("shape = \"planes\" is the limit of a wide section".into()),
            Self::LawMismatch { .. } => Some("`bedload list closures` shows all laws".into()),
            Self::LimitKey { .. } => Some("for example over = \"flow.slope=0.01:0.05:9\"".into()),
            Self::CheckLevel { column: true, .. } => Some("for example at = \"10 mm\"".into()),
            Self::CheckLevel { .. } => Some("remove it".into()),
            _ => None,
        }
    }
}
