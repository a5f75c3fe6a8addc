//! How a role states its laws: a line each, from which the modules, the choice in a case file, the catalogue entries and the
//! answers of the role are made.
//!
//! ```text
//! laws!     { file::Law(..), file::Law, ... }                    modules and catalogue entries; `(..)`: it has parameters
//! choice!   { pub enum Choice from role { file::Law(..), ... } }           the laws from which a case file chooses, by `law = "..."`
//! role!     { pub enum Role { ... } pub trait Answers { ... } }  both, and what each law answers
//! Only<Law>                                                      a choice of one
//! ```
//!
//! The doc line of the law, in its own file, is its description in schema and case reference.

use std::borrow::Cow;
use std::fmt::Debug;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;

use super::Info;

/// A law with parameters: a struct of them, the same in the case file, in the problem and in the solver.
pub trait Law: Copy + Debug + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static {
    /// Catalogue entry.
    const INFO: &'static Info;
}

/// The description of a law: the doc line of its type.
#[must_use]
pub fn described<L: JsonSchema>() -> Value {
    L::json_schema(&mut SchemaGenerator::default()).get("description").cloned().unwrap_or_default()
}

/// The one law that a model takes in a role, written as a choice of one: `{ law = "...", parameters }`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Only<L>(pub L);

#[derive(Serialize, Deserialize)]
struct Tagged<W, L> {
    law: W,
    #[serde(flatten)]
    parameters: L,
}

impl<L: Law> Serialize for Only<L> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        Tagged { law: L::INFO.law, parameters: self.0 }.serialize(to)
    }
}

impl<'de, L: Law> Deserialize<'de> for Only<L> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let Tagged::<String, L> { law, parameters } = Tagged::deserialize(from)?;
        if law == L::INFO.law { Ok(Self(parameters)) } else { Err(D::Error::custom(format_args!("not a law: {law}"))) }
    }
}

impl<L: Law> JsonSchema for Only<L> {
    fn schema_name() -> Cow<'static, str> {
        format!("Only_{}", L::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut law = L::json_schema(generator);
        let tag = serde_json::json!({ "type": "string", "const": L::INFO.law });
        let properties = law.ensure_object().entry("properties").or_insert_with(|| Value::Object(Default::default()));
        if let Value::Object(properties) = properties {
            properties.shift_insert(0, "law".into(), tag);
        }
        let required = law.ensure_object().entry("required").or_insert_with(|| Value::Array(Vec::new()));
        if let Value::Array(required) = required {
            required.insert(0, "law".into());
        }
        json_schema!({ "oneOf": [law.to_value()] })
    }
}

