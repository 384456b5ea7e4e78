use urdd_format::readable::number;
use urdd_format::urdf::JointType;

use super::prelude::*;
use crate::geometry::Shape;
use crate::pose::mass;

declare_lint! {
    /// An `<inertial>` has no mass, no inertia, or not all numbers of it.
    ///
    /// Programs refuse the robot, or go on without the inertial: without a mass the link weighs nothing.
    ///
    /// Write `<mass value>` and all of ixx, ixy, ixz, iyy, iyz, izz. A link without mass has no `<inertial>` at all.
    LNT008 "inertial-incomplete", Error, WrongMotion, since "1.1.0" => inertial_incomplete;

    /// A joint moves links of which none has a mass.
    ///
    /// Its mass depends on the program: MuJoCo fills collision shapes with 1000 kg/m³, PyBullet gives such a link 1 kg,
    /// Pinocchio 0 kg. Links that fixed joints hold together count as one.
    ///
    /// Write an `<inertial>`, or make the joint `fixed`.
    LNT006 "moving-link-without-inertial", Warning, WrongMotion, since "1.1.0" => moving_link_without_inertial;

    /// The root link has a mass.
    ///
    /// KDL, which ROS uses in `robot_state_publisher`, loses it, and warns: `KDL does not support a root link with an
    /// inertia`. Other programs take it.
    ///
    /// Where KDL computes dynamics, put an empty root link above, with a fixed joint. Leave it in a robot that floats:
    /// PyBullet gives an empty root 1 kg.
    LNT007 "root-link-with-inertial", Info, WrongMotion, since "1.1.0", off by default => root_link_with_inertial;

    /// Links of different sizes have one mass and one inertia.
    ///
    /// They are defaults that nobody replaced: the robot moves in a simulator, but not as the real one.
    ///
    /// Compute mass and inertia of each link from its geometry.
    LNT004 "same-default-inertia", Info, WrongMotion, since "1.1.0" => same_default_inertia;

    /// The inertia of a link is less than a thousandth of what its mass and shapes give.
    ///
    /// All of the mass would be in a ball of 3 % of the link's size. Joints answer to forces a thousand times more than
    /// the real ones, and MuJoCo refuses the smallest. Where it is 0, SRC004 says so.
    ///
    /// Compute the tensor from the link's geometry, in kg m²: `1e-6` is often a default.
    LNT005 "inertia-far-below-geometry", Warning, WrongMotion, since "1.1.0" => inertia_far_below_geometry;

    /// The mass and the shapes of a body make no density of a thing that is built.
    ///
    /// Above 20,000 kg/m³, unless it is the base, it is heavier than solid tungsten, although the convex hull is larger than the part. Below 10 kg/m³ it is
    /// lighter than foam. The mass is in grams, the shapes are in other units, or the mass was never filled in. Where a
    /// heavy part touches a far too light one, simulators need tiny steps, or explode.
    ///
    /// Write the mass in kilograms, and scale meshes to metres (`scale="0.001 0.001 0.001"`).
    LNT003 "odd-density", Warning, WrongMotion, since "1.1.0" => odd_density
}

fn inertial_incomplete(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for link in &urdf.links {
        let Some(inertial) = child(*link, "inertial") else { continue };
        let mut missing = Vec::new();
        match child(inertial, "mass") {
            None => missing.push("`<mass>`"),
            Some(mass) if !mass.has_attribute("value") => missing.push("`value` of the mass"),
            Some(_) => {}
        }
        match child(inertial, "inertia") {
            None => missing.push("`<inertia>`"),
            Some(inertia) => {
                let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
                missing.extend(names.into_iter().filter(|name| !inertia.has_attribute(*name)));
            }
        }
        if !missing.is_empty() {
            let message = format!("`<inertial>` has no {}; write it", missing.join(", no "));
            urdf.at(inertial, message).report(findings);
        }
    }
    Some(())
}

fn moving_link_without_inertial(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let has_mass = |link: usize| mass(&robot.links[link]).is_some_and(|mass| mass != 0.0);
    // SRC003 tells of a moving link that says 0.
    let says_zero = |link: usize| mass(&robot.links[link]) == Some(0.0);
    let moves = |joint: &usize| robot.joints[*joint].joint_type != JointType::Fixed;
    if !(0..robot.links.len()).any(has_mass) {
        let is_told = bodies.tops().any(says_zero);
        if !is_told && (0..robot.joints.len()).any(|joint| moves(&joint)) {
            let message = "no link has a mass; write an `<inertial>` for each";
            urdf.at(urdf.root, message).report(findings);
        }
        return Some(());
    }
    for top in bodies.tops() {
        let Some(joint) = bodies.tree.parent_joint[top].filter(moves) else { continue };
        if !bodies.members(top).any(has_mass) && !says_zero(top) {
            let message = format!(
                "joint `{}` moves this link, and it has no mass; write an `<inertial>`",
                robot.joints[joint].name
            );
            urdf.at(urdf.links[top], message).report(findings);
        }
    }
    Some(())
}

fn root_link_with_inertial(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let root = bodies.tree.root;
    let has_mass = mass(&robot.links[root]).is_some_and(|mass| mass != 0.0);
    if has_mass && robot.links.len() > 1 {
        let message = "the root link has an inertial, which KDL leaves out; where KDL computes dynamics, put an empty root link above it";
        urdf.at(urdf.links[root], message).report(findings);
    }
    Some(())
}

