//! Pairs of links that no check for self-collision sees touch.

use std::fmt::{self, Write};
use std::path::Path;

use serde::Serialize;

use super::statics::SAMPLES;

use urdd_format::escape;
use urdd_robot::{Robot, RobotError, ShapeKind};

/// Maximum number of pairs in text for people.
const MOST_SHOWN: usize = 10;

/// Two links that are skipped because they touch in the default configuration, or in the reference configuration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SkippedContact {
    pub links: [String; 2],
    /// Number of the sampled configurations in which they touch.
    pub touching: usize,
    /// Number of the sampled configurations.
    pub num_samples: u32,
}

impl SkippedContact {
    /// Those of the URDD at `path`, most contacts first. Null if the modules for it are missing or cannot be read.
    pub fn all(path: &Path) -> Option<Vec<SkippedContact>> {
        Self::of(&Robot::open(path).ok()?).ok()
    }

    fn of(robot: &Robot) -> Result<Vec<SkippedContact>, RobotError> {
        let Some(hidden) = robot.skipped_contacts(ShapeKind::Pieces)? else {
            return Ok(Vec::new());
        };
        let space = robot.configurations()?;
        let num_samples = robot.num_samples()?.unwrap_or(SAMPLES).min(SAMPLES);
        let values: Vec<f64> = (0..num_samples).flat_map(|k| space.random(u64::from(k))).collect();
        let name = |link: usize| hidden.body_name(link).unwrap_or_default().to_owned();
        let found = hidden.contacts_of_links(&values, |link| link)?.into_iter();
        // Links that touch in all samples are as those that always do.
        let found = found.filter(|(_, touching)| *touching < num_samples as usize);
        let mut found: Vec<SkippedContact> = found
            .map(|(links, touching)| SkippedContact {
                links: links.map(name),
                touching,
                num_samples,
            })
            .collect();
        found.sort_by_key(|one| std::cmp::Reverse(one.touching));
        Ok(found)
    }
}

/// Writes the pairs for people.
pub fn write(found: &[SkippedContact], out: &mut impl Write) -> fmt::Result {
    let Some(SkippedContact { num_samples, .. }) = found.first() else {
        return Ok(());
    };
    let (pairs, touch) = if found.len() == 1 { ("pair", "touches") } else { ("pairs", "touch") };
    writeln!(
        out,
        "  skipped   {} {pairs} of links that {touch} at rest; other collisions count as free: of {num_samples} samples, in",
        found.len()
    )?;
    for SkippedContact { links: [a, b], touching, .. } in found.iter().take(MOST_SHOWN) {
        let share = 100.0 * *touching as f64 / f64::from(*num_samples);
        let [a, b] = [a, b].map(|name| escape::line(name));
        writeln!(out, "    {touching:>7} ({share:.1} %)  {a} - {b}")?;
    }
    match found.len().saturating_sub(MOST_SHOWN) {
        0 => Ok(()),
        more => writeln!(out, "            and {more} more"),
    }
}
