use crate::rules::prelude::*;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    // With the robot of the carried URDF, urdf_module may be missing.
    let Some(module) = context.module(Kind::Urdf) else {
        return Some(());
    };
    let folder = context.root().folder_name();
    if folder != robot.name {
        let message = "the robot's name differs from that of its folder, which mesh paths use";
        finding_in(module, "/name", message)
            .values(format!("{folder:?} (the folder)"), format!("{:?}", robot.name))
            .report(findings);
    }
    Some(())
}
