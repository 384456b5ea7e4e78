//! Forward kinematics: link poses from a configuration.

use nalgebra::Isometry3;

use super::error::{ConfigurationError, KinematicsError};
use super::joint::{Motion, check_lengths, motion};
use super::pose::to_isometry;
use urdd_format::chain::ChainModule;
use urdd_format::dof::DofModule;
use urdd_format::index::LinkIdx;

/// Forward kinematics of a robot, from its `chain_module` and `dof_module`.
///
/// Poses are in the frame of the root link, whose own pose is the identity. Bounds are not checked.
///
/// ```
/// use urdd_format::{chain::ChainModule, dof::DofModule};
/// use urdd_kinematics::ForwardKinematics;
///
/// // A door: one hinge, half a metre from the wall's corner.
/// let chain: ChainModule = serde_json::from_str(r#"{
///     "links_in_chain": [
///         { "name": "wall", "link_idx": 0, "parent_joint_idx": null, "parent_link_idx": null,
///           "children_joint_idxs": [0], "children_link_idxs": [1] },
///         { "name": "door", "link_idx": 1, "parent_joint_idx": 0, "parent_link_idx": 0,
///           "children_joint_idxs": [], "children_link_idxs": [] }
///     ],
///     "joints_in_chain": [
///         { "joint_name": "hinge", "joint_idx": 0, "parent_link_name": "wall", "parent_link_idx": 0,
///           "child_link_name": "door", "child_link_idx": 1, "joint_type": "Revolute",
///           "origin": { "position": [0.5, 0, 0], "quaternion_wxyz": [1, 0, 0, 0] },
///           "axis": [0, 0, 1] }
///     ],
///     "kinematic_hierarchy": [[0], [1]],
///     "root_idx": 0
/// }"#)?;
/// let dof: DofModule = serde_json::from_str(r#"{
///     "num_dofs": 1,
///     "dof_idx_to_joint_idx_mapping": [0],
///     "joint_idx_to_dof_idxs_mapping": [[0]],
///     "joint_idx_to_mimic_mapping": [null],
///     "dofs": [{ "name": "hinge", "joint_idx": 0, "joint_name": "hinge", "quantity": "Angle" }]
/// }"#)?;
///
/// let kinematics = ForwardKinematics::new(&chain, &dof)?;
/// let poses = kinematics.link_poses(&[std::f64::consts::FRAC_PI_2])?;
///
/// // The handle is 0.8 m along the door, which is now at a right angle to the wall.
/// let handle = poses[1] * nalgebra::Point3::new(0.8, 0.0, 1.0);
/// assert!((handle - nalgebra::Point3::new(0.5, 0.8, 1.0)).norm() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct ForwardKinematics {
    num_links: usize,
    num_dofs: usize,
    root: usize,
    /// One step per joint; parents come before children.
    pub(super) steps: Vec<Step>,
    /// For each link, the index of the step that moves it; `None` for the root.
    step_of: Vec<Option<usize>>,
}

/// A joint: the pose of its child link's frame in that of its parent link is `origin`, then what `motion` says.
#[derive(Debug, Clone)]
pub struct Step {
    /// The parent link.
    pub parent: usize,
    /// The child link.
    pub child: usize,
    /// The pose of the joint's frame in that of the parent link.
    pub origin: Isometry3<f64>,
    /// How it moves.
    pub motion: Motion,
}

impl ForwardKinematics {
    /// Builds the tree from the joints of `chain`, and checks that exactly one path connects each link to the root. The
    /// order follows from the tree, not from `kinematic_hierarchy`. Data that forward kinematics does not need is not
    /// checked.
    pub fn new(chain: &ChainModule, dof: &DofModule) -> Result<Self, KinematicsError> {
        check_lengths(chain, dof)?;
        let order = joints_from_root(chain)?;
        let mut steps = Vec::with_capacity(order.len());
        for idx in order {
            let joint = &chain.joints_in_chain[idx];
            let origin = to_isometry(&joint.origin).map_err(|error| {
                let pointer = format!("/joints_in_chain/{idx}/origin");
                KinematicsError::chain(pointer, error.to_string())
            })?;
            steps.push(Step {
                parent: joint.parent_link_idx.get(),
                child: joint.child_link_idx.get(),
                origin,
                motion: motion(joint, idx, dof)?,
            });
        }
        let mut step_of = vec![None; chain.links_in_chain.len()];
        for (number, step) in steps.iter().enumerate() {
            step_of[step.child] = Some(number);
        }
        Ok(Self {
            step_of,
            num_links: chain.links_in_chain.len(),
            num_dofs: dof.num_dofs.get(),
            root: chain.root_idx.get(),
            steps,
        })
    }

    /// The joints, each after the one that moves its parent link.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Number of DOFs, which is the length of a configuration.
    pub fn num_dofs(&self) -> usize {
        self.num_dofs
    }

    /// Number of links, which is the number of poses that [`link_poses`](Self::link_poses) returns.
    pub fn num_links(&self) -> usize {
        self.num_links
    }

