use super::walk::path_fault;
use crate::rules::prelude::*;

declare_rule! {
    /// A path of `root_paths` is not the path from the root to its link.
    ///
    /// Every other path is cut from these, and they say which joints move a link: a wrong one gives wrong
    /// Jacobians and wrong paths for every pair that the link belongs to.
    ///
    /// `links` begins with the root and ends with the link itself; `joints` are those between them, one
    /// fewer. For the root: itself alone, and no joint.
    CON002 "root-path-wrong", Error, clause "6.4.2", since "0.1.0",
    phase References, needs [Version1, Passed(CON001), ModuleV1(Kind::Connections)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let tree = context.tree()?;
    let connections = document!(context, Connections)?;
    let mut fold = Fold::new(findings);
    let paths = connections.root_paths.iter().zip(&robot.links);
    for (to, (path, link)) in paths.enumerate() {
        if let Some((place, right, written)) = path_fault(tree, [tree.root, tree.root, to], path) {
            fold.add(|| {
                let pointer = format!("/root_paths/{to}{place}");
                let message =
                    format!("this is not the path from the root to link {to} ({:?})", link.name);
                finding_in(Kind::Connections, pointer, message).values(right, written)
            });
        }
    }
    Some(())
}
