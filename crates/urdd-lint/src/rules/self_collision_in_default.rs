use std::cell::LazyCell;
use std::collections::{HashMap, HashSet};
use urdd_format::readable::counted;

use nalgebra::Isometry3;

use super::prelude::*;
use crate::geometry::Shape;
use crate::pose::{above as above_joints, at_default, sampled};
use urdd_geometry::convex::across::PlacedPair;
use urdd_geometry::convex::{ConvexShape, penetration};

declare_lint! {
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
    LNT050 "self-collision-in-default", Info, Collisions, since "1.1.0"
}

/// Parts that touch are no finding, m.
const LEAST: f64 = 0.001;
const MANY: usize = 600;
const MANY_PAIRS: usize = 5_000;
/// Sampled configurations of the pair that is named.
const SAMPLES: usize = 100;
/// Maximum number of joints that the samples move.
const MOST_STEPS: usize = 100_000;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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
