use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// `links_in_chain` does not hold the links of `urdf_module`, in their order.
    ///
    /// Everything in a URDD that is indexed by link counts on this one order. An entry that is
    /// missing or out of place gives every link after it the neighbours and meshes of another.
    ///
    /// Write one entry for every link of `urdf_module`, in its order, with its name and its index. If
    /// the robot has changed since, write `chain_module` and what depends on it again.
    CHN001 "chain-link-wrong", Error, clause "6.3.1", since "0.1.0",
    phase References, needs [Module(Kind::Chain), ROBOT_SOUND],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(chain), Some(module)) = (
        context.robot(),
        context.chain(),
        context.module(ModuleKind::Chain),
    ) else {
        return;
    };
    let file = module.file("module.json");
    if chain.links.len() != robot.links.len() {
        findings.report(
            Finding::at(
                &file,
                "/links_in_chain",
                "one entry per link of urdf_module is needed",
            )
            .expected(format!("{} links", robot.links.len()))
            .actual(format!("{} links", chain.links.len())),
        );
        return;
    }
    for (index, (link, right)) in chain.links.iter().zip(&robot.links).enumerate() {
        if link.name != right.name {
            findings.report(
                Finding::at(
                    &file,
                    format!("/links_in_chain/{index}/name"),
                    format!("this is not the name of link {index} of urdf_module"),
                )
                .expected(format!("{:?}", right.name))
                .actual(format!("{:?}", link.name)),
            );
        }
        if link.link_idx.get() != index {
            findings.report(
                Finding::at(
                    &file,
                    format!("/links_in_chain/{index}/link_idx"),
                    "`link_idx` is not the link's place in this list",
                )
                .expected(index)
                .actual(link.link_idx),
            );
        }
    }
}
