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

    /// For a robot without DOFs, an empty slice is one configuration.
    pub(super) fn rows<'a>(&self, values: &'a [f64]) -> Result<Rows<'a>, RobotError> {
        let (found, dofs) = (values.len(), self.kinematics.num_dofs());
        match dofs {
            0 if found == 0 => Ok(Rows { values, dofs, count: 1 }),
            0 => Err(RobotError::Batch { found, dofs }),
            _ if !found.is_multiple_of(dofs) => Err(RobotError::Batch { found, dofs }),
            _ => Ok(Rows { values, dofs, count: found / dofs }),
        }
    }
}

/// Configurations that are stored one after another.
#[derive(Clone, Copy)]
pub(super) struct Rows<'a> {
    values: &'a [f64],
    dofs: usize,
    pub count: usize,
}

impl<'a> Rows<'a> {
    /// Configuration `k`.
    pub fn row(&self, k: usize) -> &'a [f64] {
        &self.values[k * self.dofs..(k + 1) * self.dofs]
    }
}
