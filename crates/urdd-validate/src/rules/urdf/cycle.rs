use crate::rules::prelude::*;
use crate::urdf_text::compare::first_names;

declare_rule! {
    /// Joints connect links in a circle.
    ///
    /// A URDF is a tree: from every link, going from parent to parent ends at the root. Links in a
    /// circle, and the links below them, have no pose. A program that walks the tree may never end.
    ///
    /// Swap parent and child of one of the joints, or remove the joint, in the URDF. Then write the URDD
    /// again.
    URD006 "links-in-a-circle", Error, clause "6.1.4", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD005)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    for circle in circles(&parents(robot)) {
        let links = circle.iter().filter_map(|link| robot.links.get(*link));
        let names: Vec<&str> = links.map(|link| link.name.as_str()).collect();
        let message = format!(
            "{} form a cycle, each the child of the next: remove one of their joints, or swap its parent and child",
            first_names(&names)
        );
        Finding::at(&file, format!("/links/{}", circle.first()?), message)
            .expected("a path from every link to the root")
            .actual(format!("a cycle of {} links", circle.len()))
            .report(findings);
    }
    Some(())
}

/// The parent link of each link.
fn parents(robot: &Robot) -> Vec<Option<usize>> {
    let mut parents = vec![None; robot.links.len()];
    for joint in &robot.joints {
        if let (Some(parent), Some(child)) = (robot.link(&joint.parent), robot.link(&joint.child))
            && let Some(slot) = parents.get_mut(child)
        {
            *slot = Some(parent);
        }
    }
    parents
}

/// The circles of a map, each starting at its lowest member.
pub fn circles(next: &[Option<usize>]) -> Vec<Vec<usize>> {
    // The walk that first reached each member.
    let mut walk_of: Vec<Option<usize>> = vec![None; next.len()];
    let mut circles = Vec::new();
    for start in 0..next.len() {
        let mut at = start;
        let closes = loop {
            match walk_of.get_mut(at) {
                Some(walk @ None) => *walk = Some(start),
                Some(Some(walk)) => break *walk == start,
                None => break false,
            }
            match next.get(at).copied().flatten() {
                Some(then) => at = then,
                None => break false,
            }
        };
        if closes {
            // Starts are ascending, but a walk may enter a circle anywhere.
            let mut circle = vec![at];
            while let Some(then) = circle.last().and_then(|last| next.get(*last).copied().flatten())
                && then != at
            {
                circle.push(then);
            }
            let lowest = circle.iter().enumerate().min_by_key(|(_, member)| **member);
            let place = lowest.map_or(0, |(place, _)| place);
            circle.rotate_left(place);
            circles.push(circle);
        }
    }
    circles
}
