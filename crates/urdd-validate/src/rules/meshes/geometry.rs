//! The surfaces in mesh files: that a link's mesh is its geometry, and that hulls and pieces are convex and of that mesh.

use crate::rules::prelude::*;
use crate::solids::derived::{Derived, noun};
use crate::solids::placed;
use crate::solids::polytope::{Dents, NotConvex, Polytope, dents, not_convex, step};
use urdd_document::robot::Element;
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::Geometry;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::surface::{bits, distinct, extent, nearest};

declare_rule! {
    /// A link's mesh is not its geometry in its place.
    ///
    /// The plain mesh of a link is what the URDF shows there: the triangles of each mesh that it names,
    /// scaled, turned and moved as the URDF says, and its boxes, cylinders, capsules and spheres,
    /// tessellated. Here it is something else. Often a scale or an origin was left out, a second element
    /// of the link was forgotten, or two links wrote the same file, so that one has the other's mesh.
    /// Everything that is made from the mesh is wrong then too: hull, pieces, boxes, distances.
    ///
    /// Write it again, from the carried meshes. Vertices may differ by the rounding of binary32.
    MSH015 "mesh-misplaced", Error, clause "7.8", since "0.1.0",
    phase Geometry, consequence WrongPlace, needs [
        Module(Kind::Urdf), Module(Kind::OriginalMeshes), Module(Kind::PlainMeshes), NotFailedInV1(MSH001),
        NotFailed(MSH003), NotFailed(MSH008), NotFailedInV1(MSH009), NotFailedInV1(MSH012), NotFailed(MSH016),
    ], check mesh_misplaced,

    /// A link has geometry in the URDF and no mesh here, or a mesh here and no geometry in the URDF.
    ///
    /// A link without a mesh has no hull, no box and no distances either: every collision check
    /// passes over it in silence. Converters that read mesh files only lose boxes, cylinders and
    /// spheres in this way.
    ///
    /// Tessellate the link's boxes, cylinders, capsules and spheres; use its collision geometry where it has no
    /// visual geometry; and write the mesh and link shape modules again. A link needs no mesh when its
    /// only geometry is meshes that could not be found.
    MSH011 "link-without-mesh", Error, clause "7.2", since "0.1.0",
    phase References, needs [
        NotFailed(MSH016), Module(Kind::Urdf), Module(Kind::PlainMeshes), MESHES_LISTED, NotFailed(MSH009),
        NotFailed(MSH012), LINKS_NAMED,
    ], check link_without_mesh,

    /// `geometry` names the wrong source for a link's mesh.
    ///
    /// A mesh is made from the kind of geometry that `preferred_geometry` names, `Visual` or
    /// `Collision`, and from the other kind only where a link has nothing usable of the first. A
    /// program that shows or collides links must be able to tell which of the two it sees.
    ///
    /// Write `geometry` as the mesh was really made; where the mesh itself was made from the wrong
    /// elements, write the mesh modules again.
    MSH008 "wrong-geometry-used", Error, clause "7.4", since "0.1.0",
    phase References, consequence WrongPlace, needs [
        Version1, Module(Kind::Urdf), ModuleV1(Kind::PlainMeshes), NoneFailed(&[MSH001, MSH009, MSH012, MSH011, MSH016]),
        // The entry of another link has the geometry of another link.
        NotFailed(MSH006), NotFailed(MSH007), LINKS_NAMED,
    ], check wrong_geometry_used,

    /// A convex hull is not the closed surface of a convex body.
    ///
    /// Programs compute distances from its vertices, and whether a point is inside from its faces; the
    /// two agree only for a convex body. Here a vertex lies outside of a face, an edge has a face on one
    /// side only, or the faces look inward.
    ///
    /// Compute the hull of the link's plain mesh again, and write every triangle, counter-clockwise seen
    /// from outside.
    MSH017 "hull-not-convex", Error, clause "7.9", since "0.1.0",
    phase Geometry, consequence Collisions, needs [Module(Kind::ConvexHullMeshes), NotFailed(MSH003)],
    check |context, findings| report_not_convex(context, Kind::ConvexHullMeshes, findings),

    /// A convex piece is not the closed surface of a convex body.
    ///
    /// As for hulls (MSH017): programs compute with its vertices or with its faces, and the two agree only
    /// for a convex body. Decompositions that write the parts of the surface instead of the hull of each
    /// part make such pieces.
    ///
    /// Write the convex hull of each piece, every triangle, counter-clockwise seen from outside.
    MSH020 "piece-not-convex", Error, clause "7.10", since "0.1.0",
    phase Geometry, consequence Collisions, needs [Module(Kind::ConvexDecompositionMeshes), NotFailed(MSH003)],
    check |context, findings| report_not_convex(context, Kind::ConvexDecompositionMeshes, findings),

    /// A convex hull leaves out a part of its link.
    ///
    /// A hull holds the whole plain mesh. Here a vertex of the mesh is outside: a program that checks
    /// collisions with the hull does not see that part of the robot. Often the hull is of another link,
    /// or of an earlier mesh, or was simplified.
    ///
    /// Compute the hull of the link's plain mesh again.
    MSH018 "hull-leaves-out-mesh", Error, clause "7.9", since "0.1.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::PlainMeshes), Module(Kind::ConvexHullMeshes), NoneFailed(&[MSH003, MSH007]), CONVEX_HULL,
    ], check hull_leaves_out_mesh,

    /// A vertex of a convex hull is not a vertex of its link's mesh.
    ///
    /// The hull of a mesh has some of the mesh's vertices and no others. Here one is somewhere
    /// else: the hull is larger than its link (then programs report false collisions), or it was
    /// computed from another mesh, in other coordinates, or from rounded ones.
    ///
    /// Compute the hull from the vertices of the plain mesh as its files have them.
    MSH019 "hull-vertex-off-mesh", Error, clause "7.9", since "0.1.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::PlainMeshes), Module(Kind::ConvexHullMeshes), NoneFailed(&[MSH003, MSH007]), HULL_ABOUT_MESH,
    ], check hull_vertex_off_mesh,
}

