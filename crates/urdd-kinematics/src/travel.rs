//! How far a robot reaches, and bounds on how far points of links travel on a straight line between two configurations.

use crate::error::ConfigurationError;
use crate::forward::ForwardKinematics;
use crate::joint::Motion;
use urdd_format::chain::ChainModule;
use urdd_format::urdf::{JointType, UrdfModule};

/// How far each joint moves on a straight line between two configurations.
#[derive(Debug, Clone)]
pub struct Travel<'a> {
    kinematics: &'a ForwardKinematics,
    /// For each link, what its joint does; nothing for the root.
    of_link: Vec<Moved>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Moved {
    /// The angle by which the joint turns, rad.
    turn: f64,
    /// The length by which it slides, m.
    slide: f64,
    /// The greatest distance between the origins of its parent and its child link, m.
    reach: f64,
}

impl ForwardKinematics {
    /// How far each joint moves while every DOF changes linearly from `start` to `end`, rad or m.
    ///
    /// # Errors
    /// If a configuration does not have one finite value for each DOF.
    pub fn travel(&self, start: &[f64], end: &[f64]) -> Result<Travel<'_>, ConfigurationError> {
        self.check(start)?;
        self.check(end)?;
        let mut of_link = vec![Moved::default(); self.num_links()];
        for (link, of_link) in of_link.iter_mut().enumerate() {
            if let Some(step) = self.path(link).next() {
                let mut moved = moved(&step.motion, start, end);
                moved.reach += step.origin.translation.vector.norm();
                *of_link = moved;
            }
        }
        Ok(Travel { kinematics: self, of_link })
    }
}

impl Travel<'_> {
    /// An upper bound on the length, m, that any point within `radius` (m) of a link's origin travels, in the frame of
    /// a link above it. In a part of the motion it travels at most that part of it.
    ///
    /// A joint that turns by an angle moves a point by at most the angle times the distance of the point from the
    /// child link's origin; and that is at most `radius` and the links between. The angle of a rotation vector changes
    /// by at most the vector.
    pub fn of_points(&self, link: usize, radius: f64, above: usize) -> f64 {
        let mut distance = radius;
        let mut length = 0.0;
        let mut at = link;
        for step in self.kinematics.path(link) {
            if at == above {
                break;
            }
            let moved = self.of_link[at];
            length += moved.slide + moved.turn * distance;
            distance = (distance + moved.reach).min(f64::MAX);
            at = step.parent;
        }
        length
    }

    /// The nearest link that is above both, or one of the two.
    pub fn common(&self, a: usize, b: usize) -> usize {
        let [_, of_b] = self.kinematics.steps_between([a, b]);
        of_b.last().map_or(b, |step| self.kinematics.steps[*step].parent)
    }
}

fn moved(motion: &Motion, start: &[f64], end: &[f64]) -> Moved {
    // Finite, so that no product is NaN.
    let between = |from: f64, to: f64| (to - from).abs().min(f64::MAX);
    let change = |dof: usize| between(start[dof], end[dof]);
    let most = |dof: usize| start[dof].abs().max(end[dof].abs());
    let norm = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>().sqrt().min(f64::MAX);
    let sum = |dofs: &[usize]| norm(&dofs.iter().map(|dof| change(*dof)).collect::<Vec<_>>());
    let far = |dofs: &[usize]| norm(&dofs.iter().map(|dof| most(*dof)).collect::<Vec<_>>());
    match motion {
        Motion::Fixed => Moved::default(),
        Motion::Turn { position, .. } => {
            Moved { turn: between(position.at(start), position.at(end)), ..Moved::default() }
        }
        Motion::Slide { position, .. } => Moved {
            slide: between(position.at(start), position.at(end)),
            reach: position.at(start).abs().max(position.at(end).abs()),
            ..Moved::default()
        },
        Motion::Plane { dofs, .. } => {
            Moved { turn: change(dofs[2]), slide: sum(&dofs[..2]), reach: far(&dofs[..2]) }
        }
        Motion::Float { dofs } => {
            Moved { turn: sum(&dofs[3..]), slide: sum(&dofs[..3]), reach: far(&dofs[..3]) }
        }
        Motion::Ball { dofs } => Moved { turn: sum(dofs), ..Moved::default() },
    }
}

/// The least reach, m.
const LEAST: f64 = 1e-3;

/// The robot's reach (SPEC 5.6), m. Joints that are missing in one of the modules do not count.
pub fn reach(robot: &UrdfModule, chain: &ChainModule) -> f64 {
    let mut reach = vec![0.0_f64; chain.links_in_chain.len()];
    for link in chain.kinematic_hierarchy.iter().flatten() {
        let Some(of_link) = chain.links_in_chain.get(link.get()) else { continue };
        let (Some(joint), Some(parent)) = (of_link.parent_joint_idx, of_link.parent_link_idx)
        else {
            continue;
        };
        let joints = (robot.joints.get(joint.get()), chain.joints_in_chain.get(joint.get()));
        let (Some(joint), Some(in_chain)) = joints else { continue };
        let ends = joint.limit.as_ref().and_then(|limit| match (limit.lower, limit.upper) {
            (None, None) => None,
            (lower, upper) => Some([lower.unwrap_or_default(), upper.unwrap_or_default()]),
        });
        let travel = match (joint.joint_type, ends) {
            (JointType::Prismatic, Some([lower, upper])) => lower.abs().max(upper.abs()),
            (JointType::Prismatic | JointType::Planar | JointType::Floating, _) => 1.0,
            _ => 0.0,
        };
        let offset = in_chain.origin.position.iter().map(|x| x * x).sum::<f64>().sqrt();
        let before = reach.get(parent.get()).copied().unwrap_or_default();
        reach[link.get()] = before + offset + travel;
    }
    reach.into_iter().fold(LEAST, f64::max)
}
