//! The forward kinematics, with names and units.

use super::error::RobotError;
use urdd_document::consumer;
use urdd_document::urdd::Urdd;
use urdd_format::dof::Quantity;
use urdd_kinematics::ForwardKinematics;

/// The data that kinematics needs.
#[derive(Debug)]
pub(super) struct Motion {
    pub links: Vec<String>,
    pub joints: Vec<String>,
    pub dofs: Vec<String>,
    pub units: Vec<&'static str>,
    pub kinematics: ForwardKinematics,
}

impl Motion {
    pub(super) fn new(part: &Urdd) -> Result<Self, RobotError> {
        let modules = consumer::modules(part).ok_or(RobotError::MotionOpen)?;
        let kinematics = ForwardKinematics::new(&modules.chain, &modules.dof)?;
        let unit = |quantity: &Quantity| match quantity {
            Quantity::Angle => "rad",
            Quantity::Length => "m",
        };
        let (links, joints) = (modules.chain.links_in_chain, modules.chain.joints_in_chain);
        Ok(Self {
            links: links.into_iter().map(|link| link.name).collect(),
            joints: joints.into_iter().map(|joint| joint.joint_name).collect(),
            units: modules.dof.dofs.iter().map(|dof| unit(&dof.quantity)).collect(),
            dofs: modules.dof.dofs.into_iter().map(|dof| dof.name).collect(),
            kinematics,
        })
    }

    /// Number of configurations in the slice. For a robot without DOFs, an empty slice is one configuration.
    pub(super) fn batch(&self, configurations: &[f64]) -> Result<usize, RobotError> {
        let (found, dofs) = (configurations.len(), self.kinematics.num_dofs());
        match dofs {
            0 if found == 0 => Ok(1),
            0 => Err(RobotError::Batch { found, dofs }),
            _ if !found.is_multiple_of(dofs) => Err(RobotError::Batch { found, dofs }),
            _ => Ok(found / dofs),
        }
    }
}
