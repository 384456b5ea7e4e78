use std::cell::LazyCell;
use std::collections::{BTreeMap, HashMap, HashSet};

use nalgebra::Isometry3;
use urdd_directory::account::Account;
use urdd_directory::loops_toml::{File, FrameTable};
use urdd_document::pose::unit;
use urdd_document::robot::{Joint, Robot};
use urdd_document::tree::Mimics;
use urdd_findings::part::SkipReason;
use urdd_format::readable::{self, counted};
use urdd_format::urdf::JointType;
use urdd_geometry::convex::across::PlacedPair;
use urdd_geometry::convex::{ConvexShape, penetration};
use urdd_kinematics::loops::Gap;
use urdd_kinematics::pose::from_xyz_rpy;
use urdd_kinematics::{Load, gather};
use urdd_source::loops::{LoopFault, urdf_plus};

use super::prelude::*;
use crate::geometry::Shape;
use crate::pose::{above as above_joints, at_default, default_position, sampled};

declare_lint! {
    /// The effort of a joint's limit is too small to hold the links beyond the joint against gravity.
    ///
    /// Programs that keep to the limit let the joint sag. An arm that needs 3.9 N m and has the effort 3 fell by 1.1 rad in
    /// MuJoCo 4.0 and Drake 1.51, which keep to it for every motor, and by 1 rad in PyBullet where the limit was given as the
    /// motor's force. With 4.5, it stayed.
    ///
    /// Each joint is at 0, or at the limit nearest to it, and gravity is along -z of the root link. A joint holds what is beyond
    /// the joints that mimic it, too. Left out: joints that gravity pushes against a stop within 0.01 rad or m, and links
    /// with `<turnGravityOff>`.
    ///
    /// Write what the motor can do, in N m, or N for a prismatic joint: `<limit effort="3">` becomes
    /// `<limit effort="30">`. If the motor is that weak, correct the masses, or balance the arm. `urdd info --statics` says
    /// what each joint of a URDD needs.
    LNT062 "effort-too-small", Warning, WrongMotion, since "1.3.0" => effort_too_small;

    /// Links overlap in the default configuration.
    ///
    /// It is the convex hulls of collision shapes that overlap, by more than 1 mm: MuJoCo, PyBullet and Isaac take the hull of a
    /// collision mesh. MuJoCo pushes the links apart from the first step, and the robot jerks or jams. Each joint is at 0,
    /// or at the limit nearest to it. Left out: links that fixed joints hold together, a link and the next one, pairs that the
    /// robot's SRDF disables, robots of more than 600 collision shapes, or of more than 5,000 pairs of shapes whose boxes overlap.
    ///
    /// `urdd generate` and MoveIt's Setup Assistant disable such a pair, and then no program sees the two collide. So the message
    /// says in how many of 100 sampled configurations they overlap.
    ///
    /// Make the shapes smaller or cut them into convex pieces (`urdd generate`). Disable the pair where it overlaps in nearly all
    /// configurations.
    LNT050 "self-collision-in-default", Info, Collisions, since "1.1.0" => self_collision_in_default;

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
    LNT066 "closed-chain", Warning, WrongMotion, since "1.3.0" => closed_chain
}

/// m/s², along -z of the root link.
const GRAVITY: f64 = 9.81;
/// A joint that is no farther from its stop sags no farther, rad or m.
const SLACK: f64 = 0.01;

