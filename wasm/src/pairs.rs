//! Recorded data of pairs of shapes: distance statistics, skips and reasons.

use std::collections::HashMap;

use serde_json::{Value, json};
use urdd_document::shape_matrices::{Statistics, at, shape_lists, statistics};
use urdd_document::urdd::Urdd;
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::registry::ModuleKind;
use urdd_robot::{EditedSkips, Robot, ShapeKind, Skips};

const STATISTICS: ModuleKind = ModuleKind::LinkShapesDistanceStatistics;

/// The modules, and the index of each shape.
pub struct Pairs {
    part: Urdd,
    full: HashMap<(usize, usize), usize>,
    pieces: HashMap<(usize, usize), usize>,
}

impl Pairs {
    /// Reads the modules that are present.
    pub fn read(robot: &Robot) -> Result<Self, String> {
        let part = robot.part_as_it_is(&[STATISTICS]).map_err(|error| error.to_string())?;
        let (mut full, mut pieces) = (HashMap::new(), HashMap::new());
        if let Some((links, shapes)) = part.document(STATISTICS).and_then(shape_lists) {
            full.extend(links.iter().enumerate().map(|(k, link)| ((link.get(), 0), k)));
            let place = |(k, shape): (usize, &urdd_format::shapes::PieceShape)| {
                ((shape.link_idx.get(), shape.piece_idx.get()), k)
            };
            pieces.extend(shapes.iter().enumerate().map(place));
        }
        Ok(Self { part, full, pieces })
    }

    fn of_kind(&self, kind: ShapeKind) -> Option<Statistics<'_>> {
        statistics(self.part.document(STATISTICS)?)?[kind as usize]
    }

    /// `min`, `mean` and `max` of the pair, in metres, if recorded.
    pub fn statistics(&self, kind: ShapeKind, links: [usize; 2], pieces: [usize; 2]) -> Value {
        let index = match kind.is_of_links() {
            true => &self.full,
            false => &self.pieces,
        };
        let shape = |k: usize| index.get(&(links[k], pieces[k])).copied();
        let found = || {
            let (i, j, all) = (shape(0)?, shape(1)?, self.of_kind(kind)?);
            Some(json!({
                "min": at(all.min, i, j)?,
                "mean": at(all.mean, i, j)?,
                "max": at(all.max, i, j)?,
            }))
        };
        found().unwrap_or(Value::Null)
    }

    /// Number of pairs of shapes, including skipped ones; null if the URDD does not record it.
    pub fn count(&self, kind: ShapeKind) -> Value {
        let shapes = match kind.is_of_links() {
            true => self.full.len(),
            false => self.pieces.len(),
        };
        match shapes {
            0 => Value::Null,
            shapes => json!(shapes * (shapes - 1) / 2),
        }
    }

    /// Number of configurations that the statistics cover.
    pub fn num_samples(&self, kind: ShapeKind) -> Value {
        json!(self.of_kind(kind).and_then(|all| all.num_samples))
    }

    /// `places` (the link and the piece of each shape), `skipped` (a row of `0` and `1` for each shape), `reasons` (a
    /// row of letters for each shape; null if there are none): `s` same link, `a` always, `j` adjacent, `d` default,
    /// `n` never, `-` none, `?` unknown; and the `edits` and `skipped_reasons` of `link_shapes_skips_module`.
    pub fn skips(&self, kind: ShapeKind, skips: &Skips) -> Value {
        let count = skips.len();
        let row = |i: usize| -> String {
            let letter = |j: usize| if skips.is_skipped(i, j) { '1' } else { '0' };
            (0..count).map(letter).collect()
        };
        let reasons = |i: usize| -> String {
            let letter = |j: usize| skips.reason(i, j).map_or('?', letter_of);
            (0..count).map(letter).collect()
        };
        let has_reasons = count > 0 && skips.reason(0, 0).is_some();
        json!({
            "kind": kind.name(),
            "places": skips.places(),
            "skipped": (0..count).map(row).collect::<Vec<_>>(),
            "reasons": has_reasons.then(|| (0..count).map(reasons).collect::<Vec<_>>()),
            "edits": skips.skipped_reasons().map(|_| skips.edits()),
            "skipped_reasons": skips.skipped_reasons(),
        })
    }
}

impl Pairs {
    /// As [`Pairs::skips`], with new edits, and with the `files` that change.
    pub fn edited(&self, kind: ShapeKind, skips: &Skips, edited: &EditedSkips) -> Value {
        let mut answer = self.skips(kind, &edited.skips(kind, skips));
        let files = edited
            .files
            .iter()
            .map(|(path, bytes)| json!({ "path": path, "text": String::from_utf8_lossy(bytes) }));
        answer["files"] = files.collect();
        answer
    }
}

fn letter_of(reason: SkipReason) -> char {
    match reason {
        SkipReason::SameLink => 's',
        SkipReason::Always => 'a',
        SkipReason::Adjacent => 'j',
        SkipReason::Default => 'd',
        SkipReason::Never => 'n',
        SkipReason::None => '-',
    }
}
