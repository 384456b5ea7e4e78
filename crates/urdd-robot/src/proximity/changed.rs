//! Objects that links carry, and pairs and bodies that are not checked.

use std::collections::HashSet;
use std::sync::Arc;

use super::swept::Shape;
use super::{Pair, Proximity};
use crate::error::RobotError;
use crate::obstacle::{Obstacle, fault};
use crate::robot::check_link;

impl Proximity {
    /// These shapes and an object that a link carries, such as a tool or what a gripper holds: every query then includes
    /// it, also among obstacles. The pose of `object` is that in the link's frame.
    ///
    /// The object is tested against the shapes of all links that move against it and against objects on them, except those
    /// that it [ignores](Obstacle::ignoring): the links that may touch it. Skips do not apply. An obstacle that ignores the
    /// link does not thereby ignore the object: it can name the object. These shapes are shared, not copied, and stay as
    /// they are; to release the object, use them again.
    ///
    /// ```
    /// use nalgebra::Isometry3;
    /// # use urdd_robot::{Robot, RobotError, ShapeKind};
    /// use urdd_robot::Obstacle;
    ///
    /// # fn ask(robot: &Robot) -> Result<(), RobotError> {
    /// let empty = robot.proximity(ShapeKind::Pieces)?;
    /// let part = Obstacle::cuboid("part", Isometry3::translation(0.0, 0.0, 0.05), [0.02, 0.02, 0.05])?;
    /// let holding = empty.attach(robot.link("palm")?, &part.ignoring("finger"))?;
    /// # let q = robot.configurations()?.zero();
    /// println!("{:?} m with the part, {:?} m without", holding.self_distance(&q)?, empty.self_distance(&q)?);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`RobotError::OutOfRange`] for a link that does not exist; [`RobotError::Unknown`] if the object ignores a link
    /// that does not exist; [`RobotError::Obstacle`] if a link or an attached object has its name, or
    /// a point of it is farther than 1e9 m from the link's origin.
    pub fn attach(&self, link: usize, object: &Obstacle) -> Result<Proximity, RobotError> {
        check_link(link, self.motion.links.len())?;
        if self.names.iter().any(|name| **name == *object.name()) {
            return Err(RobotError::Obstacle {
                name: object.name().to_owned(),
                reason: "a link or an attached object has this name: choose another one".to_owned(),
            });
        }
        let ignored = object.ignored.iter().map(|name| self.body(name));
        let ignored: Vec<usize> = ignored.collect::<Result<_, _>>()?;
        let mut with = self.clone();
        let owner = with.names.len();
        with.names.push(Arc::from(object.name()));
        let bodies = self.motion.kinematics.rigid_bodies();
        let meets = |shape: &usize| {
            let shape = &self.shapes[*shape];
            bodies[shape.link] != bodies[link] && !ignored.contains(&shape.owner)
        };
        let others: Vec<usize> = (0..self.shapes.len()).filter(meets).collect();
        for (piece, part) in object.parts.iter().enumerate() {
            if part.copies.is_some() {
                return Err(RobotError::Obstacle {
                    name: object.name().to_owned(),
                    reason: "a cloud of points or a field of heights cannot be attached".to_owned(),
                });
            }
            let place = with.shapes.len();
            let placed = part.placed(object.pose());
            let (core, sphere) = placed.map_err(|reason| fault(object.name(), &reason))?;
            let (core, radius) = (Arc::new(core), part.radius);
            with.shapes.push(Shape { link, owner, piece, core, radius, sphere, is_ball: false });
            let pair = |other: &usize| Pair { shapes: [*other, place], mean: None };
            with.pairs.extend(others.iter().map(pair));
        }
        Ok(with.arranged())
    }
}

impl Proximity {
    /// These shapes, without the pairs of these bodies: links, or objects that are attached. This is MoveIt's *allowed
    /// collision matrix* at run time, such as for two links that are always nearer than a margin. The shapes are shared,
    /// not copied. A pair that is not checked anyway is no error. Obstacles are still tested:
    /// [`Obstacle::ignoring`].
    ///
    /// ```
    /// # use urdd_robot::{Robot, RobotError, ShapeKind};
    /// # fn ask(robot: &Robot) -> Result<(), RobotError> {
    /// let proximity = robot.proximity(ShapeKind::Pieces)?.without([["wrist_1_link", "wrist_3_link"]])?;
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`RobotError::Unknown`], with the nearest name.
    pub fn without<'a>(
        &self,
        pairs: impl IntoIterator<Item = [&'a str; 2]>,
    ) -> Result<Proximity, RobotError> {
        let mut apart = HashSet::new();
        for [a, b] in pairs {
            let (a, b) = (self.body(a)?, self.body(b)?);
            apart.extend([[a, b], [b, a]]);
        }
        let mut with = self.clone();
        with.pairs.retain(|pair| !apart.contains(&pair.shapes.map(|at| self.shapes[at].owner)));
        Ok(with.arranged())
    }

    /// These shapes, without all that belong to these bodies, among obstacles too. The indices of the other bodies stay.
    ///
    /// # Errors
    /// As [`Proximity::without`].
    pub fn without_bodies<'a>(
        &self,
        names: impl IntoIterator<Item = &'a str>,
    ) -> Result<Proximity, RobotError> {
        let bodies = names.into_iter().map(|one| self.body(one));
        let bodies: HashSet<usize> = bodies.collect::<Result<_, _>>()?;
        let is_kept = |shape: usize| !bodies.contains(&self.shapes[shape].owner);
        let (mut with, mut places) = (self.clone(), Vec::new());
        with.shapes.clear();
        for (shape, one) in self.shapes.iter().enumerate() {
            places.push(with.shapes.len());
            with.shapes.extend(is_kept(shape).then(|| one.clone()));
        }
        with.pairs.retain(|pair| pair.shapes.into_iter().all(is_kept));
        for pair in &mut with.pairs {
            pair.shapes = pair.shapes.map(|shape| places[shape]);
        }
        Ok(with.arranged())
    }
}
