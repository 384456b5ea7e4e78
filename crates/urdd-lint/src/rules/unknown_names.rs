use std::collections::HashMap;

use super::prelude::*;
use crate::vocabulary::fits;

declare_lint! {
    /// An element or attribute of URDF is in a place where no program looks.
    ///
    /// Programs ignore it without a word: a `<mass>` directly in `<link>` is 0 kg for Pinocchio, 1 kg for PyBullet, and
    /// for MuJoCo what the volume gives.
    ///
    /// Move it to the element that it belongs to. An `<origin>` of zeros, or `rpy="0 0 0"`, changes nothing anywhere, and is
    /// left out.
    LNT046 "misplaced", Warning, Format, since "1.1.0" => misplaced;

    /// An element or attribute is misspelt.
    ///
    /// Most programs ignore what they do not know, and have a robot without it, or none.
    ///
    /// What other rules find because of it, such as a missing limit, is told here and not by itself; it is then as severe.
    ///
    /// Write the name that is meant.
    LNT040 "misspelt", Warning, Format, since "1.1.0" => misspelt;

    /// An element or attribute is neither URDF's nor that of an extension that several programs know.
    ///
    /// Programs ignore it, but the one that it is for.
    ///
    /// Nothing needs to be done where that program is known. A prefix says whose it is: `<isaac:dont_collapse>`.
    LNT047 "unknown-element-or-attribute", Info, Format, since "1.1.0", off by default => unknown_element_or_attribute
}

fn misplaced(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for one in urdf.unknown() {
        if one.meant.is_some() || one.belongs.is_empty() || is_zero(one.node, one.what) {
            continue;
        }
        let places = format!("`<{}>`", one.belongs.join(">` or `<"));
        let message = match one.what {
            What::Element => format!("programs ignore this element here; it belongs in {places}"),
            What::Attribute(name) => {
                format!("programs ignore the attribute `{name}` here; it belongs to {places}")
            }
        };
        urdf.at_unknown(one, message).report(findings);
    }
    Some(())
}

/// Whether it says only what holds without it: numbers that are all 0.
fn is_zero(node: Node, what: What) -> bool {
    let zeros = |text: &str| {
        let mut words = text.split_ascii_whitespace();
        words.all(|word| word.parse() == Ok(0.0))
    };
    match what {
        What::Element => {
            let is_empty = !node.children().any(|child| child.is_element());
            let mut attributes = node.attributes();
            is_empty && attributes.len() > 0 && attributes.all(|one| zeros(one.value()))
        }
        What::Attribute(name) => node.attribute(name).is_some_and(zeros),
    }
}

fn misspelt(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    // Two attributes of one name are no XML.
    let mut meant_so: HashMap<_, usize> = HashMap::new();
    for one in urdf.unknown().iter().filter(|one| matches!(one.what, What::Attribute(_))) {
        *meant_so.entry((one.node.id(), one.meant)).or_default() += 1;
    }
    for one in urdf.unknown() {
        let Some(meant) = one.meant else { continue };
        let (message, attribute) = match one.what {
            What::Element => (format!("programs ignore this element; write `<{meant}>`"), None),
            What::Attribute(name) => {
                let message = format!("programs ignore the attribute `{name}`; write `{meant}`");
                (message, one.node.attribute_node(name))
            }
        };
        let fix = attribute.filter(|attribute| {
            let has_one_meaning = one.is_only
                && meant_so[&(one.node.id(), Some(meant))] == 1
                && !one.node.has_attribute(meant);
            has_one_meaning && fits(meant, attribute.value())
        });
        let fix = fix.map(|attribute| {
            let range = attribute.range_qname();
            urdf.fix(format!("write `{meant}`"), range, meant.to_owned())
        });
        urdf.at_unknown(one, message).fix(fix).report(findings);
    }
    Some(())
}

fn unknown_element_or_attribute(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let unknown = urdf.unknown().iter();
    for one in unknown.filter(|one| one.meant.is_none() && one.belongs.is_empty()) {
        let what = match one.what {
            What::Element => "this element".to_owned(),
            What::Attribute(name) => format!("the attribute `{name}`"),
        };
        let message =
            format!("URDF does not define {what}; programs that do not know it ignore it");
        urdf.at_unknown(one, message).report(findings);
    }
    Some(())
}
