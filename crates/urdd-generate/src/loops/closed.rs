//! Closed configurations of a robot: the reference, and the samples.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::Made;
use crate::error::Result;
use urdd_kinematics::loops::{Gap, Loops, NotClosed, Scratch};
use urdd_kinematics::rotation::{from_rotation_vector, to_rotation_vector};
use urdd_kinematics::unit;

/// How many sampled configurations are tried as a beginning, if none is found from the default configuration.
const BEGINNINGS: u64 = 64;
/// How many configurations around the first closed one are looked at, and how far aside they begin, rad or m.
const AROUND: u64 = 8;
const ASIDE: f64 = 0.3;
/// In how many parts the way to a sample is gone.
const PARTS: u32 = 8;
/// A loop whose smallest gap is larger does not close, m by the reach, and rad.
const OPEN: f64 = 1e-4;

impl Made<'_> {
    /// The bounds of limited DOFs; others have none.
    pub(super) fn limits(&self) -> Vec<[f64; 2]> {
        let bounds = self.bounds.bounds.iter().zip(&self.bounds.dof_limited);
        let none = [f64::NEG_INFINITY, f64::INFINITY];
        bounds.map(|(bounds, limited)| if *limited { *bounds } else { none }).collect()
    }

    /// A configuration in which all loops are closed, or nearly: with its gaps where 1e-9 is not enough.
    pub(super) fn reference(
        &self,
        loops: &Loops,
        limits: &[[f64; 2]],
        beginning: Option<&[f64]>,
        reach: f64,
        scratch: &mut Scratch,
    ) -> Result<Option<(Vec<f64>, Vec<Gap>)>> {
        let beginnings = beginning.map(<[f64]>::to_vec).into_iter();
        let beginnings = beginnings.chain([self.space.default_configuration()]);
        let beginnings = beginnings.chain((0..BEGINNINGS).map(|k| self.space.sampled(k)));
        for mut configuration in beginnings {
            self.cancellation.check()?;
            if scratch.is_spent() {
                break;
            }
            let closed =
                loops.close(self.kinematics, &mut configuration, limits, |_| false, scratch);
            let gaps: Vec<Gap> = match closed {
                Ok(_) => vec![Gap::default(); loops.num_loops()],
                Err(NotClosed::Apart) => {
                    let gaps: Vec<Gap> = loops.gaps(scratch.poses()).collect();
                    let is_near = |gap: &Gap| gap.position <= OPEN * reach && gap.rotation <= OPEN;
                    let hold = loops.sums(&configuration).all(|sum| sum.abs() <= 1e-9);
                    if !hold || !gaps.iter().all(is_near) {
                        continue;
                    }
                    gaps
                }
                Err(_) => continue,
            };
            if self.is_short(&mut configuration, |_| false) {
                return Ok(Some((configuration, gaps)));
            }
        }
        Ok(None)
    }

    /// A closed configuration near a given one in which as many DOFs follow from others as anywhere near: where a robot is
    /// stretched out or folded, more move freely than elsewhere.
    pub(super) fn regular(
        &self,
        loops: &Loops,
        reference: Vec<f64>,
        widest: &[Gap],
        limits: &[[f64; 2]],
        scratch: &mut Scratch,
    ) -> Result<Vec<f64>> {
        let is_exact = widest.iter().all(|gap| *gap == Gap::default());
        let rank = |configuration: &[f64]| {
            let poses = self.kinematics.link_poses(configuration).ok()?;
            let mobility = loops.mobility(self.kinematics, configuration, &poses, |_| 0);
            Some(mobility.dependent.len())
        };
        let mut best = (rank(&reference), reference.clone());
        for k in (0..AROUND).filter(|_| is_exact) {
            self.cancellation.check()?;
            if scratch.is_spent() {
                break;
            }
            let mut near = reference.clone();
            for dof in loops.dofs().map(|dof| dof.get()) {
                near[dof] += ASIDE * (2.0 * unit(k, dof as u64) - 1.0);
            }
            let closed = loops.close(self.kinematics, &mut near, limits, |_| false, scratch);
            if closed.is_ok() && self.is_short(&mut near, |_| false) {
                scratch.spend(loops.mobility_work(self.kinematics));
                let rank = rank(&near);
                if rank > best.0 {
                    best = (rank, near);
                }
            }
        }
        Ok(best.1)
    }

    /// The closed configuration with the independent DOFs of a sampled one, reached from the reference in small steps.
    pub(super) fn sample(
        &self,
        k: u32,
        loops: &Loops,
        reference: &[f64],
        independent: &[usize],
        limits: &[[f64; 2]],
        scratch: &mut Scratch,
    ) -> Option<Vec<f64>> {
        let goal = self.space.sampled(u64::from(k));
        let is_held = |dof: usize| independent.binary_search(&dof).is_ok();
        let mut along = |parts: u32, from: &[f64]| {
            if scratch.is_spent() {
                return None;
            }
            let mut at = from.to_vec();
            for part in 1..=parts {
                let share = f64::from(part) / f64::from(parts);
                for &dof in independent {
                    let [from, to] = [from[dof], goal[dof]];
                    at[dof] = if part == parts { to } else { from + share * (to - from) };
                }
                loops.close(self.kinematics, &mut at, limits, is_held, scratch).ok()?;
            }
            self.is_short(&mut at, is_held).then_some(at)
        };
        along(PARTS, reference).or_else(|| along(1, reference))
    }

    /// Makes rotation vectors at most half a turn long; whether all are then. A part that is held stays.
    fn is_short(&self, configuration: &mut [f64], is_held: impl Fn(usize) -> bool) -> bool {
        self.space.rotation_vectors().iter().all(|dofs| {
            let vector = Vector3::from(dofs.map(|dof| configuration[dof]));
            if vector.norm() <= PI {
                return true;
            }
            if dofs.iter().any(|dof| is_held(*dof)) {
                return false;
            }
            let short = to_rotation_vector(&from_rotation_vector(vector.into()));
            for (dof, value) in dofs.iter().zip(short) {
                configuration[*dof] = value;
            }
            true
        })
    }
}
