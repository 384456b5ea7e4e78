//! The documents of modules with matrices over shapes, written row by row: for a thousand links they have millions of
//! elements.

use std::sync::Arc;

use serde::Serialize;
use serde_json::Value;

use urdd_directory::document::{Document, Member, Rows};
use urdd_format::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule as StatisticsModule,
};
use urdd_format::link_shapes_simple_skips::LinkShapesSimpleSkipsModule as SimpleSkipsModule;
use urdd_format::link_shapes_skips::LinkShapesSkipsModule as SkipsModule;
use urdd_format::shape_kind::{OfKinds, ShapeKind};

/// `link_shapes_distance_statistics_module`.
pub(super) fn statistics(module: &Arc<StatisticsModule>) -> Result<Document, serde_json::Error> {
    type Matrix = fn(&DistanceStatistics) -> &Vec<Vec<f64>>;
    let matrices: [(&str, Matrix); 3] = [
        ("mean_distances", |one| &one.mean_distances),
        ("min_distances", |one| &one.min_distances),
        ("max_distances", |one| &one.max_distances),
    ];
    let mut members = vec![
        ("num_samples", value(&module.num_samples)?),
        ("full_shapes", value(&module.full_shapes)?),
        ("decomposition_shapes", value(&module.decomposition_shapes)?),
    ];
    for kind in ShapeKind::ALL {
        let member = match module.of_kind(kind) {
            Some(_) => Member::Object(
                matrices
                    .map(|(name, matrix)| {
                        let rows = Rows::of(module, move |m| {
                            m.of_kind(kind).map_or(&[][..], |one| matrix(one))
                        });
                        (name, Member::Rows(rows))
                    })
                    .into(),
            ),
            None => Member::Value(Value::Null),
        };
        members.push((kind.key(), member));
    }
    Ok(Document::Object(members))
}

/// `link_shapes_simple_skips_module`.
pub(super) fn simple_skips(module: &Arc<SimpleSkipsModule>) -> Result<Document, serde_json::Error> {
    let mut members = vec![
        ("full_shapes", value(&module.full_shapes)?),
        ("decomposition_shapes", value(&module.decomposition_shapes)?),
    ];
    members.extend(matrices(module, |m| m));
    let reasons = matrices(module, |m| &m.reasons).collect();
    members.push(("reasons", Member::Object(reasons)));
    Ok(Document::Object(members))
}

/// `link_shapes_skips_module`.
pub(super) fn skips(module: &Arc<SkipsModule>) -> Result<Document, serde_json::Error> {
    let mut members = vec![
        ("skipped_reasons", value(&module.skipped_reasons)?),
        ("edits", value(&module.edits)?),
        ("full_shapes", value(&module.full_shapes)?),
        ("decomposition_shapes", value(&module.decomposition_shapes)?),
    ];
    members.extend(matrices(module, |m| m));
    Ok(Document::Object(members))
}

fn value(of: &impl Serialize) -> Result<Member, serde_json::Error> {
    serde_json::to_value(of).map(Member::Value)
}

/// The matrices of a module, one for each kind of shape; null if missing.
fn matrices<M, S, T>(
    module: &Arc<M>,
    part: fn(&M) -> &S,
) -> impl Iterator<Item = (&'static str, Member)>
where
    M: Send + Sync + 'static,
    S: OfKinds<Value = Vec<Vec<T>>> + 'static,
    T: Serialize + 'static,
{
    ShapeKind::ALL.into_iter().map(move |kind| {
        let rows = part(module).of_kind(kind).map(|_| {
            Rows::of(module, move |m| part(m).of_kind(kind).map_or(&[][..], Vec::as_slice))
        });
        (S::KEYS[kind as usize], Member::rows_or_null(rows))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use urdd_directory::canonical;
    use urdd_format::index::{Count, LinkIdx, PieceIdx};
    use urdd_format::link_shapes_simple_skips::{SkipReason, SkipReasons};
    use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
    use urdd_format::shapes::PieceShape;

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
}
