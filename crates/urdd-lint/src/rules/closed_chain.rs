use nalgebra::Isometry3;

use super::prelude::*;
use crate::pose::at_default;
use urdd_directory::loops_toml::{File, FrameTable};
use urdd_document::robot::Robot;
use urdd_format::readable;
use urdd_kinematics::loops::Gap;
use urdd_kinematics::pose::from_xyz_rpy;
use urdd_source::loops::urdf_plus;

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
    /// Of loops that a file beside the URDF says (`NAME.loops.toml`, the YAML of Extended URDF), or an MJCF or SDF, only those are
    /// told that are open in the default configuration.
    ///
    /// An element that is no loop or coupling of URDF+, as URDF+ has it, is told by itself, and a file beside the URDF that cannot
    /// be read.
    ///
    /// Close the chain for the program that solves it: `urdd export mjcf` writes `<connect>` and `<weld>`; Drake takes
    /// `<drake:ball_constraint>`, PyBullet `createConstraint`, Pinocchio a constraint model. Where a joint follows another one at a constant rate, as
    /// in many grippers, `<mimic>` is enough.
    LNT066 "closed-chain", Warning, WrongMotion, since "1.3.0"
}

/// Ends of a loop that are nearer meet, m and rad.
const MEET: f64 = 1e-6;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let of_urdf = urdf_plus(urdf.root).map_or_else(Vec::new, |(_, faults)| faults);
    let is_closing = |(name, node): &(&str, Node)| {
        let has_end = |end: &&str| child(*node, end).is_some();
        ["loop", "coupling"].contains(name) && ["predecessor", "successor"].iter().any(has_end)
    };
    let all = children(urdf.root).filter(is_closing);
    let fault_of = |(_, node): &(&str, Node)| {
        of_urdf.iter().find(|fault| node.range().contains(&fault.offset))
    };
    let (faulty, closing): (Vec<_>, Vec<_>) = all.partition(|one| fault_of(one).is_some());
    let checked = chains(urdf, &closing, findings);
    for (one, fault) in faulty.iter().filter_map(|one| Some((one, fault_of(one)?))) {
        let message = format!(
            "`urdd generate` leaves this out: {}; mend it, so that the chain is closed",
            urdd_format::escape::line(&fault.fault)
        );
        urdf.at(one.1, message).report(findings);
    }
    if let Err(said) = urdf.closing.beside() {
        let message = format!(
            "`urdd generate` refuses the robot, for what says its loops: {}",
            urdd_format::escape::line(said)
        );
        urdf.at(urdf.root, message).report(findings);
    }
    checked
}

/// What no program keeps closed.
fn chains<'a>(
    urdf: &Subject<'a>,
    closing: &[(&str, Node<'a, 'a>)],
    findings: &mut Findings,
) -> Option<()> {
    let said = urdf.closing.loops();
    if closing.is_empty() && said.is_none_or(|file| file.loops.is_empty()) {
        return Some(());
    }
    let (robot, bodies) = urdf.bodies(findings)?;
    let open = said.and_then(|file| widest(file, robot, &at_default(robot, &bodies.tree)));
    let open = open.map(|(name, gaps)| {
        format!(
            "in the default configuration, the ends of `{}` are {gaps} apart",
            urdd_format::escape::line(name),
        )
    });
    let Some((_, first)) = closing.first() else {
        if let Some(open) = open {
            let message = format!("{open}; begin in a closed one, which `urdd generate` looks for");
            urdf.at(urdf.root, message).report(findings);
        }
        return Some(());
    };
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
    let open = open.map_or_else(String::new, |open| format!("; {open}"));
    let count = |count: usize, one: &str| match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        _ => Some(format!("{count} {one}s")),
    };
    let loops = closing.iter().filter(|(name, _)| *name == "loop").count();
    let counts = [count(loops, "loop"), count(closing.len() - loops, "coupling")];
    let counts: Vec<String> = counts.into_iter().flatten().collect();
    let message = format!(
        "no program keeps {} of the robot: {of_tree}{open}; close the chain in the program's own format",
        counts.join(" and ")
    );
    urdf.at(*first, message).report(findings);
    Some(())
}

/// The loop whose ends are farthest apart, and how far; `None` if all are closed.
fn widest<'f>(
    file: &'f File,
    robot: &Robot,
    poses: &[Isometry3<f64>],
) -> Option<(&'f str, String)> {
    let links = robot.links.iter().enumerate().map(|(index, link)| (link.name.as_str(), index));
    let mut bodies: BTreeMap<&str, usize> = links.collect();
    // Extended URDF also names joints, and means their children.
    for joint in &robot.joints {
        if let Some(child) = bodies.get(joint.child.as_str()).copied() {
            bodies.entry(&joint.name).or_insert(child);
        }
    }
    let gaps = file.loops.iter().filter_map(|one| {
        let one = one.get_ref();
        let end = |link: &str, frame: &FrameTable| {
            Some(poses[*bodies.get(link)?] * from_xyz_rpy(frame.xyz, frame.rpy))
        };
        let a = end(one.link_a.get_ref(), &one.frame_a)?;
        let b = end(one.link_b.get_ref(), &one.frame_b)?;
        Some((&*one.name, Gap::of(one.kind, &a.inv_mul(&b))))
    });
    let size = |gap: &Gap| gap.position + gap.rotation;
    let (name, gap) = gaps.max_by(|(_, a), (_, b)| size(a).total_cmp(&size(b)))?;
    let distance = (gap.position > MEET).then(|| metres(gap.position));
    let angle = (gap.rotation > MEET).then(|| format!("{} rad", readable::number(gap.angle(), 3)));
    let gaps: Vec<String> = distance.into_iter().chain(angle).collect();
    (!gaps.is_empty()).then(|| (name, gaps.join(" and ")))
}
