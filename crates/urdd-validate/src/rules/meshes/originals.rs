//! The meshes that the URDF names, and the files that are carried for them.

use crate::rules::prelude::*;
use crate::solids::file::MeshFault;
use urdd_document::meshes::Meshes;
use urdd_format::meshes::GeometryKind;
use urdd_format::original_meshes::OriginalMeshesModule;
use urdd_format::urdf::Geometry;

declare_rule! {
    /// `original_meshes_module` does not list the meshes that the URDF names.
    ///
    /// The module maps every mesh reference of the URDF to the file that is carried for it, so that
    /// nobody has to resolve `package://` again. A reference that is missing, out of order, or of
    /// another file gives a link another link's looks.
    ///
    /// Write `references` in the order of the URDF: links, visual before collision, elements; each
    /// with the file name as the URDF has it. In legacy modules a link's files are those of its visual
    /// meshes.
    MSH009 "mesh-references-differ", Error, clause "7.5", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Module(Kind::OriginalMeshes), NotFailed(MSH001), LINKS_NAMED],
    check mesh_references_differ,

    /// `references` and `files` of `original_meshes_module` do not belong together.
    ///
    /// `files` is every carried mesh once, sorted by path; a reference names one of them, or null where
    /// the mesh could not be found. A reference to a file that is not in the list, or a file that no
    /// reference names, means that a mesh was lost or exchanged.
    ///
    /// Give each reference the path of the file that was carried for it, the same for the same file
    /// name of the URDF, and list each of these files once, sorted byte by byte; side files too.
    MSH012 "carried-files-mismatch", Error, clause "7.5", since "0.1.0",
    phase References, needs [Version1, ModuleV1(Kind::OriginalMeshes), NotFailed(DIR015), NotFailed(MSH009)],
    check carried_files_mismatch,

    /// `usable` or `side_files` of a carried mesh is wrong.
    ///
    /// `usable` says whether the file can be read as a mesh and has a triangle with an area, so
    /// that one need not try; `side_files` are the files that the mesh names in turn and that are
    /// carried with it: materials, buffers, textures. Here a file is called usable and is not, or
    /// the other way round, or the list is not what the mesh names.
    ///
    /// Set `usable` by reading the file, and list the carried files that it names, sorted.
    MSH016 "original-misdescribed", Error, clause "7.5", since "0.1.0",
    phase Geometry, needs [Version1, ModuleV1(Kind::OriginalMeshes), NotFailed(MSH002), NotFailed(MSH012)],
    check original_misdescribed,
}

/// A mesh that the URDF names: link, kind, element, file name.
type Named<'a> = (usize, GeometryKind, usize, &'a str);

fn mesh_references_differ(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    match context.document(Kind::OriginalMeshes)? {
        ModuleDocument::OriginalMeshes(original) => references(robot, original, findings),
        _ => {
            let meshes = context.meshes(Kind::OriginalMeshes)?;
            legacy(context, robot, &meshes, findings);
        }
    }
    Some(())
}

/// The meshes that the URDF names, in the order of SPEC 7.5.
fn named(robot: &Robot) -> Vec<Named<'_>> {
    let mut named = Vec::new();
    for (link, elements) in robot.links.iter().enumerate() {
        for kind in [GeometryKind::Visual, GeometryKind::Collision] {
            for (at, element) in elements.elements(kind).iter().enumerate() {
                if let Some(Geometry::Mesh(mesh)) = &element.geometry {
                    named.push((link, kind, at, mesh.filename.as_str()));
                }
            }
        }
    }
    named
}

