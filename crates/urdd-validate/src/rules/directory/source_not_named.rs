use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::root::EntryKind;

declare_rule! {
    /// The root folder holds a URDF, and `source` is null.
    ///
    /// The modules are held to the URDF that `source` names. With null there, nothing is held to it:
    /// the robot in the modules may be another one than that of the URDF beside them.
    ///
    /// Name the URDF as the source, with its size and SHA-256; or move it out of the folder, where the
    /// URDD was not made from it.
    DIR029 "source-not-named", Warning, clause "2.12", since "0.2.0",
    phase Files, needs [Version1, RootMetadata],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    if context
        .metadata()
        .is_none_or(|metadata| metadata.source.is_some())
    {
        return;
    }
    let is_urdf = |path: &str| {
        let extension = path.rsplit_once('.').map(|(_, extension)| extension);
        !path.contains('/') && extension.is_some_and(|it| it.eq_ignore_ascii_case("urdf"))
    };
    let entries = context.listing().entries.iter();
    let mut urdfs = entries.filter(|entry| entry.kind == EntryKind::File && is_urdf(&entry.path));
    let Some(urdf) = urdfs.next() else {
        return;
    };
    findings.report(
        Finding::at(
            ROOT_METADATA,
            "/source",
            format!(
                "`{}` is in the root folder, but no source is named, so the modules were not compared with it: name it as the source",
                urdf.path
            ),
        )
        .expected(format!("{{\"Urdf\": {{\"path\": \"{}\", …}}}}", urdf.path))
        .actual("null"),
    );
}
