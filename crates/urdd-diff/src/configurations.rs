//! Differences of named configurations.

use crate::fields::Fields;
use crate::parts;
use crate::side::Side;
use urdd_format::diff_report::PartDifference;
use urdd_format::registry::{ModuleDocument, ModuleKind};

/// The named configurations that differ; `None` unless one is a URDD, and the other one too or imported.
pub(super) fn differences(
    before: &Side,
    after: &Side,
    tolerance: f64,
) -> Option<Vec<PartDifference>> {
    before.urdd.as_ref().or(after.urdd.as_ref())?;
    let (a, b) = (configurations(before)?, configurations(after)?);
    Some(parts::differences(&a, &b, tolerance))
}

/// The configurations of a URDD or an import by name, each with one value per DOF; none without the module.
fn configurations(side: &Side) -> Option<Vec<(String, Fields)>> {
    let Some(urdd) = &side.urdd else {
        return imported(side);
    };
    let Some(ModuleDocument::NamedConfigurations(module)) =
        urdd.document(ModuleKind::NamedConfigurations)
    else {
        return Some(Vec::new());
    };
    let named = module.configurations.iter().map(|named| {
        let mut fields = Fields::default();
        for (dof, value) in side.dofs.iter().zip(&named.configuration) {
            fields.number(&dof.name, dof.unit(), Some(*value));
        }
        (named.name.to_string(), fields)
    });
    Some(named.collect())
}

/// Those of an import. DOFs that it does not place are at 0, as in a URDD.
fn imported(side: &Side) -> Option<Vec<(String, Fields)>> {
    let import = side.beside.import.as_ref()?;
    let named = import.configurations.iter().map(|named| {
        let mut fields = Fields::default();
        for dof in &side.dofs {
            let placed = named.positions.iter().find(|at| at.dof_name == dof.name);
            fields.number(&dof.name, dof.unit(), Some(placed.map_or(0.0, |at| at.position)));
        }
        (named.name.to_string(), fields)
    });
    Some(named.collect())
}
