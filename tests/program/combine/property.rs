//! Thirty random compositions of our nine robots: each is valid, and each part moves as it does alone.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use urdd_format::urdf::{JointType, UrdfModule};
use urdd_generate::generate;
use urdd_robot::Robot;

use crate::combine::support::{core, findings, put_together};
use testkit::dice::Dice;
use testkit::robots::our_robots;

const TYPES: [&str; 7] =
    ["fixed", "revolute", "continuous", "prismatic", "planar", "floating", "spherical"];

/// A robot that can be a part: its URDD and its content.
struct Known {
    path: PathBuf,
    robot: Robot,
    described: UrdfModule,
}

impl Known {
    fn of(path: PathBuf) -> Known {
        let robot = Robot::open(&path).expect("a robot");
        let described = robot.description().expect("a robot");
        Known { path, robot, described }
    }

    fn root(&self) -> &str {
        let is_child =
            |name: &str| self.described.joints.iter().any(|joint| joint.child.link == name);
        let mut links = self.described.links.iter();
        &links.find(|link| !is_child(&link.name)).expect("a root").name
    }

    /// The links attached to a link, and the link itself.
    fn below(&self, link: &str) -> Vec<String> {
        let mut found = vec![link.to_owned()];
        let mut next = 0;
        while next < found.len() {
            let joints = self.described.joints.iter();
            let on = joints.filter(|joint| joint.parent.link == found[next]);
            let children: Vec<String> = on.map(|joint| joint.child.link.clone()).collect();
            found.extend(children);
            next += 1;
        }
        found
    }
}

/// How one part was included.
struct Member<'a> {
    of: &'a Known,
    prefix: String,
    dropped: Vec<String>,
    /// The DOFs, by name, that do not move, and their fixed values.
    frozen: Vec<(String, f64)>,
    /// The part and link that carries it, and the joint's pose relative to that link.
    on: Option<(usize, String, Isometry3<f64>)>,
    /// The type of the joint that attaches it.
    attached: Option<&'static str>,
}

fn number(dice: &mut Dice, size: f64) -> f64 {
    // Three digits, so that the recipe gives the exact value.
    (f64::from(dice.word()) / 65536.0 * 2000.0 - 1000.0).round() / 1000.0 * size
}

/// A recipe of some robots, and its expected result.
fn recipe<'a>(dice: &mut Dice, known: &'a [Known], number_of: usize) -> (String, Vec<Member<'a>>) {
    let mut text = format!("name = \"robot_{number_of}\"\n");
    let has_base = dice.below(2) == 0;
    if has_base {
        let kind = TYPES[[0, 2, 4, 5, 6][dice.below(5)]];
        let _ = writeln!(text, "[base]\nlink = \"the world\"\njoint = \"{kind}\"");
    }
    let mut members: Vec<Member> = Vec::new();
    for idx in 0..2 + dice.below(3) {
        let of = &known[dice.below(known.len())];
        let prefix = match dice.below(3) {
            // Without a prefix if no other part can clash.
            0 if idx == 0 => String::new(),
            1 => format!("p{idx}/"),
            _ => format!("p{idx}_"),
        };
        let _ = writeln!(
            text,
            "[[part]]\nid = \"p{idx}\"\nsource = {:?}\nprefix = {prefix:?}",
            of.path.display().to_string()
        );
        let mut member = Member {
            of,
            prefix,
            dropped: Vec::new(),
            frozen: Vec::new(),
            on: None,
            attached: None,
        };
        drop_some(dice, &mut member, &mut text);
        freeze_some(dice, &mut member, &mut text);
        if idx > 0 {
            let on = dice.below(idx);
            let holder = &members[on];
            let links = holder.of.described.links.iter().map(|link| &link.name);
            let links: Vec<&String> = links.filter(|link| !holder.dropped.contains(link)).collect();
            let link = links[dice.below(links.len())].clone();
            let [xyz, rpy] = [1.0, 3.0].map(|size| [0; 3].map(|_| number(dice, size)));
            let kind = TYPES[dice.below(7)];
            let mut axis = [0; 3].map(|_| number(dice, 1.0));
            axis[0] += 1.5;
            let _ = write!(
                text,
                "attach = {{ to = {:?}, joint = \"{kind}\", xyz = {xyz:?}, rpy = {rpy:?}",
                format!("p{on}/{link}")
            );
            if !matches!(kind, "fixed" | "floating" | "spherical") {
                let _ = write!(
                    text,
                    ", axis = {axis:?}, limit = {{ lower = -0.5, upper = 1.5, effort = 1, velocity = 1 }}"
                );
            }
            let _ = writeln!(text, " }}");
            let [roll, pitch, yaw] = rpy;
            let pose = Isometry3::from_parts(
                Translation3::from(Vector3::from(xyz)),
                UnitQuaternion::from_euler_angles(roll, pitch, yaw),
            );
            member.on = Some((on, link, pose));
            member.attached = Some(kind);
        }
        members.push(member);
    }
    (text, members)
}

/// Drops a subtree that no joint outside it mimics.
fn drop_some(dice: &mut Dice, member: &mut Member, text: &mut String) {
    let of = member.of;
    if dice.below(2) == 0 || of.described.links.len() < 2 {
        return;
    }
    let link = &of.described.links[dice.below(of.described.links.len())].name;
    if link == of.root() {
        return;
    }
    let below = of.below(link);
    let joints = &of.described.joints;
    let is_gone = |name: &str| {
        joints.iter().any(|joint| joint.name == name && below.contains(&joint.child.link))
    };
    let lost = joints.iter().any(|joint| {
        let follows = joint.mimic.as_ref().is_some_and(|mimic| is_gone(&mimic.joint));
        follows && !is_gone(&joint.name)
    });
    if !lost {
        let _ = writeln!(text, "drop = [{link:?}]");
        member.dropped = below;
    }
}

