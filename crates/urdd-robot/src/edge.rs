//! Motions on a straight line between two configurations: sampled, or proved to be free.

use super::error::RobotError;
use super::proximity::{Placed, Workspace};
use arrayvec::ArrayVec;
use urdd_geometry::convex::across::AT_ONCE;
use urdd_kinematics::Travel;

/// The distance beyond the margin that a proof needs, m: without it, a motion that grazes would take steps without end.
const SLACK: f64 = 1e-4;

/// How a motion is checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeSettings {
    /// The distance that must be kept, m.
    pub margin: f64,
    /// Between two checked configurations no point of the robot travels farther than this, m. `None` proves that the
    /// motion is free, which needs 0.1 mm more than the margin.
    pub resolution: Option<f64>,
}

impl Default for EdgeSettings {
    fn default() -> Self {
        EdgeSettings { margin: 0.0, resolution: Some(0.01) }
    }
}

/// A margin, m: finite, and not negative.
pub(super) fn check_margin(margin: f64) -> Result<f64, RobotError> {
    match margin.is_finite() && margin >= 0.0 {
        true => Ok(margin),
        false => Err(RobotError::Setting("a margin is finite, and not below 0 m")),
    }
}

/// Pairs that can be checked in a configuration and along a motion.
pub(super) trait Checked {
    /// A pair of shapes.
    type Pair: Copy;
    /// The pairs that can come within a margin (m) or leave it, each with its place in `rates`.
    fn pairs(&self, margin: f64) -> impl Iterator<Item = (Self::Pair, usize)>;
    /// A lower bound of the distance of a pair, m; not positive if it may touch.
    fn bound(&self, placed: &Placed, pair: Self::Pair) -> f64;
    /// The distances of some pairs, at most [`AT_ONCE`], m.
    fn values(&self, placed: &Placed, pairs: &[Self::Pair], values: &mut [f64]);
    /// Whether any pair touches or overlaps.
    fn touches(&self, placed: &Placed) -> bool;
    fn place(&self, configuration: &[f64], placed: &mut Placed) -> Result<(), RobotError>;
    fn travel(&self, start: &[f64], end: &[f64]) -> Result<Travel<'_>, RobotError>;
    /// Bounds on how far pairs move toward each other, m.
    fn rates(&self, travel: &Travel) -> Vec<f64>;
    /// The farthest that a point of a shape travels, m.
    fn farthest(&self, travel: &Travel) -> f64;
}

/// Whether any pair is at most `margin` apart, m. Stops at the first such pairs.
pub(super) fn any_within(checked: &impl Checked, placed: &Placed, margin: f64) -> bool {
    if margin == 0.0 {
        return checked.touches(placed);
    }
    let pairs = checked.pairs(margin).map(|(pair, _)| pair);
    let near = pairs.filter(|pair| checked.bound(placed, *pair) <= margin);
    let mut near = near.peekable();
    while near.peek().is_some() {
        let pairs: ArrayVec<_, AT_ONCE> = near.by_ref().take(AT_ONCE).collect();
        let mut values = [f64::INFINITY; AT_ONCE];
        checked.values(placed, &pairs, &mut values[..pairs.len()]);
        if values.iter().any(|value| *value <= margin) {
            return true;
        }
    }
    false
}

/// The part of a motion in which no pair can come nearer than `margin` (m), at most 1.
fn least_safe_part(checked: &impl Checked, placed: &Placed, rates: &[f64], margin: f64) -> f64 {
    let mut least = 1.0f64;
    let mut pairs = checked.pairs(margin);
    loop {
        let is_needed = |(pair, rate): &(_, usize)| {
            safe_part(checked.bound(placed, *pair), rates[*rate], margin) < least
        };
        let near: ArrayVec<_, AT_ONCE> = pairs.by_ref().filter(is_needed).take(AT_ONCE).collect();
        if near.is_empty() {
            return least;
        }
        let of: ArrayVec<_, AT_ONCE> = near.iter().map(|(pair, _)| *pair).collect();
        let mut values = [f64::INFINITY; AT_ONCE];
        checked.values(placed, &of, &mut values[..of.len()]);
        for (value, (_, rate)) in values.iter().zip(&near) {
            least = least.min(safe_part(*value, rates[*rate], margin));
        }
    }
}

