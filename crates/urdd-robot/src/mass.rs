//! The masses of links, and the centre of mass.

use nalgebra::{Point3, Vector3};

use super::Robot;
use super::error::RobotError;
use super::kept::LinkMass;
use urdd_document::kept::keep;

impl Robot {
    /// The mass of each link, and its centre of mass.
    ///
    /// # Errors
    /// If `urdf_module` is missing or unusable.
    pub fn link_masses(&self) -> Result<&[LinkMass], RobotError> {
        let of = |link: urdd_format::urdf::Link| {
            let inertial = link.inertial?;
            let origin = inertial.origin.and_then(|origin| origin.xyz);
            Some(LinkMass { mass: inertial.mass?.value, centre: origin.unwrap_or_default() })
        };
        keep(&self.masses, || {
            let links = self.description()?.links.into_iter();
            Ok(links.map(|link| of(link).unwrap_or_default()).collect())
        })
        .map(Vec::as_slice)
    }

    /// The centre of mass of the robot, in the root link's frame, m; `None` if it has no mass.
    ///
    /// # Errors
    /// As [`Robot::link_poses`] and [`Robot::link_masses`].
    pub fn centre_of_mass(&self, configuration: &[f64]) -> Result<Option<[f64; 3]>, RobotError> {
        let poses = self.link_poses(configuration)?;
        let (mut mass, mut moment) = (0.0, Vector3::zeros());
        for (link, pose) in self.link_masses()?.iter().zip(&poses) {
            mass += link.mass;
            moment += link.mass * (pose * Point3::from(link.centre)).coords;
        }
        Ok((mass > 0.0).then(|| (moment / mass).into()))
    }
}
