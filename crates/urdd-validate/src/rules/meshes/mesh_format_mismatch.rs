use crate::rules::prelude::*;
use urdd_document::meshes::{Mesh, MeshFormat, Meshes};

declare_rule! {
    /// A mesh is not given in the same formats as the others of its module.
    ///
    /// `stl`, `obj` and `glb` are the same mesh for programs that read different formats. A module may
    /// do without `stl`, or without `obj`, and then has null there for every mesh. Here a file has the
    /// extension of another format, or one mesh has a format that another mesh of the module does not
    /// have; in legacy modules, which have one list per format, a link has more meshes in one format
    /// than in another. Then two programs see two different robots.
    ///
    /// Name a file with the format's own extension in each place, and give every mesh of a module in
    /// the same formats.
    MSH003 "mesh-format-mismatch", Error, clause "7.1", since "0.1.0",
    phase References, needs [DERIVED_MESHES, NotFailed(DIR015), NotFailed(MSH001)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for (kind, module, meshes) in context.mesh_modules(DERIVED) {
        counts(context, &meshes, kind, module, findings);
        formats(context, &meshes, module, findings);
        for (link, mesh) in meshes.paths() {
            let Some(format) = mesh.format else { continue };
            let right = format.extension();
            let name = mesh.path.rsplit('/').next().unwrap_or_default();
            let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
            if !extension.eq_ignore_ascii_case(right) {
                let label = context.link_label(link);
                let message = format!("for {label} this should name a .{right} file");
                finding_in(module, &mesh.pointer, message)
                    .values(format!("a path that ends in .{right}"), format!("`{}`", mesh.path))
                    .report(findings);
            }
        }
    }
    Some(())
}

/// Reports meshes of a module of version 1 that do not have the formats of most meshes.
fn formats(context: &Context, meshes: &Meshes, module: &Module, findings: &mut Findings) {
    let [list] = meshes.lists.as_slice() else { return };
    let links = list.links.iter().enumerate();
    let all = links.flat_map(|(link, meshes)| meshes.iter().map(move |mesh| (link, mesh)));
    for format in [MeshFormat::Stl, MeshFormat::Obj] {
        let given = |mesh: &Mesh| mesh.paths.iter().any(|path| path.format == Some(format));
        let with = all.clone().filter(|(_, mesh)| given(mesh)).count();
        let expected = 2 * with >= all.clone().count();
        for (link, mesh) in all.clone().filter(|(_, mesh)| given(mesh) != expected) {
            let entry = mesh.paths.first().map_or("", |path| &path.pointer);
            let entry = entry.rsplit_once('/').map_or("", |(entry, _)| entry);
            let key = format.extension();
            let word = |given: bool| if given { "a path" } else { "null" };
            let message = format!(
                "{} does not have the formats of the other meshes: write all meshes of the module as {key}, or none",
                context.link_label(link)
            );
            finding_in(module, format!("{entry}/{key}"), message)
                .values(word(expected), word(!expected))
                .report(findings);
        }
    }
}

/// Reports links that have more meshes in one format than in another.
fn counts(
    context: &Context,
    meshes: &Meshes,
    kind: Kind,
    module: &Module,
    findings: &mut Findings,
) {
    for link in 0..meshes.num_links() {
        let counts: Vec<(&str, usize)> = meshes
            .lists
            .iter()
            .filter_map(|list| Some((list.key, list.links.get(link)?.len())))
            .collect();
        // The one that differs from the other two, or the second if all three differ.
        let odd = match counts.as_slice() {
            [(_, a), (key, b), (_, c)] if a == c && a != b => Some((key, b, a)),
            [(key, a), (_, b), (_, c)] if b == c && a != b => Some((key, a, b)),
            [(_, a), (_, b), (key, c)] if a == b && b != c => Some((key, c, a)),
            [(_, a), (key, b), _] if a != b => Some((key, b, a)),
            _ => None,
        };
        let Some((key, actual, expected)) = odd else { continue };
        let what = match kind {
            Kind::ConvexDecompositionMeshes => "pieces",
            _ => "meshes",
        };
        let all: Vec<String> =
            counts.iter().map(|(key, count)| format!("{count} in `{key}`")).collect();
        let message = format!(
            "the formats of {} differ in {what}: {}",
            context.link_label(link),
            all.join(", ")
        );
        finding_in(module, format!("/{key}/{link}"), message)
            .values(format!("{expected} {what}"), format!("{actual} {what}"))
            .report(findings);
    }
}
