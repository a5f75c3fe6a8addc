//! What a fault of a case is, whoever finds it, and where it is.

use std::error::Error;
use std::ops::Range;
use std::sync::Arc;

/// What is wrong at one place of a case: its message, and what to do about it. [`Fault`](super::Fault) has those of reading a
/// case; a model has its own.
pub trait CaseFault: Error + Send + Sync + 'static {
    /// Stable identifier, as in the answer of `--json`.
    fn code(&self) -> &'static str;

    /// What is allowed there.
    fn allowed(&self) -> Option<String> {
        None
    }

    /// What to do about it.
    fn hint(&self) -> Option<String> {
        None
    }
}

impl dyn CaseFault {
    /// The fault as it was made, if it is a `T`.
    #[must_use]
    pub fn downcast_ref<T: CaseFault>(&self) -> Option<&T> {
        let error: &(dyn Error + 'static) = self;
        error.downcast_ref()
    }
}

/// Where something stands: which text, and which bytes of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// index of the text: 0 is the case file, the others are `--set` arguments
    pub text: usize,
    /// bytes
    pub bytes: Range<usize>,
}

/// A fault, the path where it is, and the places to point at.
#[derive(Clone, Debug)]
pub struct Violation {
    /// what is wrong
    pub fault: Arc<dyn CaseFault>,
    /// dotted path in the case: `flow.depth`
    pub path: String,
    /// places to point at, the main one first
    pub spans: Vec<Span>,
}

impl Violation {
    /// A fault at one place.
    #[must_use]
    pub fn new(fault: impl CaseFault, path: String, span: Span) -> Self {
        Self { fault: Arc::new(fault), path, spans: vec![span] }
    }
}
