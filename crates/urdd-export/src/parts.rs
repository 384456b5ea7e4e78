//! Names that an export invents: none is one of the robot's, nor another invented one. Above all those of the simple
//! joints that a joint of several DOFs is a chain of.

use std::collections::HashSet;

use nalgebra::Vector3;

use crate::{Format, Structure};
use urdd_document::robot::Joint as View;
use urdd_format::urdf::JointType;
use urdd_kinematics::rotation::{planar_basis, unit_axis};

/// The names of one space of names.
#[derive(Debug, Clone, Default)]
pub struct Taken(HashSet<String>);

impl Taken {
    pub fn new<'n>(names: impl IntoIterator<Item = &'n String>) -> Self {
        Taken(names.into_iter().cloned().collect())
    }

    /// Whether nothing had this name, which is taken from now on.
    pub fn insert(&mut self, name: &str) -> bool {
        self.0.insert(name.to_owned())
    }

    /// A name that nothing has yet, and that is taken from now on: the wanted one, or with a number after it.
    pub fn free(&mut self, wanted: String) -> String {
        let mut name = wanted.clone();
        let mut number = 2;
        while !self.0.insert(name.clone()) {
            name = format!("{wanted}_{number}");
            number += 1;
        }
        name
    }
}

/// How a part of a joint moves.
#[derive(Debug, Clone, Copy)]
pub(super) enum Moves {
    /// Along an axis in the joint's frame.
    Slides(Vector3<f64>),
    /// About an axis in the joint's frame.
    Turns(Vector3<f64>),
    /// About its centre.
    Ball,
}

/// The simple joints that a joint of several DOFs is a chain of, from its parent to its child: for formats that have no
/// planar and floating joints. Empty for joints of one DOF and fixed ones. A ball has the name `own` of the joint; other
/// names are new.
fn parts(joint: &View, own: &str, taken: &mut Taken) -> Vec<(String, Moves)> {
    let mut part = |name: &str, moves: Moves| (taken.free(format!("{}/{name}", joint.name)), moves);
    let ball = || (own.to_owned(), Moves::Ball);
    match joint.joint_type {
        JointType::Planar => {
            let axis = unit_axis(joint.axis).unwrap_or(Vector3::x_axis());
            let [x, y] = planar_basis(&axis);
            vec![
                part("trans_x", Moves::Slides(x)),
                part("trans_y", Moves::Slides(y)),
                part("rot", Moves::Turns(axis.into_inner())),
            ]
        }
        JointType::Floating => vec![
            part("trans_x", Moves::Slides(Vector3::x())),
            part("trans_y", Moves::Slides(Vector3::y())),
            part("trans_z", Moves::Slides(Vector3::z())),
            ball(),
        ],
        JointType::Spherical => vec![ball()],
        JointType::Fixed | JointType::Revolute | JointType::Continuous | JointType::Prismatic => {
            Vec::new()
        }
    }
}

/// What the joints of a robot are called in a file.
pub(super) struct JointNames {
    /// By joint.
    pub joints: Vec<String>,
    /// By joint, the simple joints that one of several DOFs is a chain of.
    pub parts: Vec<Vec<(String, Moves)>>,
    /// The names of the space that joints are in, with those above.
    pub taken: Taken,
}

impl JointNames {
    pub fn new(format: Format, of: &Structure) -> Self {
        let own = || of.view.joints.iter().map(|joint| &joint.name);
        let links = || of.view.links.iter().map(|link| &link.name);
        let mut joints: Vec<String> = own().cloned().collect();
        let mut taken = match format {
            // Links, joints and frames share one space of names. A joint that has the name of a link is renamed, as by
            // Gazebo's own converter.
            Format::Sdf => {
                let mut links = Taken::new(links());
                links.0.insert("world".to_owned());
                let mut taken = Taken::new(links.0.iter().chain(own()));
                for name in joints.iter_mut().filter(|name| links.0.contains(*name)) {
                    *name = taken.free(format!("{name}_joint"));
                }
                taken
            }
            // Parts of a joint have links between them, of the same names.
            Format::Drake => Taken::new(links().chain(own())),
            _ => Taken::new(own()),
        };
        let each = of.view.joints.iter().zip(&joints);
        let parts = each.map(|(joint, own)| parts(joint, own, &mut taken)).collect();
        JointNames { joints, parts, taken }
    }
}
