//! How far a robot reaches: what lengths are compared with.

use urdd_format::chain::ChainModule;
use urdd_format::urdf::{JointType, UrdfModule};

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
