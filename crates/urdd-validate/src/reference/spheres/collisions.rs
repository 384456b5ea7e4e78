//! In which sampled configurations pieces are in contact: SPEC 8.9.7.

use rayon::prelude::*;

use super::budget::Budget;
use crate::reference::distances::poses::Poses;
use crate::reference::learned::counts::COMPARISON;
use urdd_findings::skip::SkipReason;
use urdd_format::link_shapes_spheres::SPHERES_FIRST;
use urdd_geometry::convex::BodyPairs;

/// For each of the sampled configurations from the first one of 8.9.6 on, whether it is in collision.
///
/// # Errors
/// If a configuration has no poses, or it takes too much work.
pub fn collisions(
    pieces: &BodyPairs,
    poses: &Poses,
    count: u32,
    budget: &Budget,
) -> Result<Vec<bool>, SkipReason> {
    let base = 2_000 + 50 * poses.num_links() + 4 * pieces.num_shape_pairs();
    let one = |sample: u32| {
        let (_, poses) = poses.sampled(SPHERES_FIRST.wrapping_add(sample))?;
        let (collides, compared) = pieces.any_touches_and_work(&poses);
        budget.spend(base as u64 + COMPARISON * compared as u64)?;
        Ok(collides)
    };
    (0..count).into_par_iter().map(one).collect()
}
