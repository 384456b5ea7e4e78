//! Shapes behind spheres: where covering spheres are apart, so are the shapes; where not, the shapes decide.

use std::sync::Arc;

use super::answer::Covering;
use super::block::with_memory;
use super::checker::SphereChecker;
use super::level::{LinkSpheres, Sphere, SphereLevel};
use crate::Robot;
use crate::batch::{check_room, room};
use crate::error::RobotError;
use crate::lanes::LANES;
use crate::proximity::Proximity;
use crate::workspace::{Workspace, with_workspace};
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::fill;

/// A robot's shapes, asked only where covering spheres touch. Its answers are those of the shapes.
#[derive(Debug, Clone)]
pub struct ScreenedProximity {
    proximity: Arc<Proximity>,
    checker: SphereChecker<Covering>,
}

impl Proximity {
    /// The bounding sphere of each shape: a level that covers these shapes.
    pub fn bounding_level(&self) -> SphereLevel {
        let mut links: Vec<LinkSpheres> = Vec::new();
        for shape in &self.shapes {
            let sphere = Sphere {
                centre: shape.sphere.centre,
                // A point is a sphere, too.
                radius: shape.sphere.radius.max(1e-9),
            };
            match links.iter_mut().find(|own| own.link_idx == shape.link) {
                Some(own) => own.spheres.push(sphere),
                None => links.push(LinkSpheres { link_idx: shape.link, spheres: vec![sphere] }),
            }
        }
        SphereLevel { links, covers: true }
    }

    /// The pairs of links with pairs of shapes that are checked.
    pub fn link_pairs(&self) -> Vec<[usize; 2]> {
        self.groups.iter().map(|group| group.links).collect()
    }
}

impl ScreenedProximity {
    /// Shapes, and levels of spheres that cover them.
    ///
    /// # Errors
    /// As [`SphereChecker::covering`]; [`RobotError::Setting`] if a link with shapes has no spheres, or an object is attached.
    pub fn new(
        robot: &Robot,
        proximity: Arc<Proximity>,
        levels: &[SphereLevel],
    ) -> Result<Self, RobotError> {
        if proximity.num_bodies() != robot.link_names()?.len() {
            return Err(RobotError::Setting("spheres of a robot do not cover what is attached"));
        }
        let finest = levels.last();
        let has = |link: usize| finest.is_some_and(|level| !level.of(link).is_empty());
        if !proximity.shapes.iter().all(|shape| has(shape.link)) {
            return Err(RobotError::Setting("a link with shapes has no spheres"));
        }
        let checker = SphereChecker::covering(robot, levels, &proximity.link_pairs())?;
        Ok(ScreenedProximity { proximity, checker })
    }

    /// As [`Queries::in_collision`](crate::Queries::in_collision) of the shapes.
    ///
    /// # Errors
    /// As there, and [`RobotError::Far`].
    pub fn in_collision(&self, configuration: &[f64]) -> Result<bool, RobotError> {
        let mut answer = [false];
        self.some([configuration].into_iter(), &mut answer)?;
        Ok(answer[0])
    }

    /// As [`Queries::in_collision_batch`](crate::Queries::in_collision_batch) of the shapes.
    ///
    /// # Errors
    /// As there, and [`RobotError::Far`].
    pub fn in_collision_batch(&self, configurations: &[f64]) -> Result<Vec<bool>, RobotError> {
        let mut answers = room(self.proximity.motion.rows(configurations)?.count, 1)?;
        self.in_collision_batch_into(configurations, &Cancellation::default(), &mut answers)?;
        Ok(answers)
    }

    /// As [`ScreenedProximity::in_collision_batch`], into `out`.
    ///
    /// # Errors
    /// As there, and [`RobotError::Cancelled`].
    pub fn in_collision_batch_into(
        &self,
        configurations: &[f64],
        cancellation: &Cancellation,
        out: &mut [bool],
    ) -> Result<(), RobotError> {
        let rows = self.proximity.motion.rows(configurations)?;
        check_room(out.len(), rows.count, 1)?;
        fill(out, LANES, LANES, |(): &mut (), block, out| {
            cancellation.check()?;
            self.some((0..out.len()).map(|lane| rows.row(block * LANES + lane)), out)
        })
    }

    /// The answers of up to eight configurations.
    fn some<'a>(
        &self,
        rows: impl ExactSizeIterator<Item = &'a [f64]> + Clone,
        out: &mut [bool],
    ) -> Result<(), RobotError> {
        rows.clone().try_for_each(|row| self.checker.check(row))?;
        let proximity = &*self.proximity;
        // For each pair of links, the lanes in which its spheres touch.
        let mut touching: Vec<([usize; 2], u8)> = Vec::new();
        with_memory(&self.checker.model, |memory| {
            let mut each = |links: [usize; 2], lanes: u8| touching.push((links, lanes));
            self.checker.plain_scene().each_touching(memory, rows.clone(), &mut each);
        });
        out.fill(false);
        if touching.is_empty() {
            return Ok(());
        }
        with_workspace(|Workspace { placed, .. }| {
            for (lane, (row, out)) in rows.zip(out).enumerate() {
                let mut near =
                    touching.iter().filter(|(_, lanes)| lanes >> lane & 1 != 0).peekable();
                if near.peek().is_none() {
                    continue;
                }
                proximity.place(row, placed)?;
                *out = near.any(|(links, _)| {
                    let links = [links[0].min(links[1]), links[0].max(links[1])];
                    let own = proximity.groups.iter().filter(|group| {
                        [group.links[0].min(group.links[1]), group.links[0].max(group.links[1])]
                            == links
                    });
                    own.into_iter()
                        .any(|group| proximity.any_touches(placed, std::slice::from_ref(group)))
                });
            }
            Ok(())
        })
    }
}
