use super::convexity;
use crate::rules::prelude::*;

declare_rule! {
    /// A convex piece is not the closed surface of a convex body.
    ///
    /// As for hulls (MSH017): programs compute with its vertices or with its faces, and the two agree only
    /// for a convex body. Decompositions that write the parts of the surface instead of the hull of each
    /// part make such pieces.
    ///
    /// Write the convex hull of each piece, every triangle, counter-clockwise seen from outside.
    MSH020 "piece-not-convex", Error, clause "7.10", since "0.1.0",
    phase Geometry, consequence Collisions, needs [Module(Kind::ConvexDecompositionMeshes), NotFailed(MSH003)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    convexity::report(context, Kind::ConvexDecompositionMeshes, findings)
}
