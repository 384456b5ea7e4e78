use crate::rules::prelude::*;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let chain = context.chain()?;
    let (right, written) = (robot.links.len(), chain.links_in_chain.len());
    if right != written {
        finding_in(Kind::Chain, "/links_in_chain", "one entry per link of urdf_module is needed")
            .counts(right, written, "links")
            .report(findings);
        return Some(());
    }
    for (index, (link, right)) in chain.links_in_chain.iter().zip(&robot.links).enumerate() {
        if link.name != right.name {
            let message = format!("this is not the name of link {index} of urdf_module");
            finding_in(Kind::Chain, format!("/links_in_chain/{index}/name"), message)
                .literals(&right.name, &link.name)
                .report(findings);
        }
        if link.link_idx.get() != index {
            let pointer = format!("/links_in_chain/{index}/link_idx");
            let message = "`link_idx` is not the link's place in this list";
            finding_in(Kind::Chain, pointer, message).values(index, link.link_idx).report(findings);
        }
    }
    Some(())
}
