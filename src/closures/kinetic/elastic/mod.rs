//! Pressure of enduring contacts.

use crate::closures::Constant;
use crate::closures::role::role;

role! {
    /// Pressure of enduring contacts.
    pub enum Elastic {
        none::None,
        johnson_jackson::JohnsonJackson(..),
    }

    /// What the laws of this pressure answer.
    pub trait Enduring {
        /// Constants of the law, of which the phi_max of the bed is none.
        #[must_use]
        fn constants(&self) -> Vec<Constant>;
    }
}

impl Default for Elastic {
    fn default() -> Self {
        Self::JohnsonJackson(JohnsonJackson::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_out_is_as_published() {
        assert_eq!(toml::from_str::<Elastic>("law = \"johnson-jackson\"").unwrap(), Elastic::default());
    }
}
