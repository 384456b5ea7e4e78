//! `loops_module`: SPEC 6.8.

use std::collections::HashMap;
use std::f64::consts::PI;

use nalgebra::{Isometry3, Translation3, Vector3};

use super::error::{GenerateError, Result};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::loops_toml::FrameTable;
use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::dof::DofModule;
use urdd_format::index::{DofIdx, LinkIdx, SampleIdx};
use urdd_format::loops::{ClosedSample, Coupling, CouplingTerm, Loop, LoopsModule};
use urdd_format::named_configurations::{ConfigurationName, NamedConfiguration};
use urdd_format::nearest::nearest;
use urdd_format::short::Short;
use urdd_format::urdf::{JointType, UrdfModule};
use urdd_kinematics::loops::{Gap, Loops, NotClosed, Scratch};
use urdd_kinematics::pose::from_isometry;
use urdd_kinematics::rotation::{from_rotation_vector, from_rpy, to_rotation_vector};
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics, unit};
use urdd_source::Source;
use urdd_source::loops::{File, Said};
use urdd_source::note::{Note, NoteKind};

/// What the reference configuration of loops is called in edits of skips.
const CLOSED: &str = "closed loops";
/// Number of closed samples.
const SAMPLES: u32 = 16;
/// How many sampled configurations are tried as a beginning, if none is found from the default configuration.
const BEGINNINGS: u64 = 64;
/// How many configurations around the first closed one are looked at, and how far aside they begin, rad or m.
const AROUND: u64 = 8;
const ASIDE: f64 = 0.3;
/// In how many parts the way to a sample is gone.
const PARTS: u32 = 8;
/// A loop whose smallest gap is larger does not close, m by the reach, and rad.
const OPEN: f64 = 1e-4;
/// Most multiplications of one step of the solver.
const MOST_WORK: usize = 50_000_000;
/// How much larger than what was found a stated tolerance is.
const MARGIN: f64 = 1.5;

/// What loops are made from.
pub(super) struct Made<'a> {
    pub source: &'a Source,
    pub chain: &'a ChainModule,
    pub dof: &'a DofModule,
    pub bounds: &'a BoundsModule,
    pub space: &'a ConfigurationSpace,
    pub kinematics: &'a ForwardKinematics,
    pub cancellation: &'a Cancellation,
}

