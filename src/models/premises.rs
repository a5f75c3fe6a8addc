//! What models assume of a flow, in numbers of the flow.

use crate::closures::Range;
use crate::result::Validity;

/// Bulk Reynolds number U h/ν up to which a flow counts as laminar: U is the mean velocity over the gap h that the fluid has
/// to itself. Turbulence sets in from about 1000 to 3000 between planes (Patel & Head 1969, J. Fluid Mech. 38, 181-201) and
/// from 2000 to 4000 in pipes; this is one limit for both.
pub const LAMINAR: Range = Range { variable: "Re", min: f64::NEG_INFINITY, max: 2000.0 };

/// Flags a flow that a model takes for laminar and whose bulk Reynolds number says otherwise.
#[must_use]
pub fn laminar(reynolds: f64) -> Option<Validity> {
    outside("flow/laminar".into(), &LAMINAR, reynolds)
}

/// Flags `value` if it is outside `range`.
#[must_use]
pub fn outside(closure: String, range: &Range, value: f64) -> Option<Validity> {
    (!range.contains(value)).then(|| Validity {
        closure,
        variable: range.variable.into(),
        value,
        range: range.to_string(),
        z_m: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_thousand_is_laminar_and_what_is_no_number_is_not() {
        assert_eq!(laminar(0.0), None);
        assert_eq!(laminar(2000.0), None);
        let flagged = laminar(2000.1).unwrap();
        assert_eq!((flagged.closure.as_str(), flagged.range.as_str()), ("flow/laminar", "Re <= 2000"));
        assert!(laminar(f64::NAN).is_some());
    }
}
