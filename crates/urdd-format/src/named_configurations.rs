//! `named_configurations_module`: configurations that a person named, such as `home`.

use std::collections::HashMap;

use super::bounds::BoundsModule;
use super::dof::DofModule;
use super::object::pattern;
use super::types::{module, types};

module! {
    /// Configurations that a person named: `home`, `ready`, `retract`.
    pub struct NamedConfigurationsModule {
        /// The configurations, in the order in which the person added them.
        pub configurations: Vec<NamedConfiguration>,
    }
}

pattern! {
    /// A name: not empty.
    pub struct ConfigurationName matches r"^[\s\S]+$" by |text| !text.is_empty();
}

types! {
    /// A configuration that a person named.
    pub struct NamedConfiguration {
        /// Its name; unique in the module, and not empty.
        pub name: ConfigurationName,
        /// The positions that the person set, in DOF order. What a person decides is free; the names must exist.
        pub positions: Vec<DofPosition>,
        /// What follows: one value per DOF, rad or m. A DOF without an entry in `positions` has its value in the
        /// default configuration.
        pub configuration: Vec<f64> where { unit: "rad or m", length: "dofs" },
    }

    /// The position of a DOF.
    pub struct DofPosition {
        /// Name of the DOF, as in `dofs` of `dof_module`.
        pub dof_name: String,
        /// Its position, rad or m.
        pub position: f64 where { unit: "rad or m" },
    }
}

/// What a person says of a named configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct ConfigurationEdit {
    /// Its name.
    pub name: ConfigurationName,
    /// The positions, in any order.
    pub positions: Vec<DofPosition>,
}

impl From<&NamedConfiguration> for ConfigurationEdit {
    fn from(named: &NamedConfiguration) -> Self {
        ConfigurationEdit { name: named.name.clone(), positions: named.positions.clone() }
    }
}

/// The DOFs of a robot, by which the positions of a named configuration become a configuration (SPEC 6.7).
///
/// The generator and editors of URDDs write the module with this code. The validator does not use it.
#[derive(Debug, Clone)]
pub struct NamedDofs<'a> {
    indices: HashMap<&'a str, usize>,
    bounds: &'a BoundsModule,
}

/// Why a robot cannot have a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PositionFault {
    /// It has no DOF of this name.
    UnknownDof,
    /// The DOF is limited to these bounds, the smaller one first.
    OutOfBounds([f64; 2]),
}

impl<'a> NamedDofs<'a> {
    /// The DOFs of these modules.
    pub fn new(dof: &'a DofModule, bounds: &'a BoundsModule) -> Self {
        // Of several DOFs with one name, the first counts.
        let dofs = dof.dofs.iter().enumerate().rev();
        NamedDofs { indices: dofs.map(|(idx, dof)| (dof.name.as_str(), idx)).collect(), bounds }
    }

    /// Why the robot cannot have a position; `None` if it can. Only limited DOFs have to be within their bounds (SPEC
    /// 6.7.4), to the tolerance of SPEC 5.6.
    pub fn fault(&self, position: &DofPosition) -> Option<PositionFault> {
        let Some(&idx) = self.indices.get(position.dof_name.as_str()) else {
            return Some(PositionFault::UnknownDof);
        };
        let &[a, b] = self.bounds.bounds.get(idx)?;
        let (lower, upper) = (a.min(b), a.max(b));
        let is_limited = self.bounds.dof_limited.get(idx) == Some(&true);
        let tolerance = (1e-9 * lower.abs().max(upper.abs())).max(1e-12);
        let is_within = (lower - tolerance..=upper + tolerance).contains(&position.position);
        (is_limited && !is_within).then_some(PositionFault::OutOfBounds([lower, upper]))
    }

    /// The named configuration that follows. Positions of unknown DOFs are left out; of several positions of one DOF the
    /// last one counts.
    pub fn named(&self, edit: &ConfigurationEdit) -> NamedConfiguration {
        let mut set: Vec<Option<&DofPosition>> = vec![None; self.bounds.bounds.len()];
        for position in &edit.positions {
            let idx = self.indices.get(position.dof_name.as_str());
            if let Some(place) = idx.and_then(|idx| set.get_mut(*idx)) {
                *place = Some(position);
            }
        }
        let bounds = self.bounds.bounds.iter();
        let value = |(position, &[a, b]): (&Option<&DofPosition>, &[f64; 2])| match position {
            Some(position) => position.position + 0.0,
            None => 0.0_f64.max(a.min(b)).min(a.max(b)) + 0.0,
        };
        NamedConfiguration {
            name: edit.name.clone(),
            configuration: set.iter().zip(bounds).map(value).collect(),
            positions: set.into_iter().flatten().cloned().collect(),
        }
    }
}
