use super::prelude::*;
use crate::named_file::NamedFile;

declare_lint! {
    /// A mesh is not there.
    ///
    /// MuJoCo and PyBullet refuse the robot, Pinocchio its geometry. RViz shows nothing at that place, and planners see no
    /// collision. A mesh of a package that is not found is LNT037's, unless a package or folder of a near name has it: write that
    /// name, or rename the folder. A file that is there, outside of the robot's folder and packages, is no finding; its shape is
    /// read with `--allow-folder`.
    ///
    /// Correct the name, or add the file. A relative name is relative to the URDF.
    LNT029 "mesh-not-found", Error, MissingGeometry, since "1.1.0"
}

/// How far up to look for a name that is relative to a folder above the URDF.
const LEVELS: usize = 6;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.meshes(findings)? {
        let Err(missing) = &mesh.file else {
            continue;
        };
        let file = NamedFile { node, name: &mesh.filename };
        // Other rules say these.
        if missing.other_case.is_some()
            || missing.no_package.is_some() && !missing.is_in_near_package()
            || missing.outside.is_some()
            || file.is_absolute()
            || file.is_on_a_host()
        {
            continue;
        }
        let mut above = urdf.folder.ancestors().skip(1).take(LEVELS);
        let is_plain = !mesh.filename.contains("://");
        let above =
            above.find(|folder| is_plain && urdf.files.is_file(&folder.join(&mesh.filename)));
        let near = missing.near_package.as_ref().zip(missing.no_package.as_ref());
        let near = near.map(|(near, package)| near.in_words(package));
        let message = near.unwrap_or_else(|| match above {
            Some(folder) => format!(
                "the file is there only from the folder `{}` above, where few programs look; name it relative to the URDF",
                folder.file_name().unwrap_or_default().to_string_lossy()
            ),
            None if mesh.filename.starts_with("package:///") => {
                "the name has no package, which stands after `package://`; write it".to_owned()
            }
            None => "the file is not there; correct the name, or add the file".to_owned(),
        });
        urdf.at_attribute(node, "filename", message).actual(&mesh.filename).report(findings);
    }
    Some(())
}
