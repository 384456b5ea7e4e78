use super::outreach::{self, How};
use crate::rules::prelude::*;

declare_rule! {
    /// A convex piece reaches far out of the hull of its link.
    ///
    /// Pieces stand for parts of the link, so all of them are inside its hull. This one reaches out by more
    /// than 2 % of the hull's diagonal: it is of another link, in another place, or larger than what it
    /// stands for. Programs then report collisions that do not happen.
    ///
    /// Decompose the link's plain mesh, and cut the pieces to its hull.
    MSH021 "piece-leaves-hull", Error, clause "7.10", since "0.1.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes), NotFailed(MSH003),
        NotFailed(MSH007), SOUND_HULL,
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    outreach::report(context, How::Far, findings)
}
