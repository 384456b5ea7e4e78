//! The loops and couplings of a robot, and which of them share DOFs.

use std::collections::BTreeMap;

use nalgebra::Isometry3;

use crate::error::KinematicsError;
use crate::forward::ForwardKinematics;
use crate::pose::to_isometry;
use urdd_format::dof::{DofModule, Quantity};
use urdd_format::index::DofIdx;
use urdd_format::loops::{LoopKind, LoopsModule};
use urdd_format::registry::ModuleKind;

/// Most joints in all loops together: 160 MB.
const MOST_HELD: usize = 20_000_000;

/// The least length by which equations are scaled, m.
const LEAST_REACH: f64 = 1e-3;

/// Work for the pose of a link, or for the rows of a joint.
const POSE: usize = 100;
/// Work for a term of a coupling: its value, its derivative and its largest value.
const TERM: usize = 400;
/// By what the cube of the number of DOFs is divided: a sixth of it is multiplied, in long rows, a little faster than in short ones.
const SOLVED: usize = 8;

/// Rows of a loop: three of the position, three of the rotation. What is not held is 0.
pub(super) const ROWS: usize = 6;

/// The loops and couplings of a robot.
#[derive(Debug, Clone)]
pub struct Loops {
    pub(super) loops: Vec<Ends>,
    pub(super) couplings: Vec<Sum>,
    /// By what lengths are divided, m.
    pub(super) reach: f64,
    /// For each DOF, its unit: `reach` where it is a length, else 1.
    pub(super) units: Vec<f64>,
    /// Whether a loop or coupling depends on the DOF.
    pub(super) moves: Vec<bool>,
    /// What has no DOF in common, apart.
    pub(super) groups: Vec<Group>,
}

/// Loops and couplings that share DOFs, directly or through others.
#[derive(Debug, Clone, Default)]
pub(super) struct Group {
    pub(super) loops: Vec<usize>,
    pub(super) couplings: Vec<usize>,
    /// Ascending.
    pub(super) dofs: Vec<usize>,
}

/// A loop.
#[derive(Debug, Clone)]
pub(super) struct Ends {
    pub(super) kind: LoopKind,
    pub(super) links: [usize; 2],
    pub(super) frames: [Isometry3<f64>; 2],
    /// For each end, the joints that move it and not the other one, as indices of steps of the forward kinematics.
    pub(super) steps: [Vec<usize>; 2],
    /// The position's and the rotation's tolerance, m and rad.
    pub(super) tolerances: [f64; 2],
}

/// A coupling.
#[derive(Debug, Clone)]
pub(super) struct Sum {
    pub(super) constant: f64,
    pub(super) terms: Vec<(usize, [f64; 4])>,
}

impl Loops {
    /// The loops of a module. `reach` is by what lengths are divided (SPEC 5.6), m.
    ///
    /// # Errors
    /// If an index is out of range, a frame is no pose, or a number is not finite.
    pub fn new(
        module: &LoopsModule,
        kinematics: &ForwardKinematics,
        dof: &DofModule,
        reach: f64,
    ) -> Result<Self, KinematicsError> {
        let mut units: Vec<f64> = vec![1.0; kinematics.num_dofs()];
        for (unit, dof) in units.iter_mut().zip(&dof.dofs) {
            if dof.quantity == Quantity::Length {
                *unit = reach.max(LEAST_REACH);
            }
        }
        let mut all = Loops {
            loops: Vec::with_capacity(module.loops.len()),
            couplings: Vec::with_capacity(module.couplings.len()),
            reach: reach.max(LEAST_REACH),
            moves: vec![false; units.len()],
            groups: Vec::new(),
            units,
        };
        let mut held = 0;
        let mut together = Together((0..all.units.len()).collect());
        for (place, one) in module.loops.iter().enumerate() {
            let at = |key: &str| format!("/loops/{place}/{key}");
            let links = [
                (one.link_a_idx, at("link_a_idx"), &one.frame_a, at("frame_a")),
                (one.link_b_idx, at("link_b_idx"), &one.frame_b, at("frame_b")),
            ];
            let mut frames = [Isometry3::identity(); 2];
            for (frame, (link, link_at, pose, pose_at)) in frames.iter_mut().zip(links) {
                if link.get() >= kinematics.num_links() {
                    return Err(fault(link_at, format!("there is no link {}", link.get())));
                }
                *frame = to_isometry(pose).map_err(|error| fault(pose_at, error.to_string()))?;
            }
            let links = [one.link_a_idx.get(), one.link_b_idx.get()];
            let steps = kinematics.steps_between(links);
            held += steps.iter().map(Vec::len).sum::<usize>();
            if held > MOST_HELD {
                return Err(fault(at("link_a_idx"), "too many joints are in all loops".to_owned()));
            }
            let moved =
                steps.iter().flatten().flat_map(|step| kinematics.steps[*step].motion.dofs());
            together.join(moved.copied(), &mut all.moves);
            let tolerances = [one.position_tolerance, one.rotation_tolerance];
            if !tolerances.iter().all(|tolerance| tolerance.is_finite()) {
                return Err(fault(
                    at("position_tolerance"),
                    "a tolerance is not finite".to_owned(),
                ));
            }
            all.loops.push(Ends { kind: one.kind, links, frames, steps, tolerances });
        }
        for (place, one) in module.couplings.iter().enumerate() {
            let mut terms = Vec::with_capacity(one.terms.len());
            for (number, term) in one.terms.iter().enumerate() {
                let at = |key: &str| format!("/couplings/{place}/terms/{number}/{key}");
                let dof = term.dof_idx.get();
                if dof >= all.units.len() {
                    return Err(fault(at("dof_idx"), format!("there is no DOF {dof}")));
                }
                terms.push((dof, term.coefficients));
            }
            let numbers = terms.iter().flat_map(|(_, coefficients)| coefficients);
            if !numbers.chain([&one.constant]).all(|number| number.is_finite()) {
                let at = format!("/couplings/{place}");
                return Err(fault(at, "a number is not finite".to_owned()));
            }
            together.join(terms.iter().map(|(dof, _)| *dof), &mut all.moves);
            all.couplings.push(Sum { constant: one.constant, terms });
        }
        all.groups = all.grouped(kinematics, together);
        Ok(all)
    }

