use crate::rules::prelude::*;
use urdd_document::meshes::Format;

declare_rule! {
    /// A derived mesh file is not named after its link.
    ///
    /// Derived files lie in `meshes/<stl|obj|glb>/` of their module and are named by link index and
    /// link name, `3_left_finger.stl`, pieces `3_left_finger/0.stl`. So no two links can ever write to
    /// one file, names are safe on every file system, and a person sees which link a file is of.
    ///
    /// Name the file as SPEC 7.3 says, and the path with it.
    MSH006 "mesh-file-name", Error, clause "7.3", since "0.1.0",
    phase References, consequence Format, needs [
        Version1,
        Module(Kind::Urdf),
        DERIVED_MESHES,
        MESHES_LISTED,
        NotFailed(MSH002),
        NotFailed(MSH005),
        NotFailed(DIR015),
        NotFailed(URD007),
        NotFailed(CHN001),
        NotFailed(URD002),
        // A list that is displaced has the wrong names too.
        NotFailed(MSH004),
    ],
}

/// Maximum length of a slug, characters.
const MAX_SLUG: usize = 64;

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
fn expected_path(kind: Kind, format: Format, stem: &str, piece: usize) -> String {
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
