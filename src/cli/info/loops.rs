//! The kinematic loops of a URDD.

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use serde::Serialize;

use urdd_document::urdd::Urdd;
use urdd_format::escape::line as safe;
use urdd_format::readable::counted;
use urdd_format::registry::{ModuleDocument, ModuleKind};

/// Maximum number of DOFs that are named.
const MOST_NAMED: usize = 8;

/// What closes the loops of a robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoopsInfo {
    /// Number of loops of each kind.
    pub kinds: BTreeMap<&'static str, usize>,
    /// Number of equations between DOFs.
    pub couplings: usize,
    /// Names of the DOFs that move freely.
    pub independent: Vec<String>,
}

impl LoopsInfo {
    /// That of a URDD; `None` without a usable `loops_module`.
    pub fn of(urdd: &Urdd) -> Option<Self> {
        let Some(ModuleDocument::Loops(module)) = urdd.document(ModuleKind::Loops) else {
            return None;
        };
        let mut kinds = BTreeMap::new();
        for one in &module.loops {
            *kinds.entry(one.kind.as_str()).or_default() += 1;
        }
        let names: Vec<&str> = match urdd.document(ModuleKind::Dof) {
            Some(ModuleDocument::Dof(dof)) => dof.dofs.iter().map(|dof| &*dof.name).collect(),
            _ => Vec::new(),
        };
        let independent = module.independent_dof_idxs.iter().map(|idx| {
            names.get(idx.get()).map_or_else(|| idx.get().to_string(), |name| (*name).to_owned())
        });
        let independent = independent.collect();
        Some(LoopsInfo { kinds, couplings: module.couplings.len(), independent })
    }

    pub fn write(&self, out: &mut impl Write) -> fmt::Result {
        let mut parts: Vec<String> =
            self.kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        if self.couplings > 0 {
            parts.push(counted(self.couplings, "coupling"));
        }
        let parts = if parts.is_empty() { "none".to_owned() } else { parts.join(", ") };
        let free = self.independent.len();
        let named: Vec<String> =
            self.independent.iter().take(MOST_NAMED).map(|name| safe(name).to_string()).collect();
        let more = if free > MOST_NAMED { " and others" } else { "" };
        let named = if free == 0 { String::new() } else { format!(": {}{more}", named.join(", ")) };
        let (dofs, moves) = (counted(free, "DOF"), if free == 1 { "moves" } else { "move" });
        writeln!(out, "  loops     {parts}; {dofs} {moves} freely{named}")
    }
}
