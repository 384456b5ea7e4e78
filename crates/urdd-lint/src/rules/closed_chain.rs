use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::prelude::*;
use crate::pose::at_default;
use urdd_format::readable;

declare_lint! {
    /// A joint or coupling closes a chain, and no program that reads URDFs keeps it closed.
    ///
    /// `<loop>` and `<coupling>` are of URDF+. ROS, Gazebo, MuJoCo, Pinocchio, Drake, PyBullet, Isaac, Newton and three.js pass
    /// over them: of the robot, they have the tree, in which each joint moves by itself. So a plan opens the chain, and drives
    /// joints that have no motor. `urdd generate` reads them, and writes what closes the chain into `loops_module`.
    ///
    /// The message says how many degrees of freedom the tree has, how many of them the URDF calls `independent`, and how far
    /// apart the ends of a loop are in the default configuration: each joint is at 0, or at the limit nearest to it. Many robots
    /// are open there, and need another configuration to begin with. Ends within a micrometre and a microradian meet.
    ///
    /// Close the chain for the program that solves it: `urdd export mjcf` writes `<connect>` and `<weld>`; Drake takes
    /// `<drake:ball_constraint>`, PyBullet `createConstraint`, Pinocchio a constraint model. Where a joint follows another one at a constant rate, as
    /// in many grippers, `<mimic>` is enough.
    LNT066 "closed-chain", Warning, WrongMotion, since "1.3.0"
}

/// Ends of a loop that are nearer meet, m and rad.
const MEET: f64 = 1e-6;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let closing = children(urdf.root).filter(|(name, _)| ["loop", "coupling"].contains(name));
    let closing = closing.filter_map(|(name, node)| Some((name, node, ends(node)?)));
    let closing: Vec<(&str, Node, [Node; 2])> = closing.collect();
    let Some((_, first, _)) = closing.first() else { return Some(()) };
    let (robot, bodies) = urdf.bodies(findings)?;
    let poses = at_default(robot, &bodies.tree);
    let links: BTreeMap<&str, usize> =
        robot.links.iter().enumerate().map(|(index, link)| (link.name.as_str(), index)).collect();
    let freely = urdf.joints_of(&ONE_DOF).filter(|joint| child(*joint, "mimic").is_none());
    let freely: Vec<Node> = freely.collect();
    // A joint is independent unless it says otherwise.
    let follow = freely.iter().filter(|joint| joint.attribute("independent") == Some("false"));
    let of_tree = match (freely.len(), freely.len() - follow.count()) {
        (1, _) => "1 joint moves".to_owned(),
        (all, some) if some == all => format!("{all} joints move by themselves"),
        (all, 1) => format!("{all} joints move by themselves, of which 1 is `independent`"),
        (all, some) => {
            format!("{all} joints move by themselves, of which {some} are `independent`")
        }
    };
    let loops = closing.iter().filter(|(name, ..)| *name == "loop");
    let gaps = loops.clone().filter_map(|(_, node, ends)| {
        let [a, b] = ends.map(|end| {
            let link = links.get(end.attribute("link")?.trim())?;
            Some(poses[*link] * origin(end))
        });
        let (a, b) = (a?, b?);
        let mut apart = a.translation.vector - b.translation.vector;
        let axis = child(*node, "axis").and_then(|axis| numbers::<3>(axis, "xyz"));
        let axis = axis.map_or(Vector3::x(), Vector3::from);
        let angle = match node.attribute("type") {
            Some("fixed") => a.rotation.angle_to(&b.rotation),
            Some("revolute" | "continuous" | "prismatic") => {
                (a.rotation * axis).angle(&(b.rotation * axis))
            }
            _ => 0.0,
        };
        // An axis without a direction leaves nothing free.
        let along = (a.rotation * axis).try_normalize(0.0);
        if let (Some("prismatic"), Some(along)) = (node.attribute("type"), along) {
            apart -= along * apart.dot(&along);
        }
        Some((*node, apart.norm(), angle))
    });
    let worst = gaps.max_by(|(_, a, by_a), (_, b, by_b)| (a + by_a).total_cmp(&(b + by_b)));
    let is_open = |(_, distance, angle): &(Node, f64, f64)| *distance > MEET || *angle > MEET;
    let open = match worst.filter(is_open) {
        None => String::new(),
        Some((node, distance, angle)) => {
            let name = node.attribute("name").unwrap_or_default();
            let distance = (distance > MEET).then(|| metres(distance));
            let angle = (angle > MEET).then(|| format!("{} rad", readable::number(angle, 3)));
            let gaps: Vec<String> = distance.into_iter().chain(angle).collect();
            format!(
                "; in the default configuration, the ends of `{}` are {} apart",
                urdd_format::escape::line(name),
                gaps.join(" and ")
            )
        }
    };
    let count = |count: usize, one: &str| match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        _ => Some(format!("{count} {one}s")),
    };
    let loops = loops.count();
    let counts = [count(loops, "loop"), count(closing.len() - loops, "coupling")];
    let counts: Vec<String> = counts.into_iter().flatten().collect();
    let message = format!(
        "no program keeps {} of the robot: {of_tree}{open}; close the chain in the program's own format",
        counts.join(" and ")
    );
    urdf.at(*first, message).report(findings);
    Some(())
}

/// The two ends of a `<loop>` or `<coupling>` of URDF+.
fn ends<'a>(node: Node<'a, 'a>) -> Option<[Node<'a, 'a>; 2]> {
    Some([child(node, "predecessor")?, child(node, "successor")?])
}

/// The frame of an end in its link.
fn origin(end: Node) -> Isometry3<f64> {
    let of = |name: &str| {
        let origin = child(end, "origin")?;
        numbers::<3>(origin, name)
    };
    let [roll, pitch, yaw] = of("rpy").unwrap_or_default();
    let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Isometry3::from_parts(Translation3::from(of("xyz").unwrap_or_default()), turn)
}
