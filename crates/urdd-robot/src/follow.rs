//! Motions of robots with kinematic loops: the independent DOFs go straight from one closed configuration to another, the
//! others follow, each configuration closed from the last one.

use super::checked::{Checked, any_within, check_margin};
use super::edge::{self, EdgeSettings, FirstContact, HALVINGS, Obstruction, halving, steps};
use super::error::RobotError;
use super::kept::Closure;
use super::workspace::{ClosingSpace, Placed, with_closing_space};
use urdd_kinematics::loops::{FirstOpen, NotClosed};

/// As [`edge::contact`]; for a robot with loops, the motion in which they stay closed, unless the settings allow open ones.
pub(super) fn contact(
    checked: &impl Checked,
    ends: [&[f64]; 2],
    settings: &EdgeSettings,
    is_first: bool,
    placed: &mut Placed,
) -> Result<Option<FirstContact>, RobotError> {
    let closure = match settings.open_loops {
        true => None,
        false => checked.shapes().closure.as_ref().map_err(Clone::clone)?.as_deref(),
    };
    let Some(closure) = closure else {
        return edge::contact(checked, ends, settings, is_first, placed);
    };
    let margin = check_margin(settings.margin)?;
    let Some(resolution) = settings.resolution else {
        let why = "a motion in which loops stay closed has no proof: give a resolution, or ask for open loops";
        return Err(RobotError::Setting(why));
    };
    let travel = checked.shapes().travel(ends[0], ends[1])?;
    let steps = steps(checked.farthest(&travel), resolution)?;
    for (end, name) in ends.iter().zip(["start", "end"]) {
        checked.shapes().place(end, placed)?;
        check_closed(closure, end, name, placed)?;
    }
    let mut follower = Follower::new(checked, closure, ends, resolution, steps);
    let mut is_blocked = |q: &[f64]| -> Result<bool, RobotError> {
        checked.shapes().place(q, placed)?;
        Ok(any_within(checked, placed, margin))
    };
    match is_first {
        true => first_blocked(&mut follower, &mut is_blocked),
        false => any_blocked(&mut follower, &mut is_blocked),
    }
}

/// # Errors
/// [`RobotError::NotClosed`], [`RobotError::NotCoupled`].
fn check_closed(
    closure: &Closure,
    configuration: &[f64],
    end: &'static str,
    placed: &Placed,
) -> Result<(), RobotError> {
    let [loops, couplings] = &closure.names;
    match closure.loops.first_open(configuration, &placed.poses) {
        None => Ok(()),
        Some(FirstOpen::Loop(k, gap)) => {
            Err(RobotError::NotClosed { end, name: loops[k].clone(), gap })
        }
        Some(FirstOpen::Coupling(k, sum)) => {
            Err(RobotError::NotCoupled { end, name: couplings[k].clone(), sum })
        }
    }
}

type IsBlocked<'a> = dyn FnMut(&[f64]) -> Result<bool, RobotError> + 'a;

/// A configuration on the way that is blocked. The ends are checked first; then the way is gone, so that the halves can be
/// checked before the rest.
fn any_blocked<C: Checked>(
    follower: &mut Follower<'_, C>,
    is_blocked: &mut IsBlocked,
) -> Result<Option<FirstContact>, RobotError> {
    let dofs = follower.now.len();
    for (end, part) in [(follower.ends[1], 1.0), (follower.ends[0], 0.0)] {
        if is_blocked(end)? {
            return Ok(Some(FirstContact::new(0.0, part)));
        }
    }
    let (mut parts, mut way) = (vec![0.0], follower.now.clone());
    while follower.part < 1.0 {
        match follower.advance()? {
            None => {}
            // It can go no farther, whatever is in the way.
            Some(stopped) => return Ok(Some(FirstContact { free: 0.0, ..stopped })),
        }
        parts.push(follower.part);
        way.extend_from_slice(&follower.now);
    }
    // Both ends are free.
    for k in halving(parts.len() as u64 - 1).skip(1) {
        let k = k as usize;
        if is_blocked(&way[k * dofs..(k + 1) * dofs])? {
            return Ok(Some(FirstContact::new(0.0, parts[k])));
        }
    }
    Ok(None)
}

/// The first configuration on the way that is blocked, with the part before it halved.
fn first_blocked<C: Checked>(
    follower: &mut Follower<'_, C>,
    is_blocked: &mut IsBlocked,
) -> Result<Option<FirstContact>, RobotError> {
    if is_blocked(&follower.now)? {
        return Ok(Some(FirstContact::new(0.0, 0.0)));
    }
    while follower.part < 1.0 {
        let (free, before) = (follower.part, follower.now.clone());
        if let Some(stopped) = follower.advance()? {
            return Ok(Some(stopped));
        }
        if !is_blocked(&follower.now)? {
            continue;
        }
        let mut contact = FirstContact::new(free, follower.part);
        let mut near = before;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (contact.free + contact.blocked);
            // What cannot be closed is blocked too.
            let closed = follower.close(middle, &near)?;
            match !closed || is_blocked(&follower.next)? {
                true => contact.blocked = middle,
                false => {
                    contact.free = middle;
                    near.copy_from_slice(&follower.next);
                }
            }
        }
        return Ok(Some(contact));
    }
    Ok(None)
}

