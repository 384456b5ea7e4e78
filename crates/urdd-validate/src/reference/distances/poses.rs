//! Link poses in the sampled configurations.

use std::ops::Range;

use nalgebra::Isometry3;
use rayon::prelude::*;

use crate::skip;
use urdd_document::consumer;
use urdd_document::urdd::Urdd;
use urdd_findings::code::Code;
use urdd_findings::skip::SkipReason;
use urdd_format::registry::Profile;
use urdd_format::urdf::JointType;
use urdd_geometry::convex::Motion;
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics};

/// The link poses of a robot, as a consumer computes them.
pub struct Poses {
    space: ConfigurationSpace,
    kinematics: ForwardKinematics,
    /// Rigid group of each link.
    groups: Vec<usize>,
}

impl Poses {
    /// From modules of any version.
    ///
    /// # Errors
    /// Why there are no poses.
    pub fn new(urdd: &Urdd) -> Result<Self, SkipReason> {
        let open = skip::KINEMATICS_OPEN;
        let modules = consumer::modules(urdd).ok_or(open.clone())?;
        let groups = urdd.rigid_groups().ok_or(open.clone())?;
        let bounds = urdd.bounds().ok_or(open)?;
        let unlike = |joint: JointType| matches!(joint, JointType::Planar | JointType::Floating);
        let mut joints = modules.chain.joints_in_chain.iter();
        if urdd.profile() == Profile::Legacy && joints.any(|joint| unlike(joint.joint_type)) {
            return Err(skip::LEGACY_COORDINATES);
        }
        let space = ConfigurationSpace::new(&modules.dof, &modules.chain, &bounds.bounds)
            .map_err(SkipReason::obstacle)?;
        let kinematics =
            ForwardKinematics::new(&modules.chain, &modules.dof).map_err(SkipReason::obstacle)?;
        if groups.of_link.len() != kinematics.num_links() {
            return Err(SkipReason::Failed(Code::CHN001));
        }
        Ok(Poses { space, kinematics, groups: groups.of_link.clone() })
    }

    pub fn num_links(&self) -> usize {
        self.groups.len()
    }

    /// Whether only fixed joints connect two links.
    pub fn is_rigid(&self, a: usize, b: usize) -> bool {
        self.groups.get(a) == self.groups.get(b)
    }

    /// The poses in the default configuration (SPEC 9.4).
    ///
    /// # Errors
    /// If numbers exceed 64 bits.
    pub fn default_motion(&self) -> Result<Motion, SkipReason> {
        let poses = self
            .kinematics
            .link_poses(&self.space.default_configuration())
            .map_err(|error| SkipReason::obstacle(format!("default configuration: {error}")))?;
        Motion::new(&[poses], &self.groups).map_err(SkipReason::obstacle)
    }

    /// A sampled configuration and its poses.
    ///
    /// # Errors
    /// If numbers exceed 64 bits.
    pub fn sampled(&self, sample: u32) -> Result<(Vec<f64>, Vec<Isometry3<f64>>), SkipReason> {
        let configuration = self.space.sampled(u64::from(sample));
        let why = |error| SkipReason::obstacle(format!("sampled configuration {sample}: {error}"));
        let poses = self.kinematics.link_poses(&configuration).map_err(why)?;
        Ok((configuration, poses))
    }

    /// The poses in a configuration.
    ///
    /// # Errors
    /// If numbers exceed 64 bits.
    pub fn of(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, SkipReason> {
        self.kinematics.link_poses(configuration).map_err(SkipReason::obstacle)
    }

    /// The poses in a range of sampled configurations.
    ///
    /// # Errors
    /// If numbers exceed 64 bits.
    pub fn motion(&self, samples: Range<u32>) -> Result<Motion, SkipReason> {
        let poses: Vec<Vec<Isometry3<f64>>> = samples
            .into_par_iter()
            .map(|sample| Ok(self.sampled(sample)?.1))
            .collect::<Result<_, _>>()?;
        Motion::new(&poses, &self.groups).map_err(SkipReason::obstacle)
    }
}
