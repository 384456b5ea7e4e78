//! What an open robot keeps once it was read: its forward kinematics with names and units, its configurations, masses and
//! shapes.

use nalgebra::Isometry3;

use super::error::RobotError;
use urdd_document::consumer;
use urdd_document::urdd::Urdd;
use urdd_format::dof::Quantity;
use urdd_format::loops::LoopsModule;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::JointType;
use urdd_geometry::Mesh;
use urdd_kinematics::loops::Loops;
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics, reach};

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

/// The configurations of a robot. Each is a list with one value for each DOF, rad or m.
#[derive(Debug, Clone)]
pub struct Configurations {
    space: ConfigurationSpace,
    bounds: Vec<[f64; 2]>,
    is_limited: Vec<bool>,
    /// The bounds; infinite for what is not limited.
    limits: Vec<[f64; 2]>,
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
        let bounds: Vec<[f64; 2]> = bounds.bounds.iter().copied().map(sorted).collect();
        let limit = |(bounds, limited): (&[f64; 2], &bool)| match limited {
            true => *bounds,
            false => [f64::NEG_INFINITY, f64::INFINITY],
        };
        let limits = bounds.iter().zip(&is_limited).map(limit).collect();
        Ok(Self { space, bounds, is_limited, limits })
    }

    pub(super) fn space(&self) -> &ConfigurationSpace {
        &self.space
    }

    /// The bounds of each DOF; infinite for one that is not limited.
    pub(super) fn limits(&self) -> &[[f64; 2]] {
        &self.limits
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

/// What closes the loops of a robot, with what it takes to close them.
#[derive(Debug)]
pub(super) struct Closure {
    pub loops: Loops,
    /// The names of the loops, and of the couplings.
    pub names: [Vec<String>; 2],
    /// The bounds of each DOF; infinite for one that is not limited.
    pub limits: Vec<[f64; 2]>,
    /// The DOFs that move freely, ascending.
    pub independent: Vec<usize>,
    pub is_independent: Vec<bool>,
}

impl Closure {
    pub(super) fn new(
        module: &LoopsModule,
        part: &Urdd,
        kinematics: &ForwardKinematics,
        configurations: &Configurations,
    ) -> Result<Self, RobotError> {
        let modules = consumer::modules(part).ok_or(RobotError::MotionOpen)?;
        let described = part.description().ok_or(RobotError::Missing(ModuleKind::Urdf))?;
        let reach = reach(described, &modules.chain);
        let loops = Loops::new(module, kinematics, &modules.dof, reach)?;
        let mut is_independent = vec![false; kinematics.num_dofs()];
        for dof in &module.independent_dof_idxs {
            if let Some(is_independent) = is_independent.get_mut(dof.get()) {
                *is_independent = true;
            }
        }
        Ok(Self {
            loops,
            names: [
                module.loops.iter().map(|one| one.name.clone()).collect(),
                module.couplings.iter().map(|one| one.name.clone()).collect(),
            ],
            limits: configurations.limits().to_vec(),
            independent: (0..is_independent.len()).filter(|dof| is_independent[*dof]).collect(),
            is_independent,
        })
    }
}

/// The mass of a link.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LinkMass {
    /// kg; 0 where the source states none.
    pub mass: f64,
    /// The centre of mass, in the link's frame, m.
    pub centre: [f64; 3],
}

/// A shape in its link's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkShape {
    /// The link.
    pub link: usize,
    /// Index of the link's piece that it is or bounds; 0 for a hull and its bounding volumes.
    pub piece: usize,
    /// The shape.
    pub solid: Solid,
}

/// A solid in the link's frame, in metres.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// A convex mesh, each vertex once.
    Mesh(Mesh),
    /// An oriented box.
    Box {
        /// The pose of its centre and axes.
        pose: Isometry3<f64>,
        /// Half extents along its axes.
        half_extents: [f64; 3],
    },
    /// A sphere.
    Sphere {
        /// The centre.
        centre: [f64; 3],
        /// The radius.
        radius: f64,
    },
}
