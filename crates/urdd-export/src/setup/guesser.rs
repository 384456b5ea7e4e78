//! What is known while guessing, and what all guesses ask.

use nalgebra::Isometry3;

use super::chains::Chains;
use super::words::{self, Part};
use super::{EndEffector, Group, Guess, Members};
use crate::structure::Structure;

/// The longest finger, m.
pub(super) const FINGER: f64 = 0.25;

/// What is known while guessing.
pub(super) struct Guesser<'a> {
    pub structure: &'a Structure,
    pub poses: &'a [Isometry3<f64>],
    pub chains: Chains,
    pub groups: Vec<Guess<Group>>,
    pub ends: Vec<Guess<EndEffector>>,
    pub tools: Vec<usize>,
    /// Why the robot moves about, if it does.
    pub mobile: Option<&'static str>,
}

impl Guesser<'_> {
    pub fn is_horizontal(&self, joint: usize) -> bool {
        let child = self.structure.tree.joint_links[joint].1;
        let axis = self.poses[child].rotation
            * nalgebra::Vector3::from(self.structure.view.joints[joint].axis);
        axis.z.abs() < 0.5 * axis.norm()
    }

    /// Whether chains that begin at one place are the fingers of a hand: several, short, and no legs.
    pub fn are_fingers(&self, chains: &[usize]) -> bool {
        let is_finger = |chain: &usize| {
            self.chains.all[*chain].reach <= FINGER
                && !matches!(
                    self.part_of(*chain),
                    Some(Part::Leg | Part::Head | Part::Torso | Part::Arm)
                )
        };
        chains.len() > 1 && chains.iter().all(is_finger)
    }

    /// The link from which all fingers begin, if it is one.
    pub fn palm(&self, fingers: &[usize]) -> Option<usize> {
        let base = self.chains.all[*fingers.first()?].base;
        let all = fingers.iter().all(|finger| self.chains.all[*finger].base == base);
        all.then_some(base)
    }

    /// The tool frame of an arm: a frame with the name of a tool that is fixed to the palm, or else to the last link,
    /// `tool0` first; without one, the palm or the last link.
    pub fn tool(&self, last: usize, palm: Option<usize>) -> usize {
        let links = &self.structure.view.links;
        let is_frame = |link: &usize| {
            let link = &links[*link];
            link.visual.is_empty() && link.collision.is_empty() && words::is_tool(&link.name)
        };
        let best = |link: usize| {
            let fixed = self.structure.fixed_to(link);
            let frames: Vec<usize> = fixed[1..].iter().copied().filter(is_frame).collect();
            let tool0 = frames.iter().find(|frame| words::is_tool0(&links[**frame].name));
            tool0.or(frames.last()).copied()
        };
        palm.and_then(best).or_else(|| best(last)).unwrap_or(palm.unwrap_or(last))
    }

    pub fn moving(&self, joints: &[usize]) -> Members {
        let joints = joints.iter().copied();
        Members::Joints(joints.filter(|joint| self.structure.moves(*joint)).collect())
    }

    /// Adds a group with a name of its own, if it has members. Returns its place.
    pub fn push(&mut self, name: &str, members: Members, passive: bool, why: &str) -> usize {
        let place = self.groups.len();
        if members == Members::Joints(Vec::new()) {
            return place;
        }
        let is_free = |name: &str| self.groups.iter().all(|group| group.value.name != name);
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut names = [name.to_owned()].into_iter().chain(numbered);
        let name = names.find(|name| is_free(name)).unwrap_or_default();
        self.groups.push(Guess { value: Group { name, members, passive }, why: why.to_owned() });
        place
    }

    pub fn names(&self, chain: usize) -> impl Iterator<Item = &str> {
        let joints = self.chains.all[chain].joints.iter();
        joints.map(|joint| self.structure.view.joints[*joint].name.as_str())
    }

    pub fn part_of(&self, chain: usize) -> Option<Part> {
        words::part(self.names(chain))
    }

    pub fn named(&self, chain: usize, kind: &str) -> String {
        with_side(words::side(self.names(chain)).as_deref(), kind)
    }
}

pub(super) fn with_side(side: Option<&str>, kind: &str) -> String {
    side.map_or_else(|| kind.to_owned(), |side| format!("{side}_{kind}"))
}

pub(super) fn joints(count: usize) -> String {
    match count {
        1 => "1 joint".to_owned(),
        count => format!("{count} joints"),
    }
}
