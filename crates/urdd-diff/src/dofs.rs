//! Differences of the degrees of freedom (which there are, their indices, and bounds that do not follow from the joints),
//! and of named configurations of them.

use crate::dof_state::DofState;
use crate::fields::{Fields, compare};
use crate::parts::{self, matched};
use crate::side::Side;
use urdd_format::diff_report::{DofDifference, PartDifference};
use urdd_format::index::Count;
use urdd_format::registry::{ModuleDocument, ModuleKind};

pub(super) fn differences(before: &Side, after: &Side, tolerance: f64) -> Vec<DofDifference> {
    let mut found = Vec::new();
    for part in matched(&names(before), &names(after)) {
        let mut changes = Vec::new();
        if let Some((i, j)) = part.both() {
            let (x, y) = (&before.dofs[i], &after.dofs[j]);
            // What follows from the joint is said at the joint.
            let departs = |dof: &DofState| dof.stated.key() != dof.derived.key();
            if departs(x) || departs(y) {
                changes = compare("", &x.stated, &y.stated, tolerance);
            }
            if i == j && changes.is_empty() {
                continue;
            }
        }
        found.push(DofDifference {
            name: part.name.to_owned(),
            presence: part.presence(),
            index_before: part.before.map(Count::saturating),
            index_after: part.after.map(Count::saturating),
            changes,
        });
    }
    found
}

fn names(side: &Side) -> Vec<&str> {
    side.dofs.iter().map(|dof| dof.name.as_str()).collect()
}

/// The named configurations that differ; `None` unless one is a URDD, and the other one too or imported.
pub(super) fn configurations(
    before: &Side,
    after: &Side,
    tolerance: f64,
) -> Option<Vec<PartDifference>> {
    before.urdd.as_ref().or(after.urdd.as_ref())?;
    let (a, b) = (configurations_of(before)?, configurations_of(after)?);
    Some(parts::differences(&a, &b, tolerance))
}

/// The configurations of a URDD or an import by name, each with one value per DOF; none without the module.
fn configurations_of(side: &Side) -> Option<Vec<(String, Fields)>> {
    let fields = |values: &mut dyn Iterator<Item = f64>| {
        let mut fields = Fields::default();
        for (dof, value) in side.dofs.iter().zip(values) {
            fields.number(&dof.name, dof.unit(), Some(value));
        }
        fields
    };
    let Some(urdd) = &side.urdd else {
        let named = side.beside.import.as_ref()?.configurations.iter().map(|named| {
            // DOFs that an import does not place are at 0, as in a URDD.
            let mut values = side.dofs.iter().map(|dof| {
                let placed = named.positions.iter().find(|at| at.dof_name == dof.name);
                placed.map_or(0.0, |at| at.position)
            });
            (named.name.to_string(), fields(&mut values))
        });
        return Some(named.collect());
    };
    let Some(ModuleDocument::NamedConfigurations(module)) =
        urdd.document(ModuleKind::NamedConfigurations)
    else {
        return Some(Vec::new());
    };
    let named = module.configurations.iter();
    let named = named
        .map(|named| (named.name.to_string(), fields(&mut named.configuration.iter().copied())));
    Some(named.collect())
}
