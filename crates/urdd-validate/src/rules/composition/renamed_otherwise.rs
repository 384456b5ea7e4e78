use crate::rules::prelude::*;

declare_rule! {
    /// The name of a link or joint is not the name in its part, after the part's prefix.
    ///
    /// Whoever looks for a link of a part puts the prefix before its name. Under another name it is not
    /// found, or another link is.
    ///
    /// Write the name that the link or joint has in the part, and the prefix that all its names have.
    CMP004 "composition-renamed-otherwise", Error, clause "6.6.4", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND, Passed(CMP001), Passed(CMP003)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let composition = document!(context, Composition)?;
    let robot = context.robot()?;
    for (place, part) in composition.parts.iter().enumerate() {
        let links = part.links.iter().enumerate().map(|(idx, of)| {
            let name = &robot.links[of.link_idx.get()].name;
            ("links", idx, &of.name, name)
        });
        let joints = part.joints.iter().enumerate().map(|(idx, of)| {
            let name = &robot.joints[of.joint_idx.get()].name;
            ("joints", idx, &of.name, name)
        });
        for (key, idx, own, name) in links.chain(joints) {
            let renamed = format!("{}{own}", part.prefix);
            if renamed != *name {
                let message = "prefix and name are not the name in this robot";
                finding_in(Kind::Composition, format!("/parts/{place}/{key}/{idx}/name"), message)
                    .values(format!("`{name}`"), format!("`{renamed}`"))
                    .report(findings);
            }
        }
    }
    Some(())
}