    fn grouped(&self, kinematics: &ForwardKinematics, mut together: Together) -> Vec<Group> {
        let mut groups: BTreeMap<usize, Group> = BTreeMap::new();
        let moved = (0..self.moves.len()).filter(|dof| self.moves[*dof]);
        for dof in moved {
            groups.entry(together.of(dof)).or_default().dofs.push(dof);
        }
        for (place, one) in self.loops.iter().enumerate() {
            let mut steps = one.steps.iter().flatten();
            let dof = steps.find_map(|step| kinematics.steps[*step].motion.dofs().first());
            // A loop that no DOF moves is closed or not, whatever the configuration.
            if let Some(dof) = dof {
                groups.entry(together.of(*dof)).or_default().loops.push(place);
            }
        }
        for (place, one) in self.couplings.iter().enumerate() {
            if let Some((dof, _)) = one.terms.first() {
                groups.entry(together.of(*dof)).or_default().couplings.push(place);
            }
        }
        groups.into_values().collect()
    }

    /// The work of one step of [`Loops::close`] for the largest group of loops: about its multiplications, where those of long
    /// rows count less.
    pub fn work(&self, kinematics: &ForwardKinematics) -> usize {
        self.groups.iter().map(|group| self.work_of(group, kinematics)).max().unwrap_or(0)
    }

    /// The work of one step for a group: poses, derivatives, their products, and a solution.
    pub(super) fn work_of(&self, group: &Group, kinematics: &ForwardKinematics) -> usize {
        let dofs = group.dofs.len();
        let steps = group.loops.iter().flat_map(|one| &self.loops[*one].steps).map(Vec::len);
        let terms = group.couplings.iter().map(|one| self.couplings[*one].terms.len());
        let poses = POSE.saturating_mul(kinematics.num_links() + steps.sum::<usize>());
        let poses = poses.saturating_add(TERM.saturating_mul(terms.sum()));
        let products = group.num_rows().saturating_mul(dofs.saturating_pow(2));
        poses.saturating_add(products).saturating_add(dofs.saturating_pow(3) / SOLVED)
    }

    /// The work of [`Loops::mobility`].
    pub fn mobility_work(&self, kinematics: &ForwardKinematics) -> u64 {
        let of_group = |group: &Group| {
            let (rows, dofs) = (group.num_rows(), group.dofs.len());
            let taken = rows.saturating_mul(dofs).saturating_mul(rows.min(dofs)).saturating_mul(4);
            taken.saturating_add(POSE.saturating_mul(dofs)) as u64
        };
        let groups = self.groups.iter().map(of_group).fold(0, u64::saturating_add);
        groups.saturating_add((POSE * kinematics.num_links()) as u64)
    }

    /// Number of loops.
    pub fn num_loops(&self) -> usize {
        self.loops.len()
    }

    /// The DOFs that loops and couplings tie to each other, directly or through others: for each such set, ascending.
    pub fn groups(&self) -> impl Iterator<Item = &[usize]> {
        self.groups.iter().map(|group| &*group.dofs)
    }

    /// The DOFs of couplings, some more than once.
    pub(crate) fn coupled(&self) -> impl Iterator<Item = usize> {
        self.couplings.iter().flat_map(|one| one.terms.iter().map(|(dof, _)| *dof))
    }

    /// The DOFs that a loop or coupling depends on, ascending.
    pub fn dofs(&self) -> impl Iterator<Item = DofIdx> + '_ {
        let moved = self.moves.iter().enumerate().filter(|(_, moves)| **moves);
        moved.map(|(dof, _)| DofIdx(u32::try_from(dof).unwrap_or(u32::MAX)))
    }
}

/// Sets of DOFs that are joined: for each DOF, another of its set, or itself.
struct Together(Vec<usize>);

impl Together {
    fn of(&mut self, mut dof: usize) -> usize {
        while self.0[dof] != dof {
            self.0[dof] = self.0[self.0[dof]];
            dof = self.0[dof];
        }
        dof
    }

    fn join(&mut self, dofs: impl Iterator<Item = usize>, moves: &mut [bool]) {
        let mut first = None;
        for dof in dofs {
            moves[dof] = true;
            let of = self.of(dof);
            let with = *first.get_or_insert(of);
            self.0[of] = with;
        }
    }
}

fn fault(pointer: String, fault: String) -> KinematicsError {
    KinematicsError { module: ModuleKind::Loops, pointer, fault }
}

impl Group {
    pub(super) fn num_rows(&self) -> usize {
        ROWS * self.loops.len() + self.couplings.len()
    }
}
