//! Counts contacts of the shapes that a link-level format treats differently from the URDD.

use std::collections::HashMap;

use super::error::ExportError;
use super::layout::Layout;
use super::options::PairOptions;
use super::pairs::{Contacts, LinkPair, pairs};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_robot::{Robot, RobotError, ShapeKind};

/// Number of sampled configurations to evaluate if the URDD does not record its own.
const USUAL_SAMPLES: u32 = 1_000;
/// Maximum number of sampled configurations to evaluate.
const MAX_SAMPLES: u32 = 10_000;

/// Every pair of links with shapes, sorted by index, as a link-level format represents it.
pub(super) fn link_pairs(
    robot: &Robot,
    layout: &Layout,
    options: &PairOptions,
) -> Result<Vec<LinkPair>, ExportError> {
    let reasons = options.reasons.as_deref();
    let mut pairs =
        pairs::<ExportError>(robot, layout, options.shapes, reasons, options.keep_pairs)?;
    count(robot, layout, options.shapes, &mut pairs)?;
    Ok(pairs)
}

/// Counts the contacts of mixed pairs, except those that differ only by the reason `Never`. Counts nothing without
/// bounds, since there are then no sampled configurations.
fn count(
    robot: &Robot,
    layout: &Layout,
    kind: ShapeKind,
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
    let samples = robot.num_samples()?.unwrap_or(USUAL_SAMPLES).min(MAX_SAMPLES);
    let sampled: Vec<f64> =
        (0..u64::from(samples)).flat_map(|k| configurations.random(k)).collect();
    let contacts = |checked: bool| -> Result<HashMap<[usize; 2], usize>, RobotError> {
        let is_wanted = |shapes: [(usize, usize); 2]| {
            let mut shapes = shapes.map(|shape| layout.shape(shape));
            shapes.sort_unstable();
            of_shapes.get(&shapes) == Some(&checked)
        };
        let found = robot
            .proximity_of(kind, is_wanted)?
            .contacts_of_links(&sampled, |link| layout.body(link))?
            .into_iter();
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
