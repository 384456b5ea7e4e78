//! Differences of named configurations.

use crate::fields::Fields;
use crate::parts;
use crate::side::Side;
use urdd_format::diff_report::PartDifference;
use urdd_format::registry::{ModuleDocument, ModuleKind};

/// The named configurations that differ; `None` unless both are URDDs.
pub(super) fn differences(
    before: &Side,
    after: &Side,
    tolerance: f64,
) -> Option<Vec<PartDifference>> {
    let (a, b) = (configurations(before)?, configurations(after)?);
    Some(parts::differences(&a, &b, tolerance))
}

/// The configurations of a URDD by name, each with one value per DOF; none without the module.
fn configurations(side: &Side) -> Option<Vec<(String, Fields)>> {
    let urdd = side.urdd.as_ref()?;
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
