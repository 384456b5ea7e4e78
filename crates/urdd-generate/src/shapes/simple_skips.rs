//! `link_shapes_simple_skips_module` from the distance statistics and the distances in the default configuration: SPEC
//! 8.6.

use std::collections::HashSet;
use std::sync::Arc;

use super::statistics::{Shapes, distances_at};
use crate::context::Context;
use crate::made::{Shared, streamed};
use crate::shape_documents;
use urdd_format::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule,
};
use urdd_format::link_shapes_simple_skips::{
    LinkShapesSimpleSkipsModule, SeenPair, SkipReason, SkipReasons,
};

type Reasons = Vec<Vec<SkipReason>>;

/// Builds the module.
pub(crate) fn simple_skips(
    context: &Context,
    shapes: &Shapes,
    statistics: &LinkShapesDistanceStatisticsModule,
) -> Shared<LinkShapesSimpleSkipsModule> {
    let name = "the default configuration";
    let default = distances_at(context, shapes, name, &context.space.default_configuration())?;
    let joined: HashSet<[usize; 2]> = context
        .chain
        .joints_in_chain
        .iter()
        .map(|joint| [joint.parent_link_idx.get(), joint.child_link_idx.get()])
        .collect();
    let full: Vec<usize> = statistics.full_shapes.iter().map(|l| l.get()).collect();
    let pieces: Vec<usize> =
        statistics.decomposition_shapes.iter().map(|piece| piece.link_idx.get()).collect();
    let of_full =
        |kind: usize, of: &DistanceStatistics| reasons(&full, of, &default[kind], &joined);
    let of_pieces = |kind: usize, of: &Option<DistanceStatistics>| {
        let both = of.as_ref().zip(default.get(kind));
        both.map(|(of, default)| reasons(&pieces, of, default, &joined))
    };
    let reasons = SkipReasons {
        full_convex_hulls: of_full(0, &statistics.full_convex_hulls),
        full_obbs: of_full(1, &statistics.full_obbs),
        full_bounding_spheres: of_full(2, &statistics.full_bounding_spheres),
        decomposition_convex_hulls: of_pieces(3, &statistics.decomposition_convex_hulls),
        decomposition_obbs: of_pieces(4, &statistics.decomposition_obbs),
        decomposition_bounding_spheres: of_pieces(5, &statistics.decomposition_bounding_spheres),
    };
    let of_pieces = |reasons: &Option<Reasons>| reasons.as_ref().map(skips);
    let module = Arc::new(LinkShapesSimpleSkipsModule {
        full_shapes: statistics.full_shapes.clone(),
        decomposition_shapes: statistics.decomposition_shapes.clone(),
        full_convex_hulls_simple_skips: skips(&reasons.full_convex_hulls),
        full_obbs_simple_skips: skips(&reasons.full_obbs),
        full_bounding_spheres_simple_skips: skips(&reasons.full_bounding_spheres),
        decomposition_convex_hulls_simple_skips: of_pieces(&reasons.decomposition_convex_hulls),
        decomposition_obbs_simple_skips: of_pieces(&reasons.decomposition_obbs),
        decomposition_bounding_spheres_simple_skips: of_pieces(
            &reasons.decomposition_bounding_spheres,
        ),
        reasons,
    });
    streamed(shape_documents::simple_skips(&module), module)
}

/// The reason of each pair. `links[i]` is the link of shape i.
fn reasons(
    links: &[usize],
    statistics: &DistanceStatistics,
    default: &[Vec<f64>],
    joined: &HashSet<[usize; 2]>,
) -> Reasons {
    let reason = |i: usize, j: usize| {
        let (a, b) = (links[i], links[j]);
        let seen = SeenPair {
            is_same_link: a == b,
            is_joined: joined.contains(&[a, b]) || joined.contains(&[b, a]),
            range: [statistics.min_distances[i][j], statistics.max_distances[i][j]],
            at_default: default[i][j],
        };
        seen.reason()
    };
    let all = 0..links.len();
    all.clone().map(|i| all.clone().map(|j| reason(i, j)).collect()).collect()
}

/// Whether each pair is a simple skip.
fn skips(reasons: &Reasons) -> Vec<Vec<bool>> {
    reasons.iter().map(|row| row.iter().map(|reason| reason.is_simple()).collect()).collect()
}