impl Made<'_> {
    /// The module of a robot whose source tells loops; and what is to say of it. `beginning` is where a closed configuration
    /// is looked for first.
    pub fn module(&self, beginning: Option<&[f64]>) -> Result<(Option<LoopsModule>, Vec<Note>)> {
        let Some(said) = self.source.loops.as_ref().filter(|said| !said.file.is_empty()) else {
            return Ok((None, Vec::new()));
        };
        let mut module = self.resolved(said)?;
        let reach = reach(&self.source.reading.robot, self.chain);
        let made = |module: &LoopsModule| {
            let loops = Loops::new(module, self.kinematics, self.dof, reach);
            loops.map_err(|error| self.refused(said, None, error.to_string()))
        };
        let mut loops = made(&module)?;
        if loops.work() > MOST_WORK {
            let fault = "the loops depend on too many joints at once for this program";
            return Err(self.refused(said, None, fault.to_owned()));
        }
        let limits = self.limits();
        let mut scratch = Scratch::default();
        let Some((reference, widest)) =
            self.reference(&loops, &limits, beginning, reach, &mut scratch)?
        else {
            return Ok((None, vec![self.open(&loops, &module, &limits, &mut scratch)]));
        };
        let reference = self.regular(&loops, reference, &widest, &limits, &mut scratch)?;
        // While samples are looked for, wider.
        for (one, gap) in module.loops.iter_mut().zip(&widest) {
            (one.position_tolerance, one.rotation_tolerance) =
                (10.0 * gap.position, 10.0 * gap.rotation);
        }
        loops = made(&module)?;
        let mut notes = Vec::new();
        let poses = self.kinematics.link_poses(&reference);
        let poses = poses.map_err(|error| self.refused(said, None, error.to_string()))?;
        let preferred = self.preferred(said, &loops, &mut notes)?;
        let mobility =
            loops.mobility(self.kinematics, &reference, &poses, |dof| preferred[dof]);
        let free = mobility.independent.iter().filter(|dof| !preferred[**dof]).count();
        let follow = mobility.dependent.iter().filter(|dof| preferred[**dof]).count();
        // Other formats name motors; rods turn about themselves besides.
        let is_complete = said.text.is_none();
        if said.file.independent.is_some() && (follow > 0 || is_complete && free > 0) {
            notes.push(self.note(
                NoteKind::Otherwise,
                format!(
                    "the DOFs that are said to move freely are not those that do: {follow} of them follow from others, and {free} others move freely"
                ),
                "loops_module says which DOFs are independent where all loops are closed",
            ));
        }
        let index = |dof: usize| DofIdx(u32::try_from(dof).unwrap_or(u32::MAX));
        module.independent_dof_idxs = mobility.independent.iter().copied().map(index).collect();
        let mut gaps = widest;
        for k in 0..SAMPLES {
            self.cancellation.check()?;
            let found = self.sample(k, &loops, &reference, &mobility.independent, &limits, &mut scratch);
            if found.is_some() {
                widen(&mut gaps, &loops.gaps(scratch.poses()));
            }
            module.closed_samples.push(ClosedSample {
                sample_idx: SampleIdx(k),
                configuration: found.map(|found| found.iter().map(|q| q + 0.0).collect()),
            });
        }
        for (one, gap) in module.loops.iter_mut().zip(&gaps) {
            one.position_tolerance = stated(gap.position, reach);
            one.rotation_tolerance = stated(gap.rotation, 1.0);
        }
        module.reference_configuration = reference.iter().map(|q| q + 0.0).collect();
        Ok((Some(module), notes))
    }

    /// The loops and couplings by index, without configurations.
    fn resolved(&self, said: &Said) -> Result<LoopsModule> {
        let links: HashMap<&str, usize> = self
            .chain
            .links_in_chain
            .iter()
            .enumerate()
            .map(|(idx, link)| (link.name.as_str(), idx))
            .collect();
        let link = |name: &urdd_directory::export_toml::Name| -> Result<LinkIdx> {
            let word = name.get_ref().as_str();
            // Extended URDF also names joints, and means their children.
            let joints = || {
                let mut joints = self.chain.joints_in_chain.iter();
                joints.find(|joint| joint.joint_name == word).map(|joint| joint.child_link_idx)
            };
            let link = links.get(word).and_then(|idx| u32::try_from(*idx).ok()).map(LinkIdx);
            link.or_else(joints).ok_or_else(|| {
                let known = self.chain.links_in_chain.iter().map(|link| link.name.as_str());
                self.refused(said, Some(name.span()), unknown("link", word, known))
            })
        };
        let File { loops, couplings, .. } = &said.file;
        let mut names: HashMap<&str, ()> = HashMap::new();
        let all = loops.iter().map(|one| (&*one.get_ref().name, one.span()));
        let all = all.chain(couplings.iter().map(|one| (&*one.get_ref().name, one.span())));
        for (name, place) in all {
            if names.insert(name, ()).is_some() {
                let fault = format!("another loop or coupling is called `{}`", Short::of(name));
                return Err(self.refused(said, Some(place), fault));
            }
        }
        let mut module = LoopsModule {
            loops: Vec::new(),
            couplings: Vec::new(),
            independent_dof_idxs: Vec::new(),
            reference_configuration: Vec::new(),
            closed_samples: Vec::new(),
        };
        for one in loops {
            let of = one.get_ref();
            let (link_a_idx, link_b_idx) = (link(&of.link_a)?, link(&of.link_b)?);
            if link_a_idx == link_b_idx {
                let fault = format!("the loop `{}` connects a link with itself", Short::of(&of.name));
                return Err(self.refused(said, Some(one.span()), fault));
            }
            let is_usable = |frame: &FrameTable| {
                frame.xyz.iter().chain(&frame.rpy).all(|x| x.is_finite())
            };
            if !is_usable(&of.frame_a) || !is_usable(&of.frame_b) {
                let fault = "a number of a frame is not finite".to_owned();
                return Err(self.refused(said, Some(one.span()), fault));
            }
            module.loops.push(Loop {
                name: of.name.clone(),
                kind: of.kind,
                link_a_idx,
                frame_a: from_isometry(&isometry(&of.frame_a)),
                link_b_idx,
                frame_b: from_isometry(&isometry(&of.frame_b)),
                position_tolerance: 0.0,
                rotation_tolerance: 0.0,
            });
        }
        for one in couplings {
            let of = one.get_ref();
            let mut terms: Vec<CouplingTerm> = Vec::new();
            let mut constant = of.constant;
            for (name, coefficients) in &of.terms {
                let [idx] = *self.dofs(name.get_ref()) else {
                    match self.coupled(name.get_ref(), coefficients, &mut constant) {
                        Some(Some(term)) => add(&mut terms, term),
                        Some(None) => {}
                        None => {
                            let known = self.dof.dofs.iter().map(|dof| dof.name.as_str());
                            let fault = unknown("DOF", name.get_ref(), known);
                            return Err(self.refused(said, Some(name.span()), fault));
                        }
                    }
                    continue;
                };
                let Some(coefficients) = four(coefficients) else {
                    let fault = "one to four finite coefficients are needed".to_owned();
                    return Err(self.refused(said, Some(name.span()), fault));
                };
                let dof_idx = DofIdx(u32::try_from(idx).unwrap_or(u32::MAX));
                add(&mut terms, CouplingTerm { dof_idx, coefficients });
            }
            terms.retain(|term| term.coefficients.iter().any(|x| *x != 0.0));
            terms.sort_by_key(|term| term.dof_idx);
            if terms.is_empty() {
                let fault = format!("the coupling `{}` says nothing of a DOF", Short::of(&of.name));
                return Err(self.refused(said, Some(one.span()), fault));
            }
            module.couplings.push(Coupling { name: of.name.clone(), constant, terms });
        }
        Ok(module)
    }

    /// The DOFs of this name: of a DOF, or all of a joint.
    fn dofs(&self, name: &str) -> Vec<usize> {
        let all = self.dof.dofs.iter().enumerate();
        let named: Vec<usize> =
            all.clone().filter(|(_, dof)| dof.name == name).map(|(idx, _)| idx).take(1).collect();
        match named.is_empty() {
            true => all.filter(|(_, dof)| dof.joint_name == name).map(|(idx, _)| idx).collect(),
            false => named,
        }
    }

    /// What a joint without a DOF of its own adds to a coupling: a mimic joint a term of its driver, a fixed one nothing.
    /// `None` if there is no such joint, or its part is not a multiple.
    fn coupled(
        &self,
        name: &str,
        coefficients: &[f64],
        constant: &mut f64,
    ) -> Option<Option<CouplingTerm>> {
        let idx =
            self.chain.joints_in_chain.iter().position(|joint| joint.joint_name == name)?;
        let [a, b, c, d] = four(coefficients)?;
        if self.chain.joints_in_chain[idx].joint_type == JointType::Fixed {
            return Some(None);
        }
        let mimic = self.dof.joint_idx_to_mimic_mapping[idx].as_ref()?;
        let (dof_idx, m, o) = (mimic.dof_idx, mimic.multiplier, mimic.offset);
        // The polynomial of m q + o.
        *constant += o * (a + o * (b + o * (c + o * d)));
        let coefficients = [
            m * (a + o * (2.0 * b + o * (3.0 * c + o * 4.0 * d))),
            m * m * (b + o * (3.0 * c + o * 6.0 * d)),
            m * m * m * (c + 4.0 * o * d),
            m * m * m * m * d,
        ];
        Some(dof_idx.map(|dof_idx| CouplingTerm { dof_idx, coefficients }))
    }

    /// For each DOF, whether it is rather to move freely than to follow.
    fn preferred(&self, said: &Said, loops: &Loops, notes: &mut Vec<Note>) -> Result<Vec<bool>> {
        let mut preferred = vec![true; self.dof.dofs.len()];
        for dof in loops.dofs() {
            preferred[dof.get()] = false;
        }
        let Some(names) = &said.file.independent else {
            // Where nobody says it, joints that are nearest to the root move the others.
            let depths = self.depths();
            let depth = |dof: usize| depths[self.dof.dofs[dof].joint_idx.get()];
            let least = loops.dofs().map(|dof| depth(dof.get())).min();
            for dof in loops.dofs() {
                preferred[dof.get()] = Some(depth(dof.get())) == least;
            }
            return Ok(preferred);
        };
        let mut none = Vec::new();
        for name in names {
            let dofs = self.dofs(name.get_ref());
            let is_joint =
                || self.chain.joints_in_chain.iter().any(|joint| joint.joint_name == *name.get_ref());
            if dofs.is_empty() && !is_joint() {
                none.push(name.get_ref().as_str());
            }
            for dof in dofs {
                preferred[dof] = true;
            }
        }
        if let Some(first) = none.first() {
            let known = self.dof.dofs.iter().map(|dof| dof.name.as_str());
            let problem = unknown("joint", first, known);
            let problem = format!("a joint is said to move freely, but {problem}");
            let assumed = "the name is passed over";
            notes.push(self.note(NoteKind::LeftOut, problem, assumed));
        }
        Ok(preferred)
    }

    /// For each joint, how many joints are above it.
    fn depths(&self) -> Vec<usize> {
        let mut of_link = vec![0; self.chain.links_in_chain.len()];
        for (depth, links) in self.chain.kinematic_hierarchy.iter().enumerate() {
            for link in links {
                of_link[link.get()] = depth;
            }
        }
        let joints = self.chain.joints_in_chain.iter();
        joints.map(|joint| of_link[joint.parent_link_idx.get()]).collect()
    }

    /// The bounds of limited DOFs; others have none.
    fn limits(&self) -> Vec<[f64; 2]> {
        let bounds = self.bounds.bounds.iter().zip(&self.bounds.dof_limited);
        let none = [f64::NEG_INFINITY, f64::INFINITY];
        bounds.map(|(bounds, limited)| if *limited { *bounds } else { none }).collect()
    }

    /// A configuration in which all loops are closed, or nearly: with its gaps where 1e-9 is not enough.
    fn reference(
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
            let closed = loops.close(self.kinematics, &mut configuration, limits, |_| false, scratch);
            let none = || vec![Gap::default(); loops.num_loops()];
            let is_closed = closed.is_ok() && self.is_short(&mut configuration, |_| false);
            match closed {
                Ok(_) if is_closed => return Ok(Some((configuration, none()))),
                Ok(_) => {}
                Err(NotClosed::Apart) => {
                    let gaps = loops.gaps(scratch.poses());
                    let is_near =
                        |gap: &Gap| gap.position <= OPEN * reach && gap.rotation <= OPEN;
                    let couplings = loops.sums(&configuration);
                    if gaps.iter().all(is_near)
                        && couplings.iter().all(|sum| sum.abs() <= 1e-9)
                        && self.is_short(&mut configuration, |_| false)
                    {
                        let mut widest = none();
                        widen(&mut widest, &gaps);
                        return Ok(Some((configuration, widest)));
                    }
                }
                Err(_) => {}
            }
        }
        Ok(None)
    }

    /// A closed configuration near a given one in which as many DOFs follow from others as anywhere near: where a robot is
    /// stretched out or folded, more move freely than elsewhere.
    fn regular(
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
            let mobility = loops.mobility(self.kinematics, configuration, &poses, |_| false);
            Some(mobility.dependent.len())
        };
        let mut best = (rank(&reference), reference.clone());
        for k in (0..AROUND).filter(|_| is_exact) {
            self.cancellation.check()?;
            let mut near = reference.clone();
            for dof in loops.dofs().map(|dof| dof.get()) {
                near[dof] += ASIDE * (2.0 * unit(k, dof as u64) - 1.0);
            }
            let closed = loops.close(self.kinematics, &mut near, limits, |_| false, scratch);
            if closed.is_ok() && self.is_short(&mut near, |_| false) {
                let rank = rank(&near);
                if rank > best.0 {
                    best = (rank, near);
                }
            }
        }
        Ok(best.1)
    }

    /// The closed configuration with the independent DOFs of a sampled one, reached from the reference in small steps.
    fn sample(
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

    /// What is said of a robot whose loops do not close.
    fn open(
        &self,
        loops: &Loops,
        module: &LoopsModule,
        limits: &[[f64; 2]],
        scratch: &mut Scratch,
    ) -> Note {
        let mut nearest = self.space.default_configuration();
        let _ = loops.close(self.kinematics, &mut nearest, limits, |_| false, scratch);
        let gaps = self.kinematics.link_poses(&nearest).map(|poses| loops.gaps(&poses));
        let gaps = gaps.unwrap_or_default();
        let worst = gaps.iter().enumerate().max_by(|(_, a), (_, b)| {
            (a.position + a.rotation).total_cmp(&(b.position + b.rotation))
        });
        let which = worst.map_or_else(
            || "the couplings do not hold".to_owned(),
            |(place, gap)| {
                format!(
                    "the loop `{}` stays {} m and {} rad apart",
                    Short::of(&module.loops[place].name),
                    urdd_format::readable::number(gap.position, 3),
                    urdd_format::readable::number(gap.rotation, 3)
                )
            },
        );
        self.note(
            NoteKind::LeftOut,
            format!("no configuration was found in which all loops of the robot are closed: {which}"),
            "the URDD has no loops_module: it is that of the tree with open ends",
        )
    }

    fn note(&self, kind: NoteKind, problem: String, assumed: &str) -> Note {
        let file = self.source.shown.clone();
        Note { kind, file, line: 0, column: 0, problem, assumed: assumed.to_owned() }
    }

    fn refused(
        &self,
        said: &Said,
        place: Option<std::ops::Range<usize>>,
        fault: String,
    ) -> GenerateError {
        said.error(place, &self.source.shown, fault).into()
    }
}

