//! Whether the water goes where the slope pulls it, and what to change where it does not.

use super::error::CoupledError;
use super::run::Run;
use crate::closures::mixing_length::{BelowPacked, MixingLength};
use crate::dem::GrainError;
use crate::result::{NumericalError, SolveError};

/// Samples of the mean that is checked during the run.
const LATE: usize = 10;

/// What helps where the published integral leaves no turbulence in the lowest water.
const DENSE: &str = "closures.mixing_length.below_packed = \"clipped\", or a closures.mixing_length.phi_max well above the solid fraction of the bed: over a bed denser than that, the lowest water has no turbulence and runs away";
/// What helps elsewhere.
const COARSE: &str = "thicker slices of the fluid (discrete.slice), or a larger cell (cell.length, cell.width)";

impl Run<'_> {
    /// Refuses water that on the mean flows against the slope: over the last samples, or, at the `end`, over all that are
    /// averaged.
    pub(super) fn downhill(&self, end: bool) -> Result<(), NumericalError> {
        let samples = &self.record.samples;
        let first = self.record.transient().0;
        let averaged = samples.iter().take_while(|sample| sample.block < first).count();
        let late = (samples.len() >= LATE).then(|| samples.len() - LATE);
        for from in late.into_iter().chain(end.then_some(averaged)).filter(|from| *from < samples.len()) {
            let mean =
                samples[from..].iter().map(|sample| sample.velocity).sum::<f64>() / (samples.len() - from) as f64;
            if mean < 0.0 {
                let start = if from > 0 { samples[from - 1].time } else { 0.0 };
                let hint = if self.published() { DENSE } else { COARSE };
                return Err(NumericalError::FlowsUphill {
                    velocity_m_s: mean,
                    over_s: Some([start, self.time()]),
                    hint,
                });
            }
        }
        Ok(())
    }

    /// The error, with what helps where water without turbulence may be behind it.
    pub(super) fn hinted(&self, error: SolveError) -> SolveError {
        match error.downcast_ref() {
            Some(grains @ GrainError::Overlap { .. }) if self.published() => CoupledError::Thrown(*grains).into(),
            _ => error,
        }
    }

    /// Whether a layer denser than phi_max takes turbulence away from what lies above it.
    fn published(&self) -> bool {
        matches!(self.flow.mixing_length, MixingLength::LiSawamoto(law) if law.below_packed != BelowPacked::Clipped)
    }
}
