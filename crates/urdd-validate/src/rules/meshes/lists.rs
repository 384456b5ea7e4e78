//! Which files the mesh modules list for each link.

use crate::rules::prelude::*;
use crate::views::shared_meshes;
use urdd_document::mesh_files::{Absence, MeshFiles};
use urdd_document::meshes::MeshFormat;
use urdd_document::shapes::{LIST_MODULES, entry_counts};

declare_rule! {
    /// A list of a mesh module does not hold one entry per link.
    ///
    /// The place in the list is the link index: where an entry is missing or too many, every later
    /// link gets another link's mesh. Most often the module is stale: it was written before a link
    /// was added or removed.
    ///
    /// Write the mesh modules again from the same URDF as `urdf_module`, with null (or an empty list)
    /// for links without a mesh.
    MSH001 "mesh-list-length", Error, clause "7.1", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), MESHES, LINKS_NAMED], check mesh_list_length,

    /// Two entries of a mesh module name the same file, which can be right for one of them only.
    ///
    /// A derived mesh is in its link's own frame: the origin and scale of the link's geometry are
    /// applied. When two links are given one file, the mesh of the second overwrote that of the first,
    /// and hulls, pieces, boxes and distances of the first were then made from the wrong shape.
    ///
    /// Name derived files by link (SPEC 7.3), and write the mesh and link shape modules again. In
    /// legacy modules, links that place the very same mesh at the very same origin and scale may
    /// share a file: then it is right for both (LEG007).
    MSH005 "mesh-file-shared", Error, clause "7.3", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf), DERIVED_MESHES, NotFailed(MSH001), NotFailed(MSH003), NotFailedInV1(MSH007),
    ], check mesh_file_shared,

    /// A link has a mesh in one mesh module and none in another.
    ///
    /// Hulls and convex pieces are made from the plain mesh: a link has all three or none. Where one is
    /// missing, a program that checks collisions passes over a link that another program sees.
    ///
    /// Write the mesh modules again, all from the same plain meshes.
    MSH007 "mesh-presence-differs", Error, clause "7.2", since "0.1.0",
    phase References, needs [DERIVED_MESHES, NotFailed(MSH001), NotFailed(MSH003)], check mesh_presence_differs,

    /// Modules disagree about the number of convex pieces of a link.
    ///
    /// Piece k of a link is the same piece in `convex_decomposition_meshes_module`, in the boxes and
    /// spheres, and in the distances. Where one of them has more or fewer, boxes belong to other
    /// pieces than their places say. Most often the meshes were decomposed again and the link shape
    /// modules were not.
    ///
    /// Write the link shape modules again from the convex pieces that are there.
    MSH004 "piece-count-mismatch", Error, clause "7.7", since "0.1.0",
    phase References, needs [
        Module(Kind::ConvexDecompositionMeshes), SHAPE_LISTS, MESHES_LISTED, NotFailed(SHP001), NO_PIECE_TWICE,
    ], check piece_count_mismatch,

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

fn mesh_list_length(context: &Context, findings: &mut Findings) -> Option<()> {
    let links = context.robot()?.links.len();
    for (_, module, meshes) in context.mesh_modules(MESH_MODULES) {
        let lists = meshes.lists.iter().map(|list| (list.key, list.links.len()));
        if let Some(wrong) = wrong_lengths(&lists.collect::<Vec<_>>(), links) {
            let message = format!(
                "one entry per link is needed, and urdf_module has {links} links: {}; write the module again",
                wrong.in_words
            );
            finding_in(module, wrong.pointer, message)
                .expected(format!("{links} entries (links of urdf_module)"))
                .actual(format!("{} entries", wrong.length))
                .report(findings);
        }
    }
    Some(())
}

