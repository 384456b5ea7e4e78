//! `link_shapes_simple_skips_module` from the distance statistics and the distances in the default configuration: SPEC
//! 8.6.

use std::collections::HashSet;

use urdd_format::chain::ChainModule;
use urdd_format::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule,
};
use urdd_format::link_shapes_simple_skips::{
    LinkShapesSimpleSkipsModule, SeenPair, SkipReason, SkipReasons,
};

type Skips = Vec<Vec<bool>>;
type Reasons = Vec<Vec<SkipReason>>;

/// Builds the module. `default` contains the distances in the default configuration, by kind of shape.
pub(crate) fn simple_skips(
    statistics: &LinkShapesDistanceStatisticsModule,
    default: &[Vec<Vec<f64>>],
    chain: &ChainModule,
) -> LinkShapesSimpleSkipsModule {
    let joined: HashSet<[usize; 2]> = chain
        .joints_in_chain
        .iter()
        .map(|joint| [joint.parent_link_idx.get(), joint.child_link_idx.get()])
        .collect();
    let full: Vec<usize> = statistics.full_shapes.iter().map(|l| l.get()).collect();
    let pieces: Vec<usize> =
        statistics.decomposition_shapes.iter().map(|piece| piece.link_idx.get()).collect();
    let of_full =
        |kind: usize, of: &DistanceStatistics| classed(&full, of, &default[kind], &joined);
    let of_pieces = |kind: usize, of: &Option<DistanceStatistics>| {
        let both = of.as_ref().zip(default.get(kind));
        both.map(|(of, default)| classed(&pieces, of, default, &joined)).unzip()
    };
    let s = statistics;
    let (hulls, hull_reasons) = of_full(0, &s.full_convex_hulls);
    let (obbs, obb_reasons) = of_full(1, &s.full_obbs);
    let (spheres, sphere_reasons) = of_full(2, &s.full_bounding_spheres);
    let (piece_hulls, piece_hull_reasons) = of_pieces(3, &s.decomposition_convex_hulls);
    let (piece_obbs, piece_obb_reasons) = of_pieces(4, &s.decomposition_obbs);
    let (piece_spheres, piece_sphere_reasons) = of_pieces(5, &s.decomposition_bounding_spheres);
    LinkShapesSimpleSkipsModule {
        full_shapes: statistics.full_shapes.clone(),
        decomposition_shapes: statistics.decomposition_shapes.clone(),
        full_convex_hulls_simple_skips: hulls,
        full_obbs_simple_skips: obbs,
        full_bounding_spheres_simple_skips: spheres,
        decomposition_convex_hulls_simple_skips: piece_hulls,
        decomposition_obbs_simple_skips: piece_obbs,
        decomposition_bounding_spheres_simple_skips: piece_spheres,
        reasons: SkipReasons {
            full_convex_hulls: hull_reasons,
            full_obbs: obb_reasons,
            full_bounding_spheres: sphere_reasons,
            decomposition_convex_hulls: piece_hull_reasons,
            decomposition_obbs: piece_obb_reasons,
            decomposition_bounding_spheres: piece_sphere_reasons,
        },
    }
}

/// Whether each pair is a simple skip, and its reason. `links[i]` is the link of shape i.
fn classed(
    links: &[usize],
    statistics: &DistanceStatistics,
    default: &[Vec<f64>],
    joined: &HashSet<[usize; 2]>,
) -> (Skips, Reasons) {
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
    let reasons: Reasons =
        all.clone().map(|i| all.clone().map(|j| reason(i, j)).collect()).collect();
    let skips =
        reasons.iter().map(|row| row.iter().map(|reason| reason.is_simple()).collect()).collect();
    (skips, reasons)
}
