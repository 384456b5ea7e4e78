use crate::rule::declare_lint;
use crate::subject::Subject;
use crate::unknown::{Unknown, What};
use urdd_validate::finding::Findings;

declare_lint! {
    /// An element or attribute is misspelt.
    ///
    /// Most programs ignore what they do not know: with `<limits>` for `<limit>` MuJoCo has a joint without limits, and
    /// Pinocchio and PyBullet refuse the robot; with `uper` for `upper` Pinocchio's joint goes from -1 to 0.
    ///
    /// Write the name that is meant.
    LNT040 "misspelt", Warning, Format, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for Unknown {
        node, what, meant, ..
    } in urdf.unknown()
    {
        let Some(meant) = meant else {
            continue;
        };
        match what {
            What::Element => {
                let message = format!("programs ignore this element; write `<{meant}>`");
                urdf.at(node, message).report(findings);
            }
            What::Attribute(name) => {
                let message = format!("programs ignore the attribute `{name}`; write `{meant}`");
                let mut finding = urdf.at_attribute(node, name, message);
                let range = node
                    .attribute_node(name)
                    .map(|attribute| attribute.range_qname());
                if let (Some(range), false) = (range, node.has_attribute(meant)) {
                    let fix = urdf.fix(format!("write `{meant}`"), range, meant.to_owned());
                    finding = finding.fix(fix);
                }
                finding.report(findings);
            }
        }
    }
    Some(())
}
