use super::prelude::*;

declare_lint! {
    /// The robot is drawn, and no link has a `<collision>`.
    ///
    /// Nothing can collide with it: planners move it through the world and itself, and simulators let it fall through the floor.
    /// MoveIt and Gazebo take no visual elements instead; `urdd generate` does.
    ///
    /// Add a `<collision>` to each link that can touch something: a box or cylinder is often enough.
    LNT065 "no-collision", Info, Collisions, since "1.3.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, _) = urdf.bodies(findings)?;
    if robot.links.iter().any(|link| !link.collision.is_empty()) {
        return Some(());
    }
    let drawn = robot.links.iter().filter(|link| !link.visual.is_empty()).count();
    let first = robot.links.iter().position(|link| !link.visual.is_empty())?;
    let visual = child(urdf.links[first], "visual").unwrap_or(urdf.links[first]);
    let links = if drawn == 1 { "link is" } else { "links are" };
    let message = format!(
        "no link has a `<collision>`, and {drawn} {links} drawn: nothing can collide with the robot; add a `<collision>`"
    );
    urdf.at(visual, message).report(findings);
    Some(())
}
