use crate::format::registry::ModuleKind;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;
use crate::validate::skip::SkipReason;

/// Up to this many links the explicit tables must be there (SPEC 6.4.6): some 90,000 paths.
const EXPLICIT_UP_TO: usize = 300;

declare_rule! {
    /// `link_to_link_paths` or `link_connection_paths` is null, though the robot has at most 300 links.
    ///
    /// Consumers may count on these tables for robots of usual size, and need no way to make paths of
    /// their own. They are left out only where they would be very large.
    ///
    /// Write both tables; above 300 links they may be null.
    CON006 "explicit-paths-missing", Error, clause "6.4.6", since "0.1.0",
    phase References, needs [Version1, Module(Kind::Urdf), Module(Kind::Connections)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(connections), Some(module)) = (
        context.robot(),
        context.connections().and_then(|connections| connections.v1),
        context.module(ModuleKind::Connections),
    ) else {
        return findings.skip(SkipReason::NotInThisVersion(ModuleKind::Connections));
    };
    let links = robot.links.len();
    if links > EXPLICIT_UP_TO {
        return;
    }
    for (name, missing) in [
        (
            "link_to_link_paths",
            connections.link_to_link_paths.is_none(),
        ),
        (
            "link_connection_paths",
            connections.link_connection_paths.is_none(),
        ),
    ] {
        if missing {
            findings.report(
                Finding::at(
                    module.file("module.json"),
                    format!("/{name}"),
                    format!(
                        "the robot has {links} links: this table is needed up to {EXPLICIT_UP_TO}"
                    ),
                )
                .expected(format!("{links} x {links} paths"))
                .actual("null"),
            );
        }
    }
}
