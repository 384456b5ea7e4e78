//! The spheres of links that a URDD has.

use super::Robot;
use super::edits::Files;
use super::error::RobotError;
use super::robot::usable;
use urdd_format::link_shapes_spheres::{LinkShapesSpheresModule, SphereLevel};
use urdd_format::registry::{ModuleDocument, ModuleKind};

impl Robot {
    /// `link_shapes_spheres_module` (SPEC 8.9): spheres of links in levels from coarse to fine. `None` without the module.
    ///
    /// # Errors
    /// If `link_shapes_spheres_module` or `urdf_module` is unusable, or it has spheres or pairs of links that are not there.
    pub fn spheres_module(&self) -> Result<Option<LinkShapesSpheresModule>, RobotError> {
        const KIND: ModuleKind = ModuleKind::LinkShapesSpheres;
        let part = self.part_as_it_is(&[KIND])?;
        if part.module(KIND).is_none() {
            return Ok(None);
        }
        usable(&part, KIND)?;
        let Some(ModuleDocument::LinkShapesSpheres(module)) = part.document(KIND) else {
            return Err(RobotError::Missing(KIND));
        };
        let count = self.link_names()?.len();
        match module
            .levels
            .iter()
            .enumerate()
            .find_map(|(number, level)| fault(level, number, count))
        {
            Some(reason) => Err(RobotError::Unusable { module: KIND, reason }),
            None => Ok(Some((**module).clone())),
        }
    }

    /// The files of the URDD that change where it gets this module: those of the module, and `urdd.json` with their sizes and
    /// hashes, and version 1.1.0. Writes nothing.
    ///
    /// # Errors
    /// [`RobotError::Metadata`] if `urdd.json` is unusable.
    pub fn with_spheres(&self, module: &LinkShapesSpheresModule) -> Result<Files, RobotError> {
        self.edited_files(ModuleKind::LinkShapesSpheres, serde_json::to_value(module))
    }
}

/// What would make a program look beyond a list.
fn fault(level: &SphereLevel, number: usize, links: usize) -> Option<String> {
    if level.spheres.len() != links {
        let found = level.spheres.len();
        return Some(format!("level {number} has lists for {found} links, the robot has {links}"));
    }
    let lists = [&level.ignored_pairs, &level.always_pairs, &level.sometimes_pairs];
    let ends = lists.into_iter().flatten().flat_map(|pair| [pair.link_a_idx, pair.link_b_idx]);
    if let Some(link) = ends.map(|link| link.get()).find(|link| *link >= links) {
        return Some(format!(
            "link {link} of a pair of level {number} is out of range: the robot has {links} links"
        ));
    }
    let mut spheres = level.spheres.iter().flatten();
    let bad = spheres.find(|sphere| !(sphere.radius > 0.0))?;
    Some(format!("a sphere of level {number} has the radius {}", bad.radius))
}
