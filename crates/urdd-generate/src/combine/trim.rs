//! Determines which links and joints of a part are dropped, and which joints are frozen, and where.

use std::collections::BTreeMap;

use super::error::Result;
use super::part::Loaded;
use super::recipe::{Part, Recipe};
use urdd_format::urdf::{Joint, JointType};
use urdd_kinematics::rotation::{to_rpy, unit_axis};
use urdd_kinematics::{joint_motion, num_dofs};
use urdd_source::origin;
use urdd_source::urdf::written_axis;
use urdd_xml::number::numbers;

/// What is dropped and frozen. Lists are indexed by the part's own links and joints.
#[derive(Debug)]
pub(super) struct Trim {
    /// For each link, the index of the entry in the part's `drop` that removes it.
    pub dropped_links: Vec<Option<usize>>,
    pub dropped_joints: Vec<Option<usize>>,
    /// Frozen joints, with a value for each of their DOFs.
    pub frozen: BTreeMap<usize, Vec<f64>>,
    /// Joints that are frozen because the joint that they mimic is.
    pub following: Vec<String>,
    pub root: usize,
}

impl Trim {
    pub fn keeps_link(&self, link: usize) -> bool {
        self.dropped_links[link].is_none()
    }

    pub fn keeps_joint(&self, joint: usize) -> bool {
        self.dropped_joints[joint].is_none()
    }
}

/// Determines what is dropped and frozen.
/// Fails if the recipe names a missing link or joint, or asks for something impossible.
pub(super) fn trim(recipe: &Recipe, part: &Part, loaded: &Loaded) -> Result<Trim> {
    let trimmer = Trimmer { recipe, part, loaded, id: &part.id.text };
    let robot = &loaded.robot;
    let mut is_child = vec![false; robot.links.len()];
    for joint in &robot.joints {
        if let Some(child) = loaded.links.get(&joint.child.link) {
            is_child[*child] = true;
        }
    }
    let root = is_child.iter().position(|is_child| !is_child);
    let mut trim = Trim {
        dropped_links: vec![None; robot.links.len()],
        dropped_joints: vec![None; robot.joints.len()],
        frozen: BTreeMap::new(),
        following: Vec::new(),
        root: root.unwrap_or_default(),
    };
    trimmer.drop(&mut trim)?;
    trimmer.freeze(&mut trim)?;
    trimmer.follow(&mut trim)?;
    Ok(trim)
}

struct Trimmer<'a> {
    recipe: &'a Recipe,
    part: &'a Part,
    loaded: &'a Loaded,
    id: &'a str,
}

