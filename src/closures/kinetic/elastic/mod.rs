//! Pressure of enduring contacts.

use crate::closures::role::role;

role! {
    /// Pressure of enduring contacts.
    pub enum Elastic {
        none::None,
        johnson_jackson::JohnsonJackson(..),
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
