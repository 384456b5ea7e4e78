//! The kinematic reference: link poses computed from the text of the carried URDF by a path of its
//! own (urdf-rs reads, nalgebra multiplies), sharing nothing with the modules or with
//! `crate::kinematics`, which it is there to check.

mod motion;
mod quaternions;

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use urdf_rs::JointType;

/// A robot as its URDF has it.
pub struct Reference {
    links: usize,
    joints: Vec<Joint>,
    /// Joints from the root outwards.
    order: Vec<usize>,
    dofs: usize,
}

struct Joint {
    parent: usize,
    child: usize,
    kind: JointType,
    origin: Isometry3<f64>,
    axis: [f64; 3],
    limits: Option<[f64; 2]>,
    source: Source,
}

/// Where a joint's position comes from.
enum Source {
    /// Its own DOFs, from this one on.
    Own(usize),
    /// Another joint.
    Mimic {
        joint: usize,
        multiplier: f64,
        offset: f64,
    },
    /// Nothing: it does not move.
    None,
}

/// What to do with mimic joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MimicDofs {
    /// They follow (SPEC 5.8).
    Follow,
    /// They have DOFs of their own, as in `dof_module` 0.0.1.
    Own,
}

impl Reference {
    /// Reads a URDF.
    ///
    /// # Errors
    /// Why the URDF cannot be used.
    pub fn read(urdf: &str, mimics: MimicDofs) -> Result<Reference, String> {
        let robot = urdf_rs::read_from_string(urdf)
            .map_err(|error| format!("urdf-rs cannot read the URDF: {error}"))?;
        let link = |name: &str| {
            robot
                .links
                .iter()
                .position(|link| link.name == name)
                .ok_or_else(|| format!("no link is called {name}"))
        };
        let quaternions = quaternions::of_joints(urdf);
        let mut dofs = 0;
        let mut joints = Vec::with_capacity(robot.joints.len());
        for joint in &robot.joints {
            let freedom = motion::freedom(&joint.joint_type);
            let source = match &joint.mimic {
                _ if freedom == 0 => Source::None,
                Some(mimic) if mimics == MimicDofs::Follow => Source::Mimic {
                    joint: robot
                        .joints
                        .iter()
                        .position(|other| other.name == mimic.joint)
                        .ok_or_else(|| format!("no joint is called {}", mimic.joint))?,
                    multiplier: mimic.multiplier.unwrap_or(1.0),
                    offset: mimic.offset.unwrap_or(0.0),
                },
                _ => {
                    dofs += freedom;
                    Source::Own(dofs - freedom)
                }
            };
            let [x, y, z] = joint.origin.xyz.0;
            let [roll, pitch, yaw] = joint.origin.rpy.0;
            let rotation = match quaternions.get(&joint.name) {
                Some(quaternion) => *quaternion,
                None => UnitQuaternion::from_euler_angles(roll, pitch, yaw),
            };
            let limits = [joint.limit.lower, joint.limit.upper];
            let limited = matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic)
                && limits.iter().all(|limit| limit.is_finite())
                && limits != [0.0, 0.0];
            joints.push(Joint {
                parent: link(&joint.parent.link)?,
                child: link(&joint.child.link)?,
                kind: joint.joint_type.clone(),
                origin: Isometry3::from_parts(Translation3::new(x, y, z), rotation),
                axis: joint.axis.xyz.0,
                limits: limited.then_some(limits),
                source,
            });
        }
        let order = order(robot.links.len(), &joints)?;
        Ok(Reference {
            links: robot.links.len(),
            joints,
            order,
            dofs,
        })
    }

    /// Number of links.
    pub fn num_links(&self) -> usize {
        self.links
    }

    /// Number of DOFs.
    pub fn num_dofs(&self) -> usize {
        self.dofs
    }

    /// Whether a joint is of a kind.
    pub fn has(&self, kind: &JointType) -> bool {
        self.joints.iter().any(|joint| joint.kind == *kind)
    }

    /// For each DOF, an interval to take configurations from: the URDF's limits, or [-pi, pi].
    pub fn intervals(&self) -> Vec<[f64; 2]> {
        let free = [-std::f64::consts::PI, std::f64::consts::PI];
        let mut intervals = vec![free; self.dofs];
        for joint in &self.joints {
            if let (Source::Own(first), Some(limits)) = (&joint.source, joint.limits) {
                intervals[*first] = limits;
            }
        }
        intervals
    }

    /// The pose of every link in the root link's frame; `None` where the configuration is of
    /// another length.
    pub fn link_poses(&self, configuration: &[f64]) -> Option<Vec<Isometry3<f64>>> {
        if configuration.len() != self.dofs {
            return None;
        }
        let mut poses = vec![Isometry3::identity(); self.links];
        for &index in &self.order {
            let joint = &self.joints[index];
            let position = self.position(index, configuration, self.joints.len());
            let motion = motion::motion(&joint.kind, joint.axis, &position);
            poses[joint.child] = poses[joint.parent] * joint.origin * motion;
        }
        Some(poses)
    }

    /// Position of a joint. `left` bounds how many mimics are followed: a circle of mimics is
    /// another rule's finding, and must not be followed for ever.
    fn position(&self, joint: usize, configuration: &[f64], left: usize) -> [f64; 6] {
        let mut position = [0.0; 6];
        match self.joints[joint].source {
            Source::None => {}
            Source::Own(first) => {
                let freedom = motion::freedom(&self.joints[joint].kind);
                position[..freedom].copy_from_slice(&configuration[first..first + freedom]);
            }
            Source::Mimic {
                joint,
                multiplier,
                offset,
            } if left > 0 => {
                position[0] =
                    multiplier * self.position(joint, configuration, left - 1)[0] + offset;
            }
            Source::Mimic { .. } => {}
        }
        position
    }
}

/// The joints from the root outwards.
fn order(links: usize, joints: &[Joint]) -> Result<Vec<usize>, String> {
    let mut moved = vec![false; links];
    let mut on_link: Vec<Vec<usize>> = vec![Vec::new(); links];
    for (index, joint) in joints.iter().enumerate() {
        on_link[joint.parent].push(index);
        if std::mem::replace(&mut moved[joint.child], true) {
            return Err("a link is the child of two joints".to_owned());
        }
    }
    let mut stack: Vec<usize> = (0..links).filter(|link| !moved[*link]).collect();
    if stack.len() != 1 {
        return Err(format!("there are {} root links", stack.len()));
    }
    let mut order = Vec::with_capacity(joints.len());
    while let Some(link) = stack.pop() {
        for &joint in &on_link[link] {
            order.push(joint);
            stack.push(joints[joint].child);
        }
    }
    if order.len() == joints.len() {
        Ok(order)
    } else {
        Err("the joints go in a circle".to_owned())
    }
}
