use super::hull_and_mesh;
use crate::rules::prelude::*;
use crate::solids::polytope::{Polytope, step};
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::surface::{bits, distinct};

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
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    hull_and_mesh::report(
        context,
        findings,
        Code::MSH018,
        farthest_outside,
        |label, place, distance| {
            (
                format!(
                    "the hull of {label} leaves out its mesh: the vertex at {place} is {distance} outside"
                ),
                "every vertex of the plain mesh inside",
                format!("{distance} outside"),
            )
        },
    )
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
