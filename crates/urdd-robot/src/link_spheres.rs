//! The spheres of links that a URDD has.

use std::collections::BTreeSet;

use super::Robot;
use super::edits::Files;
use super::error::RobotError;
use super::shapes::ShapeKind;
use super::spheres::{self, Approximating, Covering, SphereChecker};
use urdd_format::link_shapes_spheres::{LinkShapesSpheresModule, SphereLevel};
use urdd_format::registry::{ModuleDocument, ModuleKind};

impl Robot {
    /// `link_shapes_spheres_module` (SPEC 8.9): spheres of links in levels from coarse to fine. `None` without the module.
    ///
    /// # Errors
    /// If `link_shapes_spheres_module` or `urdf_module` is unusable, or it has spheres or pairs of links that are not there.
    pub fn spheres_module(&self) -> Result<Option<LinkShapesSpheresModule>, RobotError> {
        const KIND: ModuleKind = ModuleKind::LinkShapesSpheres;
        let Some(part) = self.optional(KIND)? else { return Ok(None) };
        let Some(ModuleDocument::LinkShapesSpheres(module)) = part.document(KIND) else {
            return Err(RobotError::Missing(KIND));
        };
        let count = self.link_names()?.len();
        let mut levels = module.levels.iter().enumerate();
        match levels.find_map(|(number, level)| fault(level, number, count)) {
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
    let bad = spheres.find(|sphere| sphere.radius.is_nan() || sphere.radius <= 0.0)?;
    Some(format!("a sphere of level {number} has the radius {}", bad.radius))
}

/// How a robot is checked by the spheres of its URDD.
impl Robot {
    /// A checker by the finest level that covers, with the coarser ones around it: where it says
    /// [`Free`](crate::spheres::CoveringAnswer::Free), no checked pair of pieces is in contact. That is as true as the module:
    /// `urdd validate` finds levels that do not cover by more than the 1e-6 of SPEC 8.9.4, or do not nest.
    ///
    /// # Errors
    /// [`RobotError::Missing`] without `link_shapes_spheres_module`, or without a level that covers; as
    /// [`Robot::spheres_module`], and if skips or kinematics are missing or unusable.
    pub fn covering_checker(&self) -> Result<SphereChecker<Covering>, RobotError> {
        let (levels, pairs) = self.sphere_levels(true)?;
        SphereChecker::covering(self, &levels, &pairs)
    }

    /// A checker by the last level that does not cover: fitted spheres, or those that a person gave. How often it is wrong
    /// stands in the level's [`evaluation`](SphereLevel::evaluation).
    ///
    /// # Errors
    /// [`RobotError::Missing`] without `link_shapes_spheres_module`, or without such a level; as
    /// [`Robot::covering_checker`].
    pub fn approximating_checker(&self) -> Result<SphereChecker<Approximating>, RobotError> {
        let (levels, pairs) = self.sphere_levels(false)?;
        SphereChecker::approximating(self, &levels, &pairs)
    }

    /// What the two checkers are made of: the last level that covers, or that does not, after those that it is inside of; and
    /// the pairs of links that it checks.
    ///
    /// # Errors
    /// As [`Robot::covering_checker`].
    pub fn sphere_levels(
        &self,
        covers: bool,
    ) -> Result<(Vec<spheres::SphereLevel>, Vec<[usize; 2]>), RobotError> {
        let missing = RobotError::Missing(ModuleKind::LinkShapesSpheres);
        let Some(module) = self.spheres_module()? else { return Err(missing) };
        let last = module.levels.iter().rposition(|level| level.covers == covers);
        let mut at = last.ok_or(missing)?;
        let pairs = self.checked_links(&module.levels[at])?;
        let mut levels = vec![level(&module.levels[at])];
        while let Some(outer) = module.levels[at].outer_level_idx {
            // A level that is no earlier one is a fault that a validator names.
            if outer.get() >= at {
                break;
            }
            at = outer.get();
            levels.push(level(&module.levels[at]));
        }
        levels.reverse();
        Ok((levels, pairs))
    }

    /// The pairs of links with spheres that are neither skipped (SPEC 8.8.5) nor ignored by a level.
    fn checked_links(&self, level: &SphereLevel) -> Result<Vec<[usize; 2]>, RobotError> {
        let skips = self.skips(ShapeKind::Pieces)?;
        let mut shapes = vec![Vec::new(); level.spheres.len()];
        for (shape, (link, _)) in skips.places().iter().enumerate() {
            if let Some(of) = shapes.get_mut(*link) {
                of.push(shape);
            }
        }
        let ignored: BTreeSet<[usize; 2]> = (level.ignored_pairs.iter())
            .map(|pair| [pair.link_a_idx.get(), pair.link_b_idx.get()])
            .collect();
        let links: Vec<usize> =
            (0..shapes.len()).filter(|link| !level.spheres[*link].is_empty()).collect();
        let mut pairs = Vec::new();
        for (place, a) in links.iter().enumerate() {
            for b in &links[place + 1..] {
                let mut between =
                    shapes[*a].iter().flat_map(|i| shapes[*b].iter().map(move |j| [*i, *j]));
                if !ignored.contains(&[*a, *b]) && between.any(|[i, j]| !skips.is_skipped(i, j)) {
                    pairs.push([*a, *b]);
                }
            }
        }
        Ok(pairs)
    }
}

fn level(level: &SphereLevel) -> spheres::SphereLevel {
    let links = level.spheres.iter().enumerate().filter(|(_, own)| !own.is_empty());
    let links = links.map(|(link_idx, own)| spheres::LinkSpheres {
        link_idx,
        spheres: (own.iter())
            .map(|of| spheres::Sphere { centre: of.offset_xyz, radius: of.radius })
            .collect(),
    });
    spheres::SphereLevel { links: links.collect(), covers: level.covers }
}