fn mesh_misplaced(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = context.module(Kind::PlainMeshes)?;
    for (link, why) in &context.placed().unknown {
        findings.not_verified(Part::Plain(*link), *why);
    }
    for wrong in &context.placed().wrong {
        let label = context.link_label(wrong.link);
        let owner = placed::owner(context, context.solids(), wrong.link);
        let hint = owner.map_or_else(String::new, |owner| {
            format!("; it is the mesh of {}", context.link_label(owner))
        });
        let message = format!(
            "the mesh of {label} is not its geometry in the URDF, at its place: {}{hint}",
            wrong.what
        );
        finding_in(module, &wrong.pointer, message)
            .values(&wrong.expected, &wrong.actual)
            .tolerance(wrong.tolerance)
            .part(Part::Plain(wrong.link))
            .report(findings);
    }
    Some(())
}

fn link_without_mesh(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let meshes = context.meshes(Kind::PlainMeshes)?;
    let usable = UsableGeometry::new(context);
    for (link, named) in robot.links.iter().enumerate() {
        let has = |kind| usable.has(link, kind);
        let wanted = has(GeometryKind::Visual) || has(GeometryKind::Collision);
        if wanted == (meshes.count(link) > 0) {
            continue;
        }
        let label = context.link_label(link);
        let mut kinds = shapes("visual", &named.visual);
        kinds.extend(shapes("collision", &named.collision));
        let finding = |message| finding_in(Kind::PlainMeshes, meshes.pointer(link), message);
        findings.report(match wanted {
            true => finding(format!(
                "{label} has geometry in urdf_module ({}) but no mesh here, so no program sees it: make one",
                kinds.join(", ")
            ))
            .values("a mesh", format!("none for {label}")),
            false => finding(format!(
                "{label} has no geometry in urdf_module that a mesh could be made from, but a mesh here"
            ))
            .values("null", format!("a mesh for {label}")),
        });
    }
    Some(())
}

/// The shapes of a link's elements, as `visual Box`.
fn shapes(element: &str, elements: &[Element]) -> Vec<String> {
    let named = elements.iter().filter_map(|e| e.geometry.as_ref()).map(|geometry| {
        let shape = match geometry {
            Geometry::Mesh(_) => "Mesh",
            Geometry::Box(_) => "Box",
            Geometry::Cylinder(_) => "Cylinder",
            Geometry::Capsule(_) => "Capsule",
            Geometry::Sphere(_) => "Sphere",
        };
        format!("{element} {shape}")
    });
    let mut named: Vec<String> = named.collect();
    named.dedup();
    named
}

