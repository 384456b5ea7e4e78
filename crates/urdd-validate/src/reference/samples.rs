//! The sampled configurations (SPEC 9.3): where links are in them, and how many of them the work allows that a rule may do.
//! Work is counted in operations, not in time, so that results are the same on every machine.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::Isometry3;
use rayon::prelude::*;

use crate::skip;
use urdd_document::consumer;
use urdd_document::urdd::Urdd;
use urdd_findings::code::Code;
use urdd_findings::part::SkipReason;
use urdd_format::registry::Profile;
use urdd_format::urdf::JointType;
use urdd_geometry::convex::Motion;
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics};

/// The link poses of a robot, as a consumer computes them.
pub struct Poses {
    space: ConfigurationSpace,
    kinematics: ForwardKinematics,
    /// Rigid group of each link.
    groups: Vec<usize>,
}

impl Poses {
    /// From modules of any version.
    ///
    /// # Errors
    /// Why there are no poses.
    pub fn new(urdd: &Urdd) -> Result<Self, SkipReason> {
        let open = skip::KINEMATICS_OPEN;
        let modules = consumer::modules(urdd).ok_or(open.clone())?;
        let groups = urdd.rigid_groups().ok_or(open.clone())?;
        let bounds = urdd.bounds().ok_or(open)?;
        let unlike = |joint: JointType| matches!(joint, JointType::Planar | JointType::Floating);
        let mut joints = modules.chain.joints_in_chain.iter();
        if urdd.profile() == Profile::Legacy && joints.any(|joint| unlike(joint.joint_type)) {
            return Err(skip::LEGACY_COORDINATES);
        }
        let space = ConfigurationSpace::new(&modules.dof, &modules.chain, &bounds.bounds)
            .map_err(SkipReason::obstacle)?;
        let kinematics =
            ForwardKinematics::new(&modules.chain, &modules.dof).map_err(SkipReason::obstacle)?;
        if groups.of_link.len() != kinematics.num_links() {
            return Err(SkipReason::Failed(Code::CHN001));
        }
        Ok(Poses { space, kinematics, groups: groups.of_link.clone() })
    }

    pub fn num_links(&self) -> usize {
        self.groups.len()
    }

    /// Whether only fixed joints connect two links.
    pub fn is_rigid(&self, a: usize, b: usize) -> bool {
        self.groups.get(a) == self.groups.get(b)
    }

    /// The poses in the default configuration (SPEC 9.4).
    ///
    /// # Errors
    /// If numbers exceed 64 bits.
    pub fn default_motion(&self) -> Result<Motion, SkipReason> {
        let poses = self
            .kinematics
            .link_poses(&self.space.default_configuration())
            .map_err(|error| SkipReason::obstacle(format!("default configuration: {error}")))?;
        Motion::new(&[poses], &self.groups).map_err(SkipReason::obstacle)
    }

    /// A sampled configuration and its poses.
    ///
    /// # Errors
    /// If numbers exceed 64 bits.
    pub fn sampled(&self, sample: u32) -> Result<(Vec<f64>, Vec<Isometry3<f64>>), SkipReason> {
        let configuration = self.space.sampled(u64::from(sample));
        let why = |error| SkipReason::obstacle(format!("sampled configuration {sample}: {error}"));
        let poses = self.kinematics.link_poses(&configuration).map_err(why)?;
        Ok((configuration, poses))
    }

    /// The poses in a configuration.
    ///
    /// # Errors
    /// If numbers exceed 64 bits.
    pub fn of(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, SkipReason> {
        self.kinematics.link_poses(configuration).map_err(SkipReason::obstacle)
    }

    /// The poses in a range of sampled configurations.
    ///
    /// # Errors
    /// If numbers exceed 64 bits.
    pub fn motion(&self, samples: Range<u32>) -> Result<Motion, SkipReason> {
        let poses: Vec<Vec<Isometry3<f64>>> = samples
            .into_par_iter()
            .map(|sample| Ok(self.sampled(sample)?.1))
            .collect::<Result<_, _>>()?;
        Motion::new(&poses, &self.groups).map_err(SkipReason::obstacle)
    }
}

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
pub const AT_ONCE: u32 = 4096;

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

/// The work of a rule, the sum over all threads.
pub struct Budget {
    left: u64,
    done: AtomicU64,
    reason: SkipReason,
}

impl Budget {
    /// This many operations; the reason is given where they are not enough.
    pub fn of(operations: u64, reason: SkipReason) -> Self {
        Budget { left: operations, done: AtomicU64::new(0), reason }
    }

    /// That of a rule about spheres: about 10 seconds of one core, with `deep` some minutes.
    pub fn of_spheres(deep: bool) -> Self {
        let operations = if deep { 400_000_000_000 } else { 10_000_000_000 };
        Budget::of(operations, skip::spheres_take_too_long(deep))
    }

    /// Adds operations. The sum of all of them decides, whatever their order: where it is too large, some call fails.
    ///
    /// # Errors
    /// If the sum is larger than allowed.
    pub fn spend(&self, operations: u64) -> Result<(), SkipReason> {
        let before = self.done.fetch_add(operations.min(self.left + 1), Ordering::Relaxed);
        match before.saturating_add(operations) > self.left {
            true => Err(self.reason.clone()),
            false => Ok(()),
        }
    }
}
