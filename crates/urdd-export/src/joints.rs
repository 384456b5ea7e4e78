//! Joints in a form that every URDF reader accepts: mimic chains resolved, rotations as roll, pitch, yaw. And kinematic loops as
//! formats need them: on which links of the file their ends are, which couplings are mimics, and what is said of those that a
//! format cannot hold.

use std::collections::{BTreeMap, HashMap};

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use crate::layout::{Place, origin};
use crate::names::one;
use crate::{ExportError, Format, Note, Subject, Taken};
use urdd_document::pose::has_quaternions;
use urdd_document::robot::{Joint as View, Origin as ViewOrigin};
use urdd_document::tree::Resolved;
use urdd_format::index::LinkIdx;
use urdd_format::loops::{Coupling, Loop, LoopKind, LoopsModule};
use urdd_format::pose::Pose;
use urdd_format::urdf::{Joint, JointType, Mimic, Origin};
use urdd_kinematics::pose::to_isometry;
use urdd_kinematics::rotation::{to_rpy, unit_axis};

const STANDS: &str =
    "it mimics a fixed joint and never moves; it is exported as a fixed joint at its offset";
const SEVERAL: &str =
    "it mimics a joint of several DOFs, which no program supports; it moves freely";

/// The joints of the robot, in URDF order.
pub(super) fn joints(subject: &Subject, notes: &mut Vec<Note>) -> Vec<Joint> {
    let quaternions = has_quaternions(subject.urdf.version.as_deref());
    let each = subject.urdf.joints.iter().zip(&subject.view.joints).zip(&subject.mimics.by_joint);
    let joint = |((source, view), resolved): ((&Joint, &View), &Option<Resolved>)| {
        let mut joint = source.clone();
        joint.origin = (joint.origin.as_ref())
            .map(|origin| without_quaternion(origin, &view.origin, quaternions));
        let mut note = |what| notes.push(Note::joint(&view.name, what));
        // A mimic of a fixed joint is meaningless (SPEC 6.1.5).
        joint.mimic = None;
        if let Some(resolved) = resolved {
            let driver = &subject.view.joints[resolved.driver];
            match driver.num_dofs() {
                0 => {
                    note(STANDS);
                    return standing(joint, view, resolved.offset);
                }
                1 => joint.mimic = Some(mimic(source.mimic.as_ref(), driver, resolved)),
                _ => note(SEVERAL),
            }
        }
        joint
    };
    each.map(joint).collect()
}

/// The joints where couplings are mimics too, for formats that have no other couplings.
pub(super) fn coupled(subject: &Subject, notes: &mut Vec<Note>) -> Result<Vec<Joint>, ExportError> {
    let mut left_out = LeftOut::default();
    let followers = Followers::new(subject, &mut left_out)?;
    notes.extend(left_out.notes());
    let mut joints = joints(subject, notes);
    for (index, joint) in joints.iter_mut().enumerate() {
        let own = subject.mimics.by_joint[index];
        if let Some(of) = followers.mimic(subject, index).filter(|of| Some(*of) != own) {
            joint.mimic = Some(mimic(None, &subject.view.joints[of.driver], &of));
        }
    }
    Ok(joints)
}

/// The mimic as written in the source if it names the driver directly; otherwise the resolved one.
fn mimic(source: Option<&Mimic>, driver: &View, resolved: &Resolved) -> Mimic {
    match source {
        Some(source) if source.joint == driver.name => source.clone(),
        _ => Mimic {
            joint: driver.name.clone(),
            multiplier: Some(resolved.multiplier),
            offset: Some(resolved.offset),
        },
    }
}

/// Replaces a joint of one DOF by a fixed joint at `position`.
fn standing(joint: Joint, view: &View, position: f64) -> Joint {
    Joint {
        origin: Some(origin(&(view.origin.motion() * moved(view, position)))),
        unknown_elements: joint.unknown_elements,
        ..Joint::new(joint.name, JointType::Fixed, joint.parent.link, joint.child.link)
    }
}

/// The limits of a joint's position; `None`, with a note, where the lower one is above the upper one.
pub(super) fn range(
    joint: &View,
    crossed: &'static str,
    notes: &mut Vec<Note>,
) -> Option<(f64, f64)> {
    let (lower, upper) = joint.position_limits()?;
    if lower > upper {
        notes.push(Note::joint(&joint.name, crossed));
        return None;
    }
    Some((lower, upper))
}

/// The pose of a joint of one DOF at a position, in its frame.
pub(super) fn moved(joint: &View, position: f64) -> Isometry3<f64> {
    match (unit_axis(joint.axis), joint.joint_type) {
        (Some(axis), JointType::Prismatic) => {
            Isometry3::from(Translation3::from(axis.into_inner() * position))
        }
        (Some(axis), _) => Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_axis_angle(&axis, position),
        ),
        (None, _) => Isometry3::identity(),
    }
}

