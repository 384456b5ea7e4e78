//! Queries on batches of configurations, stored one after another in one slice.

use super::batch::check_room;
use super::checked::Checked;
use super::error::RobotError;
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::fill;

/// A motion takes at least as long as this many configurations.
const MOTION: usize = 8;

/// Writes `width` results of each configuration into `out`, as `ask` does for one.
///
/// # Errors
/// [`RobotError::Batch`], [`RobotError::Room`], [`RobotError::Cancelled`], and that of `ask` for the first configuration
/// that fails.
pub(super) fn answer<C: Checked, T: Send>(
    pairs: &C,
    configurations: &[f64],
    cancellation: &Cancellation,
    (out, width): (&mut [T], usize),
    ask: impl Fn(&[f64], &mut [T]) -> Result<(), RobotError> + Sync,
) -> Result<(), RobotError> {
    let rows = pairs.shapes().motion.rows(configurations)?;
    check_room(out.len(), rows.count, width)?;
    fill(out, width, C::BLOCK, |(): &mut (), k, out| {
        cancellation.check()?;
        ask(rows.row(k), out)
    })
}

/// As [`answer`], for motions from each configuration of `starts` to that of `ends`.
///
/// # Errors
/// As there.
pub(super) fn answer_edges<C: Checked, const N: usize>(
    pairs: &C,
    [starts, ends]: [&[f64]; 2],
    cancellation: &Cancellation,
    out: &mut [f64],
    ask: impl Fn(&[f64], &[f64]) -> Result<[f64; N], RobotError> + Sync,
) -> Result<(), RobotError> {
    let motion = &pairs.shapes().motion;
    let ends = motion.rows(ends)?;
    check_room(starts.len(), ends.count, motion.kinematics.num_dofs())?;
    let starts = motion.rows(starts)?;
    check_room(out.len(), ends.count, N)?;
    fill(out, N, C::BLOCK.div_ceil(MOTION), |(): &mut (), k, out| {
        cancellation.check()?;
        out.copy_from_slice(&ask(starts.row(k), ends.row(k))?);
        Ok(())
    })
}
