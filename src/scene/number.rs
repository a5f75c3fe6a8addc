//! A number of a scene, and whether a value was given or follows.

/// A number that the scene alone fixes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SceneNumber {
    /// its name, with the unit where it has one
    pub name: &'static str,
    /// its value \[SI]
    pub value: f64,
    /// what it is
    pub definition: &'static str,
}

impl SceneNumber {
    pub(super) const fn new(name: &'static str, value: f64, definition: &'static str) -> Self {
        Self { name, value, definition }
    }
}

/// A value of a scene, and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Given {
    /// it stands in the case
    Given(f64),
    /// it follows from the rest
    Derived(f64),
}

impl Given {
    /// The value, wherever it comes from.
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Self::Given(value) | Self::Derived(value) => value,
        }
    }
}