/// An origin without `quat_xyzw`, which most programs ignore. Before URDF 1.1 the attribute has no meaning.
pub(super) fn without_quaternion(origin: &Origin, view: &ViewOrigin, counts: bool) -> Origin {
    let mut plain = Origin { quat_xyzw: None, ..origin.clone() };
    if counts && origin.quat_xyzw.is_some() {
        plain.rpy = Some(to_rpy(&view.rotation()));
    }
    plain
}

/// Why a loop of a kind that a format does not have is left out.
pub(super) const OTHER_KIND: &str = "the format holds no loop of its kind";
const ONE_BODY: &str = "its two links are one body in the file";
const OTHER_LINK: &str = "it is of a link that the robot does not have";
const NO_MIMIC: &str =
    "only a joint that follows one other, by a factor and an offset, can be a mimic";

/// How far apart the points are that hold a hinge or a weld, m.
pub(super) const APART: f64 = 0.1;

/// A loop, with its ends on links of the file.
pub(super) struct Closing<'s> {
    /// Its number in the module.
    pub number: usize,
    /// Its name, or another that the format can hold. No other loop or coupling has it.
    pub name: String,
    pub of: &'s Loop,
    /// The links that have the mass and shapes of its links, and its frames in theirs.
    pub ends: [Place; 2],
}

impl Closing<'_> {
    /// Places on the axis whose coincidence holds the loop, m: two hold a hinge. `None` of a kind that points do not hold.
    pub fn points(&self) -> Option<&'static [f64]> {
        match self.of.kind {
            LoopKind::Fixed | LoopKind::Spherical => Some(&[0.0]),
            LoopKind::Revolute => Some(&[0.0, APART]),
            _ => None,
        }
    }
}

pub(super) fn closings<'s>(
    subject: &'s Subject,
    left_out: &mut LeftOut,
) -> Result<Vec<Closing<'s>>, ExportError> {
    let Some(module) = subject.robot.loops()? else { return Ok(Vec::new()) };
    let end = |link: LinkIdx, frame: &Pose| {
        let link = Some(link.get()).filter(|link| *link < subject.described.links.len())?;
        Some(subject.layout.place(link, &to_isometry(frame).ok()?))
    };
    let mut closings = Vec::with_capacity(module.loops.len());
    let names = names(subject.format, module);
    for (number, of) in module.loops.iter().enumerate() {
        match (end(of.link_a_idx, &of.frame_a), end(of.link_b_idx, &of.frame_b)) {
            (Some(a), Some(b)) if a.link == b.link => left_out.of_loop(&of.name, ONE_BODY),
            (Some(a), Some(b)) => {
                closings.push(Closing { number, name: names[number].clone(), of, ends: [a, b] });
            }
            _ => left_out.of_loop(&of.name, OTHER_LINK),
        }
    }
    Ok(closings)
}

/// The names of loops and then of couplings, as a format can hold them.
pub(super) fn names(format: Format, module: &LoopsModule) -> Vec<String> {
    let own = module.loops.iter().map(|of| &of.name);
    let own: Vec<&String> = own.chain(module.couplings.iter().map(|of| &of.name)).collect();
    let mut taken = Taken::new(own.iter().copied());
    let name = |(number, name): (usize, &&String)| match one(format, "joint", name) {
        Ok(()) => (*name).clone(),
        Err(_) => taken.free(format!("loop_{number}")),
    };
    own.iter().enumerate().map(name).collect()
}

