use crate::rules::prelude::*;

declare_rule! {
    /// A path is not one that a URDD may name.
    ///
    /// Paths are relative to the URDD's root, with forward slashes, and have no empty part, no `.` or
    /// `..`, no backslash, colon or control character: only such a path means the same on every
    /// system, stays right when the URDD is moved, and cannot lead a reader out of it. An absolute
    /// path is right on one machine only.
    ///
    /// Write the path from the URDD's root, such as
    /// `mesh_modules/plain_meshes_module/meshes/stl/0_base.stl`.
    DIR015 "bad-path", Error, clause "2.8", since "0.1.0",
    phase References, needs [Version1],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for path in paths::all(context) {
        if !path.from_parent()
            && let Err(fault) = path::check(path.path)
        {
            Finding::at(path.file(), path.pointer.clone(), fault.to_string())
                .values("a path relative to the URDD's root", format!("{:?}", path.path))
                .report(findings);
        }
    }
    Some(())
}
