//! The learned self-collision model of a robot.

use super::Robot;
use super::error::RobotError;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_learned::CollisionModel;

impl Robot {
    /// The learned self-collision model (SPEC 8.8): an estimate of the clearance between links. It filters out
    /// configurations that are far from contact, before an exact check of the rest. It is an estimate, not a guarantee:
    /// [`CollisionModel::evaluation`] gives its measured error rates.
    ///
    /// ```
    /// # use urdd_robot::{Queries, Robot, RobotError, ShapeKind};
    /// fn is_free(robot: &Robot, q: &[f64]) -> Result<bool, RobotError> {
    ///     let model = robot.collision_model()?;
    ///     if !model.may_collide(q)? {
    ///         return Ok(true); // most free configurations, and some collisions: `evaluation` counts them
    ///     }
    ///     Ok(!robot.proximity(ShapeKind::Pieces)?.in_collision(q)?)
    /// }
    /// ```
    ///
    /// # Errors
    /// If `self_collision_model_module`, `chain_module` or `dof_module` is missing or unusable.
    pub fn collision_model(&self) -> Result<CollisionModel, RobotError> {
        let kind = ModuleKind::SelfCollisionModel;
        let part = self.part(&[kind])?;
        let Some(ModuleDocument::SelfCollisionModel(module)) = part.document(kind) else {
            return Err(RobotError::Missing(kind));
        };
        let num_dofs = self.motion()?.kinematics.num_dofs();
        let unusable = |reason: String| RobotError::Unusable { module: kind, reason };
        let (pairs, others) = (module.pairs.iter(), module.other_pairs.iter());
        let links = pairs.flat_map(|pair| [pair.link_a_idx, pair.link_b_idx]);
        let links = links.chain(others.flat_map(|pair| [pair.link_a_idx, pair.link_b_idx]));
        let num_links = self.link_names()?.len();
        if let Some(link) = links.map(|link| link.get()).find(|link| *link >= num_links) {
            let reason = format!("link {link} is out of range: the robot has {num_links} links");
            return Err(unusable(reason));
        }
        CollisionModel::new(module, num_dofs).map_err(|error| unusable(error.to_string()))
    }
}
