use crate::rules::prelude::*;

declare_rule! {
    /// A link is the child of two joints.
    ///
    /// A URDF is a tree. A link with two parents would have two poses; readers take one of them, or
    /// refuse. Closed chains (parallel grippers, delta robots) cannot be written this way.
    ///
    /// Keep one of the joints in the URDF. Write the other as a constraint, in an element for the
    /// program that solves it (`<gazebo>`, `<loop_joint>`). Then write the URDD again.
    URD005 "link-with-two-parents", Error, clause "6.1.4", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD003), Passed(URD007)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    let mut held_by: HashMap<&str, (usize, &str)> = HashMap::new();
    for (index, joint) in robot.joints.iter().enumerate() {
        let link = &joint.child;
        let (first, other) = *held_by.entry(link).or_insert((index, &joint.name));
        if first != index {
            let message = format!(
                "link `{link}` is the child of joint `{}` and of joint `{other}`; a link has one parent",
                joint.name
            );
            Finding::at(&file, format!("/joints/{index}/child/link"), message)
                .expected("a link that no other joint has as its child")
                .actual(format!("`{link}`, child of /joints/{first} too"))
                .report(findings);
        }
    }
    Some(())
}