fn effort_too_small(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let tree = &bodies.tree;
    let poses = at_default(robot, tree);
    let weightless = weightless(urdf);
    let own = robot.links.iter().zip(&poses).map(|(link, pose)| match &link.inertial {
        Some(inertial) if !weightless.contains(link.name.as_str()) => {
            Load::new(inertial.mass.unwrap_or(0.0), inertial.origin.xyz.into(), pose)
        }
        _ => Load::default(),
    });
    let mut loads: Vec<Load> = own.collect();
    let up = tree.order.iter().rev();
    gather(&mut loads, up.filter_map(|child| Some((tree.parent_link[*child]?, *child))));

    // A joint that others follow holds what is beyond them too.
    let mimics = Mimics::resolve(robot).map(|mimics| mimics.by_joint);
    let mimic = |joint: usize| mimics.as_ref().and_then(|all| all[joint]);
    let followed: BTreeSet<usize> =
        (0..robot.joints.len()).filter_map(|joint| Some(mimic(joint)?.driver)).collect();
    let mut needed = vec![0.0; robot.joints.len()];
    for (index, joint) in robot.joints.iter().enumerate() {
        let child = tree.joint_links[index].1;
        let effort = effort(joint, &poses[child], &loads[child]);
        let (driver, factor) =
            mimic(index).map_or((index, 1.0), |mimic| (mimic.driver, mimic.multiplier));
        needed[driver] += factor * effort;
    }
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(limit) = joint.limit.and_then(|limit| limit.effort) else {
            continue;
        };
        let needed = needed[index];
        if limit <= 0.0
            || needed.abs() <= limit
            || mimic(index).is_some()
            || is_at_stop(robot, joint, needed)
        {
            continue;
        }
        let unit = if joint.joint_type == JointType::Prismatic { "N" } else { "N m" };
        let mass = loads[tree.joint_links[index].1].mass;
        let [needed, limit, mass] =
            [needed.abs(), limit, mass].map(|value| readable::number(value, 3));
        let others = if followed.contains(&index) { " and what its followers hold" } else { "" };
        let message = format!(
            "in the default configuration, the joint needs {needed} {unit} to hold the {mass} kg beyond it{others}, and `effort` \
            is {limit}: it sags; write what the motor can do, in {unit}"
        );
        let node = urdf.joints[index];
        urdf.at_attribute(child(node, "limit").unwrap_or(node), "effort", message).report(findings);
    }
    Some(())
}

/// The links that Gazebo turns gravity off for.
fn weightless<'a>(urdf: &Subject<'a>) -> BTreeSet<&'a str> {
    let links = named(urdf.root, "gazebo").filter_map(|node| {
        let text = child(node, "turnGravityOff")?.text()?.trim();
        matches!(text, "true" | "True" | "1").then(|| node.attribute("reference"))?
    });
    links.collect()
}

/// What a joint of one degree of freedom must give to hold a load, N m or N.
fn effort(joint: &Joint, child: &Isometry3<f64>, load: &Load) -> f64 {
    let (Some(centre), Some(axis)) = (load.centre(), unit(joint.axis)) else {
        return 0.0;
    };
    let axis = child.rotation * axis;
    let lift = match joint.joint_type {
        JointType::Prismatic => axis.z,
        JointType::Revolute | JointType::Continuous => {
            axis.cross(&(centre.coords - child.translation.vector)).z
        }
        _ => 0.0,
    };
    GRAVITY * load.mass * lift
}

/// Whether gravity pushes a joint against its stop, or nearly.
fn is_at_stop(robot: &Robot, joint: &Joint, needed: f64) -> bool {
    joint.position_limits().is_some_and(|(lower, upper)| {
        let position = default_position(robot, joint);
        let left = if needed > 0.0 { position - lower } else { upper - position };
        left <= SLACK
    })
}

/// Parts that touch are no finding, m.
const LEAST: f64 = 0.001;
const MANY: usize = 600;
const MANY_PAIRS: usize = 5_000;
/// Sampled configurations of the pair that is named.
const SAMPLES: usize = 100;
/// Maximum number of joints that the samples move.
const MOST_STEPS: usize = 100_000;

