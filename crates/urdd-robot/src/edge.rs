//! Motions on a straight line between two configurations: sampled, or proved to be free.

use super::checked::{Checked, any_within, check_margin};
use super::error::RobotError;
use super::workspace::Placed;
use arrayvec::ArrayVec;
use urdd_geometry::convex::across::AT_ONCE;

/// The distance beyond the margin that a proof needs, m: without it, a motion that grazes would take steps without end.
const SLACK: f64 = 1e-4;

/// The most configurations that are checked between two, and the most steps of a proof.
const MAX_SAMPLES: u64 = 1_000_000;
const MAX_STEPS: u64 = 100_000;

/// Halvings of the part in which a first contact is.
pub(super) const HALVINGS: u32 = 10;

/// How a motion is checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeSettings {
    /// The distance that must be kept, m.
    pub margin: f64,
    /// Between two checked configurations no point of the robot travels farther than this, m. `None` proves that the
    /// motion is free, which needs 0.1 mm more than the margin.
    pub resolution: Option<f64>,
    /// Whether the kinematic loops of the robot may be open on the way: the motion is then that of its spanning tree,
    /// straight in all DOFs. Without meaning for a tree.
    pub open_loops: bool,
}

impl Default for EdgeSettings {
    fn default() -> Self {
        EdgeSettings { margin: 0.0, resolution: Some(0.01), open_loops: false }
    }
}

/// Where a motion first comes too near, as parts of it from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstContact {
    /// The last part that is known to be free; 0 if the start is not.
    pub free: f64,
    /// The first part that is not.
    pub blocked: f64,
    /// Why it is not.
    pub obstruction: Obstruction,
}

/// Why a motion cannot go on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Obstruction {
    /// A pair is at most the margin apart, or is not proved farther apart.
    Contact,
    /// No configuration was found there in which the robot's loops are closed, within its bounds.
    Open,
    /// The DOFs that follow would have to jump, or arrive elsewhere than at the end: it is on another branch of the closed
    /// configurations.
    Branch,
}

impl FirstContact {
    pub(super) fn new(free: f64, blocked: f64) -> Self {
        FirstContact { free, blocked, obstruction: Obstruction::Contact }
    }
}

/// A motion, and the memory to check it.
struct Motion<'a, C> {
    checked: &'a C,
    ends: [&'a [f64]; 2],
    margin: f64,
    placed: &'a mut Placed,
    configuration: Vec<f64>,
}

impl<C: Checked> Motion<'_, C> {
    fn place(&mut self, part: f64) -> Result<(), RobotError> {
        let ends = self.ends[0].iter().zip(self.ends[1]);
        for (now, (from, to)) in self.configuration.iter_mut().zip(ends) {
            *now = if part == 1.0 { *to } else { from + part * (to - from) };
        }
        self.checked.shapes().place(&self.configuration, self.placed)
    }

    fn is_blocked(&mut self, part: f64) -> Result<bool, RobotError> {
        self.place(part)?;
        Ok(any_within(self.checked, self.placed, self.margin))
    }

    /// One of this many parts that is blocked.
    fn any_blocked(&mut self, steps: u64) -> Result<Option<FirstContact>, RobotError> {
        for k in std::iter::once(steps).chain(halving(steps)) {
            let blocked = k as f64 / steps as f64;
            if self.is_blocked(blocked)? {
                return Ok(Some(FirstContact::new(0.0, blocked)));
            }
        }
        Ok(None)
    }

    /// The first of this many parts that is blocked, with the part before it halved.
    fn first_blocked(&mut self, steps: u64) -> Result<Option<FirstContact>, RobotError> {
        let at = |k: u64| k as f64 / steps as f64;
        for k in 0..=steps {
            if !self.is_blocked(at(k))? {
                continue;
            }
            let mut contact = FirstContact::new(at(k.saturating_sub(1)), at(k));
            for _ in 0..if k == 0 { 0 } else { HALVINGS } {
                let middle = 0.5 * (contact.free + contact.blocked);
                match self.is_blocked(middle)? {
                    true => contact.blocked = middle,
                    false => contact.free = middle,
                }
            }
            return Ok(Some(contact));
        }
        Ok(None)
    }

    /// The first part that cannot be proved free.
    fn unproved(&mut self, rates: &[f64]) -> Result<Option<FirstContact>, RobotError> {
        // In a motion without end, a step is no part of it.
        if rates.iter().all(|rate| rate.is_finite()) {
            let mut contact = FirstContact::new(0.0, 0.0);
            for _ in 0..MAX_STEPS {
                self.place(contact.blocked)?;
                let safe = least_safe_part(self.checked, self.placed, rates, self.margin);
                if safe <= 0.0 {
                    return Ok(Some(contact));
                }
                if contact.blocked + safe >= 1.0 {
                    return Ok(None);
                }
                let next = contact.blocked + safe;
                if next <= contact.blocked {
                    break;
                }
                contact = FirstContact::new(contact.blocked + 0.999 * safe, next);
            }
        }
        Err(RobotError::Steps { most: MAX_STEPS })
    }
}

/// Where a straight motion is not free: the first such place, or any; `None` if it is free.
pub(super) fn contact(
    checked: &impl Checked,
    ends: [&[f64]; 2],
    settings: &EdgeSettings,
    is_first: bool,
    placed: &mut Placed,
) -> Result<Option<FirstContact>, RobotError> {
    let margin = check_margin(settings.margin)?;
    let travel = checked.shapes().travel(ends[0], ends[1])?;
    let mut motion = Motion { checked, ends, margin, placed, configuration: ends[0].to_vec() };
    let Some(resolution) = settings.resolution else {
        return motion.unproved(&checked.rates(&travel));
    };
    let steps = steps(checked.farthest(&travel), resolution)?;
    match is_first {
        true => motion.first_blocked(steps),
        false => motion.any_blocked(steps),
    }
}

/// In how many parts a motion of this length is checked, m.
///
/// # Errors
/// If the resolution makes no sense, or there are too many.
pub(super) fn steps(length: f64, resolution: f64) -> Result<u64, RobotError> {
    if !(resolution.is_finite() && resolution > 0.0) {
        return Err(RobotError::Setting("a resolution is finite, and above 0 m"));
    }
    let steps = (length / resolution).ceil().max(1.0);
    match steps > MAX_SAMPLES as f64 {
        true => Err(RobotError::Steps { most: MAX_SAMPLES }),
        false => Ok(steps as u64),
    }
}

/// The part of a motion in which no pair can come nearer than `margin` (m), at most 1.
fn least_safe_part(checked: &impl Checked, placed: &Placed, rates: &[f64], margin: f64) -> f64 {
    let mut least = 1.0f64;
    let mut pairs = checked.within(margin);
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

/// The numbers from 0 to below `count`, the halves first: what is far from the ends of a motion is blocked most often.
pub(super) fn halving(count: u64) -> impl Iterator<Item = u64> {
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
