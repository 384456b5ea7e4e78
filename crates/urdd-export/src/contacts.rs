//! How often shapes touch of which a format that knows links only says the wrong thing.

use std::collections::HashMap;

use super::Options;
use super::pairs::{Contacts, LinkPair, pairs};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_robot::{Robot, RobotError, ShapeKind};

/// Sampled configurations that are looked at where the URDD does not say how many it took.
const USUAL_SAMPLES: u32 = 1_000;
/// Most sampled configurations that are looked at.
const MAX_SAMPLES: u32 = 10_000;

/// Every pair of links with shapes, by index: what a format that knows links only says of it, with [`Options::shapes`],
/// [`Options::reasons`] and [`Options::keep_pairs`]; [`super::Note::of_pair`] says what is wrong with that.
///
/// # Errors
/// Where the skips or the shapes are missing or of no use.
pub fn link_pairs(robot: &Robot, options: &Options) -> Result<Vec<LinkPair>, RobotError> {
    let mut pairs = pairs(robot, options)?;
    count(robot, options.shapes, &mut pairs)?;
    Ok(pairs)
}

/// Counts the contacts of mixed pairs, but of those that differ by the reason `Never` alone. Without bounds there are no
/// sampled configurations, and nothing is counted.
fn count(robot: &Robot, kind: ShapeKind, pairs: &mut [LinkPair]) -> Result<(), RobotError> {
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
    let samples = robot.num_samples()?.unwrap_or(USUAL_SAMPLES);
    let samples = samples.min(MAX_SAMPLES);
    let sampled: Vec<f64> = (0..u64::from(samples))
        .flat_map(|k| configurations.random(k))
        .collect();
    let contacts = |checked: bool| -> Result<HashMap<[usize; 2], usize>, RobotError> {
        let is_wanted = |mut shapes: [(usize, usize); 2]| {
            shapes.sort_unstable();
            of_shapes.get(&shapes) == Some(&checked)
        };
        let proximity = robot.proximity_of(kind, is_wanted)?;
        let found = proximity.contacts_of_links(&sampled)?.into_iter();
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
            mixed.contacts = Some(Contacts {
                checked: *checked,
                skipped: *skipped,
                samples,
            });
        }
    }
    Ok(())
}
