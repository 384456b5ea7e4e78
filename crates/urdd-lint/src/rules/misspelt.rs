use std::collections::HashMap;

use super::prelude::*;
use crate::vocabulary::fits;

declare_lint! {
    /// An element or attribute is misspelt.
    ///
    /// Most programs ignore what they do not know: with `<limits>` for `<limit>` MuJoCo has a joint without limits, and
    /// Pinocchio and PyBullet refuse the robot; with `uper` for `upper` Pinocchio's joint goes from -1 to 0.
    ///
    /// What other rules find because of it, such as a missing limit, is told here and not by itself; it is then as severe.
    ///
    /// Write the name that is meant.
    LNT040 "misspelt", Warning, Format, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    // Two attributes of one name are no XML.
    let mut meant_so: HashMap<_, usize> = HashMap::new();
    for one in urdf.unknown().iter().filter(|one| matches!(one.what, What::Attribute(_))) {
        *meant_so.entry((one.node.id(), one.meant)).or_default() += 1;
    }
    for Unknown { node, what, meant, is_only, .. } in urdf.unknown().iter().cloned() {
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
                let has_one_meaning = is_only
                    && meant_so[&(node.id(), Some(meant))] == 1
                    && !node.has_attribute(meant);
                let attribute = node
                    .attribute_node(name)
                    .filter(|attribute| has_one_meaning && fits(meant, attribute.value()));
                let fix = attribute.map(|attribute| {
                    let range = attribute.range_qname();
                    urdf.fix(format!("write `{meant}`"), range, meant.to_owned())
                });
                urdf.at_attribute(node, name, message).fix(fix).report(findings);
            }
        }
    }
    Some(())
}