impl Trimmer<'_> {
    fn drop(&self, trim: &mut Trim) -> Result<()> {
        let robot = &self.loaded.robot;
        for (with, word) in self.part.drop.iter().enumerate() {
            let link = self.recipe.find(self.id, "link", &self.loaded.links, &word.text, word)?;
            if link == trim.root {
                let fault = format!(
                    "`{}` is the root of part `{}`, and without it nothing is left; leave out the part, or drop links farther from the root",
                    word.text, self.id
                );
                return Err(self.recipe.refused(word, fault));
            }
            trim.dropped_links[link].get_or_insert(with);
        }
        // A joint is dropped with its child link, and a link with its parent link: traverse from the root.
        let mut joints_on: Vec<Vec<(usize, usize)>> = vec![Vec::new(); robot.links.len()];
        for (idx, joint) in robot.joints.iter().enumerate() {
            let of = |name: &String| self.loaded.links.get(name).copied();
            if let (Some(parent), Some(child)) = (of(&joint.parent.link), of(&joint.child.link)) {
                joints_on[parent].push((idx, child));
            }
        }
        let mut reached = vec![trim.root];
        while let Some(parent) = reached.pop() {
            for (joint, child) in std::mem::take(&mut joints_on[parent]) {
                let with = trim.dropped_links[child].or(trim.dropped_links[parent]);
                trim.dropped_links[child] = with;
                trim.dropped_joints[joint] = with;
                reached.push(child);
            }
        }
        Ok(())
    }

    fn freeze(&self, trim: &mut Trim) -> Result<()> {
        for (word, position) in &self.part.freeze {
            let name = &word.text;
            let idx = self.recipe.find(self.id, "joint", &self.loaded.joints, name, word)?;
            let joint = &self.loaded.robot.joints[idx];
            let values = position.values();
            let joint_of_part = format!("joint `{name}` of part `{}`", self.id);
            let (expected, found) = (num_dofs(joint.joint_type), values.len());
            let fault = if let Some(with) = trim.dropped_joints[idx] {
                format!("the {joint_of_part} is dropped, with `{}`", self.part.drop[with].text)
            } else if expected == 0 {
                format!("{joint_of_part} is already fixed")
            } else if expected != found {
                let plural = if expected == 1 { "" } else { "s" };
                let are = if found == 1 { "is" } else { "are" };
                format!("{joint_of_part} has {expected} DOF{plural}, but there {are} {found}")
            } else if let (Some([lower, upper]), &[value]) = (limits(joint), values)
                && !(lower..=upper).contains(&value)
            {
                format!(
                    "{joint_of_part} moves from {lower} to {upper}, so it cannot be frozen at {value}"
                )
            } else {
                trim.frozen.insert(idx, values.to_vec());
                continue;
            };
            return Err(self.recipe.refused(word, fault));
        }
        Ok(())
    }

    /// Freezes the mimic joints of frozen joints at the resulting positions. A mimic joint whose driver is dropped is
    /// an error.
    fn follow(&self, trim: &mut Trim) -> Result<()> {
        let joints = &self.loaded.robot.joints;
        let mut followers: Vec<Vec<usize>> = vec![Vec::new(); joints.len()];
        for (idx, joint) in joints.iter().enumerate() {
            let moves = joint.joint_type != JointType::Fixed;
            let is_free = trim.keeps_joint(idx) && !trim.frozen.contains_key(&idx) && moves;
            let Some(mimic) = joint.mimic.as_ref().filter(|_| is_free) else { continue };
            let Some(&driver) = self.loaded.joints.get(&mimic.joint) else { continue };
            if let Some(with) = trim.dropped_joints[driver] {
                let at = &self.part.drop[with];
                let fault = format!(
                    "joint `{}` of part `{}` follows `{}`, which is dropped with `{}`; freeze the joint, or drop its child link too",
                    joint.name, self.id, mimic.joint, at.text
                );
                return Err(self.recipe.refused(at, fault));
            }
            followers[driver].push(idx);
        }
        let mut drivers: Vec<usize> = trim.frozen.keys().copied().collect();
        let mut following = Vec::new();
        while let Some(driver) = drivers.pop() {
            let Some(&[value]) = trim.frozen.get(&driver).map(Vec::as_slice) else { continue };
            for idx in std::mem::take(&mut followers[driver]) {
                let Some(mimic) = &joints[idx].mimic else { continue };
                let (multiplier, offset) = (mimic.multiplier, mimic.offset);
                let value = multiplier.unwrap_or(1.0) * value + offset.unwrap_or(0.0);
                trim.frozen.insert(idx, vec![value]);
                following.push(idx);
                drivers.push(idx);
            }
        }
        following.sort_unstable();
        trim.following = following.into_iter().map(|idx| joints[idx].name.clone()).collect();
        Ok(())
    }
}

/// The limits of a joint, if it has any: SPEC 6.5.
fn limits(joint: &Joint) -> Option<[f64; 2]> {
    let is_limited = matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic);
    let limit = joint.limit.as_ref().filter(|_| is_limited)?;
    match (limit.lower, limit.upper) {
        (None, None) => None,
        (lower, upper) => Some([lower.unwrap_or(0.0), upper.unwrap_or(0.0)]),
    }
}

/// The `<origin>` of a joint that is frozen at a position, given as one value per DOF (SPEC 5.8).
pub(super) fn frozen_origin(joint: &Joint, position: &[f64], quaternions: bool) -> String {
    let axis = unit_axis(written_axis(joint));
    let motion = joint_motion(joint.joint_type, axis, position);
    let pose = origin::of(joint.origin.as_ref(), quaternions) * motion;
    let rpy = to_rpy(pose.rotation.to_rotation_matrix().matrix());
    let xyz = pose.translation.vector;
    origin_text([xyz.x, xyz.y, xyz.z], rpy)
}

pub(super) fn origin_text(xyz: [f64; 3], rpy: [f64; 3]) -> String {
    format!("<origin xyz=\"{}\" rpy=\"{}\"/>", numbers(&xyz), numbers(&rpy))
}
