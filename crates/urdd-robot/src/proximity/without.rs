//! Pairs and bodies that are not checked.

use std::collections::HashSet;

use super::Proximity;
use crate::error::RobotError;

impl Proximity {
    /// These shapes, without the pairs of these bodies: links, or objects that are attached. This is MoveIt's *allowed
    /// collision matrix* at run time, such as for two links that are always nearer than a margin. The shapes are shared,
    /// not copied. A pair that is not checked anyway is no error. Obstacles are still tested:
    /// [`Obstacle::ignoring`](crate::Obstacle::ignoring).
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
