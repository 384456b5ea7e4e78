//! The source URDF: as data, its text, its limits and its masses.

use super::Robot;
use super::error::RobotError;
use super::kept::LinkMass;
use urdd_directory::read_error::ReadError;
use urdd_document::carried_urdf::read_file;
use urdd_document::kept::keep;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::root_metadata::Source;
use urdd_format::urdf::{Link, UrdfModule};
use urdd_kinematics::Load;

/// The file that a URDD was generated from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// The file's path in the URDD.
    pub path: String,
    /// The SHA-256 of its content, as 64 hexadecimal digits.
    pub sha256: String,
}

impl Robot {
    /// The robot's URDF as data: links with mass, visuals and collisions, joints with limits. Link and joint indices
    /// refer to this order. Zeros that a legacy URDD writes for missing values are absent here.
    ///
    /// # Errors
    /// If `urdf_module` is missing or unusable.
    pub fn description(&self) -> Result<UrdfModule, RobotError> {
        let part = self.part(&[ModuleKind::Urdf])?;
        part.description().cloned().ok_or(RobotError::Missing(ModuleKind::Urdf))
    }

    /// The source URDF that the URDD includes, according to its metadata. `None` if there is none, or in a legacy URDD.
    ///
    /// # Errors
    /// If the files cannot be listed.
    pub fn source(&self) -> Result<Option<SourceFile>, RobotError> {
        let part = self.part_as_it_is(&[])?;
        let source = part.metadata().and_then(|metadata| metadata.source.as_ref());
        Ok(source.map(|Source::Urdf(file)| SourceFile {
            path: file.path.clone(),
            sha256: file.sha256.to_string(),
        }))
    }

    /// The text of the source URDF. `None` if there is none, or it cannot be read.
    ///
    /// # Errors
    /// If the files cannot be listed, or this one changed on disk.
    pub fn source_text(&self) -> Result<Option<String>, RobotError> {
        let Some(file) = self.source()? else { return Ok(None) };
        match read_file(self.root(), &file.path) {
            Err(ReadError::Changed) => Err(RobotError::Changed(self.folder_name())),
            read => Ok(read.ok().map(|read| read.text)),
        }
    }
}

/// Each method fails if `bounds_module` is missing or unusable, or that of a legacy URDD, which has neither.
impl Robot {
    /// The largest speed of each DOF, rad/s or m/s, as the source states it; infinite where it states none.
    pub fn velocity_limits(&self) -> Result<&[f64], RobotError> {
        Ok(&self.limits()?[0])
    }

    /// The largest effort of each DOF, N m or N, as the source states it; infinite where it states none.
    pub fn effort_limits(&self) -> Result<&[f64], RobotError> {
        Ok(&self.limits()?[1])
    }

    fn limits(&self) -> Result<&[Vec<f64>; 2], RobotError> {
        keep(&self.limits, || {
            let part = self.part(&[ModuleKind::Bounds])?;
            let Some(ModuleDocument::Bounds(bounds)) = part.document_v1(ModuleKind::Bounds) else {
                return Err(RobotError::Missing(ModuleKind::Bounds));
            };
            let limits = [&bounds.dof_velocity_limits, &bounds.dof_effort_limits];
            Ok(limits.map(|all| all.iter().map(|limit| limit.unwrap_or(f64::INFINITY)).collect()))
        })
    }
}

impl Robot {
    /// The mass of each link, and its centre of mass.
    ///
    /// # Errors
    /// If `urdf_module` is missing or unusable.
    pub fn link_masses(&self) -> Result<&[LinkMass], RobotError> {
        let of = |link: Link| {
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
        let mut all = Load::default();
        for (link, pose) in self.link_masses()?.iter().zip(&poses) {
            all += Load::new(link.mass, link.centre.into(), pose);
        }
        Ok((all.mass > 0.0).then(|| (all.moment / all.mass).into()))
    }
}
