use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;

declare_rule! {
    /// A link or joint of a part is not called as the part calls it, with the part's prefix.
    ///
    /// Whoever looks for a link of a part puts the prefix before its name. Under another name it is not
    /// found, or another link is.
    ///
    /// Write the name that the link or joint has in the part, and the prefix that all its names have.
    CMP004 "composition-renamed-otherwise", Error, clause "6.6.4", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND, Passed(CMP001), Passed(CMP003)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some((module, composition, robot)) = subject(context) else {
        return;
    };
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
            if renamed == *name {
                continue;
            }
            let pointer = format!("/parts/{place}/{key}/{idx}/name");
            let message = "prefix and name are not the name in this robot";
            findings.report(
                Finding::at(module.file("module.json"), pointer, message)
                    .expected(format!("`{name}`"))
                    .actual(format!("`{renamed}`")),
            );
        }
    }
}
