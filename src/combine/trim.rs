//! What of a part comes along: links and joints that are dropped, joints that are made fixed.

use std::collections::BTreeMap;

use super::error::{CombineError, RecipeFault};
use super::recipe::{Part, Recipe, Word};
use crate::format::nearest::nearest;
use crate::format::urdf::{Joint, JointType, UrdfModule};

/// What of a part comes along. Lists go with the part's own links and joints.
#[derive(Debug)]
pub(super) struct Trim {
    /// For each link, the link of the recipe with which it is dropped.
    pub dropped_links: Vec<Option<String>>,
    pub dropped_joints: Vec<Option<String>>,
    /// Joints that become fixed, with a value for each of their DOFs.
    pub frozen: BTreeMap<usize, Vec<f64>>,
    /// Joints that become fixed because the joint that they follow does.
    pub following: Vec<String>,
    /// The root link.
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

/// Finds out what comes along.
///
/// # Errors
/// Where the recipe names what is not there, or what cannot be.
pub(super) fn trim(recipe: &Recipe, part: &Part, robot: &UrdfModule) -> Result<Trim, CombineError> {
    let trimmer = Trimmer {
        recipe,
        part,
        robot,
        id: part.id.text.clone(),
    };
    let child = |link: &str| robot.joints.iter().any(|joint| joint.child.link == link);
    let root = robot.links.iter().position(|link| !child(&link.name));
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
    robot: &'a UrdfModule,
    id: String,
}

impl Trimmer<'_> {
    fn drop(&self, trim: &mut Trim) -> Result<(), CombineError> {
        for word in &self.part.drop {
            let links = self.robot.links.iter().map(|link| link.name.as_str());
            let link = self.find("link", links, word)?;
            if link == trim.root {
                let fault = RecipeFault::DropsRoot {
                    part: self.id.clone(),
                    link: word.text.clone(),
                };
                return Err(self.recipe.refused(word, fault));
            }
            trim.dropped_links[link].get_or_insert_with(|| word.text.clone());
        }
        // A joint goes with its child, and all that hangs on a link with the link.
        let mut again = true;
        while again {
            again = false;
            for (idx, joint) in self.robot.joints.iter().enumerate() {
                let of = |name: &str| self.robot.links.iter().position(|link| link.name == name);
                let (Some(parent), Some(child)) = (of(&joint.parent.link), of(&joint.child.link))
                else {
                    continue;
                };
                let with = trim.dropped_links[child].clone();
                let with = with.or_else(|| trim.dropped_links[parent].clone());
                if with.is_some() && trim.dropped_joints[idx].is_none() {
                    trim.dropped_links[child] = with.clone();
                    trim.dropped_joints[idx] = with;
                    again = true;
                }
            }
        }
        Ok(())
    }

    fn freeze(&self, trim: &mut Trim) -> Result<(), CombineError> {
        for (word, values) in &self.part.freeze {
            let joints = self.robot.joints.iter().map(|joint| joint.name.as_str());
            let idx = self.find("joint", joints, word)?;
            let joint = &self.robot.joints[idx];
            let part = self.id.clone();
            let name = joint.name.clone();
            let refused = |fault| Err(self.recipe.refused(word, fault));
            if let Some(with) = &trim.dropped_joints[idx] {
                let (what, with) = ("joint", with.clone());
                return refused(RecipeFault::Dropped {
                    what,
                    part,
                    name,
                    with,
                });
            }
            let (expected, found) = (num_dofs(joint.joint_type), values.len());
            if expected == 0 {
                return refused(RecipeFault::FreezesFixed { part, joint: name });
            }
            if expected != found {
                return refused(RecipeFault::FreezeCount {
                    part,
                    joint: name,
                    expected,
                    found,
                });
            }
            if let (Some([lower, upper]), &[value]) = (limits(joint), values.as_slice())
                && !(lower..=upper).contains(&value)
            {
                return refused(RecipeFault::FreezeBeyond {
                    part,
                    joint: name,
                    value,
                    lower,
                    upper,
                });
            }
            trim.frozen.insert(idx, values.clone());
        }
        Ok(())
    }

    /// What follows a joint that is frozen is frozen where it is then; what follows one that is dropped
    /// has nothing to follow.
    fn follow(&self, trim: &mut Trim) -> Result<(), CombineError> {
        let joints = &self.robot.joints;
        let mut again = true;
        while again {
            again = false;
            for (idx, joint) in joints.iter().enumerate() {
                let moves = joint.joint_type != JointType::Fixed;
                let is_free = trim.keeps_joint(idx) && !trim.frozen.contains_key(&idx) && moves;
                let Some(mimic) = joint.mimic.as_ref().filter(|_| is_free) else {
                    continue;
                };
                let Some(driver) = joints.iter().position(|of| of.name == mimic.joint) else {
                    continue;
                };
                if let Some(with) = &trim.dropped_joints[driver] {
                    let fault = RecipeFault::DriverDropped {
                        part: self.id.clone(),
                        joint: joint.name.clone(),
                        driver: mimic.joint.clone(),
                        with: with.clone(),
                    };
                    let mut drops = self.part.drop.iter();
                    let at = drops.find(|word| word.text == *with);
                    return Err(self.recipe.refused(at.unwrap_or(&self.part.id), fault));
                }
                if let Some(&[value]) = trim.frozen.get(&driver).map(Vec::as_slice) {
                    let (multiplier, offset) = (mimic.multiplier, mimic.offset);
                    let value = multiplier.unwrap_or(1.0) * value + offset.unwrap_or(0.0);
                    trim.frozen.insert(idx, vec![value]);
                    trim.following.push(joint.name.clone());
                    again = true;
                }
            }
        }
        Ok(())
    }

    fn find<'a>(
        &self,
        what: &'static str,
        mut names: impl Iterator<Item = &'a str> + Clone,
        word: &Word,
    ) -> Result<usize, CombineError> {
        let near = names.clone();
        names.position(|name| name == word.text).ok_or_else(|| {
            let fault = RecipeFault::Unknown {
                what,
                part: self.id.clone(),
                name: word.text.clone(),
                nearest: nearest(near, &word.text),
            };
            self.recipe.refused(word, fault)
        })
    }
}

/// How many numbers say where a joint is.
fn num_dofs(joint_type: JointType) -> usize {
    match joint_type {
        JointType::Fixed => 0,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic => 1,
        JointType::Planar | JointType::Spherical => 3,
        JointType::Floating => 6,
    }
}

/// The limits of a joint that has some: SPEC 6.5.
fn limits(joint: &Joint) -> Option<[f64; 2]> {
    let is_limited = matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic);
    let limit = joint.limit.as_ref().filter(|_| is_limited)?;
    match (limit.lower, limit.upper) {
        (None, None) => None,
        (lower, upper) => Some([lower.unwrap_or(0.0), upper.unwrap_or(0.0)]),
    }
}
