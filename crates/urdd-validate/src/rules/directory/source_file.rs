use std::path::Path;

use crate::rules::prelude::*;
use urdd_directory::file_type::FileType;
use urdd_format::root_metadata::Source;

declare_rule! {
    /// The source URDF is in a folder below the root.
    ///
    /// It must lie in the root folder itself: there people and programs look for the one URDF that a
    /// URDD was made from, and there no module's folder can claim it.
    ///
    /// Move it next to `urdd.json`, and change `source` to its new path.
    DIR028 "source-not-in-root", Error, clause "2.12", since "0.2.0",
    phase Files, needs [Version1, RootMetadata], check source_not_in_root,

    /// The root folder holds a URDF, and `source` is null.
    ///
    /// The modules are compared with the URDF that `source` names. With null there, they are compared
    /// with nothing: the robot in the modules may be another one than that of the URDF beside them.
    ///
    /// Name the URDF as the source, with its size and SHA-256; or move it out of the folder, where the
    /// URDD was not made from it.
    DIR029 "source-not-named", Warning, clause "2.12", since "0.2.0",
    phase Files, needs [Version1, RootMetadata], check source_not_named,

    /// `urdd.json` and `urdf_module` name different robots.
    ///
    /// `robot_name` is what a collection of URDDs is searched by; it must be the name that the robot
    /// has in its URDF.
    ///
    /// Write `name` of `urdf_module` as `robot_name`.
    DIR020 "robot-name-differs", Error, clause "2.11", since "0.1.0",
    phase References, needs [Version1, RootMetadata, Module(Kind::Urdf)], check robot_name_differs,
}

fn source_not_in_root(context: &Context, findings: &mut Findings) -> Option<()> {
    // DIR015 reports an invalid path.
    if let Some(Source::Urdf(file)) = &context.metadata()?.source
        && path::check(&file.path).is_ok()
        && file.path.contains('/')
    {
        let message = "the source URDF is not in the root folder: move it there";
        let finding = Finding::at(ROOT_METADATA, "/source/Urdf/path", message);
        findings.report(finding.actual(&file.path));
    }
    Some(())
}

fn source_not_named(context: &Context, findings: &mut Findings) -> Option<()> {
    let is_urdf = |path: &str| !path.contains('/') && FileType::Urdf.is_of(Path::new(path));
    let mut entries = context.listing().entries.iter();
    let urdf = entries.find(|entry| entry.kind == EntryKind::File && is_urdf(&entry.path));
    if let (None, Some(urdf)) = (&context.metadata()?.source, urdf) {
        let path = &urdf.path;
        let message = format!(
            "`{path}` is in the root folder, but no source is named, so the modules were not compared with it: name it as the source"
        );
        Finding::at(ROOT_METADATA, "/source", message)
            .values(format!("{{\"Urdf\": {{\"path\": \"{path}\", …}}}}"), "null")
            .report(findings);
    }
    Some(())
}

fn robot_name_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let stated = &context.metadata()?.robot_name;
    let name = &context.robot()?.name;
    // If the carried URDF agrees with urdd.json, urdf_module is wrong, and URD013 reports it.
    let carried = context.urdf_text().and_then(|urdf| urdf.robot.as_ref());
    if stated != name && carried.is_none_or(|carried| carried.name != *stated) {
        let message = "this is not the name in urdf_module: write that one here";
        Finding::at(ROOT_METADATA, "/robot_name", message).literals(name, stated).report(findings);
    }
    Some(())
}
