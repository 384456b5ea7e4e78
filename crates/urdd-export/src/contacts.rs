//! Counts contacts of the shapes that a link-level format treats differently from the URDD.

use std::collections::HashMap;

use super::error::ExportError;
use super::layout::Layout;
use super::options::PairOptions;
use super::pairs::{Contacts, LinkPair, pairs};
use super::reasons::Judged;
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_robot::{Robot, RobotError, ShapeKind};

/// Number of sampled configurations to evaluate if the URDD does not record its own.
const USUAL_SAMPLES: u32 = 1_000;
/// Maximum number of sampled configurations to evaluate.
const MAX_SAMPLES: u32 = 10_000;

/// By what pairs are judged.
pub(super) enum Basis {
    /// By the URDD's own skips of a kind of shapes.
    Kind(ShapeKind),
    /// By shapes that only the export has.
    Written(Box<Judged>),
}

impl Basis {
    /// The link and the number of each shape.
    pub fn places(&self, robot: &Robot) -> Result<Vec<(usize, usize)>, RobotError> {
        Ok(match self {
            Basis::Kind(kind) => robot.skips(*kind)?.places().to_vec(),
            Basis::Written(judged) => judged.skips.places().to_vec(),
        })
    }

    /// Every pair of links with shapes, sorted by index. Does not count contacts.
    pub fn pairs(
        &self,
        robot: &Robot,
        layout: &Layout,
        links: &[String],
        reasons: Option<&[SkippedReason]>,
        keep_pairs: bool,
    ) -> Result<Vec<LinkPair>, ExportError> {
        Ok(match self {
            Basis::Kind(kind) => pairs(&robot.skips(*kind)?, layout, links, reasons, keep_pairs)?,
            Basis::Written(judged) => pairs(&judged.skips, layout, links, reasons, keep_pairs)?,
        })
    }

    /// As a link-level format represents them: the same, with contacts.
    pub fn link_pairs(
        &self,
        robot: &Robot,
        layout: &Layout,
        links: &[String],
        options: &PairOptions,
    ) -> Result<Vec<LinkPair>, ExportError> {
        let (reasons, keep_pairs) = (options.reasons.as_deref(), options.keep_pairs);
        let mut pairs = self.pairs(robot, layout, links, reasons, keep_pairs)?;
        count(robot, layout, self, &mut pairs)?;
        Ok(pairs)
    }
}

/// The number of sampled configurations by which pairs are judged here.
pub(super) fn num_samples(robot: &Robot) -> Result<u32, RobotError> {
    Ok(robot.num_samples()?.unwrap_or(USUAL_SAMPLES).min(MAX_SAMPLES))
}

/// Counts the contacts of mixed pairs, except those that differ only by the reason `Never`. Counts nothing without
/// bounds, since there are then no sampled configurations.
fn count(
    robot: &Robot,
    layout: &Layout,
    basis: &Basis,
    pairs: &mut [LinkPair],
) -> Result<(), RobotError> {
    let of_shapes: HashMap<[(usize, usize); 2], bool> = pairs
        .iter()
        .filter(|pair| !matches!(pair.reason, Some(SkipReason::Never | SkipReason::None)))
        .flat_map(|pair| {
            let [a, b] = pair.links;
            let mixed = pair.mixed.iter();
            mixed.flat_map(move |mixed| {
                let checked = mixed.checked.iter().map(|pieces| (pieces, true));
                let skipped = mixed.skipped.iter().map(|pieces| (pieces, false));
                let both = checked.chain(skipped);
                both.map(move |(pieces, checked)| ([(a, pieces[0]), (b, pieces[1])], checked))
            })
        })
        .collect();
    if of_shapes.is_empty() {
        return Ok(());
    }
    let configurations = match robot.configurations() {
        Err(RobotError::Missing(_)) => return Ok(()),
        other => other?,
    };
    let samples = num_samples(robot)?;
    let sampled: Vec<f64> =
        (0..u64::from(samples)).flat_map(|k| configurations.random(k)).collect();
    let body = |link: usize| layout.body(link);
    let contacts = |checked: bool| -> Result<HashMap<[usize; 2], usize>, RobotError> {
        let is_wanted = |shapes: [(usize, usize); 2]| {
            let mut shapes = shapes.map(|shape| layout.shape(shape));
            shapes.sort_unstable();
            of_shapes.get(&shapes) == Some(&checked)
        };
        let kind = match basis {
            Basis::Written(judged) => return Ok(judged.contacts(is_wanted, body)),
            Basis::Kind(kind) => *kind,
        };
        let found = robot.proximity_of(kind, is_wanted)?.contacts_of_links(&sampled, body)?;
        let found = found.into_iter();
        Ok(found
            .map(|(mut links, count)| {
                links.sort_unstable();
                (links, count)
            })
            .collect())
    };
    let (checked, skipped) = (contacts(true)?, contacts(false)?);
    for pair in pairs {
        if let Some(mixed) = &mut pair.mixed
            && let (Some(checked), Some(skipped)) =
                (checked.get(&pair.links), skipped.get(&pair.links))
        {
            mixed.contacts = Some(Contacts { checked: *checked, skipped: *skipped, samples });
        }
    }
    Ok(())
}
