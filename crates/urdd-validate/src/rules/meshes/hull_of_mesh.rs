use crate::rules::prelude::*;
use crate::solids::derived::Derived;
use crate::solids::polytope::{Polytope, step};
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::surface::{bits, distinct, extent, nearest};

declare_rule! {
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
