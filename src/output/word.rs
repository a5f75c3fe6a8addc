//! How what is printed can be typed again.

/// An argument as a shell takes it back.
#[must_use]
pub fn word(argument: &str) -> String {
    let plain = |s: &str| !s.is_empty() && s.chars().all(|c| c.is_alphanumeric() || "/._-+,:=".contains(c));
    if plain(argument) { argument.to_owned() } else { format!("'{}'", argument.replace('\'', "'\\''")) }
}
