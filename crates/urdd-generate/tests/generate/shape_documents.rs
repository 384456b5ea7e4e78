//! Documents with matrices over shapes, written row by row.

use std::sync::Arc;

use serde::Serialize;
use urdd_directory::canonical;
use urdd_directory::writer::Document;
use urdd_format::index::{Count, LinkIdx, PieceIdx};
use urdd_format::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule as StatisticsModule,
};
use urdd_format::link_shapes_simple_skips::LinkShapesSimpleSkipsModule as SimpleSkipsModule;
use urdd_format::link_shapes_simple_skips::{SkipReason, SkipReasons};
use urdd_format::link_shapes_skips::LinkShapesSkipsModule as SkipsModule;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::shapes::PieceShape;
use urdd_generate::made::*;

fn assert_whole(document: &Document, module: &impl Serialize) {
    let whole = serde_json::to_value(module).unwrap();
    let (mut json, mut yaml) = (String::new(), String::new());
    document.json(&mut json).unwrap();
    document.yaml(&mut yaml).unwrap();
    assert_eq!(json, canonical::json_string(&whole));
    assert_eq!(yaml, canonical::yaml_string(&whole));
}

/// Returns different matrices, one per call.
fn matrices<T>(element: impl Fn(usize) -> T) -> impl FnMut() -> Vec<Vec<T>> {
    let mut next = 0;
    move || {
        next += 1;
        let row = |i: usize| (0..2).map(|j| element(100 * next + 10 * i + j)).collect();
        (0..2).map(row).collect()
    }
}

fn shapes() -> (Vec<LinkIdx>, Vec<PieceShape>) {
    let piece = |piece| PieceShape { link_idx: LinkIdx(4), piece_idx: PieceIdx(piece) };
    (vec![LinkIdx(1), LinkIdx(4)], vec![piece(0), piece(1)])
}

#[test]
fn statistics_are_the_whole_module() {
    let mut next = matrices(|n| n as f64 + 0.5);
    let mut three = || DistanceStatistics {
        mean_distances: next(),
        min_distances: next(),
        max_distances: next(),
    };
    let (full_shapes, decomposition_shapes) = shapes();
    let mut module = StatisticsModule {
        num_samples: Count(7),
        full_shapes,
        decomposition_shapes,
        full_convex_hulls: three(),
        full_obbs: three(),
        full_bounding_spheres: three(),
        decomposition_convex_hulls: Some(three()),
        decomposition_obbs: Some(three()),
        decomposition_bounding_spheres: Some(three()),
    };
    assert_whole(&statistics(&Arc::new(module.clone())).unwrap(), &module);
    module.decomposition_obbs = None;
    module.full_obbs.min_distances.clear();
    assert_whole(&statistics(&Arc::new(module.clone())).unwrap(), &module);
}

#[test]
fn skips_are_the_whole_module() {
    let reason = |n: usize| SkipReason::ALL[n % SkipReason::ALL.len()];
    let mut next = matrices(|n| n.count_ones() % 2 == 0);
    let mut reasons = matrices(reason);
    let (full_shapes, decomposition_shapes) = shapes();
    let simple = SimpleSkipsModule {
        full_shapes: full_shapes.clone(),
        decomposition_shapes: decomposition_shapes.clone(),
        full_convex_hulls_simple_skips: next(),
        full_obbs_simple_skips: next(),
        full_bounding_spheres_simple_skips: next(),
        decomposition_convex_hulls_simple_skips: Some(next()),
        decomposition_obbs_simple_skips: None,
        decomposition_bounding_spheres_simple_skips: Some(next()),
        reasons: SkipReasons {
            full_convex_hulls: reasons(),
            full_obbs: reasons(),
            full_bounding_spheres: reasons(),
            decomposition_convex_hulls: Some(reasons()),
            decomposition_obbs: None,
            decomposition_bounding_spheres: Some(reasons()),
        },
    };
    assert_whole(&simple_skips(&Arc::new(simple.clone())).unwrap(), &simple);
    let edited = SkipsModule {
        skipped_reasons: SkippedReason::USUAL.to_vec(),
        edits: vec![SkipEdit {
            link_a: "a".to_owned(),
            link_b: "b".to_owned(),
            skip: true,
            reason: "why: not".to_owned(),
        }],
        full_shapes,
        decomposition_shapes,
        full_convex_hulls_skips: next(),
        full_obbs_skips: next(),
        full_bounding_spheres_skips: next(),
        decomposition_convex_hulls_skips: Some(next()),
        decomposition_obbs_skips: Some(next()),
        decomposition_bounding_spheres_skips: None,
    };
    assert_whole(&skips(&Arc::new(edited.clone())).unwrap(), &edited);
}
