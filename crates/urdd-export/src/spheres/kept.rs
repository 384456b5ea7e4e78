//! The spheres that the URDD has, in place of new ones.

use crate::Choices;
use urdd_format::link_shapes_spheres::{SphereLevel, SphereOrigin};
use urdd_robot::{Robot, RobotError};
use urdd_spheres::model::{Sphere, Spheres};
use urdd_spheres::samples::Pairs;

/// A level of `link_shapes_spheres_module`.
pub(super) struct Level {
    number: usize,
    level: SphereLevel,
}

/// The level to write: with `cover` the finest that covers, otherwise the last that does not. `None` where the URDD has none,
/// or other spheres are asked for.
pub(super) fn level(robot: &Robot, options: &Choices) -> Result<Option<Level>, RobotError> {
    let default = Choices::default();
    let is_other = options.spheres.is_some()
        || options.total_spheres.is_some()
        || options.shapes != default.shapes;
    if is_other {
        return Ok(None);
    }
    let Some(module) = robot.spheres_module()? else { return Ok(None) };
    let mut levels = module.levels.into_iter().enumerate().rev();
    let found = levels.find(|(_, level)| level.covers == options.cover);
    Ok(found.map(|(number, level)| Level { number, level }))
}

impl Level {
    /// The spheres of these links.
    pub fn spheres(&self, links: &[usize]) -> Spheres {
        let one = |link: &usize| {
            let own = self.level.spheres[*link].iter();
            own.map(|sphere| Sphere { centre: sphere.offset_xyz, radius: sphere.radius }).collect()
        };
        links.iter().map(one).collect()
    }

    /// Marks the pairs that a check by this level leaves out.
    pub fn mark_ignored(&self, pairs: &Pairs, ignored: &mut [bool]) {
        for (pair, ignored) in pairs.checked.iter().zip(ignored) {
            let links = pair.map(|link| pairs.links[link]);
            let mut own = self.level.ignored_pairs.iter();
            *ignored = own.any(|of| [of.link_a_idx.get(), of.link_b_idx.get()] == links);
        }
    }

    /// Whether a person gave them.
    pub fn is_given(&self) -> bool {
        self.level.origin == SphereOrigin::Given
    }

    /// Which spheres these are.
    pub fn said(&self) -> String {
        let origin = if self.is_given() { ", which a person gave" } else { "" };
        format!(
            "The spheres are those of level {} of link_shapes_spheres_module{origin}.",
            self.number
        )
    }
}
