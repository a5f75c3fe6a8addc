//! The longest steps that a coupled flow bears: of the grains, with their contacts and the drag on them, and of the fluid.

use super::exchange::Exchange;
use crate::dem::engine::Engine;
use crate::dem::error::GrainError;
use crate::dem::law::LinearSpring;
use crate::models::coupled::Coupled;

/// Refuses a step of the grains beyond what drag and contacts bear, unless it is forced.
pub(super) fn grains(flow: &Coupled, engine: &Engine<LinearSpring>, exchange: &Exchange) -> Result<(), GrainError> {
    if flow.bed.discrete.force_time_step {
        Ok(())
    } else {
        engine.check_step()?;
        drag(flow, engine, exchange)
    }
}

/// Refuses a step of the grains beyond what the drag on them bears, unless it is forced.
pub(super) fn drag(flow: &Coupled, engine: &Engine<LinearSpring>, exchange: &Exchange) -> Result<(), GrainError> {
    let (step_s, limit_s) = (engine.settings().dt, exchange.drag_limit());
    let borne = step_s <= limit_s || flow.bed.discrete.force_time_step;
    if borne { Ok(()) } else { Err(GrainError::DragStep { step_s, limit_s }) }
}

/// Refuses an explicit step of the fluid beyond its limit, unless it is forced.
pub(super) fn fluid(flow: &Coupled, exchange: &Exchange) -> Result<(), GrainError> {
    let (step_s, limit_s) = (flow.coupling_period / f64::from(flow.fluid_steps), exchange.fluid_limit());
    match limit_s {
        Some(limit_s) if step_s > limit_s && !flow.bed.discrete.force_time_step => {
            Err(GrainError::FluidStep { step_s, limit_s })
        }
        _ => Ok(()),
    }
}