/// Compares `references` with the robot's meshes.
fn references(robot: &Robot, original: &OriginalMeshesModule, findings: &mut Findings) {
    let shown = |(link, kind, element, filename): &Named| {
        format!("link {link}, {kind:?} {element}, `{filename}`")
    };
    let expected = named(robot);
    let actual: Vec<Named> = (original.references.iter())
        .map(|of| (of.link_idx.get(), of.geometry, of.element_idx.get(), of.filename.as_str()))
        .collect();
    if expected.len() != actual.len() {
        let differs = (0..).find(|at| expected.get(*at) != actual.get(*at));
        let at = differs.unwrap_or_default();
        let place = match at < actual.len() {
            true => format!("/references/{at}"),
            false => "/references".to_owned(),
        };
        let first = match (expected.get(at), actual.get(at)) {
            (Some(expected), _) => format!("the first that differs should be {}", shown(expected)),
            (None, Some(actual)) => format!("the URDF has no {}", shown(actual)),
            (None, None) => String::new(),
        };
        let message = format!("one reference for each mesh of urdf_module is needed; {first}");
        finding_in(Kind::OriginalMeshes, place, message)
            .counts(expected.len(), actual.len(), "references")
            .report(findings);
        return;
    }
    for (at, (expected, actual)) in expected.iter().zip(&actual).enumerate() {
        if expected != actual {
            let message = "this is not the mesh that urdf_module has in this place";
            finding_in(Kind::OriginalMeshes, format!("/references/{at}"), message)
                .values(shown(expected), shown(actual))
                .report(findings);
        }
    }
}

/// Legacy: the files of a link are copies of its visual meshes, under their own names.
fn legacy(context: &Context, robot: &Robot, meshes: &Meshes, findings: &mut Findings) {
    let base = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or(path).to_owned();
    let mut names: Vec<HashSet<String>> = vec![HashSet::new(); robot.links.len()];
    for (link, kind, _, filename) in named(robot) {
        if kind == GeometryKind::Visual
            && let Some(names) = names.get_mut(link)
        {
            names.insert(base(filename));
        }
    }
    for (link, path) in meshes.paths() {
        let Some(names) = names.get(link) else { continue };
        if !names.contains(&base(path.path)) {
            let mut expected: Vec<&str> = names.iter().map(String::as_str).collect();
            expected.sort_unstable();
            let message = format!(
                "the URDF does not name this file as a visual mesh of {}",
                context.link_label(link)
            );
            finding_in(Kind::OriginalMeshes, &path.pointer, message)
                .expected(match expected.is_empty() {
                    true => "null: the link has no visual mesh".to_owned(),
                    false => format!("a copy of {}", expected.join(" or ")),
                })
                .actual(format!("`{}`", path.path))
                .report(findings);
        }
    }
}

fn carried_files_mismatch(context: &Context, findings: &mut Findings) -> Option<()> {
    let original = document!(context, OriginalMeshes)?;
    // One wrong path shows in several of these: each runs only if those before it found nothing.
    for look in [paths, used, order] {
        look(original, findings);
        if !findings.is_empty() {
            return Some(());
        }
    }
    listed(context, original, findings);
    Some(())
}

/// Reports mesh files that `urdd.json` lists and the module does not name.
fn listed(context: &Context, original: &OriginalMeshesModule, findings: &mut Findings) {
    let side_files = original.files.iter().flat_map(|f| &f.side_files);
    let paths = original.files.iter().map(|f| &f.path).chain(side_files);
    let named: HashSet<&str> = paths.map(String::as_str).collect();
    // A missing file may have been renamed: MSH002 reports it.
    if named.iter().any(|path| entries::look(context, path).is_err()) {
        return;
    }
    let meshes = format!("{}/meshes/", Kind::OriginalMeshes.folder());
    for entry in entries::all(context) {
        for file in &entry.entry.files {
            let path = file.path.as_str();
            // DIR011 reports a file that is listed and missing.
            if path.starts_with(&meshes)
                && !named.contains(path)
                && entries::look(context, path).is_ok()
            {
                let message = "urdd.json lists a file in `meshes/` that is not named here: name it with the mesh that needs it, or remove it";
                finding_in(Kind::OriginalMeshes, "/files", message)
                    .values(format!("`{path}` as `path` or in `side_files`"), "neither")
                    .report(findings);
            }
        }
    }
}

