//! Robots with loops: what their URDF+ says closes them, against the `loops_module` that a producer writes.

use std::collections::BTreeSet;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::data::{Damage, Data, LOOPED};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::regular;
use urdd_format::dof::DofModule;
use urdd_format::loops::LoopsModule;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::UrdfModule;

/// What closes a robot, by names. Names of loops, their frames and their order are the producer's: the validator judges
/// whether they close.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Looped {
    /// The two links of each loop.
    loops: Vec<BTreeSet<String>>,
    /// The joints of each coupling.
    couplings: Vec<BTreeSet<String>>,
    num_independent: usize,
}

/// What a URDD's `loops_module` does not say of the robot; `None` where all is there, or a document cannot be read.
///
/// # Errors
/// If the suite's list of the robot's loops is damaged.
pub(crate) fn fault(data: &Data, robot: &str, urdd: &Path) -> Result<Option<String>, Damage> {
    let path = format!("{LOOPED}/{robot}.json");
    let list = data.file(&path).unwrap_or_default();
    let expected: Looped =
        serde_json::from_slice(list).map_err(|error| Damage::new(&path, error))?;
    Ok(difference(&expected, urdd))
}

fn difference(expected: &Looped, urdd: &Path) -> Option<String> {
    let robot: UrdfModule = document(urdd, ModuleKind::Urdf)?;
    let dofs: DofModule = document(urdd, ModuleKind::Dof)?;
    let module: LoopsModule = document(urdd, ModuleKind::Loops)?;
    let link = |idx: usize| Some(robot.links.get(idx)?.name.clone());
    let joint = |idx: usize| Some(dofs.dofs.get(idx)?.joint_name.clone());
    let loops: Vec<BTreeSet<String>> = module
        .loops
        .iter()
        .map(|one| {
            [one.link_a_idx.get(), one.link_b_idx.get()].into_iter().filter_map(link).collect()
        })
        .collect();
    let couplings: Vec<BTreeSet<String>> = module
        .couplings
        .iter()
        .map(|one| one.terms.iter().filter_map(|term| joint(term.dof_idx.get())).collect())
        .collect();
    let missing = |of: &str, expected: &[BTreeSet<String>], found: &[BTreeSet<String>]| {
        let names = expected.iter().find(|names| !found.contains(names))?;
        let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        Some(format!("no {of} {}, as the URDF says", names.join(" and ")))
    };
    let independent = module.independent_dof_idxs.len();
    missing("loop between", &expected.loops, &loops)
        .or_else(|| missing("coupling of", &expected.couplings, &couplings))
        .or_else(|| {
            let right = expected.num_independent;
            let text = format!("{independent} independent DOFs, where the robot has {right}");
            (independent != right).then_some(text)
        })
}

fn document<T: DeserializeOwned>(urdd: &Path, kind: ModuleKind) -> Option<T> {
    let path = urdd.join(kind.folder()).join("module.json");
    serde_json::from_slice(&regular::read(&path, MAX_DOCUMENT_BYTES).ok()?).ok()
}
