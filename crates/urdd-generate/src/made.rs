//! What a stage returns; and the documents of modules with matrices over shapes, written row by row: for a thousand links they
//! have millions of elements.

use std::collections::HashMap;
use std::sync::Arc;

use serde::Serialize;
use serde_json::Value;

use crate::error::{GenerateError, Result};
use urdd_directory::writer::{Document, Member, Rows};
use urdd_format::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule as StatisticsModule,
};
use urdd_format::link_shapes_simple_skips::LinkShapesSimpleSkipsModule as SimpleSkipsModule;
use urdd_format::link_shapes_skips::LinkShapesSkipsModule as SkipsModule;
use urdd_format::shape_kind::{OfKinds, ShapeKind};
use urdd_source::note::Note;

/// The SHA-256 of each file that was written or kept, by its path.
pub(super) type Digests = HashMap<String, String>;

pub(super) struct Made<T = ()> {
    /// The module; `None` if it is of no use for this robot.
    pub document: Option<Document>,
    pub files: Vec<MadeFile>,
    pub notes: Vec<Note>,
    /// What later stages use.
    pub product: T,
}

/// What a stage returns whose module later stages use.
pub(crate) type Shared<T> = Result<Made<Arc<T>>>;

pub(super) struct MadeFile {
    /// Path relative to the URDD's root.
    pub path: String,
    /// Its content, which a mesh reader or another link may share.
    pub bytes: Arc<Vec<u8>>,
}

/// A module without additional files, from its document.
pub(super) fn streamed<T>(
    document: Result<Document, serde_json::Error>,
    product: T,
) -> Result<Made<T>> {
    let document = document.map_err(|error| GenerateError::internal("", error))?;
    Ok(Made { document: Some(document), files: Vec::new(), notes: Vec::new(), product })
}

/// A module without additional files or product.
pub(super) fn made(module: &impl Serialize) -> Result<Made> {
    made_with(module, Vec::new(), ())
}

pub(super) fn made_with<T>(
    module: &impl Serialize,
    files: Vec<MadeFile>,
    product: T,
) -> Result<Made<T>> {
    let made = streamed(serde_json::to_value(module).map(Document::Whole), product)?;
    Ok(Made { files, ..made })
}

/// `link_shapes_distance_statistics_module`.
pub fn statistics(module: &Arc<StatisticsModule>) -> Result<Document, serde_json::Error> {
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
pub fn simple_skips(module: &Arc<SimpleSkipsModule>) -> Result<Document, serde_json::Error> {
    let mut members = vec![
        ("full_shapes", value(&module.full_shapes)?),
        ("decomposition_shapes", value(&module.decomposition_shapes)?),
    ];
    members.extend(matrices(module, |m| m));
    members.push(("reasons", Member::Object(matrices(module, |m| &m.reasons).collect())));
    Ok(Document::Object(members))
}

/// `link_shapes_skips_module`.
pub fn skips(module: &Arc<SkipsModule>) -> Result<Document, serde_json::Error> {
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