    /// The pose of each link in the root link's frame, in link order. `configuration` has one value
    /// per DOF, rad or m.
    pub fn link_poses(
        &self,
        configuration: &[f64],
    ) -> Result<Vec<Isometry3<f64>>, ConfigurationError> {
        let mut poses = Vec::new();
        self.link_poses_into(configuration, &mut poses)?;
        Ok(poses)
    }

    /// As [`link_poses`](Self::link_poses), into a reusable vector. Its previous content is discarded, also on error.
    pub fn link_poses_into(
        &self,
        configuration: &[f64],
        poses: &mut Vec<Isometry3<f64>>,
    ) -> Result<(), ConfigurationError> {
        poses.clear();
        self.check(configuration)?;
        poses.resize(self.num_links, Isometry3::identity());
        for step in &self.steps {
            let frame = poses[step.parent] * step.origin;
            let pose = match &step.motion {
                Motion::Fixed => frame,
                motion => frame * motion.at(configuration),
            };
            if !is_finite(&pose) {
                poses.clear();
                let link_idx = step.child;
                return Err(ConfigurationError::Overflow { link_idx });
            }
            poses[step.child] = pose;
        }
        Ok(())
    }

    /// Checks that a configuration has one finite value for each DOF.
    ///
    /// # Errors
    /// If it does not.
    pub fn check(&self, configuration: &[f64]) -> Result<(), ConfigurationError> {
        ConfigurationError::check(configuration, self.num_dofs)
    }

    /// The joints from a link up to the root.
    pub(super) fn path(&self, link: usize) -> impl Iterator<Item = &Step> {
        self.path_steps(link).map(|step| &self.steps[step])
    }

    /// Their indices.
    fn path_steps(&self, link: usize) -> impl Iterator<Item = usize> {
        let step = |link: usize| self.step_of.get(link).copied().flatten();
        std::iter::successors(step(link), move |above| step(self.steps[*above].parent))
    }

    /// The indices of the joints that move one link and not the other, for each of two links, from the link to the root.
    pub(super) fn steps_between(&self, links: [usize; 2]) -> [Vec<usize>; 2] {
        let [mut a, mut b] = links.map(|link| self.path_steps(link).collect::<Vec<_>>());
        while let (Some(last), Some(other)) = (a.last(), b.last())
            && last == other
        {
            a.pop();
            b.pop();
        }
        [a, b]
    }

    /// Index of the root link; its pose is the identity.
    pub fn root(&self) -> usize {
        self.root
    }
}

pub(super) fn is_finite(pose: &Isometry3<f64>) -> bool {
    pose.translation.vector.iter().all(|x| x.is_finite())
        && pose.rotation.coords.iter().all(|x| x.is_finite())
}

/// The indices of all joints, each after the joint that moves its parent link.
fn joints_from_root(chain: &ChainModule) -> Result<Vec<usize>, KinematicsError> {
    let num_links = chain.links_in_chain.len();
    let root = link_at("/root_idx", chain.root_idx, num_links)?;

    let mut moved_by: Vec<Option<usize>> = vec![None; num_links];
    let mut joints_on: Vec<Vec<usize>> = vec![Vec::new(); num_links];
    for (idx, joint) in chain.joints_in_chain.iter().enumerate() {
        let place = |key| format!("/joints_in_chain/{idx}/{key}");
        let parent = link_at(place("parent_link_idx"), joint.parent_link_idx, num_links)?;
        let child = link_at(place("child_link_idx"), joint.child_link_idx, num_links)?;
        let fail = |fault| Err(KinematicsError::chain(place("child_link_idx"), fault));
        if child == root {
            return fail(format!("this joint's child is the root link, {child}"));
        }
        if let Some(first) = moved_by[child].replace(idx) {
            return fail(format!("link {child} is already the child of joint {first}"));
        }
        joints_on[parent].push(idx);
    }

    // At most one joint moves each link except the root, so the walk visits no joint twice and ends. A link that it
    // does not reach is disconnected or on a cycle.
    let mut order: Vec<usize> = Vec::with_capacity(chain.joints_in_chain.len());
    order.extend(&joints_on[root]);
    let mut reached = vec![false; num_links];
    reached[root] = true;
    let mut next = 0;
    while let Some(&joint) = order.get(next) {
        let child = chain.joints_in_chain[joint].child_link_idx.get();
        reached[child] = true;
        order.extend(&joints_on[child]);
        next += 1;
    }
    let unreached = reached.iter().position(|reached| !reached);
    let fault = "no path leads from the root to this link";
    let error = |link| KinematicsError::chain(format!("/links_in_chain/{link}"), fault);
    unreached.map_or(Ok(order), |link| Err(error(link)))
}

fn link_at(
    pointer: impl Into<String>,
    link: LinkIdx,
    count: usize,
) -> Result<usize, KinematicsError> {
    if link.get() < count {
        return Ok(link.get());
    }
    let fault = format!("link {} is out of range: there are {count}", link.0);
    Err(KinematicsError::chain(pointer, fault))
}