fn wrong_geometry_used(context: &Context, findings: &mut Findings) -> Option<()> {
    let plain = document!(context, PlainMeshes)?;
    let usable = UsableGeometry::new(context);
    let preferred = plain.preferred_geometry;
    let other = match preferred {
        GeometryKind::Visual => GeometryKind::Collision,
        GeometryKind::Collision => GeometryKind::Visual,
    };
    for (link, mesh) in plain.link_meshes.iter().enumerate() {
        let (expected, why) = match usable.has(link, preferred) {
            true => (preferred, "it has geometry of the preferred kind"),
            false => (other, "it has none of the preferred kind"),
        };
        if let Some(mesh) = mesh
            && mesh.geometry != expected
        {
            let message = format!(
                "preferred_geometry is {preferred:?}, and for {} this must be {expected:?}: {why}",
                context.link_label(link)
            );
            finding_in(Kind::PlainMeshes, format!("/link_meshes/{link}/geometry"), message)
                .literals(expected, mesh.geometry)
                .report(findings);
        }
    }
    Some(())
}

/// Reports every mesh of a module that is not the closed surface of a convex body.
fn report_not_convex(context: &Context, kind: Kind, findings: &mut Findings) -> Option<()> {
    let module = context.module(kind)?;
    let judge = |mesh: &'_ Derived| {
        let solid = mesh.sound()?;
        let key = context.solids().content(kind, mesh.link, mesh.piece)?;
        let compute = || Some((not_convex(solid)?, dents(solid)));
        context.memos.convexity.get(key, compute)
    };
    let meshes = context.solids().derived(kind);
    let faults: Vec<Option<(NotConvex, Option<Dents>)>> = meshes.par_iter().map(judge).collect();
    for (mesh, fault) in meshes.iter().zip(faults) {
        let part = Part::of(kind, mesh.link, mesh.piece);
        if let (None, Some(part)) = (mesh.sound(), part) {
            findings.not_verified(part, Why::Unreadable);
        }
        let Some((fault, dents)) = fault else { continue };
        let extent = mesh.mesh.as_ref().map_or(0.0, extent);
        let resolution = mesh_resolution(extent);
        let depth = dents.map(|dents| dents.depth).filter(|depth| *depth > resolution);
        let what = match fault {
            NotConvex::Nothing => "it has no face with an area".to_owned(),
            NotConvex::Open(at) => {
                format!("the edge at {} is not shared by two faces that are wound alike", point(at))
            }
            NotConvex::Inward => "its faces are oriented inward".to_owned(),
            NotConvex::Vertex(at, _) => match dents {
                Some(dents) => in_words(&dents, depth),
                None => format!("the vertex at {} is outside of a face", point(at)),
            },
        };
        let label = context.link_label(mesh.link);
        let which = match kind {
            Kind::ConvexDecompositionMeshes => format!("piece {} of {label}", mesh.piece),
            _ => format!("the {} of {label}", noun(kind)),
        };
        let message = format!("{which} is not a convex body: {what}");
        let mut finding = finding_in(module, mesh.pointer(), message)
            .values("a closed convex surface, faces counter-clockwise seen from outside", what)
            .tolerance(resolution)
            .part(part);
        if let Some(depth) = depth {
            finding = finding.off_by(depth, "m");
        }
        findings.report(finding);
    }
    Some(())
}

/// Number of inward faces, and the deepest dent.
fn in_words(dents: &Dents, depth: Option<f64>) -> String {
    let faces = match dents.inward {
        0 => "vertices lie outside of its faces".to_owned(),
        1 => format!("1 of {} faces is oriented inward", dents.faces),
        inward => format!("{inward} of {} faces are oriented inward", dents.faces),
    };
    match depth {
        None => faces,
        Some(depth) => {
            format!("{faces}, the deepest dent is {:.3} mm, at {}", 1e3 * depth, point(dents.place))
        }
    }
}

