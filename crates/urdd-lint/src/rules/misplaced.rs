use super::prelude::*;

declare_lint! {
    /// An element or attribute of URDF is in a place where no program looks.
    ///
    /// Programs ignore it without a word: a `<mass>` directly in `<link>` is 0 kg for Pinocchio, 1 kg for PyBullet, and
    /// for MuJoCo what the volume gives.
    ///
    /// Move it to the element that it belongs to. An `<origin>` of zeros, or `rpy="0 0 0"`, changes nothing anywhere, and is
    /// left out.
    LNT046 "misplaced", Warning, Format, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for Unknown { node, what, meant, belongs, .. } in urdf.unknown().iter().cloned() {
        if meant.is_some() || belongs.is_empty() || is_zero(node, what) {
            continue;
        }
        let places = format!("`<{}>`", belongs.join(">` or `<"));
        match what {
            What::Element => {
                let message = format!("programs ignore this element here; it belongs in {places}");
                urdf.at(node, message)
            }
            What::Attribute(name) => {
                let message =
                    format!("programs ignore the attribute `{name}` here; it belongs to {places}");
                urdf.at_attribute(node, name, message)
            }
        }
        .report(findings);
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
