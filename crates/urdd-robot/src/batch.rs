//! Many configurations at once: room for the answers, and the threads that write them.

use rayon::iter::repeat_n;
use rayon::prelude::*;

use super::error::RobotError;

/// Room for the answers of `count` configurations, `width` values each: a caller decides how many these are.
///
/// # Errors
/// [`RobotError::Memory`] where there is not enough memory.
pub(super) fn room<T: Clone + Default + Send>(
    count: usize,
    width: usize,
) -> Result<Vec<T>, RobotError> {
    let memory = RobotError::Memory { count, width };
    let Some(values) = count.checked_mul(width) else {
        return Err(memory);
    };
    let mut room = Vec::new();
    room.try_reserve_exact(values).map_err(|_| memory)?;
    room.par_extend(repeat_n(T::default(), values));
    Ok(room)
}

/// Writes the answers of many configurations, `width` values each, into `out`: `block` of them at a time, by all
/// threads of rayon's pool. `start` makes what the configurations of a block share; `write` is called with that, the
/// number of the configuration and its part of `out`. Besides what these two allocate, it takes no memory.
///
/// # Errors
/// What `write` returns for the first configuration that has an error; those after it may not be written then.
pub fn fill<T: Send, S, E: Send>(
    out: &mut [T],
    width: usize,
    block: usize,
    start: impl Fn() -> S + Sync,
    write: impl Fn(&mut S, usize, &mut [T]) -> Result<(), E> + Sync,
) -> Result<(), E> {
    if width == 0 {
        return Ok(());
    }
    let blocks = out.par_chunks_mut(width.saturating_mul(block)).enumerate();
    let error = blocks.find_map_first(|(number, out)| {
        let mut shared = start();
        let mut each = out.chunks_mut(width).enumerate();
        each.find_map(|(k, row)| write(&mut shared, number * block + k, row).err())
    });
    error.map_or(Ok(()), Err)
}

/// # Errors
/// [`RobotError::Room`] where `found` values are not `count` times `width`.
pub(super) fn check_room(found: usize, count: usize, width: usize) -> Result<(), RobotError> {
    match count.checked_mul(width) {
        Some(expected) if expected == found => Ok(()),
        _ => Err(RobotError::Room {
            found,
            count,
            width,
        }),
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
        assert_eq!(fill(&mut out, 3, 7, || (), write), Err(517));
        let all = |_: &mut (), k: usize, out: &mut [usize]| write(&mut (), k % 500, out);
        assert_eq!(fill(&mut out, 3, 7, || (), all), Ok(()));
        let expected = (0..1000).flat_map(|k| [k % 500; 3]);
        assert!(out.into_iter().eq(expected));
        assert_eq!(fill(&mut [0; 0], 0, 7, || (), write), Ok(()));
    }

    #[test]
    fn room_is_for_all_answers_and_no_more() {
        assert_eq!(check_room(6, 3, 2), Ok(()));
        for (found, count, width) in [(5, 3, 2), (0, usize::MAX, 2)] {
            let expected = RobotError::Room {
                found,
                count,
                width,
            };
            assert_eq!(check_room(found, count, width), Err(expected));
        }
    }
}
