//! The joints of a robot as a tree.

use crate::ExportError;
use urdd_document::robot::{Robot as View, of_urdf};
use urdd_document::tree::{Mimics, Tree};
use urdd_format::urdf::UrdfModule;
use urdd_kinematics::rotation::unit_axis;
use urdd_robot::Robot;

pub(super) struct Structure {
    /// The robot with the defaults of URDF filled in.
    pub view: View,
    pub tree: Tree,
    /// For each joint, the DOF that it follows, with mimic chains resolved.
    pub mimics: Mimics,
}

impl Structure {
    pub fn new(robot: &Robot) -> Result<Self, ExportError> {
        Structure::of(&robot.description()?)
    }

    pub fn of(urdf: &UrdfModule) -> Result<Self, ExportError> {
        let view = of_urdf(urdf);
        let tree = Tree::new(&view).ok_or(ExportError::NoTree)?;
        let mimics = Mimics::resolve(&view).ok_or(ExportError::Mimics)?;
        Ok(Structure { view, tree, mimics })
    }

    /// The robot's name, and its numbers of links and joints.
    pub fn identity(&self) -> (String, [usize; 2]) {
        let view = &self.view;
        (view.name.clone(), [view.links.len(), view.joints.len()])
    }

    pub fn check(&self, of: &(String, [usize; 2])) -> Result<(), ExportError> {
        if *of == self.identity() {
            Ok(())
        } else {
            Err(ExportError::OtherSetup { found: of.0.clone(), expected: self.view.name.clone() })
        }
    }

    /// Whether a link is the root link and called `world`: what MuJoCo, SDF, Drake and MoveIt call their own.
    pub fn is_world(&self, link: usize) -> bool {
        link == self.tree.root && self.view.links[link].name == "world"
    }

    /// Whether a joint has one DOF and follows no other: what an actuator can drive.
    pub fn is_driven(&self, joint: usize) -> bool {
        self.view.joints[joint].num_dofs() == 1 && self.moves(joint)
    }

    /// Whether a joint has DOFs and follows no other.
    pub fn moves(&self, joint: usize) -> bool {
        self.view.joints[joint].num_dofs() > 0 && self.mimics.by_joint[joint].is_none()
    }

    /// The position at which equal limits hold a joint of one DOF that follows no other.
    pub fn locked_at(&self, joint: usize) -> Option<f64> {
        let limits = self.view.joints[joint].position_limits().filter(|_| self.moves(joint));
        limits.filter(|(lower, upper)| lower == upper).map(|(lower, _)| lower)
    }

    /// Whether a joint follows one that is fixed.
    pub fn follows_fixed(&self, joint: usize) -> bool {
        let mimic = self.mimics.by_joint[joint].as_ref();
        mimic.is_some_and(|mimic| self.view.joints[mimic.driver].num_dofs() == 0)
    }

    /// The position of a joint of one DOF that never moves: fixed, without an axis, locked, or as it follows such a one.
    pub fn stands_at(&self, joint: usize) -> Option<f64> {
        let view = &self.view.joints[joint];
        let has_axis = unit_axis(view.axis).is_some();
        match &self.mimics.by_joint[joint] {
            _ if view.num_dofs() == 0 || (view.num_dofs() == 1 && !has_axis) => Some(0.0),
            Some(mimic) => Some(mimic.multiplier * self.stands_at(mimic.driver)? + mimic.offset),
            None => self.locked_at(joint),
        }
    }

    /// Whether an actuator of a simulation drives a joint.
    pub fn is_actuated(&self, joint: usize) -> bool {
        self.is_driven(joint) && self.locked_at(joint).is_none()
    }

    /// A link and those that are fixed to it, further from the root.
    pub fn fixed_to(&self, link: usize) -> Vec<usize> {
        self.reached(link, |joint| self.view.joints[joint].num_dofs() == 0)
    }

    /// The moving joints that are attached to a link or to what is fixed to it, in joint order.
    pub fn joints_after(&self, link: usize) -> Vec<usize> {
        let joints = self.fixed_to(link).into_iter().flat_map(|link| &self.tree.child_joints[link]);
        let mut joints: Vec<usize> =
            joints.copied().filter(|joint| self.view.joints[*joint].num_dofs() > 0).collect();
        joints.sort_unstable();
        joints
    }

    pub fn links_after(&self, link: usize) -> Vec<usize> {
        self.reached(link, |_| true)
    }

    /// A link and its descendants over such joints, those nearer first.
    fn reached(&self, link: usize, over: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut links = vec![link];
        let mut next = 0;
        while let Some(&link) = links.get(next) {
            let children = self.tree.child_joints[link].iter().filter(|joint| over(**joint));
            links.extend(children.map(|joint| self.tree.joint_links[*joint].1));
            next += 1;
        }
        links
    }

    /// The joints from a link to a descendant, from the root outwards; empty if it is not one.
    pub fn between(&self, base: usize, tip: usize) -> Vec<usize> {
        let mut joints = Vec::new();
        let mut link = tip;
        while link != base {
            let Some(joint) = self.tree.parent_joint[link] else { return Vec::new() };
            joints.push(joint);
            link = self.tree.joint_links[joint].0;
        }
        joints.reverse();
        joints
    }

    /// Whether a joint between the two links moves.
    pub fn is_chain(&self, base: usize, tip: usize) -> bool {
        self.between(base, tip).iter().any(|joint| self.moves(*joint))
    }
}
