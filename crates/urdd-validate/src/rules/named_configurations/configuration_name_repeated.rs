use crate::rules::prelude::*;
use crate::views::repeated::repeated;

declare_rule! {
    /// Two named configurations have the same name.
    ///
    /// A program that asks for `home` moves the robot to one of the two, and another program to the other.
    ///
    /// Rename one of them, or remove it: `urdd configurations remove` and `urdd configurations set`.
    CNF001 "configuration-name-repeated", Error, clause "6.7.2", since "1.0.0",
    phase References, needs [ModuleV1(Kind::NamedConfigurations)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let named = document!(context, NamedConfigurations)?;
    let names = named.configurations.iter().map(|one| one.name.as_str());
    for (index, first, name) in repeated(names) {
        let pointer = format!("/configurations/{index}/name");
        finding_in(Kind::NamedConfigurations, pointer, "another configuration has this name")
            .values("each name once", format!("`{name}`, as configuration {first}"))
            .report(findings);
    }
    Some(())
}
