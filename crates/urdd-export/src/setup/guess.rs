//! Guesses from structure, each with its reason: chains of joints, where they branch, how far they reach, where they
//! point in the default configuration, and words in names.

use std::collections::BTreeMap;

use super::guesser::{Chains, FINGER, Guesser, Part, with_side};
use super::{Curobo, EndEffector, Gains, Guess, Members, Setup, guesser};
use crate::{ExportError, Structure};
use urdd_format::readable::counted;
use urdd_format::urdf::JointType;
use urdd_robot::Robot;

/// The fewest joints of an arm.
const ARM: usize = 3;

impl Setup {
    /// Guesses from the structure of a robot.
    ///
    /// # Errors
    /// If a module that describes the robot is missing or unusable.
    pub fn guess(robot: &Robot) -> Result<Setup, ExportError> {
        let structure = Structure::new(robot)?;
        let poses = robot.link_poses(&robot.configurations()?.zero())?;
        let mut guesser = Guesser {
            chains: Chains::new(&structure, &poses),
            structure: &structure,
            poses: &poses,
            groups: Vec::new(),
            ends: Vec::new(),
            tools: Vec::new(),
            mobile: None,
        };
        guesser.all();
        Ok(guesser.setup())
    }
}

impl Guesser<'_> {
    fn all(&mut self) {
        let wheels = self.wheels();
        let mut roots = self.chains.roots.clone();
        roots.retain(|root| !wheels.contains(root));
        // A base that the URDF itself lets move, such as by a floating joint from `world`.
        while let [root] = roots[..]
            && let [joint] = self.chains.all[root].joints[..]
            && self.structure.view.joints[joint].num_dofs() > 1
        {
            let why = "a joint of several DOFs at the root link, before all others";
            self.push("base", Members::Joints(vec![joint]), false, why);
            roots.clone_from(&self.chains.all[root].children);
        }
        if self.are_fingers(&roots) {
            self.hand(&[], &roots);
            return;
        }
        let legs: Vec<usize> = roots.iter().copied().filter(|root| self.is_leg(*root)).collect();
        let legs = if legs.len() > 1 { legs } else { Vec::new() };
        for root in roots {
            if legs.contains(&root) { self.leg(root) } else { self.limb(root) }
        }
    }

    fn setup(self) -> Setup {
        let (floating, why) = match self.mobile {
            Some(why) => (true, why),
            None => (false, "it has neither legs nor wheels"),
        };
        let links = self.structure.view.links.iter().enumerate();
        let imus = links.filter(|(_, link)| guesser::is_imu(&link.name)).map(|(link, _)| link);
        Setup {
            of: self.structure.identity(),
            floating: Guess {
                value: floating,
                why: why.to_owned(),
            },
            base_poses: BTreeMap::new(),
            groups: self.groups,
            end_effectors: self.ends,
            tools: Guess {
                value: self.tools,
                why: "at the end of each arm, the frame without shapes and with a name like `tool0`; without one, the hand or the last link".to_owned(),
            },
            imus: Guess {
                value: imus.collect(),
                why: "links with `imu` in their names".to_owned(),
            },
            gains: Gains::default(),
            curobo: Curobo::default(),
            acceleration: None,
            jerk: None,
            friction: None,
        }
    }

    /// Finds wheels and casters: two or more continuous joints that end there, with horizontal axes.
    fn wheels(&mut self) -> Vec<usize> {
        let mut wheels = Vec::new();
        let mut casters = Vec::new();
        for &root in &self.chains.roots {
            let chain = &self.chains.all[root];
            let is_continuous = |joint: &usize| {
                self.structure.view.joints[*joint].joint_type == JointType::Continuous
            };
            let ends = chain.children.is_empty() && chain.joints.iter().all(is_continuous);
            if ends && self.is_horizontal(chain.joints[chain.joints.len() - 1]) {
                match chain.joints.len() {
                    1 => wheels.push(root),
                    2 => casters.push(root),
                    _ => {}
                }
            }
        }
        if wheels.len() + casters.len() < 2 {
            return Vec::new();
        }
        let joints = |chains: &[usize]| {
            let chains = chains.iter().flat_map(|chain| &self.chains.all[*chain].joints);
            let mut joints: Vec<usize> = chains.copied().collect();
            joints.retain(|joint| self.structure.moves(*joint));
            joints.sort_unstable();
            joints
        };
        let [driven, swivelling] = [joints(&wheels), joints(&casters)];
        if !driven.is_empty() {
            self.mobile = Some("it has wheels");
        }
        let why =
            "continuous joints at the root link with a horizontal axis, and nothing after them";
        self.push("wheels", Members::Joints(driven), false, why);
        let why = "two continuous joints in a row at the root link, and nothing after them; nothing drives casters";
        self.push("casters", Members::Joints(swivelling), true, why);
        wheels.extend(casters);
        wheels
    }

    /// Whether a chain at the root link is a leg: by its name, or because it points down to the lowest part of the robot.
    fn is_leg(&self, chain: usize) -> bool {
        let height = |link: usize| self.poses[link].translation.z;
        let of = &self.chains.all[chain];
        let first = self.structure.tree.joint_links[of.joints[0]].1;
        let after = |link: usize| {
            self.structure.links_after(link).into_iter().map(height).fold(f64::INFINITY, f64::min)
        };
        match self.part_of(chain) {
            Some(Part::Leg) => true,
            Some(_) => false,
            None => {
                let lowest = after(first);
                height(first) - lowest > 0.5 * of.reach
                    && lowest < after(self.structure.tree.root) + 0.2 * of.reach
                    && of.joints.len() >= ARM
            }
        }
    }

    fn leg(&mut self, chain: usize) {
        self.mobile = Some("it has legs");
        let name = self.named(chain, "leg");
        let why = format!(
            "{} at the root link that lead down, as others do",
            counted(self.chains.all[chain].joints.len(), "joint")
        );
        let members = if self.chains.all[chain].children.is_empty() {
            let of = &self.chains.all[chain];
            let tip = self.structure.fixed_to(of.last).into_iter().max_by(|a, b| {
                let depth = |link: usize| -self.poses[link].translation.z;
                depth(*a).total_cmp(&depth(*b))
            });
            Members::Chain { base: of.base, tip: tip.unwrap_or(of.last) }
        } else {
            self.moving(&self.chains.joints_from(chain))
        };
        self.push(&name, members, false, &why);
    }

    /// A chain that is no leg, and what begins at its end.
    fn limb(&mut self, first: usize) {
        let mut open = vec![first];
        while let Some(chain) = open.pop() {
            let of = &self.chains.all[chain];
            let (base, children) = (of.base, of.children.clone());
            let driven = of.joints.iter().filter(|joint| self.structure.moves(**joint)).count();
            let own = of.joints.clone();
            if self.are_fingers(&children) {
                if driven < ARM {
                    self.hand(&own, &children);
                    continue;
                }
                let arm = self.arm(chain, base, self.palm(&children), driven);
                let hand = self.hand(&[], &children);
                self.end_effector(arm, hand);
                continue;
            }
            if children.is_empty() && (driven >= ARM || self.part_of(chain) == Some(Part::Arm)) {
                match self.part_of(chain) {
                    Some(Part::Head) => self.small(chain, "head", driven),
                    Some(Part::Torso) => self.small(chain, "torso", driven),
                    _ => {
                        self.arm(chain, base, None, driven);
                    }
                }
                continue;
            }
            match (self.part_of(chain), children.is_empty()) {
                (Some(Part::Head), _) => self.small(chain, "head", driven),
                (Some(Part::Torso), _) | (_, false) => self.small(chain, "torso", driven),
                _ => self.small(chain, "chain", driven),
            }
            open.extend(children.iter().rev());
        }
    }

    /// An arm, which may carry a hand with a palm. Returns its group and its tip.
    fn arm(
        &mut self,
        chain: usize,
        base: usize,
        palm: Option<usize>,
        driven: usize,
    ) -> (usize, usize) {
        let last = self.chains.all[chain].last;
        let tool = self.tool(last, palm);
        let tip = match palm {
            Some(palm) if palm != last => self.structure.tree.parent_link[palm].unwrap_or(last),
            Some(_) => last,
            None => tool,
        };
        let why = match palm {
            Some(_) => format!("{} in a row, then the fingers of a hand", counted(driven, "joint")),
            None => format!("{} in a row, and none after them", counted(driven, "joint")),
        };
        let name = self.named(chain, "arm");
        self.tools.push(tool);
        (self.push(&name, Members::Chain { base, tip }, false, &why), tip)
    }

    /// A hand: its own joints, and fingers. Returns its group.
    fn hand(&mut self, own: &[usize], fingers: &[usize]) -> usize {
        let mut all = own.to_vec();
        let after = fingers.iter().flat_map(|finger| self.chains.joints_from(*finger));
        all.extend(after);
        all.sort_unstable();
        let names = |joints: &[usize]| -> Vec<String> {
            joints.iter().map(|joint| self.structure.view.joints[*joint].name.clone()).collect()
        };
        let is_single = |finger: &usize| self.chains.joints_from(*finger).len() == 1;
        let is_gripper = fingers.iter().all(is_single)
            && !self
                .palm(fingers)
                .is_some_and(|palm| guesser::is_hand(&self.structure.view.links[palm].name));
        let side = guesser::side(names(&all).iter().map(String::as_str));
        let kind = if is_gripper { "gripper" } else { "hand" };
        let name = with_side(side.as_deref(), kind);
        let chains: Vec<(Option<String>, usize, usize)> = fingers
            .iter()
            .filter(|_| fingers.len() > 2)
            .map(|finger| &self.chains.all[*finger])
            .filter(|finger| finger.joints.len() > 1 && finger.children.is_empty())
            .map(|finger| {
                let word = guesser::finger(names(&finger.joints).iter().map(String::as_str));
                (word, finger.base, finger.last)
            })
            .collect();
        let why =
            format!("{} chains that reach at most {FINGER} m begin at one place", fingers.len());
        let members = self.moving(&all);
        let group = self.push(&name, members, false, &why);
        for (word, base, last) in chains {
            let tip = self.structure.fixed_to(last).pop().unwrap_or(last);
            let name = with_side(side.as_deref(), word.as_deref().unwrap_or("finger"));
            if self.structure.is_chain(base, tip) {
                self.push(&name, Members::Chain { base, tip }, false, "one of these chains");
            }
        }
        group
    }

    fn end_effector(&mut self, (arm, tip): (usize, usize), hand: usize) {
        let name = self.groups[hand].value.name.clone();
        self.ends.push(Guess {
            value: EndEffector { name, group: hand, parent_group: Some(arm), parent_link: tip },
            why: "the hand at the end of this arm".to_owned(),
        });
    }

    /// A chain of few joints.
    fn small(&mut self, chain: usize, kind: &str, driven: usize) {
        let name = self.named(chain, kind);
        let after = if self.chains.all[chain].children.is_empty() {
            "none after them"
        } else {
            "other chains begin at their end"
        };
        let why = format!("{} in a row, and {after}", counted(driven, "joint"));
        let of = &self.chains.all[chain];
        let (base, tip) = (of.base, of.last);
        if self.structure.is_chain(base, tip) {
            self.push(&name, Members::Chain { base, tip }, false, &why);
        }
    }
}
