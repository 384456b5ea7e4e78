use crate::rules::prelude::*;

declare_rule! {
    /// The root folder holds a URDF, and `source` is null.
    ///
    /// The modules are compared with the URDF that `source` names. With null there, they are compared
    /// with nothing: the robot in the modules may be another one than that of the URDF beside them.
    ///
    /// Name the URDF as the source, with its size and SHA-256; or move it out of the folder, where the
    /// URDD was not made from it.
    DIR029 "source-not-named", Warning, clause "2.12", since "0.2.0",
    phase Files, needs [Version1, RootMetadata],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let is_urdf = |path: &str| {
        let extension = path.rsplit_once('.').map(|(_, extension)| extension);
        !path.contains('/') && extension.is_some_and(|it| it.eq_ignore_ascii_case("urdf"))
    };
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