/// Loops and couplings that are not in the file, by what they are and why.
#[derive(Default)]
pub(super) struct LeftOut(BTreeMap<(&'static str, String), Vec<String>>);

impl LeftOut {
    pub fn of_loop(&mut self, name: &str, why: impl Into<String>) {
        self.0.entry(("loop", why.into())).or_default().push(name.to_owned());
    }

    pub fn coupling(&mut self, name: &str, why: impl Into<String>) {
        self.0.entry(("coupling", why.into())).or_default().push(name.to_owned());
    }

    pub fn notes(self) -> impl Iterator<Item = Note> {
        self.0.into_iter().map(|((what, why), names)| Note::LeftOut { what, names, why })
    }
}

/// The joint of one DOF that each DOF is, and whether the DOF moves freely, by the robot's loops.
pub(super) fn joints_of_dofs(subject: &Subject) -> Result<Vec<(Option<usize>, bool)>, ExportError> {
    let joints = &subject.view.joints;
    let of_one = joints.iter().enumerate().filter(|(_, joint)| joint.num_dofs() == 1);
    let by_name: HashMap<&str, usize> =
        of_one.map(|(index, joint)| (joint.name.as_str(), index)).collect();
    let found = |name: &String| by_name.get(name.as_str()).copied();
    let names = subject.robot.dof_names()?.iter().map(found);
    Ok(names.zip(free_dofs(subject)?).collect())
}

fn free_dofs(subject: &Subject) -> Result<Vec<bool>, ExportError> {
    let mut free = vec![false; subject.robot.dof_names()?.len()];
    for dof in subject.robot.loops()?.iter().flat_map(|module| &module.independent_dof_idxs) {
        if let Some(free) = free.get_mut(dof.get()) {
            *free = true;
        }
    }
    Ok(free)
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Freedom {
    pub any: bool,
    pub all: bool,
}

/// For each joint, whether its DOFs move freely; `None` for one without DOFs of its own, and of a robot without loops.
pub(super) fn freedom(subject: &Subject) -> Result<Vec<Option<Freedom>>, ExportError> {
    let joints = &subject.view.joints;
    if subject.robot.loops()?.is_none() {
        return Ok(vec![None; joints.len()]);
    }
    let by_name: HashMap<&str, usize> =
        joints.iter().enumerate().map(|(index, joint)| (joint.name.as_str(), index)).collect();
    let mut freedom: Vec<Option<Freedom>> = vec![None; joints.len()];
    for (name, is_free) in subject.robot.dof_names()?.iter().zip(free_dofs(subject)?) {
        // A joint of several DOFs has its name before the last slash of theirs.
        let joint = by_name.get(name.as_str()).filter(|joint| joints[**joint].num_dofs() == 1);
        let several = || by_name.get(name.rsplit_once('/')?.0);
        let Some(joint) = joint.or_else(several) else { continue };
        let of = freedom[*joint].get_or_insert(Freedom { any: false, all: true });
        (of.any, of.all) = (of.any || is_free, of.all && is_free);
    }
    Ok(freedom)
}

/// Whether only the first coefficient is not 0.
pub(super) fn is_linear([_, rest @ ..]: &[f64; 4]) -> bool {
    rest.iter().all(|other| *other == 0.0)
}

/// Joints that follow another by a coupling, for formats that have mimics and no other couplings.
#[derive(Default)]
pub(super) struct Followers(BTreeMap<usize, Resolved>);

impl Followers {
    pub fn new(subject: &Subject, left_out: &mut LeftOut) -> Result<Self, ExportError> {
        let mut made = Followers::default();
        let Some(module) = subject.robot.loops()? else { return Ok(made) };
        let dofs = joints_of_dofs(subject)?;
        for coupling in &module.couplings {
            if made.follow(coupling, &dofs).is_none() {
                left_out.coupling(&coupling.name, NO_MIMIC);
            }
        }
        let followers: Vec<usize> = made.0.keys().copied().collect();
        followers.into_iter().for_each(|joint| _ = made.leader(joint));
        Ok(made)
    }

    /// What a joint follows, by its mimic and by couplings.
    pub fn mimic(&self, subject: &Subject, joint: usize) -> Option<Resolved> {
        let of = self.0.get(&joint).copied().or(subject.mimics.by_joint[joint])?;
        Some(self.0.get(&of.driver).map_or(of, |next| through(of, *next)))
    }

    /// What a joint follows in the end: itself if nothing. Those on the way follow it at once from now on.
    fn leader(&mut self, joint: usize) -> Resolved {
        let mut chain = Vec::new();
        let mut of = Resolved { driver: joint, multiplier: 1.0, offset: 0.0 };
        while let Some(next) = self.0.get(&of.driver) {
            chain.push(of.driver);
            of.driver = next.driver;
        }
        for follower in chain.into_iter().rev() {
            if let Some(own) = self.0.get_mut(&follower) {
                of = through(*own, of);
                *own = of;
            }
        }
        of
    }

    /// Makes a joint follow another; `None` if no mimic says so.
    fn follow(&mut self, coupling: &Coupling, dofs: &[(Option<usize>, bool)]) -> Option<()> {
        let mut constant = coupling.constant;
        let [one, other] = &coupling.terms[..] else { return None };
        let mut sides = Vec::with_capacity(2);
        for term in [one, other] {
            let (joint, is_free) = *dofs.get(term.dof_idx.get())?;
            let root = self.leader(joint?);
            let factor = Some(term.coefficients[0]).filter(|_| is_linear(&term.coefficients))?;
            constant += factor * root.offset;
            sides.push((root.driver, factor * root.multiplier, is_free));
        }
        // What moves freely leads.
        sides.sort_by_key(|(.., is_free)| !is_free);
        let [(driver, factor, _), (follower, divisor, _)] = sides[..] else { return None };
        let of =
            Resolved { driver, multiplier: -factor / divisor, offset: -constant / divisor + 0.0 };
        let is_usable = of.multiplier.is_finite() && of.offset.is_finite();
        (is_usable && driver != follower).then(|| _ = self.0.insert(follower, of))
    }
}

/// What follows a joint that itself follows another.
fn through(own: Resolved, next: Resolved) -> Resolved {
    Resolved {
        driver: next.driver,
        multiplier: own.multiplier * next.multiplier,
        offset: own.multiplier * next.offset + own.offset,
    }
}