fn self_collision_in_default(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    let collides = |shape: &&Shape| shape.kind == GeometryKind::Collision && !shape.is_turned;
    let all = geometry.links.iter().flat_map(|link| &link.shapes);
    if all.filter(collides).count() > MANY {
        return Some(());
    }
    let poses = at_default(robot, &bodies.tree);
    let mut items = Vec::new();
    for (link, shapes) in geometry.links.iter().enumerate() {
        for shape in shapes.shapes.iter().filter(collides) {
            let corners: Vec<Vector3<f64>> = shape.placed(&poses[link]).corners().collect();
            let Some(bounds) = bounds(corners.iter().copied()) else {
                continue;
            };
            let Some(hull) = Hull::coarse(&corners) else {
                continue;
            };
            let corners: Vec<[f64; 3]> = hull.corners.into_iter().map(Into::into).collect();
            // Made where a pair asks for it.
            let shape = LazyCell::new(move || ConvexShape::of_points(&corners).ok());
            items.push((link, bounds, shape));
        }
    }
    let above = |top: usize| bodies.tree.parent_link[top].map(|parent| bodies.top[parent]);
    let links: HashMap<&str, usize> =
        robot.links.iter().enumerate().map(|(index, link)| (link.name.as_str(), index)).collect();
    let disabled = srdf::disabled_pairs(urdf).into_iter().filter_map(|(a, b)| {
        let (a, b) = (*links.get(a.as_str())?, *links.get(b.as_str())?);
        Some((a.min(b), a.max(b)))
    });
    let disabled: HashSet<(usize, usize)> = disabled.collect();
    let mut worst: Option<(f64, usize, usize)> = None;
    let mut worst_shapes = None;
    let mut pairs = BTreeSet::new();
    let mut compared = 0;
    for (number, (a, (low_a, high_a), first)) in items.iter().enumerate() {
        for (b, (low_b, high_b), second) in &items[number + 1..] {
            let (top_a, top_b) = (bodies.top[*a], bodies.top[*b]);
            let is_near =
                top_a == top_b || above(top_a) == Some(top_b) || above(top_b) == Some(top_a);
            let is_apart =
                (0..3).any(|axis| low_a[axis] > high_b[axis] || low_b[axis] > high_a[axis]);
            if is_near || is_apart || disabled.contains(&(*a.min(b), *a.max(b))) {
                continue;
            }
            compared += 1;
            if compared > MANY_PAIRS {
                return Some(());
            }
            let (Some(first), Some(second)) = (&**first, &**second) else {
                continue;
            };
            let overlap = penetration(&PlacedPair::new(first, second, &Isometry3::identity()));
            let depth = overlap.map_or(0.0, |overlap| overlap.depth);
            if depth > LEAST {
                pairs.insert((top_a.min(top_b), top_a.max(top_b)));
                if worst.is_none_or(|(most, _, _)| depth > most) {
                    worst = Some((depth, *a, *b));
                    worst_shapes = Some((first, second));
                }
            }
        }
    }
    let Some((depth, a, b)) = worst else {
        return Some(());
    };
    let more = match pairs.len() - 1 {
        0 => String::new(),
        more => format!(", and {}", counted(more, "more pair")),
    };
    // Fewer samples of a robot with very many joints.
    let joints = above_joints(&bodies.tree, a).count() + above_joints(&bodies.tree, b).count();
    let samples = (MOST_STEPS / joints.max(1)).clamp(1, SAMPLES);
    // The hulls are where the default configuration has them.
    let moved = |link: usize, k: u64| sampled(robot, &bodies.tree, link, k) * poses[link].inverse();
    let touches = |k: u64| {
        let pose = moved(a, k).inverse() * moved(b, k);
        let overlap = worst_shapes
            .and_then(|(first, second)| penetration(&PlacedPair::new(first, second, &pose)));
        overlap.is_some_and(|overlap| overlap.depth > LEAST)
    };
    let touching = (0..samples as u64).filter(|k| touches(*k)).count();
    let advice = if touching == samples {
        "make them smaller, or disable the pair"
    } else {
        "make them smaller: once the pair is disabled, as `urdd generate` does, no program sees the two collide"
    };
    let message = format!(
        "in the default configuration, the convex hulls of `{}` and `{}` overlap by {}{more}; these two overlap in \
        {touching} of {samples} sampled configurations; {advice}",
        robot.links[a].name,
        robot.links[b].name,
        metres(depth)
    );
    let node = child(urdf.links[a], "collision").unwrap_or(urdf.links[a]);
    urdf.at(node, message).report(findings);
    Some(())
}

/// Ends of a loop that are nearer meet, m and rad.
const MEET: f64 = 1e-6;

fn closed_chain(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let account = Account::new(&urdf.settings.source.cancellation);
    account.deposit(urdf.root.document().input_text().len());
    let of_urdf = urdf_plus(urdf.root, &account);
    let of_urdf = findings.or_skip(of_urdf.map_err(|costly| SkipReason::obstacle(costly.error)))?;
    let of_urdf = of_urdf.map_or_else(Vec::new, |(_, faults)| faults);
    let of_urdf: BTreeMap<usize, LoopFault> =
        of_urdf.into_iter().map(|fault| (fault.offset, fault)).collect();
    let is_closing = |(name, node): &(&str, Node)| {
        let has_end = |end: &&str| child(*node, end).is_some();
        ["loop", "coupling"].contains(name) && ["predecessor", "successor"].iter().any(has_end)
    };
    let all = children(urdf.root).filter(is_closing);
    let fault_of =
        |(_, node): &(&str, Node)| of_urdf.range(node.range()).next().map(|(_, fault)| fault);
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