fn hull_leaves_out_mesh(context: &Context, findings: &mut Findings) -> Option<()> {
    report(context, findings, Code::MSH018, farthest_outside, |label, place, distance| {
        let message = format!(
            "the hull of {label} leaves out its mesh: the vertex at {place} is {distance} outside"
        );
        (message, "every vertex of the plain mesh inside", format!("{distance} outside"))
    })
}

/// The vertex of a mesh that is farthest outside a hull.
fn farthest_outside(hull: &Mesh, mesh: &Mesh) -> Option<Farthest> {
    let polytope = Polytope::new(hull)?;
    let known: HashSet<[u64; 3]> = hull.vertices.iter().copied().map(bits).collect();
    // The corners of the mesh's own hull suffice, and most of them are vertices of the hull.
    let mut corners = match ConvexHull::new(&distinct(mesh)) {
        Ok(own) => own.into_mesh().vertices,
        Err(_) => mesh.vertices.clone(),
    };
    corners.retain(|corner| !known.contains(&bits(*corner)));
    let every = step(corners.len(), polytope.num_faces());
    let corners = corners.into_iter().step_by(every);
    let outside = corners.map(|corner| (corner, polytope.outside(corner)));
    Farthest::of(outside, polytope.resolution).filter(Farthest::is_off)
}

/// Maximum number of hull vertices, not exactly equal to a vertex of the mesh, whose nearest one is searched.
const MAX_SEARCHED: usize = 2_000;

fn hull_vertex_off_mesh(context: &Context, findings: &mut Findings) -> Option<()> {
    report(context, findings, Code::MSH019, farthest_off, |label, place, distance| {
        let message = format!(
            "the hull of {label} has a vertex at {place} that is not a vertex of its mesh: the nearest one is {distance} away"
        );
        (message, "vertices of the plain mesh only", format!("a vertex {distance} off"))
    })
}

/// The vertex of a hull that is farthest from the vertices of a mesh.
fn farthest_off(hull: &Mesh, mesh: &Mesh) -> Option<Farthest> {
    let known: HashSet<[u64; 3]> = mesh.vertices.iter().copied().map(bits).collect();
    let vertices = distinct(hull).into_iter();
    let unknown = vertices.filter(|vertex| !known.contains(&bits(*vertex))).take(MAX_SEARCHED);
    let off = unknown.map(|vertex| (vertex, nearest(mesh, vertex)));
    Farthest::of(off, mesh_resolution(extent(mesh))).filter(Farthest::is_off)
}

/// Reports for a rule every hull for which `off`, given the hull and the plain mesh, finds a vertex. `words` describes it, given
/// the link, the place and the distance: message, expected, actual.
fn report(
    context: &Context,
    findings: &mut Findings,
    code: Code,
    off: impl Fn(&Mesh, &Mesh) -> Option<Farthest> + Sync,
    words: impl Fn(&str, &str, &str) -> (String, &'static str, String),
) -> Option<()> {
    let kind = Kind::ConvexHullMeshes;
    let module = context.module(kind)?;
    // Computed before the threads start, so that the computation itself can use all of them.
    context.placed();
    let solids = context.solids();
    let hulls = solids.derived(kind).iter().filter(|hull| {
        let by = [Part::Plain(hull.link)];
        judged(context, findings, Part::Hull(hull.link), &by)
    });
    let hulls: Vec<&Derived> = hulls.collect();
    let off_of = |link| {
        let mesh = solids.sound(Kind::PlainMeshes, link, 0)?;
        let hull = solids.sound(kind, link, 0)?;
        let contents = [kind, Kind::PlainMeshes].map(|kind| solids.content(kind, link, 0));
        let key = (code, contents.into_iter().flatten().collect());
        context.memos.farthest.get(key, || off(hull, mesh))
    };
    let off: Vec<Option<Farthest>> = hulls.par_iter().map(|hull| off_of(hull.link)).collect();
    for (hull, off) in hulls.iter().zip(off) {
        let Some(off) = off else { continue };
        let label = context.link_label(hull.link);
        let (message, expected, actual) = words(&label, &point(off.place), &metres(off.distance));
        finding_in(module, hull.pointer(), message)
            .values(expected, actual)
            .tolerance(off.tolerance)
            .off_by(off.distance, "m")
            .part(Part::Hull(hull.link))
            .report(findings);
    }
    Some(())
}
