use crate::rules::prelude::*;
use urdd_document::mesh_files::{Absence, MeshFiles};
use urdd_document::meshes::MeshFormat;

declare_rule! {
    /// A mesh module names a file that is not there.
    ///
    /// Whoever loads the robot fails at this file, or shows the robot without the link. Often the
    /// file was not committed (see `.gitignore`), or was renamed by hand. In a legacy URDD the path
    /// is relative to the folder *above* the URDD and may lead into a URDD beside it: then that one
    /// must be there too, under its old name.
    ///
    /// Put the file back, or write the module again. DIR011 reports files that `urdd.json` lists
    /// and that do not exist.
    MSH002 "mesh-file-missing", Error, clause "7.1", since "0.1.0",
    phase References, needs [MESHES, NoneFailed(&[MSH003, MSH009, MSH012])], check mesh_file_missing,

    /// A derived mesh file is not named after its link.
    ///
    /// Derived files lie in `meshes/<stl|obj|glb>/` of their module and are named by link index and
    /// link name, `3_left_finger.stl`, pieces `3_left_finger/0.stl`. So no two links can ever write to
    /// one file, names are safe on every file system, and a person sees which link a file is of.
    ///
    /// Name the file as SPEC 7.3 says, and the path with it.
    MSH006 "mesh-file-name", Error, clause "7.3", since "0.1.0",
    phase References, consequence Format, needs [
        Version1, Module(Kind::Urdf), DERIVED_MESHES, MESHES_LISTED, NoneFailed(&[MSH002, MSH005, DIR015, URD007, CHN001, URD002]),
        // A list that is displaced has the wrong names too.
        NotFailed(MSH004),
    ], check mesh_file_name,
}

fn mesh_file_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    // DIR011 reports a file that is listed and missing.
    let listed = context.metadata().map(listed_files).unwrap_or_default();
    let mut files = MeshFiles::new(context);
    let mut no_siblings: BTreeMap<String, (usize, Finding)> = BTreeMap::new();
    for module in MESH_MODULES.iter().filter_map(|kind| context.module(*kind)) {
        for named in paths::of_module(module) {
            let (path, pointer) = (named.path, named.pointer.clone());
            let profile = if named.from_parent() { Profile::Legacy } else { Profile::V1 };
            if named.is_reference || (profile == Profile::V1 && listed.contains(path)) {
                continue;
            }
            match files.find(profile, path) {
                Ok(()) | Err(Absence::Other(_)) => {}
                Err(Absence::Missing) => {
                    let message =
                        format!("`{path}` is missing: restore the file, or write the module again");
                    finding_in(module, pointer, message).values("a file", "none").report(findings);
                }
                // A missing sibling URDD is one mistake, however many paths lead there.
                Err(Absence::NoSibling(name)) => {
                    let entry = no_siblings.entry(name).or_insert_with_key(|name| {
                        (0, finding_in(module, pointer, no_sibling(context, name)))
                    });
                    entry.0 += 1;
                }
            }
        }
    }
    for (name, (count, finding)) in no_siblings {
        let expected = format!("a URDD in the folder `{name}` beside this one");
        findings.report(finding.values(expected, "none").count(count));
    }
    Some(())
}

fn no_sibling(context: &Context, name: &str) -> String {
    let own = context.root().folder_name();
    let renamed = if context.listing().has_folder("mesh_modules") {
        format!("; or, if this URDD's folder `{own}` was `{name}` before, rename it back")
    } else {
        String::new()
    };
    format!(
        "mesh paths lead into a URDD `{name}` in the folder above this one, which does not exist: put it there{renamed}"
    )
}

/// Maximum length of a slug, characters.
const MAX_SLUG: usize = 64;

fn mesh_file_name(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    for (kind, module, meshes) in context.mesh_modules(DERIVED) {
        if meshes.profile != Profile::V1 {
            continue;
        }
        for (link, named) in robot.links.iter().enumerate() {
            let stem = format!("{link}_{}", slug(&named.name));
            let pieces = meshes.of_link(link).enumerate();
            for (piece, path) in pieces.flat_map(|(i, mesh)| mesh.paths.iter().map(move |p| (i, p)))
            {
                let expected = path.format.map(|format| expected_path(kind, format, &stem, piece));
                if let Some(expected) = expected.filter(|expected| path.path != expected) {
                    let label = context.link_label(link);
                    let message = format!("the file of {label} is not named after it");
                    finding_in(module, &path.pointer, message)
                        .values(format!("`{expected}`"), format!("`{}`", path.path))
                        .report(findings);
                }
            }
        }
    }
    Some(())
}

/// Path of a derived file (SPEC 7.3).
fn expected_path(kind: Kind, format: MeshFormat, stem: &str, piece: usize) -> String {
    let extension = format.extension();
    let folder = format!("{}/meshes/{extension}", kind.folder());
    match kind {
        Kind::ConvexDecompositionMeshes => format!("{folder}/{stem}/{piece}.{extension}"),
        _ => format!("{folder}/{stem}.{extension}"),
    }
}

/// A link's name as part of a file name (SPEC 7.3).
pub fn slug(name: &str) -> String {
    let mut slug = String::new();
    let mut replaced = false;
    for character in name.chars() {
        if character.is_ascii_alphanumeric() || character == '-' || character == '_' {
            slug.push(character);
            replaced = false;
        } else if !replaced {
            slug.push('_');
            replaced = true;
        }
    }
    slug.truncate(MAX_SLUG);
    if slug.is_empty() {
        slug.push_str("link");
    }
    slug
}
