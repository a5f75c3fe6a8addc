//! The codes of an error are stated once: what each variant answers, and the list of them all.

/// `codes!(Type { Self::Variant { .. } => "code", ... })` gives `Type` its `code` and the list `CODES`, so that neither lacks one.
/// Variants that hold another error answer with its code: they follow in `nested { Self::Variant(error) => error.code(), ... }`.
macro_rules! codes {
    ($type:ty { $($variant:pat => $code:literal),+ $(,)? } $(nested { $($outer:pat => $inner:expr),+ $(,)? })?) => {
        impl $type {
            /// Every code that it has of its own.
            #[allow(dead_code, reason = "the codes of a type that is not public are read by a test alone")]
            pub const CODES: &'static [&'static str] = &[$($code),+];

            /// Stable identifier, as in the answer of `--json`.
            #[must_use]
            pub fn code(&self) -> &'static str {
                match self {
                    $($variant => $code,)+
                    $($($outer => $inner,)+)?
                }
            }
        }
    };
}
pub(crate) use codes;
