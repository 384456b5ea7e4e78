use crate::rules::prelude::*;

declare_rule! {
    /// `urdd.json` and `urdf_module` name different robots.
    ///
    /// `robot_name` is what a collection of URDDs is searched by; it must be the name that the robot
    /// has in its URDF.
    ///
    /// Write `name` of `urdf_module` as `robot_name`.
    DIR020 "robot-name-differs", Error, clause "2.11", since "0.1.0",
    phase References, needs [Version1, RootMetadata, Module(Kind::Urdf)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let stated = &context.metadata()?.robot_name;
    let name = &context.robot()?.name;
    // If the carried URDF agrees with urdd.json, urdf_module is wrong, and URD013 reports it.
    let carried = context.urdf().ok().and_then(|urdf| {
        let document = urdd_xml::parse(&urdf.text, urdd_xml::Kind::Other).ok()?;
        document.root_element().attribute("name").map(str::to_owned)
    });
    if stated != name && carried.as_ref() != Some(stated) {
        let message = "this is not the name in urdf_module: write that one here";
        Finding::at(ROOT_METADATA, "/robot_name", message).literals(name, stated).report(findings);
    }
    Some(())
}
