use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::meshes::{DERIVED, Format};
use urdd_format::registry::{ModuleKind, Profile};

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
        AnyModule(&[Kind::PlainMeshes, Kind::ConvexHullMeshes, Kind::ConvexDecompositionMeshes]),
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
    check check,
}

/// Longest slug, characters.
const MAX_SLUG: usize = 64;

fn check(context: &Context, findings: &mut Findings) {
    let Some(robot) = context.robot() else {
        return;
    };
    for kind in DERIVED {
        let (Some(meshes), Some(module)) = (context.meshes(*kind), context.module(*kind)) else {
            continue;
        };
        if meshes.profile != Profile::V1 {
            continue;
        }
        for (link, named) in robot.links.iter().enumerate() {
            let stem = format!("{link}_{}", slug(&named.name));
            for (piece, mesh) in meshes.of_link(link).enumerate() {
                for path in &mesh.paths {
                    let Some(format) = path.format else {
                        continue;
                    };
                    let expected = expected_path(*kind, format, &stem, piece);
                    if path.path != expected {
                        findings.report(
                            Finding::at(
                                module.file("module.json"),
                                &path.pointer,
                                format!(
                                    "the file of {} is not named after it",
                                    context.link_label(link)
                                ),
                            )
                            .expected(format!("`{expected}`"))
                            .actual(format!("`{}`", path.path)),
                        );
                    }
                }
            }
        }
    }
}

/// Path of a derived file (SPEC 7.3).
fn expected_path(kind: ModuleKind, format: Format, stem: &str, piece: usize) -> String {
    let extension = format.extension();
    let folder = format!("{}/meshes/{extension}", kind.folder());
    match kind {
        ModuleKind::ConvexDecompositionMeshes => format!("{folder}/{stem}/{piece}.{extension}"),
        _ => format!("{folder}/{stem}.{extension}"),
    }
}

/// A link's name as a file's name may hold it (SPEC 7.3).
fn slug(name: &str) -> String {
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

#[cfg(test)]
mod tests {
    use super::slug;

    #[test]
    fn names_become_slugs() {
        assert_eq!(slug("base_link-2"), "base_link-2");
        assert_eq!(slug("arm/forearm äö.x"), "arm_forearm_x");
        assert_eq!(slug("_/_"), "___");
        assert_eq!(slug("//"), "_");
        assert_eq!(slug(""), "link");
        assert_eq!(slug(&"x".repeat(80)).len(), 64);
    }
}
