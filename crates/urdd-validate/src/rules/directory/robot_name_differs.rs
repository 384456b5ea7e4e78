use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;

declare_rule! {
    /// `urdd.json` and `urdf_module` name different robots.
    ///
    /// `robot_name` is what a collection of URDDs is searched by; it must be the name that the robot
    /// has in its URDF.
    ///
    /// Write `name` of `urdf_module` as `robot_name`.
    DIR020 "robot-name-differs", Error, clause "2.11", since "0.1.0",
    phase References, needs [Version1, RootMetadata, Module(Kind::Urdf)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(metadata), Some(robot)) = (context.metadata(), context.robot()) else {
        return;
    };
    if metadata.robot_name == robot.name {
        return;
    }
    // Where the carried URDF agrees with urdd.json, it is urdf_module that is wrong, and a rule of
    // its family tells.
    let carried = context.urdf().ok().and_then(|urdf| {
        let document = roxmltree::Document::parse(&urdf.text).ok()?;
        document.root_element().attribute("name").map(str::to_owned)
    });
    if carried.as_deref() == Some(metadata.robot_name.as_str()) {
        return;
    }
    findings.report(
        Finding::at(
            ROOT_METADATA,
            "/robot_name",
            "this is not the name in urdf_module: write that one here",
        )
        .expected(format!("{:?}", robot.name))
        .actual(format!("{:?}", metadata.robot_name)),
    );
}