/// Freezes a joint that has DOFs of its own, of any type.
fn freeze_some(dice: &mut Dice, member: &mut Member, text: &mut String) {
    let of = member.of;
    let joints = of.described.joints.iter();
    let free: Vec<_> = joints
        .filter(|joint| joint.joint_type != JointType::Fixed && joint.mimic.is_none())
        .filter(|joint| !member.dropped.contains(&joint.child.link))
        .collect();
    if dice.below(2) == 0 || free.is_empty() {
        return;
    }
    let joint = free[dice.below(free.len())];
    let names: Vec<String> = (of.robot.dof_names().expect("DOFs").iter())
        .filter(|name| **name == joint.name || name.starts_with(&format!("{}/", joint.name)))
        .cloned()
        .collect();
    let space = of.robot.configurations().expect("configurations");
    let values: Vec<f64> = (names.iter())
        .map(|name| {
            let [lower, upper] = space.bounds()[of.robot.dof(name).expect("a DOF")];
            lower + (upper - lower) * f64::from(dice.word()) / 65536.0
        })
        .collect();
    let _ = match values.as_slice() {
        [one] => writeln!(text, "freeze = {{ {:?} = {one:?} }}", joint.name),
        _ => writeln!(text, "freeze = {{ {:?} = {values:?} }}", joint.name),
    };
    member.frozen = names.into_iter().zip(values).collect();
}

/// The poses of a part's own links, transformed by its attachment, next to those in the whole robot.
fn compare(whole: &Robot, members: &[Member], k: u64) {
    let q = whole.configurations().expect("configurations").random(k);
    let poses = whole.link_poses(&q).expect("poses");
    let dof = |name: &str| whole.dof(name).ok().map(|dof| q[dof]);
    for member in members {
        let own = &member.of.robot;
        let names = own.dof_names().expect("DOFs");
        let own_q: Vec<f64> = names
            .iter()
            .map(|name| {
                let frozen = member.frozen.iter().find(|(of, _)| of == name);
                match frozen {
                    Some((_, value)) => *value,
                    // Dropped joints move none of the remaining links.
                    None => dof(&format!("{}{name}", member.prefix)).unwrap_or(0.0),
                }
            })
            .collect();
        let own_poses = own.link_poses(&own_q).expect("poses");
        let at =
            |name: &str| poses[whole.link(&format!("{}{name}", member.prefix)).expect("a link")];
        let root = at(member.of.root());
        for (name, pose) in own.link_names().expect("links").iter().zip(own_poses) {
            if member.dropped.contains(name) {
                assert!(whole.link(&format!("{}{name}", member.prefix)).is_err());
                continue;
            }
            let apart = (at(name).to_homogeneous() - (root * pose).to_homogeneous()).amax();
            assert!(apart < 1e-9, "{}{name}: {apart:e}", member.prefix);
        }
    }
}

#[test]
fn robots_put_together_at_random_are_valid_and_move_as_their_parts() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    let mut known: Vec<Known> = our_robots()
        .into_iter()
        .map(|(name, urdf)| {
            let path = folder.join(name);
            generate(&urdf, &path, &core(), &()).expect("a URDD");
            Known::of(path)
        })
        .collect();
    let mut dice = Dice(11);
    let (mut frozen, mut dropped, mut nested) = (0, 0, 0);
    let (mut attached, mut prefixes) = (BTreeSet::new(), BTreeSet::new());
    for number in 0..30 {
        let (text, members) = recipe(&mut dice, &known, number);
        let (_, target) =
            put_together(&text, folder, &core()).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(findings(&target), [] as [String; 0], "{text}");
        let whole = Robot::open(&target).expect("a robot");
        // At zero, where all joints between the parts are at their origins.
        let zero = whole.configurations().expect("configurations").zero();
        let poses = whole.link_poses(&zero).expect("poses");
        for member in &members {
            let Some((on, link, pose)) = &member.on else {
                continue;
            };
            let at = |name: String| poses[whole.link(&name).expect("a link")];
            let carrier = at(format!("{}{link}", members[*on].prefix));
            let root = at(format!("{}{}", member.prefix, member.of.root()));
            let apart = (root.to_homogeneous() - (carrier * pose).to_homogeneous()).amax();
            assert!(apart < 1e-12, "{apart:e}\n{text}");
        }
        for k in 0..3 {
            compare(&whole, &members, k);
        }
        frozen += members.iter().filter(|member| !member.frozen.is_empty()).count();
        dropped += members.iter().filter(|member| !member.dropped.is_empty()).count();
        nested += members.iter().filter(|member| member.of.path.ends_with("nested")).count();
        attached.extend(members.iter().filter_map(|member| member.attached));
        prefixes.extend(members.iter().map(|member| member.prefix.clone()));
        // The first ones are parts of later ones.
        if number == 4 {
            let path: &Path = &folder.join("nested");
            std::fs::rename(&target, path).expect("a folder");
            known.push(Known::of(path.to_owned()));
            known.push(Known::of(path.to_owned()));
        }
    }
    assert!(frozen > 10 && dropped > 10 && nested > 5, "{frozen} {dropped} {nested}");
    assert_eq!(attached, BTreeSet::from(TYPES));
    let without = |prefix: &str| prefixes.contains(prefix);
    assert!(without("") && without("p0/") && without("p1_"), "{prefixes:?}");
}
