//! Plans the number of configurations.

/// The work of computing the distances of one kind of shapes. The unit is one distance between two spheres, about a
/// nanosecond.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Once, in total.
    pub once: u64,
    /// Per configuration.
    pub each: u64,
}

/// Work of the distance between two boxes, measured on links of robots.
pub const BOX: u64 = 20;
/// Work of the distance between two hulls.
pub const HULL: u64 = 40;
/// Work of a link's pose.
pub const POSE: u64 = 50;

/// As many configurations are held in memory at once.
pub(super) const AT_ONCE: u32 = 4096;

/// The work that a validation does by default: about a quarter of a second of one core.
const DEFAULT: u64 = 250_000_000;
/// Work allowed with `--deep`: minutes. Bounds what a number in a document can demand.
const DEEP: u64 = 2_000_000_000_000;

/// Configurations are processed eight at a time; fewer take just as long.
const LEAST: u32 = 8;

pub fn budget(deep: bool) -> u64 {
    if deep { DEEP } else { DEFAULT }
}

/// The number of configurations, out of `num_samples` and from the first on, for each kind. The kinds with the least
/// work are computed completely as long as the budget lasts. The rest of it goes to equal numbers of configurations of
/// the others, at least eight of each.
pub fn configurations(kinds: &[Option<Work>], num_samples: u32, budget: u64) -> Vec<u32> {
    let in_full =
        |work: &Work| work.each.saturating_mul(u64::from(num_samples)).saturating_add(work.once);
    let mut order: Vec<(u64, usize)> = kinds
        .iter()
        .enumerate()
        .filter_map(|(at, work)| Some((in_full(work.as_ref()?), at)))
        .collect();
    order.sort_unstable();
    let mut planned = vec![0; kinds.len()];
    let mut left = budget;
    let mut others = Work::default();
    for (cost, at) in order {
        match left.checked_sub(cost) {
            Some(rest) => {
                left = rest;
                planned[at] = num_samples;
            }
            None => {
                let work = kinds[at].unwrap_or_default();
                others.once = others.once.saturating_add(work.once);
                others.each = others.each.saturating_add(work.each);
                planned[at] = LEAST;
            }
        }
    }
    let each = others.each.max(1).saturating_mul(u64::from(LEAST));
    let eights = left.saturating_sub(others.once) / each;
    let some = u32::try_from(eights).unwrap_or(u32::MAX).max(1).saturating_mul(LEAST).min(AT_ONCE);
    for n in &mut planned {
        if *n != num_samples {
            *n = some.min(num_samples) * u32::from(*n > 0);
        }
    }
    planned
}
