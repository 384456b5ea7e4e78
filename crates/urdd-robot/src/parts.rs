//! Loading of only the modules that a query needs.

use std::sync::Arc;

use super::Robot;
use super::error::RobotError;
use urdd_document::load::Loaded;
use urdd_document::urdd::Urdd;
use urdd_format::registry::{ModuleKind, Profile};

impl Robot {
    /// These modules; an error if one is missing or unusable.
    pub(super) fn part(&self, kinds: &[ModuleKind]) -> Result<Urdd, RobotError> {
        let part = self.part_as_it_is(kinds)?;
        for kind in kinds {
            usable(&part, *kind)?;
        }
        Ok(part)
    }

    /// These modules, without a check that they are present and usable.
    pub(super) fn part_as_it_is(&self, kinds: &[ModuleKind]) -> Result<Urdd, RobotError> {
        let loaded = Loaded::read_only(self.root.clone(), kinds).map_err(RobotError::List)?;
        Ok(Urdd::new(Arc::new(loaded)))
    }

    /// The modules that kinematics needs, and `more`. For a legacy URDD also `urdf_module`, which alone has origins and
    /// axes.
    pub(super) fn moving_part(&self, more: &[ModuleKind]) -> Result<Urdd, RobotError> {
        let mut kinds = vec![ModuleKind::Chain, ModuleKind::Dof];
        kinds.extend_from_slice(more);
        let part = self.part(&kinds)?;
        if part.profile() == Profile::V1 {
            return Ok(part);
        }
        kinds.push(ModuleKind::Urdf);
        self.part(&kinds)
    }
}

/// An error if a module is missing or unusable.
pub(super) fn usable(part: &Urdd, kind: ModuleKind) -> Result<(), RobotError> {
    let module = part.module(kind).ok_or(RobotError::Missing(kind))?;
    match module.unusable() {
        None => Ok(()),
        Some(unusable) => Err(RobotError::Unusable {
            module: kind,
            reason: module
                .first_fault()
                .unwrap_or_else(|| unusable.to_string())
                .escape_debug()
                .to_string(),
        }),
    }
}
