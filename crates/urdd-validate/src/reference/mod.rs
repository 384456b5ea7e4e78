//! What the validator computes by itself, from SPEC.md alone, where the generator computes it too (CONTRIBUTING.md has the
//! list): the URDF's text as data (`urdf_text`), link poses, distances and their statistics (`distances`), the
//! learned model with its counts (`learned`), spheres of links (`spheres`), and what kinematic loops hold (`loops`).
//!
//! Here are the link poses, computed from the text of the carried URDF (multiplied by nalgebra). They share nothing with
//! the modules or with `urdd_kinematics`, which they verify. Nothing recurses, because a chain may be as long as the file.

pub mod distances;
pub mod learned;
pub mod loops;
pub mod samples;
pub mod spheres {
    //! Spheres that stand for links, judged by SPEC 8.9 alone: how far they are from the pieces ([`fit`]), whether they
    //! cover these ([`cells`]), which of them touch in sampled configurations, and how often that is right ([`contacts`]).
    //! Shares nothing with the making of spheres; poses and contacts of pieces are those of the other rules.

    pub mod cells;
    pub mod contacts;
    pub mod fit;
}
pub mod urdf_text;

use std::collections::HashMap;
use std::f64::consts::PI;

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

use urdd_document::pose::has_quaternions;
use urdd_format::urdf::{self as v1, JointType, UrdfModule};

/// Largest angle of a limit that is used: beyond it, binary64 is coarser than 1e-10 rad.
const MOST_RADIANS: f64 = 1e6;

/// A robot as its URDF describes it.
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

/// What determines a joint's position.
enum Source {
    /// Its own DOFs, starting at this index.
    Own(usize),
    /// Another joint.
    Mimic { joint: usize, multiplier: f64, offset: f64 },
    /// Nothing: the joint does not move.
    None,
}

/// How mimic joints are treated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MimicDofs {
    /// They follow their drivers (SPEC 5.8).
    Follow,
    /// They have DOFs of their own, as in `dof_module` 0.0.1.
    Own,
}

impl Reference {
    /// The kinematics of a parsed URDF.
    ///
    /// # Errors
    /// Why the URDF cannot be used.
    pub fn new(robot: &UrdfModule, mimics: MimicDofs) -> Result<Reference, String> {
        // Of several of one name, the first.
        let places = |names: Vec<&str>| -> HashMap<String, usize> {
            let names = names.into_iter().enumerate().rev();
            names.map(|(index, name)| (name.to_owned(), index)).collect()
        };
        let links = places(robot.links.iter().map(|link| link.name.as_str()).collect());
        let drivers = places(robot.joints.iter().map(|joint| joint.name.as_str()).collect());
        let link = |name: &str| {
            links.get(name).copied().ok_or_else(|| format!("no link is called {name}"))
        };
        let quaternions = has_quaternions(robot.version.as_deref());
        let mut dofs = 0;
        let mut joints = Vec::with_capacity(robot.joints.len());
        for joint in &robot.joints {
            let freedom = freedom(joint.joint_type);
            let source = match &joint.mimic {
                _ if freedom == 0 => Source::None,
                Some(mimic) if mimics == MimicDofs::Follow => Source::Mimic {
                    joint: (drivers.get(&mimic.joint).copied())
                        .ok_or_else(|| format!("no joint is called {}", mimic.joint))?,
                    multiplier: mimic.multiplier.unwrap_or(1.0),
                    offset: mimic.offset.unwrap_or(0.0),
                },
                _ => {
                    dofs += freedom;
                    Source::Own(dofs - freedom)
                }
            };
            let axis = joint.axis.as_ref().and_then(|axis| axis.xyz);
            joints.push(Joint {
                parent: link(&joint.parent.link)?,
                child: link(&joint.child.link)?,
                kind: joint.joint_type,
                origin: origin(joint.origin.as_ref(), quaternions),
                axis: axis.unwrap_or([1.0, 0.0, 0.0]),
                limits: limits(joint),
                source,
            });
        }
        let order = order(robot.links.len(), &joints)?;
        Ok(Reference { links: robot.links.len(), joints, order, dofs })
    }

    pub fn num_links(&self) -> usize {
        self.links
    }

    pub fn num_dofs(&self) -> usize {
        self.dofs
    }

    /// Whether some joint has a type.
    pub fn has(&self, kind: JointType) -> bool {
        self.joints.iter().any(|joint| joint.kind == kind)
    }

    /// An interval for configurations of each DOF: the URDF's limits, or [-pi, pi] without limits or if an angle is
    /// beyond 1e6 rad.
    pub fn intervals(&self) -> Vec<[f64; 2]> {
        let free = [-PI, PI];
        let mut intervals = vec![free; self.dofs];
        for joint in &self.joints {
            let Some(limits) = joint.limits else { continue };
            // An angle of this many turns has no digits left for the joint's position.
            let is_turns = joint.kind == JointType::Revolute
                && limits.iter().any(|limit| limit.abs() > MOST_RADIANS);
            if let (Source::Own(first), false) = (&joint.source, is_turns) {
                intervals[*first] = limits;
            }
        }
        intervals
    }