/// The most configurations on the way: all are kept.
const MAX_SAMPLES: u64 = 100_000;

/// The smallest step, as a part of those in which the straight motion of the tree would be checked.
const SMALLEST: f64 = 1.0 / 1024.0;

/// A motion in which loops stay closed.
struct Follower<'a, C> {
    checked: &'a C,
    closure: &'a Closure,
    ends: [&'a [f64]; 2],
    resolution: f64,
    /// The bounds of the robot, wide enough for both ends.
    bounds: Vec<[f64; 2]>,
    longest: f64,
    step: f64,
    /// How far it is, from 0 to 1, and the closed configuration there.
    part: f64,
    now: Vec<f64>,
    next: Vec<f64>,
    count: u64,
}

impl<'a, C: Checked> Follower<'a, C> {
    fn new(
        checked: &'a C,
        closure: &'a Closure,
        ends: [&'a [f64]; 2],
        resolution: f64,
        steps: u64,
    ) -> Self {
        let wide = |([lower, upper], (a, b)): (&[f64; 2], (&f64, &f64))| {
            [lower.min(*a).min(*b), upper.max(*a).max(*b)]
        };
        let longest = 1.0 / steps as f64;
        Follower {
            checked,
            closure,
            ends,
            resolution,
            bounds: closure.limits.iter().zip(ends[0].iter().zip(ends[1])).map(wide).collect(),
            longest,
            step: longest,
            part: 0.0,
            now: ends[0].to_vec(),
            next: ends[0].to_vec(),
            count: 0,
        }
    }

    /// Goes on by one step in which no point of the robot travels farther than the resolution; or says what stops it. At the
    /// end, the configuration is that of the end.
    fn advance(&mut self) -> Result<Option<FirstContact>, RobotError> {
        self.count += 1;
        if self.count > MAX_SAMPLES {
            return Err(RobotError::Steps { most: MAX_SAMPLES });
        }
        loop {
            let to = if self.part + self.step >= 1.0 - 1e-9 { 1.0 } else { self.part + self.step };
            let now = std::mem::take(&mut self.now);
            let closed = self.close(to, &now);
            self.now = now;
            let obstruction = if closed? {
                let length = self.length(&self.now, &self.next)?;
                if length <= self.resolution {
                    if to == 1.0 && !self.arrives()? {
                        let (free, blocked) = (self.part, 1.0);
                        return Ok(Some(FirstContact {
                            free,
                            blocked,
                            obstruction: Obstruction::Branch,
                        }));
                    }
                    let is_short = length < 0.4 * self.resolution;
                    self.step =
                        if is_short { self.longest.min(2.0 * self.step) } else { self.step };
                    self.part = to;
                    std::mem::swap(&mut self.now, &mut self.next);
                    return Ok(None);
                }
                Obstruction::Branch
            } else {
                Obstruction::Open
            };
            if self.step <= SMALLEST * self.longest {
                return Ok(Some(FirstContact { free: self.part, blocked: to, obstruction }));
            }
            self.step *= 0.5;
        }
    }

    /// Writes the closed configuration near another one at a part of the motion into `next`: false if none is found.
    fn close(&mut self, part: f64, near: &[f64]) -> Result<bool, RobotError> {
        self.next.copy_from_slice(near);
        let is_independent = &self.closure.is_independent;
        for (dof, value) in self.next.iter_mut().enumerate().filter(|(dof, _)| is_independent[*dof])
        {
            let [from, to] = self.ends.map(|end| end[dof]);
            *value = if part == 1.0 { to } else { from + part * (to - from) };
        }
        let kinematics = &self.checked.shapes().motion.kinematics;
        let (next, bounds) = (&mut self.next, &self.bounds);
        let held = |dof: usize| is_independent[dof];
        let closing = with_closing_space(|ClosingSpace { scratch, .. }| {
            self.closure.loops.close(kinematics, next, bounds, held, scratch)
        });
        match closing {
            Ok(_) => Ok(true),
            Err(NotClosed::Unusable(error)) => Err(error.into()),
            Err(_) => Ok(false),
        }
    }

    fn length(&self, from: &[f64], to: &[f64]) -> Result<f64, RobotError> {
        Ok(self.checked.farthest(&self.checked.shapes().travel(from, to)?))
    }

    /// Whether the configuration that was reached at the end is that of the end: then it is replaced by it, as angles may
    /// be a whole turn apart.
    fn arrives(&mut self) -> Result<bool, RobotError> {
        let kinematics = &self.checked.shapes().motion.kinematics;
        let [found, expected] =
            [&*self.next, self.ends[1]].map(|configuration| kinematics.link_poses(configuration));
        let (found, expected) = (found?, expected?);
        let arrives = found.iter().zip(&expected).all(|(a, b)| {
            let shift = (a.translation.vector - b.translation.vector).norm();
            shift <= self.resolution && a.rotation.angle_to(&b.rotation) <= self.resolution
        });
        self.next.copy_from_slice(self.ends[1]);
        Ok(arrives)
    }
}