/// Number of links, and of different sizes: a left and a right twin are no defaults.
const MANY: usize = 3;
/// Links without a mass of their own, such as frames, are written with less than this, kg: their mass is that of others.
const MASSLESS: f64 = 1e-3;
/// A size is another one from this ratio of volumes on.
const APART: f64 = 1.1;

fn same_default_inertia(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, _) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    let mut groups: BTreeMap<[u64; 7], Vec<usize>> = BTreeMap::new();
    for (index, link) in robot.links.iter().enumerate() {
        let inertial = link.inertial.as_ref();
        let numbers = inertial.and_then(|inertial| Some((inertial.mass?, inertial.inertia?)));
        if let Some((mass, [a, b, c, d, e, f])) = numbers
            && mass > MASSLESS
            && [a, b, c, d, e, f] != [0.0; 6]
        {
            let key = [mass, a, b, c, d, e, f].map(f64::to_bits);
            groups.entry(key).or_default().push(index);
        }
    }
    let mut groups: Vec<_> = groups.into_iter().filter(|(_, links)| links.len() >= MANY).collect();
    groups.sort_by_key(|(_, links)| links[0]);
    for (key, links) in groups {
        let hulls = links.iter().filter(|link| !geometry.links[**link].is_partial);
        let hulls = hulls.filter_map(|link| geometry.links[*link].hull());
        let mut volumes: Vec<f64> = hulls.map(|hull| hull.volume).collect();
        volumes.sort_by(f64::total_cmp);
        let mut sizes: Vec<f64> = Vec::new();
        for volume in volumes {
            if sizes.last().is_none_or(|last| volume > APART * last) {
                sizes.push(volume);
            }
        }
        if sizes.len() < MANY {
            continue;
        }
        let [mass, xx, _, _, yy, _, zz] = key.map(f64::from_bits);
        let message = format!(
            "{} links of {} different sizes have {} kg and the moments {} {} {}; compute those of each link",
            links.len(),
            sizes.len(),
            number(mass, 4),
            number(xx, 4),
            number(yy, 4),
            number(zz, 4)
        );
        urdf.at(urdf.inertial(links[0], "inertia"), message).report(findings);
    }
    Some(())
}

/// A motor in a shell has a tenth of the inertia of the evenly filled hull.
const LEAST_PART: f64 = 1e-3;

fn inertia_far_below_geometry(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, _) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    if !urdf.moves() {
        return Some(());
    }
    // LNT022 finds larger ones.
    let longest = urdf.longest_part(findings)?;
    for (index, link) in robot.links.iter().enumerate() {
        let shapes = &geometry.links[index];
        let Some(inertial) = Inertial::of(link).filter(|_| !shapes.is_partial) else {
            continue;
        };
        let Some(hull) = shapes.hull() else { continue };
        let (trace, even) = (inertial.trace(), inertial.mass * hull.even_trace());
        let is_huge = diagonal(shapes.corners()) > longest;
        if trace <= 0.0 || trace >= LEAST_PART * even || is_huge {
            continue;
        }
        let message = format!(
            "the principal moments sum up to {} kg m²; the link's mass and shapes give {}, {} times as much. Compute the \
            inertia from the link's geometry, in kg m²",
            number(trace, 3),
            number(even, 3),
            number(even / trace, 2)
        );
        urdf.at(urdf.inertial(index, "inertia"), message).report(findings);
    }
    Some(())
}

/// The least and the greatest density, kg/m³.
const LEAST: f64 = 10.0;
const GREATEST: f64 = 20_000.0;
/// Dummies of a gram in a box of a millimetre are not meant to be dense, kg.
const DUMMY: f64 = 0.05;

fn odd_density(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    // LNT022 finds larger ones.
    let longest = urdf.longest_part(findings)?;
    for (&top, body) in geometry.bodies.iter().filter(|(_, body)| !body.is_partial) {
        let mass_of = |link: usize| mass(&robot.links[link]);
        let mass: f64 = bodies.members(top).filter_map(mass_of).sum();
        let Some(hull) = (mass > 0.0).then(|| body.hull()).flatten() else {
            continue;
        };
        // Each shape by itself, so that an L is not filled; the smaller of what is seen and what collides.
        let sum = |kind: GeometryKind| -> f64 {
            let shapes = body.shapes.iter().filter(|shape| shape.kind == kind);
            shapes.map(Shape::volume).sum()
        };
        let sums = [GeometryKind::Visual, GeometryKind::Collision].map(sum);
        let least = sums.into_iter().filter(|sum| *sum > 0.0).fold(f64::INFINITY, f64::min);
        let least = if least.is_finite() { least } else { hull.volume };
        // A heavy base holds the robot in place.
        let is_dense = bodies.tree.parent_joint[top].is_some() && mass > DUMMY;
        let (volume, wrong) = if mass / hull.volume > GREATEST && is_dense {
            (hull.volume, "denser than any metal")
        } else if mass / least < LEAST
            && urdf.moves()
            && diagonal(hull.corners.iter().copied()) <= longest
        {
            (least, "lighter than foam")
        } else {
            continue;
        };
        let message = format!(
            "{} kg in {} litres are {} kg/m³, {wrong}; write the mass that the part has, in kilograms, and its shapes in \
            metres",
            number(mass, 3),
            number(volume * 1000.0, 3),
            number(mass / volume, 3)
        );
        let size = |link: &usize| mass_of(*link).unwrap_or(0.0);
        let heaviest = bodies.members(top).max_by(|a, b| size(a).total_cmp(&size(b)));
        urdf.at(urdf.inertial(heaviest.unwrap_or(top), "mass"), message).report(findings);
    }
    Some(())
}
