use super::prelude::*;

declare_lint! {
    /// A body is drawn, and nothing can collide with it.
    ///
    /// It falls through the floor in simulators, and planners move through it. MoveIt warns: `Link X has visual geometry but no
    /// collision geometry`. Links that fixed joints hold together count as one body; bodies under 10 cm, and robots
    /// without any collision, are left out.
    ///
    /// Add a `<collision>`: a box or cylinder is often enough.
    LNT020 "visual-without-collision", Info, Collisions, since "1.1.0", off by default
}

/// Smaller bodies are screws and finger tips, m.
const SMALL: f64 = 0.1;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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
