//! Batches of configurations: allocation of the results, and the threads that write them.

use rayon::iter::repeat_n;
use rayon::prelude::*;

use super::error::RobotError;
use super::memory::has_room;

/// Allocates the results of `count` configurations, `width` values each. The caller determines both numbers.
///
/// # Errors
/// [`RobotError::Memory`] if there is not enough memory.
pub(super) fn room<T: Clone + Default + Send>(
    count: usize,
    width: usize,
) -> Result<Vec<T>, RobotError> {
    let memory = RobotError::Memory { count, width };
    let Some(values) = count.checked_mul(width) else {
        return Err(memory);
    };
    if !has_room(values.saturating_mul(size_of::<T>())) {
        return Err(memory);
    }
    let mut room = Vec::new();
    room.try_reserve_exact(values).map_err(|_| memory)?;
    room.par_extend(repeat_n(T::default(), values));
    Ok(room)
}

/// Writes the results of a batch of configurations, `width` values each, into `out`, in blocks of `block`
/// configurations on rayon's thread pool. `write` gets the scratch state that a block shares, the index of the
/// configuration and its part of `out`. A single block is written on the caller's thread. Apart from the state and
/// `write`, nothing allocates.
///
/// # Errors
/// The error of `write` for the first configuration that fails. Results after it may then be missing.
pub fn fill<T: Send, S: Default, E: Send>(
    out: &mut [T],
    width: usize,
    block: usize,
    write: impl Fn(&mut S, usize, &mut [T]) -> Result<(), E> + Sync,
) -> Result<(), E> {
    if width == 0 {
        return Ok(());
    }
    let write_block = |(number, out): (usize, &mut [T])| {
        let mut shared = S::default();
        let mut each = out.chunks_mut(width).enumerate();
        each.find_map(|(k, row)| write(&mut shared, number * block + k, row).err())
    };
    let size = width.saturating_mul(block);
    let error = match out.len() <= size {
        true => write_block((0, out)),
        false => (out.par_chunks_mut(size).enumerate()).find_map_first(write_block),
    };
    error.map_or(Ok(()), Err)
}

/// # Errors
/// [`RobotError::Room`] if `found` is not `count` times `width`.
pub(super) fn check_room(found: usize, count: usize, width: usize) -> Result<(), RobotError> {
    match count.checked_mul(width) {
        Some(expected) if expected == found => Ok(()),
        _ => Err(RobotError::Room { found, count, width }),
    }
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
    fn the_first_error_counts() {
        let mut out = vec![0; 3000];
        let write = |_: &mut (), k: usize, out: &mut [usize]| match k {
            517 | 900 => Err(k),
            _ => {
                out.fill(k);
                Ok(())
            }
        };
        assert_eq!(fill(&mut out, 3, 7, write), Err(517));
        let all = |_: &mut (), k: usize, out: &mut [usize]| write(&mut (), k % 500, out);
        assert_eq!(fill(&mut out, 3, 7, all), Ok(()));
        let expected = (0..1000).flat_map(|k| [k % 500; 3]);
        assert!(out.into_iter().eq(expected));
        assert_eq!(fill(&mut [0; 0], 0, 7, write), Ok(()));
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