fn mesh_file_shared(context: &Context, findings: &mut Findings) -> Option<()> {
    for shared in shared_meshes::all(context).into_iter().filter(|shared| !shared.alike) {
        let ((first, first_pointer), (link, pointer)) = (shared.first, shared.other);
        let label = context.link_label(link);
        let message = match first == link {
            true => format!("{label} names one file twice"),
            false => format!(
                "{} and {label} name the same file, which can be right for only one of them: write one for each link",
                context.link_label(first)
            ),
        };
        let file = format!("{}/module.json", shared.kind.folder());
        let mut finding = Finding::at(file, pointer, message)
            .values("a file of its own", format!("`{}` (also {first_pointer})", shared.path));
        finding.parts = shared.parts;
        findings.report(finding);
    }
    Some(())
}

fn mesh_presence_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let modules: Vec<_> = context.mesh_modules(DERIVED).collect();
    let links = modules.iter().map(|(_, _, meshes)| meshes.num_links()).max();
    for link in 0..links.unwrap_or(0) {
        let (with, without): (Vec<_>, Vec<_>) =
            (modules.iter()).partition(|(_, _, meshes)| meshes.count(link) > 0);
        if with.is_empty() || without.is_empty() {
            continue;
        }
        // Reported at the module that differs from the others; of two, at the one without a mesh.
        let odd_has = with.len() < without.len();
        let (odd, others) = if odd_has { (with, without) } else { (without, with) };
        let (_, module, meshes) = odd.first()?;
        let others: Vec<&str> = others.iter().map(|(kind, ..)| kind.name()).collect();
        let (label, others) = (context.link_label(link), others.join(" and "));
        let (message, expected, actual) = match odd_has {
            true => {
                let message = format!("{label} has a mesh here, but none in {others}");
                (message, "no mesh", "a mesh")
            }
            false => {
                let message = format!("{label} has no mesh here, but one in {others}");
                (message, "a mesh", "none")
            }
        };
        let finding = finding_in(*module, meshes.pointer(link), message);
        findings.report(finding.values(expected, actual));
    }
    Some(())
}

fn piece_count_mismatch(context: &Context, findings: &mut Findings) -> Option<()> {
    let pieces = context.meshes(Kind::ConvexDecompositionMeshes)?;
    let links = 0..pieces.num_links();
    // Each with its module, its key, and the number of pieces of each link.
    let mut lists = vec![(
        context.module(Kind::ConvexDecompositionMeshes)?,
        pieces.lists.first().map_or("", |list| list.key),
        links.clone().map(|link| pieces.count(link)).collect::<Vec<usize>>(),
    )];
    for (_, module, document) in context.documents(LIST_MODULES) {
        let of_pieces = entry_counts(document).into_iter().filter(|list| !list.kind.is_of_links());
        let counts = of_pieces.map(|list| (list.key, list.links.iter().map(Vec::len).collect()));
        lists.extend(counts.map(|(key, counts)| (module, key, counts)));
    }
    for link in links {
        let counts = lists.iter().filter_map(|list| Some((*list.2.get(link)?, list)));
        // One finding per link, reported at the first list that differs from most lists.
        let usual = most_common(counts.clone().map(|(count, _)| count));
        let mut odd = counts.filter(|(count, _)| *count != usual);
        let Some((count, (module, key, _))) = odd.next() else { continue };
        let also = match odd.count() {
            0 => String::new(),
            n => format!(" (and {n} more lists)"),
        };
        let message = format!(
            "{} has {count} convex pieces here{also} and {usual} in the other modules that list them: write the link shape modules again from convex_decomposition_meshes_module",
            context.link_label(link)
        );
        finding_in(*module, format!("/{key}/{link}"), message)
            .counts(usual, count, "entries")
            .report(findings);
    }
    Some(())
}

/// The most frequent number; of several, the first.
pub fn most_common(numbers: impl Iterator<Item = usize>) -> usize {
    let mut seen: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
    for (place, number) in numbers.enumerate() {
        seen.entry(number).or_insert((0, place)).0 += 1;
    }
    let best =
        seen.into_iter().max_by_key(|(_, (times, place))| (*times, std::cmp::Reverse(*place)));
    best.map_or(0, |(number, _)| number)
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
