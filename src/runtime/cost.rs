//! Time and memory of the running program.

/// Peak resident memory \[MB] of this process, where the system tells (Linux).
#[must_use]
pub fn peak_memory_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|l| l.starts_with("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib * 1024.0 / 1e6)
}

#[cfg(test)]
mod tests {
    #[test]
    fn memory_is_plausible() {
        if let Some(mb) = super::peak_memory_mb() {
            assert!((1.0..10_000.0).contains(&mb), "{mb}");
        }
    }
}
