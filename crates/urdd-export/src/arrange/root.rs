//! Another root. A joint that is turned round has its links exchanged, and its axis turned: with the same value, they are in
//! the same pose to each other. URDF has the frame of a link at the joint that moves it, so that of the link that was the
//! parent of a hinge goes there, by the shortest way and without turning.

use nalgebra::{Isometry3, Translation3, Vector3};

use crate::layout::{Place, origin};
use crate::{ExportError, Layout, Note, Structure, Taken};
use urdd_document::robot::{Joint as View, Link as ViewOfLink};
use urdd_format::urdf::{Axis, Joint, JointType, Link, UrdfModule};
use urdd_kinematics::rotation::unit_axis;

/// A distance that is rounding, m.
const ROUNDING: f64 = 1e-12;

/// Makes a link the root.
pub(super) fn turn(
    urdf: &mut UrdfModule,
    structure: &Structure,
    root: usize,
    notes: &mut Vec<Note>,
) -> Result<Layout, ExportError> {
    let (view, tree) = (&structure.view, &structure.tree);
    let count = view.links.len();
    // The new frame of each link, in its own.
    let mut shifts = vec![Translation3::<f64>::identity(); count];
    let mut is_turned = vec![false; view.joints.len()];
    let mut moved_by = Vec::new();
    for index in structure.between(tree.root, root).into_iter().rev() {
        let (joint, (parent, child)) = (&view.joints[index], tree.joint_links[index]);
        let place = joint.origin.motion();
        let axis = place.rotation * Vector3::from(joint.axis);
        shifts[parent] = shift(joint, root, structure, &place, axis)?;
        if shifts[parent] != Translation3::identity() {
            moved_by.push((parent, index));
        }
        let turned = &mut urdf.joints[index];
        turned.origin = Some(origin(&(shifts[child].inverse() * place.inverse() * shifts[parent])));
        std::mem::swap(&mut turned.parent, &mut turned.child);
        if turned.joint_type != JointType::Fixed {
            turned.axis = Some(Axis { xyz: Some((-axis).into()) });
        }
        is_turned[index] = true;
    }
    for (index, joint) in view.joints.iter().enumerate() {
        let shift = shifts[tree.joint_links[index].0];
        if !is_turned[index] && shift != Translation3::identity() {
            urdf.joints[index].origin = Some(origin(&(shift.inverse() * joint.origin.motion())));
        }
    }
    let mut layout = Layout::new(count, root);
    let names = view.links.iter().map(|link| &link.name);
    let mut taken = Taken::new(names.chain(view.joints.iter().map(|joint| &joint.name)));
    moved_by.sort_unstable();
    for (link, joint) in moved_by {
        let back = Isometry3::from(shifts[link].inverse());
        layout.content[link].pose = back;
        layout.frames[link].pose = shifts[link].into();
        place(&mut urdf.links[link], &view.links[link], &back);
        let name = view.links[link].name.as_str();
        let frame = taken.free(format!("{name}_frame"));
        layout.frame_of[link] = urdf.links.len();
        layout.frames.push(Place::at(link));
        layout.is_frame.push(true);
        let fixed = taken.free(format!("{frame}_joint"));
        let fixed = Joint::new(fixed, JointType::Fixed, name, frame.as_str());
        urdf.joints.push(Joint { origin: Some(origin(&back)), ..fixed });
        let joint = view.joints[joint].name.clone();
        notes.push(Note::Moved { link: name.to_owned(), joint, frame: frame.clone() });
        urdf.links.push(Link::new(frame));
    }
    Ok(layout)
}

/// Where the frame of a joint's parent has to be for the joint to move it. The joint is at `place` in it.
fn shift(
    joint: &View,
    root: usize,
    structure: &Structure,
    place: &Isometry3<f64>,
    axis: Vector3<f64>,
) -> Result<Translation3<f64>, ExportError> {
    match joint.joint_type {
        JointType::Fixed | JointType::Prismatic => Ok(Translation3::identity()),
        JointType::Revolute | JointType::Continuous => {
            let to = place.translation.vector;
            let aside = unit_axis(axis.into()).map(|axis| to - *axis * axis.dot(&to));
            let aside = aside.filter(|aside| aside.norm() > ROUNDING);
            Ok(aside.map_or(Translation3::identity(), Translation3::from))
        }
        JointType::Planar | JointType::Floating | JointType::Spherical => Err(ExportError::Root {
            root: structure.view.links[root].name.clone(),
            joint: joint.name.clone(),
            kind: joint.joint_type,
        }),
    }
}

/// Moves what is in a link.
pub(super) fn place(link: &mut Link, view: &ViewOfLink, by: &Isometry3<f64>) {
    if let Some((inertial, view)) = link.inertial.as_mut().zip(view.inertial.as_ref()) {
        inertial.origin = Some(origin(&(by * view.origin.motion())));
    }
    for (visual, view) in link.visual.iter_mut().zip(&view.visual) {
        visual.origin = Some(origin(&(by * view.origin.motion())));
    }
    for (collision, view) in link.collision.iter_mut().zip(&view.collision) {
        collision.origin = Some(origin(&(by * view.origin.motion())));
    }
}
