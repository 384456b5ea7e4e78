//! Counts contacts of the shapes that a link-level format treats differently from the URDD.

use std::collections::HashMap;

use crate::pairs::pairs;
use crate::{Contacts, ExportError, Judged, Layout, LinkPair, ModelOptions};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_robot::{Robot, RobotError, ShapeKind, Skips};

/// Number of sampled configurations to evaluate if the URDD does not record its own.
const USUAL_SAMPLES: u32 = 1_000;
/// Maximum number of sampled configurations to evaluate.
const MAX_SAMPLES: u32 = 10_000;

/// By what pairs are judged.
pub(super) enum Basis {
    /// By the URDD's own skips of a kind of shapes.
    Kind(ShapeKind, Skips),
    /// By shapes that only the export has.
    Written(Box<Judged>),
}

impl Basis {
    /// The shapes, and which pairs of them are skipped.
    pub fn skips(&self) -> &Skips {
        match self {
            Basis::Kind(_, skips) => skips,
            Basis::Written(judged) => &judged.skips,
        }
    }

    /// Every pair of links with shapes, sorted by index, as a format of pairs of links, or of pieces, represents them; the
    /// former with contacts.
    pub fn link_pairs(
        &self,
        robot: &Robot,
        layout: &Layout,
        links: &[String],
        options: &ModelOptions,
        of_pieces: bool,
    ) -> Result<Vec<LinkPair>, ExportError> {
        let (reasons, keeps) = (options.reasons.as_deref(), options.keep_pairs && !of_pieces);
        let mut pairs = pairs(self.skips(), layout, links, reasons, keeps)?;
        if !of_pieces {
            count(robot, layout, self, &mut pairs)?;
        }
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
        Ok(match basis {
            Basis::Written(judged) => judged.contacts(is_wanted, body),
            Basis::Kind(kind, _) => {
                let found = robot.proximity_of(*kind, is_wanted)?;
                found.contacts_of_links(&sampled, body)?.into_iter().collect()
            }
        })
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