/// Reports references that name an unlisted file, or another file than the same name before.
fn paths(original: &OriginalMeshesModule, findings: &mut Findings) {
    let files: HashSet<&str> = original.files.iter().map(|f| f.path.as_str()).collect();
    let mut by_name: HashMap<&str, Option<&str>> = HashMap::new();
    for (at, reference) in original.references.iter().enumerate() {
        let path = reference.path.as_deref();
        let pointer = format!("/references/{at}/path");
        if let Some(path) = path
            && !files.contains(path)
        {
            let message = "`files` does not list this file: list it there";
            finding_in(Kind::OriginalMeshes, pointer, message)
                .values("the path of one of `files`, or null", format!("`{path}`"))
                .report(findings);
            continue;
        }
        let first = *by_name.entry(reference.filename.as_str()).or_insert(path);
        if first != path {
            let shown = |path: Option<&str>| path.map_or("null".to_owned(), |p| format!("`{p}`"));
            let message = format!(
                "`{}` is another file here than in an earlier reference",
                reference.filename
            );
            finding_in(Kind::OriginalMeshes, pointer, message)
                .values(shown(first), shown(path))
                .report(findings);
        }
    }
}

/// Reports files that no reference names.
fn used(original: &OriginalMeshesModule, findings: &mut Findings) {
    let used: HashSet<&str> =
        original.references.iter().filter_map(|reference| reference.path.as_deref()).collect();
    for (at, carried) in original.files.iter().enumerate() {
        if !used.contains(carried.path.as_str()) {
            let message =
                "no reference names this file: give the reference its path, or leave the file out";
            finding_in(Kind::OriginalMeshes, format!("/files/{at}"), message)
                .values("a file that a reference names", format!("`{}`", carried.path))
                .report(findings);
        }
    }
}

/// Reports lists of files that are unsorted or contain duplicates.
fn order(original: &OriginalMeshesModule, findings: &mut Findings) {
    let mut lists =
        vec![("/files".to_owned(), original.files.iter().map(|f| f.path.as_str()).collect())];
    for (at, carried) in original.files.iter().enumerate() {
        let side: Vec<&str> = carried.side_files.iter().map(String::as_str).collect();
        lists.push((format!("/files/{at}/side_files"), side));
    }
    for (pointer, list) in lists {
        let unsorted = list.windows(2).position(|pair| match pair {
            [before, after] => before >= after,
            _ => false,
        });
        if let Some(at) = unsorted {
            let message = "files are sorted by path, byte by byte, each once";
            finding_in(Kind::OriginalMeshes, format!("{pointer}/{}", at + 1), message)
                .expected(format!("a path after `{}`", list.get(at).unwrap_or(&"")))
                .actual(format!("`{}`", list.get(at + 1).unwrap_or(&"")))
                .report(findings);
        }
    }
}

fn original_misdescribed(context: &Context, findings: &mut Findings) -> Option<()> {
    let original = document!(context, OriginalMeshes)?;
    for (at, listed) in original.files.iter().enumerate() {
        let Some(read) = context.solids().original(&listed.path) else { continue };
        if read.may_be_refused && !listed.usable {
            continue;
        }
        let path = &listed.path;
        let (usable, message) = match &read.mesh {
            Ok(_) => (true, format!("`{path}` can be read, and has a surface")),
            Err(MeshFault::Broken(why)) => (false, format!("`{path}` cannot be used: {why}")),
            Err(MeshFault::TooLarge(size)) => {
                (false, format!("`{path}` cannot be used: it is {size} bytes long"))
            }
            Err(MeshFault::Absent(_)) => continue,
        };
        if usable != listed.usable {
            let finding = finding_in(Kind::OriginalMeshes, format!("/files/{at}/usable"), message);
            findings.report(finding.values(usable, listed.usable));
        }
        if let Some(named) = &read.side_files
            && *named != listed.side_files
        {
            let mut pointer = format!("/files/{at}/side_files");
            let mut sides = listed.side_files.iter().enumerate();
            let message = match sides.find(|(_, side)| !named.contains(side)) {
                Some((odd, side)) => {
                    pointer += &format!("/{odd}");
                    format!("`{path}` does not name `{side}`")
                }
                None => format!("`{path}` also names other files"),
            };
            finding_in(Kind::OriginalMeshes, pointer, message)
                .literals(named, &listed.side_files)
                .report(findings);
        }
    }
    Some(())
}
