//! Configurations: one value for each DOF.

use super::error::RobotError;
use urdd_document::consumer;
use urdd_document::urdd::Urdd;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::JointType;
use urdd_kinematics::ConfigurationSpace;

/// The configurations of a robot. Each is a list with one value for each DOF, rad or m.
#[derive(Debug, Clone)]
pub struct Configurations {
    space: ConfigurationSpace,
    bounds: Vec<[f64; 2]>,
    is_limited: Vec<bool>,
}

impl Configurations {
    pub(super) fn new(part: &Urdd) -> Result<Self, RobotError> {
        let modules = consumer::modules(part).ok_or(RobotError::MotionOpen)?;
        let bounds = part.bounds().ok_or(RobotError::Missing(ModuleKind::Bounds))?;
        let space = ConfigurationSpace::new(&modules.dof, &modules.chain, &bounds.bounds)?;
        let is_limited = if bounds.dof_limited.len() == bounds.bounds.len() {
            bounds.dof_limited.clone()
        } else {
            // Of a legacy URDD, the joint's type says so.
            let joint_of = &modules.dof.dof_idx_to_joint_idx_mapping;
            let limited = |k: usize| {
                let joint = modules.chain.joints_in_chain.get(joint_of.get(k)?.get())?;
                Some(matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic))
            };
            (0..bounds.bounds.len()).map(|k| limited(k) == Some(true)).collect()
        };
        // A producer may write the two bounds in either order.
        let sorted = |[a, b]: [f64; 2]| [a.min(b), a.max(b)];
        let bounds = bounds.bounds.iter().copied().map(sorted).collect();
        Ok(Self { space, bounds, is_limited })
    }

    pub(super) fn space(&self) -> &ConfigurationSpace {
        &self.space
    }

    /// Number of DOFs.
    pub fn num_dofs(&self) -> usize {
        self.bounds.len()
    }

    /// The lower and the upper bound of each DOF. The bounds of a rotation vector include all rotations. Those of other
    /// DOFs that are [not limited](Configurations::dof_is_limited) are a range to sample from, [-pi, pi] or [-1, 1],
    /// which the DOF may leave.
    pub fn bounds(&self) -> &[[f64; 2]] {
        &self.bounds
    }

    /// For each DOF, whether the source limits it: false for continuous, planar, floating and spherical joints.
    pub fn dof_is_limited(&self) -> &[bool] {
        &self.is_limited
    }

    /// The default configuration (SPEC 9.4): every DOF at 0, or at the bound nearest to 0 if 0 is out of bounds.
    /// Pinocchio's *neutral configuration* is the same, without the clamping to the bounds.
    pub fn zero(&self) -> Vec<f64> {
        self.space.default_configuration()
    }

    /// Every DOF half-way between its bounds.
    pub fn middle(&self) -> Vec<f64> {
        self.space.middle()
    }

    /// Every DOF at its lower bound.
    pub fn lower(&self) -> Vec<f64> {
        self.space.lower()
    }

    /// Every DOF at its upper bound.
    pub fn upper(&self) -> Vec<f64> {
        self.space.upper()
    }

    /// Sample `k` of the pseudorandom sequence that the specification defines (SPEC 9.3): uniform within the bounds,
    /// and the same in every implementation.
    pub fn random(&self, k: u64) -> Vec<f64> {
        self.space.sampled(k)
    }

    /// Clamps each value of a configuration to its bounds. Leaves rotation vectors, and surplus values without bounds,
    /// unchanged.
    pub fn clamp(&self, configuration: &mut [f64]) {
        let rotations = self.space.rotation_vectors();
        for (dof, (value, [lower, upper])) in configuration.iter_mut().zip(&self.bounds).enumerate()
        {
            if !rotations.iter().flatten().any(|other| *other == dof) {
                *value = value.max(*lower).min(*upper);
            }
        }
    }

    /// Whether each value is within its bounds. Rotation vectors always are.
    pub fn is_within_bounds(&self, configuration: &[f64]) -> bool {
        let mut clamped = configuration.to_vec();
        self.clamp(&mut clamped);
        clamped == configuration
    }
}