/// The laws of a role: their modules, and their catalogue entries in `LAWS`.
macro_rules! laws {
    ({ $($(#[$attribute:meta])* $law:ident::$variant:ident $(($dots:tt))?),* $(,)? }) => {
        $(
            pub mod $law;
            $crate::closures::role::laws!(@export $law $variant $($dots)?);
        )*
        /// Catalogue entries of the role.
        pub(in crate::closures) static LAWS: &[&$crate::closures::Info] = &[$(&$law::INFO),*];
    };
    (@export $law:ident $variant:ident) => {};
    (@export $law:ident $variant:ident ..) => {
        pub use $law::$variant;

        impl $crate::closures::role::Law for $variant {
            const INFO: &'static $crate::closures::Info = &$law::INFO;
        }
    };
}

/// The laws from which a case file chooses, by `law = "..."`.
macro_rules! choice {
    ($(#[$meta:meta])* pub enum $role:ident from $from:ident $laws:tt) => {
        $crate::closures::role::choice! { @enum $(#[$meta])* #[serde(tag = "law")] $role $from $laws }
    };
    ($(#[$meta:meta])* pub enum $role:ident as word from $from:ident $laws:tt) => {
        $crate::closures::role::choice! { @enum $(#[$meta])* #[derive(Eq)] $role $from $laws }
    };
    (@enum $(#[$meta:meta])* $role:ident $from:ident {
        $($(#[$attribute:meta])* $law:ident::$variant:ident $(($dots:tt))?),* $(,)?
    }) => {
        #[derive(Clone, Copy, Debug, PartialEq, ::serde::Serialize, ::serde::Deserialize, ::schemars::JsonSchema)]
        #[serde(rename_all = "kebab-case")]
        $(#[$meta])*
        pub enum $role {
            $(
                #[schemars(extend("description" = $crate::closures::role::described::<$from::$law::$variant>()))]
                #[doc = concat!("[`", stringify!($from), "::", stringify!($law), "::", stringify!($variant), "`]")]
                $(#[$attribute])*
                $variant $(($crate::closures::role::choice!(@of $from $law $variant $dots)))?,
            )*
        }

        impl $role {
            /// Catalogue entry of the law.
            #[must_use]
            pub fn info(&self) -> &'static $crate::closures::Info {
                match self {
                    $(Self::$variant { .. } => &$from::$law::INFO,)*
                }
            }
        }
    };
    (@of $from:ident $law:ident $variant:ident ..) => { $from::$law::$variant };
}

/// A role: its laws, the choice of all of them, and what each of them answers.
macro_rules! role {
    ($(#[$meta:meta])* pub enum $role:ident $(as $word:tt)? { $($laws:tt)* } $($answers:tt)*) => {
        $crate::closures::role::laws! { { $($laws)* } }
        $crate::closures::role::choice! { $(#[$meta])* pub enum $role $(as $word)? from self { $($laws)* } }
        $crate::closures::role::role! { @answers $role { $($laws)* } $($answers)* }
    };
    (@answers $role:ident $laws:tt) => {};
    (@answers $role:ident $laws:tt $(#[$about:meta])* $vis:vis trait $answers:ident { $(
        $(#[$doc:meta])*
        fn $ask:ident $(<$real:ident: $bound:ident>)? (&self $(, $argument:ident: $of:ty)* $(,)?) $(-> $result:ty)?;
    )* }) => {
        $(#[$about])*
        $vis trait $answers {
            $($(#[$doc])* fn $ask $(<$real: $bound>)? (&self $(, $argument: $of)*) $(-> $result)?;)*
        }

        impl $answers for $role {
            $(
                #[inline]
                fn $ask $(<$real: $bound>)? (&self $(, $argument: $of)*) $(-> $result)? {
                    $crate::closures::role::role!(@each self $laws $ask ($($argument),*))
                }
            )*
        }
    };
    (@each $me:ident { $($(#[$attribute:meta])* $law:ident::$variant:ident $(($dots:tt))?),* $(,)? }
        $ask:ident $arguments:tt) => {
        match $me {
            $(Self::$variant { $(0: law, $dots)? } => {
                $crate::closures::role::role!(@law $law::$variant $(, law $dots)?).$ask $arguments
            })*
        }
    };
    (@law $law:ident::$variant:ident) => { $law::$variant };
    (@law $law:ident::$variant:ident, $found:ident ..) => { $found };
}

pub(crate) use {choice, laws, role};

#[cfg(test)]
mod tests {
    use schemars::generate::SchemaSettings;

    use super::*;
    use crate::closures::friction::{self, Coulomb};
    use crate::closures::mixture_viscosity::MixtureViscosity;

    choice! {
        /// One law.
        pub enum One from friction {
            coulomb::Coulomb(..),
        }
    }

    #[test]
    fn only_is_a_choice_of_one_to_the_letter() {
        let law = Coulomb { mu_s: 0.4 };
        let text = toml::to_string(&Only(law)).unwrap();
        assert_eq!(text, "law = \"coulomb\"\nmu_s = 0.4\n");
        assert_eq!(text, toml::to_string(&One::Coulomb(law)).unwrap());
        assert_eq!(One::Coulomb(law).info().law, "coulomb");
        assert_eq!(toml::from_str::<Only<Coulomb>>(&text).unwrap(), Only(law));
        assert!(toml::from_str::<Only<Coulomb>>(&text.replace("coulomb", "mu-i")).is_err());
        let laws = |schema: Schema| schema.get("oneOf").unwrap().to_string();
        let generator = &mut SchemaSettings::default().with(|s| s.inline_subschemas = true).into_generator();
        assert_eq!(laws(Only::<Coulomb>::json_schema(generator)), laws(One::json_schema(generator)));
    }

    #[test]
    fn the_words_of_a_choice_are_those_of_its_laws() {
        for (law, text) in [(MixtureViscosity::Clear, "clear"), (MixtureViscosity::Einstein, "einstein")] {
            assert_eq!(toml::to_string(&law).unwrap(), format!("law = \"{text}\"\n"));
            assert_eq!(law.info().law, text);
        }
        let described = format!("{:?}", MixtureViscosity::json_schema(&mut SchemaGenerator::default()));
        assert!(described.contains("The grains do not change the viscosity."), "{described}");
    }
}
