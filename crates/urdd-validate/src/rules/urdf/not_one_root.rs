use crate::rules::prelude::*;
use crate::urdf_text::compare::first_names;

declare_rule! {
    /// The robot has several roots, or no link at all.
    ///
    /// The root is the one link that is not the child of a joint; all poses are in its frame. With two
    /// such links the robot is in parts that no joint connects: readers keep one part, or refuse.
    ///
    /// Connect the parts by joints (a fixed one will do) in the URDF, or make each a robot of its
    /// own. Then write the URDD again.
    URD004 "not-one-root", Error, clause "6.1.4", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD005)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    let children: HashSet<usize> =
        (robot.joints.iter()).filter_map(|joint| robot.link(&joint.child)).collect();
    let links = robot.links.iter().enumerate();
    let roots = links.filter(|(index, _)| !children.contains(index));
    let roots: Vec<&str> = roots.map(|(_, link)| link.name.as_str()).collect();
    let (message, actual) = match roots.len() {
        0 if robot.links.is_empty() => ("the robot has no link", "no link".to_owned()),
        // Without a root, all links are in circles: URD006 reports these.
        0 | 1 => return Some(()),
        count => (
            "the links are not one tree: connect these links by joints",
            format!("{count}: {}", first_names(&roots)),
        ),
    };
    Finding::at(file, "/links", message)
        .values("one link that is not the child of a joint", actual)
        .report(findings);
    Some(())
}
