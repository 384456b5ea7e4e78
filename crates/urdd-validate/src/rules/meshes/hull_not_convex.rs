use super::convexity;
use crate::rules::prelude::*;

declare_rule! {
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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    convexity::report(context, Kind::ConvexHullMeshes, findings)
}