/// The reference configuration as a named one, by which contacts are skipped.
pub(super) fn closed(module: &LoopsModule) -> Option<NamedConfiguration> {
    Some(NamedConfiguration {
        name: ConfigurationName::new(CLOSED)?,
        positions: Vec::new(),
        configuration: module.reference_configuration.clone(),
    })
}

fn isometry(frame: &FrameTable) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(frame.xyz), from_rpy(frame.rpy))
}

/// Up to four coefficients, the others 0.
fn four(coefficients: &[f64]) -> Option<[f64; 4]> {
    let mut four = [0.0; 4];
    four.get_mut(..coefficients.len())?.copy_from_slice(coefficients);
    (!coefficients.is_empty() && four.iter().all(|x| x.is_finite())).then_some(four)
}

fn add(terms: &mut Vec<CouplingTerm>, term: CouplingTerm) {
    match terms.iter_mut().find(|other| other.dof_idx == term.dof_idx) {
        Some(other) => {
            for (sum, more) in other.coefficients.iter_mut().zip(term.coefficients) {
                *sum += more;
            }
        }
        None => terms.push(term),
    }
}

fn unknown<'n>(what: &str, name: &str, known: impl Iterator<Item = &'n str>) -> String {
    let near = nearest(known, name);
    let near = near.map_or_else(String::new, |near| format!("; did you mean `{}`?", Short::of(&near)));
    format!("there is no {what} `{}`{near}", Short::of(name))
}

