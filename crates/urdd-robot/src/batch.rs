//! Batches of configurations, stored one after another in one slice: their results, and the memory for these.

use std::fs;

use rayon::iter::repeat_n;
use rayon::prelude::*;

use super::checked::Checked;
use super::error::RobotError;
use super::kept::Motion;
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::fill;

/// Allocates the results of `count` configurations, `width` values each. The caller determines both numbers.
///
/// # Errors
/// [`RobotError::Memory`] if there is not enough memory.
pub(super) fn room<T: Clone + Default + Send>(
    count: usize,
    width: usize,
) -> Result<Vec<T>, RobotError> {
    let memory = RobotError::Memory { count, width };
    let Some(values) = count.checked_mul(width) else { return Err(memory) };
    if !has_room(values.saturating_mul(size_of::<T>())) {
        return Err(memory);
    }
    let mut room = Vec::new();
    room.try_reserve_exact(values).map_err(|_| memory)?;
    room.par_extend(repeat_n(T::default(), values));
    Ok(room)
}

/// # Errors
/// [`RobotError::Room`] if `found` is not `count` times `width`.
pub(super) fn check_room(found: usize, count: usize, width: usize) -> Result<(), RobotError> {
    match count.checked_mul(width) {
        Some(expected) if expected == found => Ok(()),
        _ => Err(RobotError::Room { found, count, width }),
    }
}

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

/// As [`answer`], for motions from each configuration of `starts` to that of `ends`. `block` configurations are one piece of
/// work for a thread.
///
/// # Errors
/// As there.
pub(super) fn answer_edges<T: Copy + Send, const N: usize>(
    (motion, block): (&Motion, usize),
    [starts, ends]: [&[f64]; 2],
    cancellation: &Cancellation,
    out: &mut [T],
    ask: impl Fn(&[f64], &[f64]) -> Result<[T; N], RobotError> + Sync,
) -> Result<(), RobotError> {
    let ends = motion.rows(ends)?;
    check_room(starts.len(), ends.count, motion.kinematics.num_dofs())?;
    let starts = motion.rows(starts)?;
    check_room(out.len(), ends.count, N)?;
    fill(out, N, block.div_ceil(MOTION), |(): &mut (), k, out| {
        cancellation.check()?;
        out.copy_from_slice(&ask(starts.row(k), ends.row(k))?);
        Ok(())
    })
}

/// Results below this size are not compared with the memory that there is: reading it takes longer than making them, bytes.
const SMALL: usize = 64 << 20;

/// Whether this many bytes may be allocated and filled. An allocation alone does not tell on Linux: it succeeds, and the
/// system ends the process once it fills more than there is.
pub fn has_room(bytes: usize) -> bool {
    bytes < SMALL || available().is_none_or(|available| bytes as u64 <= available)
}

/// The bytes that this process can still take: those of the system, and of its control group (version 2), where both are
/// known. `None` on other systems than Linux.
fn available() -> Option<u64> {
    let number = |path: &str| fs::read_to_string(path).ok()?.trim().parse::<u64>().ok();
    let of_group = || {
        let most = number("/sys/fs/cgroup/memory.max")?;
        Some(most.saturating_sub(number("/sys/fs/cgroup/memory.current")?))
    };
    let of_system = fs::read_to_string("/proc/meminfo").ok()?;
    let of_system = of_system.lines().find_map(|line| {
        let kibibytes = line.strip_prefix("MemAvailable:")?.trim();
        let kibibytes = kibibytes.strip_suffix("kB")?.trim().parse::<u64>().ok()?;
        Some(kibibytes << 10)
    })?;
    Some(of_group().map_or(of_system, |of_group| of_group.min(of_system)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_any_memory_is_an_error() {
        for (count, width) in [(usize::MAX, 2), (usize::MAX / 16, 1), (1 << 40, 1 << 40)] {
            let found = room::<f64>(count, width);
            assert_eq!(found, Err(RobotError::Memory { count, width }));
        }
        assert_eq!(room::<bool>(3, 2), Ok(vec![false; 6]));
        assert_eq!(room::<f64>(usize::MAX, 0), Ok(Vec::new()));
    }

    #[test]
    fn room_is_for_all_answers_and_no_more() {
        assert_eq!(check_room(6, 3, 2), Ok(()));
        for (found, count, width) in [(5, 3, 2), (0, usize::MAX, 2)] {
            let expected = RobotError::Room { found, count, width };
            assert_eq!(check_room(found, count, width), Err(expected));
        }
    }

    /// As many bytes as the machine has are never free. Linux would give them, and end the process that fills them.
    #[test]
    #[cfg(target_os = "linux")]
    fn as_much_as_the_machine_has_is_refused() {
        let text = std::fs::read_to_string("/proc/meminfo").expect("a file");
        let total = text.split_whitespace().nth(1).expect("a number");
        let total: usize = total.parse().expect("a number");
        let refused = room::<f64>(total, 1024 / size_of::<f64>());
        assert!(matches!(refused, Err(RobotError::Memory { .. })));
        assert_eq!(room::<f64>(1000, 7).expect("room").len(), 7000);
    }
}
