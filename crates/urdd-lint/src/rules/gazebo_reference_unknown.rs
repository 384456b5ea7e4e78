use super::prelude::*;
use crate::vocabulary::Names;

declare_lint! {
    /// A `<gazebo reference>` names neither a link nor a joint.
    ///
    /// Gazebo leaves out its friction, sensors and plugins without a word.
    ///
    /// Write the name of a link or joint.
    LNT044 "gazebo-reference-unknown", Warning, WrongMotion, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let known = Names::new(urdf.names(&urdf.links).chain(urdf.names(&urdf.joints)));
    for (_, node) in children(urdf.root).filter(|(name, _)| *name == "gazebo") {
        let reference = node.attribute("reference").filter(|name| !name.is_empty());
        let Some(reference) = reference.filter(|name| !known.has(name)) else {
            continue;
        };
        let hint = known.hint(reference);
        let message = format!(
            "neither a link nor a joint is called `{reference}`{hint}; write a name that is there"
        );
        urdf.at_attribute(node, "reference", message).report(findings);
    }
    Some(())
}
