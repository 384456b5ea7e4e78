use super::prelude::*;

declare_lint! {
    /// An element or attribute is neither URDF's nor that of an extension that several programs know.
    ///
    /// Programs ignore it, but the one that it is for.
    ///
    /// Nothing needs to be done where that program is known. A prefix says whose it is: `<isaac:dont_collapse>`.
    LNT047 "unknown-element-or-attribute", Info, Format, since "1.1.0", off by default
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for Unknown { node, what, meant, belongs, .. } in urdf.unknown().iter().cloned() {
        if meant.is_some() || !belongs.is_empty() {
            continue;
        }
        match what {
            What::Element => urdf.at(
                node,
                "URDF does not define this element; programs that do not know it ignore it",
            ),
            What::Attribute(name) => {
                let message =
                    format!("URDF does not define the attribute `{name}`; programs that do not know it ignore it");
                urdf.at_attribute(node, name, message)
            }
        }
        .report(findings);
    }
    Some(())
}
