//! The results of batches of configurations: their allocation, and the room for them.

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