/// What is stated for a gap: 0 where 1e-9 is enough, else a round number above it.
fn stated(gap: f64, unit: f64) -> f64 {
    if gap <= 1e-9 * unit * 0.5 {
        return 0.0;
    }
    let power = (gap * MARGIN).log10().floor();
    let step = 10.0_f64.powf(power);
    (gap * MARGIN / step).ceil() * step
}

fn widen(widest: &mut [Gap], gaps: &[Gap]) {
    for (widest, gap) in widest.iter_mut().zip(gaps) {
        widest.position = widest.position.max(gap.position);
        widest.rotation = widest.rotation.max(gap.rotation);
    }
}

/// The robot's reach: SPEC 5.6, m.
fn reach(robot: &UrdfModule, chain: &ChainModule) -> f64 {
    let mut reach = vec![0.0_f64; robot.links.len()];
    for link in chain.kinematic_hierarchy.iter().flatten() {
        let of_link = &chain.links_in_chain[link.get()];
        let (Some(joint), Some(parent)) = (of_link.parent_joint_idx, of_link.parent_link_idx) else {
            continue;
        };
        let joint = &robot.joints[joint.get()];
        let limit = joint.limit.as_ref();
        let ends = limit.and_then(|limit| match (limit.lower, limit.upper) {
            (None, None) => None,
            (lower, upper) => Some([lower.unwrap_or_default(), upper.unwrap_or_default()]),
        });
        let travel = match (joint.joint_type, ends) {
            (JointType::Prismatic, Some([lower, upper])) => lower.abs().max(upper.abs()),
            (JointType::Prismatic | JointType::Planar | JointType::Floating, _) => 1.0,
            _ => 0.0,
        };
        let origin = &chain.joints_in_chain[of_link.parent_joint_idx.map_or(0, |of| of.get())].origin;
        let offset = origin.position.iter().map(|x| x * x).sum::<f64>().sqrt();
        reach[link.get()] = reach[parent.get()] + offset + travel;
    }
    reach.into_iter().fold(1e-3, f64::max)
}