/// Where a straight motion is not free, as a part of it from 0 to 1; `None` if it is free.
pub(super) fn blocked(
    checked: &impl Checked,
    [start, end]: [&[f64]; 2],
    settings: &EdgeSettings,
    workspace: &mut Workspace,
) -> Result<Option<f64>, RobotError> {
    let margin = check_margin(settings.margin)?;
    let travel = checked.travel(start, end)?;
    let placed = &mut workspace.placed;
    let mut configuration = start.to_vec();
    let mut place = |part: f64, placed: &mut Placed| {
        for ((now, from), to) in configuration.iter_mut().zip(start).zip(end) {
            *now = if part == 1.0 { *to } else { from + part * (to - from) };
        }
        checked.place(&configuration, placed)
    };
    let Some(resolution) = settings.resolution else {
        let rates = checked.rates(&travel);
        let mut part = 0.0;
        loop {
            place(part, placed)?;
            let safe = least_safe_part(checked, placed, &rates, margin);
            if safe <= 0.0 {
                return Ok(Some(part));
            }
            if part + safe >= 1.0 {
                return Ok(None);
            }
            part += safe;
        }
    };
    if !(resolution.is_finite() && resolution > 0.0) {
        return Err(RobotError::Setting("a resolution is finite, and above 0 m"));
    }
    let steps = (checked.farthest(&travel) / resolution).ceil().max(1.0);
    if steps > MAX_STEPS {
        return Err(RobotError::Setting(
            "more than a million configurations between two: give a coarser resolution",
        ));
    }
    let steps = steps as u64;
    for k in std::iter::once(steps).chain(halving(steps)) {
        let part = k as f64 / steps as f64;
        place(part, placed)?;
        if any_within(checked, placed, margin) {
            return Ok(Some(part));
        }
    }
    Ok(None)
}

/// The most configurations that are checked between two.
const MAX_STEPS: f64 = 1e6;

/// The numbers from 0 to below `count`, the halves first: what is far from the ends of a motion is blocked most often.
fn halving(count: u64) -> impl Iterator<Item = u64> {
    let bits = 64 - (count.max(1) - 1).leading_zeros();
    let reversed = move |k: u64| match bits {
        0 => 0,
        bits => k.reverse_bits() >> (64 - bits),
    };
    (0..1u64 << bits).map(reversed).filter(move |k| *k < count)
}

/// The part of a motion in which a pair at `distance` (m) that moves at most `rate` (m in the whole motion) keeps more
/// than `margin`.
fn safe_part(distance: f64, rate: f64, margin: f64) -> f64 {
    let left = distance - margin;
    let needed = if rate > 0.0 { SLACK } else { 0.0 };
    match (left <= needed, rate > 0.0) {
        (true, _) => 0.0,
        // More than what is rounded.
        (false, true) => left / (rate * (1.0 + 1e-9)),
        (false, false) => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_comes_once() {
        for count in [1, 2, 3, 7, 8, 100] {
            let mut all: Vec<u64> = halving(count).collect();
            assert_eq!(all[0], 0);
            if count > 2 {
                assert!(all[1] == (count.next_power_of_two() / 2).min(all[1]));
            }
            all.sort_unstable();
            assert_eq!(all, (0..count).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_pair_that_does_not_move_is_safe_for_the_whole_motion() {
        assert_eq!(safe_part(0.5, 0.0, 0.1), 1.0);
        assert!((safe_part(0.5, 2.0, 0.1) - 0.2).abs() < 1e-8);
        assert_eq!(safe_part(0.1, 0.0, 0.1), 0.0);
        // What hardly keeps apart is safe only if it never moves.
        assert_eq!([1.0, 0.0].map(|rate| safe_part(1e-5, rate, 0.0)), [0.0, 1.0]);
    }
}
