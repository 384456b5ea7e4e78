use super::prelude::*;
use urdd_format::report::Fix;

declare_lint! {
    /// A collision shape has a size of 0 or less.
    ///
    /// Programs that load the robot have a shape that nothing touches. A visual of size 0 draws nothing, and is no finding.
    ///
    /// Write the size in metres, or remove the collision.
    LNT033 "size-not-positive", Error, Collisions, since "1.1.0" => size_not_positive;

    /// A body is drawn, and nothing can collide with it.
    ///
    /// It falls through the floor in simulators, and planners move through it. MoveIt warns: `Link X has visual geometry but no
    /// collision geometry`. Links that fixed joints hold together count as one body; bodies under 10 cm, and robots
    /// without any collision, are left out.
    ///
    /// Add a `<collision>`: a box or cylinder is often enough.
    LNT020 "visual-without-collision", Info, Collisions, since "1.1.0", off by default => visual_without_collision;

    /// The visuals and the collisions of a link are the same, but in different places or in different units.
    ///
    /// Boxes around both have the same three lengths to 5 %, and are apart; or one is 10, 25.4, 100 or 1000 times as large as
    /// the other. Contacts then happen where nothing is seen.
    ///
    /// Give both the same `<origin>` and `scale`.
    LNT021 "visual-and-collision-apart", Warning, Collisions, since "1.1.0" => visual_and_collision_apart;

    /// A number of a colour is below 0 or above 1.
    ///
    /// Programs leave the colour out, or show white; yourdfpy stops. Mostly these are 0 to 255.
    ///
    /// Divide by 255.
    LNT048 "color-out-of-range", Warning, Appearance, since "1.1.0" => color_out_of_range
}

fn size_not_positive(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for link in &urdf.links {
        let geometries =
            named(*link, "collision").filter_map(|collision| child(collision, "geometry"));
        for (name, shape) in geometries.flat_map(children) {
            let length = |name| number(shape, name).unwrap_or(f64::INFINITY);
            let least = match name {
                "box" => {
                    numbers::<3>(shape, "size").map_or(f64::INFINITY, |[x, y, z]| x.min(y).min(z))
                }
                "sphere" => length("radius"),
                "cylinder" | "capsule" => length("radius").min(length("length")),
                _ => continue,
            };
            if least <= 0.0 {
                let message = format!(
                    "the {name} has a size of {least}; write the size in metres, or remove the collision"
                );
                urdf.at(shape, message).report(findings);
            }
        }
    }
    Some(())
}

/// Smaller bodies are screws and finger tips, m.
const SMALL: f64 = 0.1;

fn visual_without_collision(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    let collides = |link: usize| !robot.links[link].collision.is_empty();
    if !(0..robot.links.len()).any(collides) {
        return Some(());
    }
    for (&top, body) in &geometry.bodies {
        if robot.links[top].name == "world" || bodies.members(top).any(collides) {
            continue;
        }
        let visuals = body.shapes.iter().filter(|shape| shape.kind == GeometryKind::Visual);
        let size = diagonal(visuals.flat_map(|shape| shape.corners()));
        if size >= SMALL {
            let message = format!(
                "this is drawn {} long, and nothing can collide with it; add a `<collision>`",
                metres(size)
            );
            let mut members = bodies.members(top);
            let drawn = members.find(|link| !robot.links[*link].visual.is_empty());
            urdf.at(urdf.links[drawn.unwrap_or(top)], message).report(findings);
        }
    }
    Some(())
}

/// Lengths are the same to this part.
const SAME: f64 = 0.05;
/// How far the centres may be apart, as a part of the diagonal.
const APART: f64 = 0.2;
/// Ratios of units, and to which part.
const UNITS: [f64; 4] = [10.0, 25.4, 100.0, 1000.0];
const CLOSE: f64 = 0.03;

fn visual_and_collision_apart(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let geometry = urdf.geometry(findings)?;
    for (index, link) in
        geometry.links.iter().enumerate().filter(|(_, link)| !link.is_partial && !link.is_turned())
    {
        let visual = bounds(link.corners_of(GeometryKind::Visual));
        let collision = bounds(link.corners_of(GeometryKind::Collision));
        let Some(((a, b), (c, d))) = visual.zip(collision) else { continue };
        let (visual, collision) = (b - a, d - c);
        let (seen, solid) = (visual.norm(), collision.norm());
        if seen.min(solid) <= 0.0 {
            continue;
        }
        let ratio = seen.max(solid) / seen.min(solid);
        let apart = ((a + b - c - d) / 2.0).norm();
        let message = if is_same(&visual, &collision) && apart > APART * seen.max(solid) {
            format!(
                "visuals and collisions have the same size, but are {} apart; put both in the same place",
                metres(apart)
            )
        } else if UNITS.iter().any(|unit| (ratio / unit - 1.0).abs() < CLOSE) {
            format!(
                "the visuals are {} long and the collisions {}; give both the same scale",
                metres(seen),
                metres(solid)
            )
        } else {
            continue;
        };
        urdf.at(urdf.links[index], message).report(findings);
    }
    Some(())
}

fn is_same(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    let sorted = |lengths: &Vector3<f64>| {
        let mut sorted = [lengths.x, lengths.y, lengths.z];
        sorted.sort_by(f64::total_cmp);
        sorted
    };
    let pairs = sorted(a).into_iter().zip(sorted(b));
    pairs.into_iter().all(|(a, b)| (a - b).abs() <= SAME * a.max(b))
}

/// A rounded 1.
const MOST: f64 = 1.001;
const BYTE: f64 = 255.0;

fn color_out_of_range(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let colors = urdf.root.descendants().filter(|node| node.tag_name().name() == "color");
    for color in colors {
        let Some(rgba) = numbers::<4>(color, "rgba") else { continue };
        if rgba.iter().all(|value| (0.0..=MOST).contains(value)) {
            continue;
        }
        let message = "the colour is not red, green, blue and opacity from 0 to 1; divide by 255";
        let is_bytes = rgba.iter().all(|value| (0.0..=BYTE).contains(value));
        let fix = urdf.value(color, "rgba").filter(|_| is_bytes).map(|range| {
            // An opacity of 1 beside bytes may be either.
            let [r, g, b, a] = rgba;
            let a = if a <= MOST { a } else { a / BYTE };
            let mended = [r / BYTE, g / BYTE, b / BYTE, a].map(|value| format!("{value}"));
            let fix = urdf.fix("divide the colour by 255", range, mended.join(" "));
            Fix { is_safe: false, ..fix }
        });
        urdf.at_attribute(color, "rgba", message).fix(fix).report(findings);
    }
    Some(())
}
