//! Chooses the margins of the pairs.

use super::labels::Labels;

/// The fraction of collisions in the calibration set that may be missed.
const MISSES: f64 = 0.005;
/// Maximum number of a pair's contacts with the highest outputs that form its tail.
const TAIL: usize = 10;
/// Expected misses of a pair at its first margin; each further level doubles them.
const FIRST_MISSES: f64 = 0.02;
/// Maximum number of margins to try per pair.
const LEVELS: usize = 14;

struct Pair {
    /// The configurations in which the output is at most the first margin, by descending output.
    order: Vec<u32>,
    /// How many of them are above the current margin.
    passed: usize,
    /// Descending margins, each with its expected number of misses.
    levels: Vec<Level>,
    /// Index of the current level.
    level: usize,
}

#[derive(Debug, Clone, Copy)]
pub struct Level {
    pub margin: f64,
    /// Expected number of missed collisions in the calibration set.
    misses: f64,
}

/// A step of a pair to another level.
struct Offer {
    pair: usize,
    level: usize,
    /// Free configurations cleared per collision missed.
    worth: f64,
}

/// The margin of each pair, in the unit of the outputs: a pair may be in contact if its output is at most its margin.
/// `clip` is the clip distance in that unit.
///
/// Few contacts have high outputs, and a margin fitted to just these would miss others. The expected misses are
/// therefore estimated from a tail: the excess of a pair's highest contacts over the next one is taken as exponentially
/// distributed. All pairs start with a margin that misses hardly any. The margin that clears the most free
/// configurations per miss is then lowered, until the expected misses reach the limit.
pub fn margins(outputs: &[f64], labels: &Labels, clip: f64) -> Vec<f64> {
    let num_pairs = labels.num_pairs;
    let count = labels.collides.len();
    let output = |k: u32, pair: usize| outputs[k as usize * num_pairs + pair];
    let is_contact = |k: u32, pair: usize| labels.row(k as usize)[pair] == 0.0;
    let all = || 0..u32::try_from(count).unwrap_or(u32::MAX);
    let contacts_of = |k: u32| labels.row(k as usize).iter().filter(|d| **d == 0.0).count();
    let pair = |pair: usize| {
        let contacts: Vec<u32> = all().filter(|k| is_contact(*k, pair)).collect();
        // A miss of this pair does not matter if another pair is in contact too.
        let alone = contacts.iter().filter(|k| contacts_of(**k) == 1).count();
        let alone = alone as f64 / contacts.len().max(1) as f64;
        let mut values: Vec<f64> = contacts.iter().map(|k| output(*k, pair)).collect();
        values.sort_by(|a, b| b.total_cmp(a));
        let levels = levels(&values, alone.max(LEAST_ALONE), clip);
        let first = levels[0].margin;
        let mut order: Vec<u32> = all().filter(|k| output(*k, pair) <= first).collect();
        order.sort_by(|a, b| output(*b, pair).total_cmp(&output(*a, pair)));
        Pair { order, passed: 0, levels, level: 0 }
    };
    let mut pairs: Vec<Pair> = (0..num_pairs).map(pair).collect();
    // The number of pairs that report a configuration as a possible collision.
    let mut held_by = vec![0_u32; count];
    for k in pairs.iter().flat_map(|pair| &pair.order) {
        held_by[*k as usize] += 1;
    }
    let colliding = labels.collides.iter().filter(|collides| **collides).count();
    let expected = pairs.iter().map(|pair| pair.levels[0].misses);
    let mut left = MISSES * colliding as f64 - expected.sum::<f64>();
    loop {
        let offers = pairs.iter().enumerate().filter_map(|(at, pair)| {
            let now = pair.levels[pair.level];
            let mut rest = pair.order[pair.passed..].iter().peekable();
            // A configuration that other pairs also report is cleared in part.
            let mut cleared = 0.0;
            let mut best: Option<Offer> = None;
            for (level, next) in pair.levels.iter().enumerate().skip(pair.level + 1) {
                while let Some(k) = rest.next_if(|k| output(**k, at) > next.margin) {
                    let k = *k as usize;
                    if !labels.collides[k] {
                        cleared += 1.0 / f64::from(held_by[k]);
                    }
                }
                let misses = next.misses - now.misses;
                if misses > left {
                    break;
                }
                let worth = cleared / misses;
                if cleared > 0.0 && best.as_ref().is_none_or(|best| worth > best.worth) {
                    best = Some(Offer { pair: at, level, worth });
                }
            }
            best
        });
        let best = offers.max_by(|a, b| a.worth.total_cmp(&b.worth).then(b.pair.cmp(&a.pair)));
        let Some(Offer { pair: at, level, .. }) = best else {
            return pairs.iter().map(|of| of.levels[of.level].margin).collect();
        };
        let pair = &mut pairs[at];
        left -= pair.levels[level].misses - pair.levels[pair.level].misses;
        pair.level = level;
        let margin = pair.levels[level].margin;
        let passed = pair.order[pair.passed..].iter().take_while(|k| output(**k, at) > margin);
        let passed: Vec<u32> = passed.copied().collect();
        pair.passed += passed.len();
        for k in passed {
            held_by[k as usize] -= 1;
        }
    }
}

/// Minimum fraction of a pair's misses that are taken as missed collisions.
const LEAST_ALONE: f64 = 0.1;
/// With fewer contacts than this, no tail is fitted.
const FEW: usize = 4;

/// The margin levels of a pair whose contacts have these outputs, descending.
pub fn levels(contacts: &[f64], alone: f64, clip: f64) -> Vec<Level> {
    if contacts.len() < FEW {
        let highest = contacts.first().copied().unwrap_or(-0.1 * clip);
        return vec![Level { margin: highest + 0.1 * clip, misses: 0.0 }];
    }
    let tail = (contacts.len() / 2).min(TAIL);
    let base = contacts[tail];
    let mean = contacts[..tail].iter().map(|value| value - base).sum::<f64>() / tail as f64;
    let mut levels: Vec<Level> = Vec::new();
    let mut misses = FIRST_MISSES;
    for _ in 0..LEVELS {
        let margin = match misses <= tail as f64 {
            true => base + mean * libm::log(tail as f64 / misses),
            // Enough contacts to count the misses.
            false if misses < contacts.len() as f64 / 4.0 => contacts[misses as usize],
            false => break,
        };
        let falls = levels.last().is_none_or(|last| margin < last.margin);
        if falls {
            levels.push(Level { margin, misses: misses * alone });
        }
        misses *= 2.0;
    }
    levels
}
