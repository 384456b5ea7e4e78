use super::hull_and_mesh;
use crate::rules::prelude::*;
use urdd_geometry::surface::{bits, distinct, extent, nearest};

declare_rule! {
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
    ],
}

/// Maximum number of hull vertices, not exactly equal to a vertex of the mesh, whose nearest one is searched.
const MAX_SEARCHED: usize = 2_000;

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    hull_and_mesh::report(
        context,
        findings,
        Code::MSH019,
        farthest_off,
        |label, place, distance| {
            (
                format!(
                    "the hull of {label} has a vertex at {place} that is not a vertex of its mesh: the nearest one is {distance} away"
                ),
                "vertices of the plain mesh only",
                format!("a vertex {distance} off"),
            )
        },
    )
}

/// The vertex of a hull that is farthest from the vertices of a mesh.
fn farthest_off(hull: &Mesh, mesh: &Mesh) -> Option<Farthest> {
    let known: HashSet<[u64; 3]> = mesh.vertices.iter().copied().map(bits).collect();
    let vertices = distinct(hull).into_iter();
    let unknown = vertices.filter(|vertex| !known.contains(&bits(*vertex))).take(MAX_SEARCHED);
    let off = unknown.map(|vertex| (vertex, nearest(mesh, vertex)));
    Farthest::of(off, mesh_resolution(extent(mesh))).filter(Farthest::is_off)
}
