use super::outreach::{self, How};
use crate::rules::prelude::*;

declare_rule! {
    /// A convex piece reaches a little out of the hull of its link.
    ///
    /// Pieces stand for parts of the link, so all of them are inside its hull. Programs that simplify pieces, or
    /// fit them to voxels (V-HACD, CoACD), make them reach out of it by up to some 1 % of its diagonal. Distances of
    /// pieces are then smaller than those of the link.
    ///
    /// Cut the pieces to the hull, or decompose the link's plain mesh more finely.
    MSH023 "piece-barely-leaves-hull", Warning, clause "7.10", since "0.2.0",
    phase Geometry, consequence Collisions, needs [
        Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes), NotFailed(MSH003),
        NotFailed(MSH007), SOUND_HULL,
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    outreach::report(context, How::Barely, findings)
}
