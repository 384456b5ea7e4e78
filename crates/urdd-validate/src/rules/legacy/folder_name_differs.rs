use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// The folder of a URDD from before version 1 does not have its robot's name.
    ///
    /// Programs of that time find a robot by its folder's name, and mesh paths begin with it. A program
    /// that uses the name in the URDF looks in the wrong place. This is so in many published URDDs.
    ///
    /// Use the folder's name, not the robot's. In version 1 the folder may have any name, and
    /// `robot_name` of `urdd.json` says the robot's.
    LEG003 "folder-name-differs", Info, clause "10.2", since "0.1.0",
    phase References, needs [Legacy, Module(Kind::Urdf)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(module)) = (context.robot(), context.module(ModuleKind::Urdf)) else {
        return;
    };
    let folder = context.root().folder_name();
    if folder != robot.name {
        findings.report(
            Finding::at(
                module.file("module.json"),
                "/name",
                "the robot has another name than its folder, which is what mesh paths go by",
            )
            .expected(format!("{folder:?} (the folder)"))
            .actual(format!("{:?}", robot.name)),
        );
    }
}
