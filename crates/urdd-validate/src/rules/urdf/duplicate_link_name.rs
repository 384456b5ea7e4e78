use std::collections::HashMap;

use crate::rules::prelude::*;

declare_rule! {
    /// Two links have one name.
    ///
    /// Joints, skips and most programs say which link they mean by its name. With two of one name
    /// each reader takes the one it finds first, or last.
    ///
    /// Give every link a different name in the URDF, and write the URDD again.
    URD002 "duplicate-link-name", Error, clause "6.1.3", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    let names = robot.links.iter().map(|link| link.name.as_str());
    for (index, first, name) in repeated(names) {
        let pointer = format!("/links/{index}/name");
        let message =
            format!("another link is already named `{name}`; give this one a name of its own");
        Finding::at(&file, pointer, message)
            .expected("a name that no other link has")
            .actual(format!("`{name}`, the name of /links/{first} too"))
            .report(findings);
    }
    Some(())
}

/// Names that occurred before: index, index of the first occurrence, name.
pub(super) fn repeated<'a>(
    names: impl Iterator<Item = &'a str>,
) -> impl Iterator<Item = (usize, usize, &'a str)> {
    let mut seen: HashMap<&str, usize> = HashMap::new();
    names.enumerate().filter_map(move |(index, name)| {
        let first = *seen.entry(name).or_insert(index);
        (first != index).then_some((index, first, name))
    })
}

#[cfg(test)]
mod tests {
    use super::repeated;

    #[test]
    fn case_makes_another_name() {
        let names = ["a", "A", "", "a", "", "a"];
        let found: Vec<_> = repeated(names.into_iter()).collect();
        assert_eq!(found, [(3, 0, "a"), (4, 2, ""), (5, 0, "a")]);
    }
}