    /// The pose of every link in the root link's frame; `None` if the configuration has another length.
    pub fn link_poses(&self, configuration: &[f64]) -> Option<Vec<Isometry3<f64>>> {
        if configuration.len() != self.dofs {
            return None;
        }
        let positions = self.positions(configuration);
        let mut poses = vec![Isometry3::identity(); self.links];
        for &index in &self.order {
            let joint = &self.joints[index];
            let motion = motion(joint.kind, joint.axis, &positions[index]);
            poses[joint.child] = poses[joint.parent] * joint.origin * motion;
        }
        Some(poses)
    }

    /// The position of every joint. Another rule reports a circle of mimics; its joints are at their offsets here.
    fn positions(&self, configuration: &[f64]) -> Vec<[f64; 6]> {
        let mut known: Vec<Option<[f64; 6]>> = vec![None; self.joints.len()];
        for start in 0..self.joints.len() {
            let mut chain = Vec::new();
            let mut at = start;
            while known[at].is_none() {
                let mut position = [0.0; 6];
                if let Source::Own(first) = self.joints[at].source {
                    let freedom = freedom(self.joints[at].kind);
                    position[..freedom].copy_from_slice(&configuration[first..first + freedom]);
                }
                known[at] = Some(position);
                if let Source::Mimic { joint, .. } = self.joints[at].source {
                    chain.push(at);
                    at = joint;
                }
            }
            for follower in chain.into_iter().rev() {
                if let Source::Mimic { joint, multiplier, offset } = self.joints[follower].source {
                    let driver = known[joint].unwrap_or_default()[0];
                    let position = multiplier * driver + offset;
                    known[follower] = Some([position, 0.0, 0.0, 0.0, 0.0, 0.0]);
                }
            }
        }
        known.into_iter().map(Option::unwrap_or_default).collect()
    }
}

/// SPEC 5.4 and 6.1.9; a missing origin is zero.
fn origin(origin: Option<&v1::Origin>, quaternions: bool) -> Isometry3<f64> {
    let Some(origin) = origin else { return Isometry3::identity() };
    let rotation = match origin.quat_xyzw.filter(|_| quaternions) {
        Some(xyzw) => {
            // Divided by the largest number first, so that squares of tiny or huge numbers do not underflow or
            // overflow.
            let largest = xyzw.iter().fold(0.0_f64, |most, n| most.max(n.abs()));
            let [x, y, z, w] = xyzw.map(|n| n / largest);
            UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.0).unwrap_or_default()
        }
        None => {
            let [roll, pitch, yaw] = origin.rpy.unwrap_or_default();
            UnitQuaternion::from_euler_angles(roll, pitch, yaw)
        }
    };
    Isometry3::from_parts(Translation3::from(origin.xyz.unwrap_or_default()), rotation)
}

/// SPEC 6.5.2.
fn limits(joint: &v1::Joint) -> Option<[f64; 2]> {
    let limit = joint.limit.as_ref()?;
    let has_limits = matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic)
        && (limit.lower.is_some() || limit.upper.is_some());
    has_limits.then(|| [limit.lower, limit.upper].map(Option::unwrap_or_default))
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

/// Number of values of a joint's position.
pub fn freedom(kind: JointType) -> usize {
    match kind {
        JointType::Fixed => 0,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic => 1,
        JointType::Planar | JointType::Spherical => 3,
        JointType::Floating => 6,
    }
}

/// The motion of a joint of a type at a position (SPEC 9.1), by nalgebra alone; only the first [`freedom`] numbers are used.
pub fn motion(kind: JointType, axis: [f64; 3], q: &[f64; 6]) -> Isometry3<f64> {
    let axis = Vector3::from(axis);
    // Divided first, so that squares of huge numbers do not overflow.
    let largest = axis.amax();
    let unit = if largest > 0.0 { (axis / largest).normalize() } else { Vector3::x() };
    let turn = |v: Vector3<f64>| UnitQuaternion::from_scaled_axis(v);
    let (shift, rotation) = match kind {
        JointType::Fixed => (Vector3::zeros(), UnitQuaternion::identity()),
        JointType::Revolute | JointType::Continuous => (Vector3::zeros(), turn(unit * q[0])),
        JointType::Prismatic => (unit * q[0], UnitQuaternion::identity()),
        JointType::Planar => {
            let basis = turn(arc_from_z(unit));
            (basis * Vector3::new(q[0], q[1], 0.0), turn(unit * q[2]))
        }
        JointType::Floating => {
            (Vector3::new(q[0], q[1], q[2]), turn(Vector3::new(q[3], q[4], q[5])))
        }
        JointType::Spherical => (Vector3::zeros(), turn(Vector3::new(q[0], q[1], q[2]))),
    };
    Isometry3::from_parts(Translation3::from(shift), rotation)
}

/// The shortest arc from z to a unit axis, as a rotation vector (SPEC 5.9). `rotation_between` computes the angle from
/// its cosine, and loses the arc near -z.
fn arc_from_z(axis: Vector3<f64>) -> Vector3<f64> {
    let sine = axis.x.hypot(axis.y);
    let angle = sine.atan2(axis.z);
    if sine >= 1e-10 {
        Vector3::new(-axis.y, axis.x, 0.0) * (angle / sine)
    } else if axis.z < 0.0 {
        Vector3::x() * PI
    } else {
        Vector3::zeros()
    }
}
