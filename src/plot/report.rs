//! The page of a run.

/// x
pub struct Page;
/// x
pub fn report_html(_: &Page) -> String {
    String::new()
}
