//! Whether a model solves what drives and bounds a flow: what it does not solve is refused, for left out in silence it would be another
//! flow.

use super::{Faults, ModelInfo};
use crate::case::{Fault, FlowTables};

/// Refuses what `scene` gives and the model does not solve, with the names of those of `others` that do.
pub(super) fn takes<S: FlowTables>(
    scene: &S,
    info: &ModelInfo,
    others: &[(&'static str, ModelInfo)],
    faults: &mut Faults,
) {
    let others: Vec<&ModelInfo> = others.iter().filter(|(kind, _)| *kind == S::KIND).map(|(_, info)| info).collect();
    let users = |solves: &dyn Fn(&ModelInfo) -> bool| -> Vec<String> {
        others.iter().filter(|info| solves(info)).map(|info| info.name.to_owned()).collect()
    };
    let refused = |name: String, users: Vec<String>, allowed: &[&str]| Fault::NotUsed {
        what: "key",
        name,
        model: info.name.into(),
        users,
        allowed: allowed.iter().map(|&name| name.to_owned()).collect(),
    };
    if let Some(top) = scene.top()
        && info.tops.is_some_and(|tops| !tops.contains(&top))
    {
        let fault = Fault::Top {
            top: top.into(),
            model: info.name.into(),
            users: users(&|info| info.tops.is_none_or(|tops| tops.contains(&top))),
            allowed: info.tops.unwrap_or_default().iter().map(|&top| top.to_owned()).collect(),
        };
        faults.push(("flow.top", fault));
    }
    for path in scene.given() {
        let name = path.rsplit('.').next().unwrap_or(path);
        if !info.solves(name) {
            faults.push((
                path,
                refused(name.to_owned(), users(&|info| info.solves(name)), info.takes.unwrap_or_default()),
            ));
        }
    }
}

impl ModelInfo {
    /// Whether the model solves these drives: `slope and shields`.
    pub(super) fn solves_all(&self, drives: &str) -> bool {
        drives.split(" and ").all(|drive| drive == "depth" || self.solves(drive))
    }

    /// Whether the model solves the key `name` of a flow.
    fn solves(&self, name: &str) -> bool {
        self.takes.is_none_or(|takes| takes.contains(&name))
    }
}
