//! One body for links that are fixed to each other: that nearest to the root. Nothing becomes part of a root called `world`,
//! which has neither mass nor shapes in programs.

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};

use super::root::place;
use crate::inertia::tensor;
use crate::layout::{Place, origin};
use crate::{ExportError, Layout, Note, Structure};
use urdd_document::robot::Inertial as View;
use urdd_format::urdf::{Inertia, Inertial, JointType, Mass, UrdfModule};

const NEGATIVE: &str = "its mass is negative; in the link that it is joined with, it counts as 0 kg, and its moments of inertia stay";

/// Joins links.
pub(super) fn merge(
    urdf: &mut UrdfModule,
    structure: &Structure,
    layout: &mut Layout,
    notes: &mut Vec<Note>,
) -> Result<(), ExportError> {
    let (view, tree) = (&structure.view, &structure.tree);
    let mut places: Vec<Place> = (0..view.links.len()).map(Place::at).collect();
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); view.links.len()];
    for &link in &tree.order {
        if let (Some(joint), Some(parent)) = (tree.parent_joint[link], tree.parent_link[link])
            && view.joints[joint].joint_type == JointType::Fixed
            && !structure.is_world(parent)
        {
            let on = places[parent];
            let pose = on.pose * view.joints[joint].origin.motion();
            places[link] = Place { link: on.link, pose };
            members[on.link].push(link);
        }
    }
    for (index, joint) in view.joints.iter().enumerate() {
        let on = places[tree.joint_links[index].0];
        if on.link != tree.joint_links[index].0 {
            let own = &mut urdf.joints[index];
            own.parent.link.clone_from(&view.links[on.link].name);
            own.origin = Some(origin(&(on.pose * joint.origin.motion())));
        }
    }
    for (body, others) in members.iter().enumerate().filter(|(_, others)| !others.is_empty()) {
        join(urdf, structure, (body, others), &places, notes)?;
    }
    let joined = places.iter().enumerate().filter(|(link, place)| place.link != *link);
    let joined: Vec<String> = joined.map(|(link, _)| view.links[link].name.clone()).collect();
    if !joined.is_empty() {
        notes.push(Note::Joined(joined));
    }
    record(layout, &places, tree.root);
    Ok(())
}

/// Puts what is in some links into the one that they are fixed to.
fn join(
    urdf: &mut UrdfModule,
    structure: &Structure,
    (body, others): (usize, &[usize]),
    places: &[Place],
    notes: &mut Vec<Note>,
) -> Result<(), ExportError> {
    let view = &structure.view;
    let all = || std::iter::once(&body).chain(others);
    let masses = all().filter_map(|link| Some((*link, view.links[*link].inertial.as_ref()?)));
    let masses: Vec<_> = masses.collect();
    if masses.iter().any(|(link, _)| *link != body) {
        let bodies: Vec<_> = masses.iter().map(|(link, of)| (places[*link].pose, *of)).collect();
        let name = || view.links[body].name.clone();
        let joined = lump(&bodies).ok_or_else(|| ExportError::Infinite { link: name() })?;
        for (link, of) in masses {
            if of.mass.is_some_and(|mass| mass < 0.0) {
                let link = view.links[link].name.clone();
                notes.push(Note::Inertia { link, what: NEGATIVE });
            }
        }
        urdf.links[body].inertial = Some(joined);
    }
    for &link in others {
        let mut own = urdf.links[link].clone();
        place(&mut own, &view.links[link], &places[link].pose);
        let left = &mut urdf.links[link];
        (left.inertial, left.visual, left.collision) = Default::default();
        urdf.links[body].visual.append(&mut own.visual);
        urdf.links[body].collision.append(&mut own.collision);
    }
    Ok(())
}

/// Writes down what is where now.
fn record(layout: &mut Layout, places: &[Place], root: usize) {
    if layout.is_empty() {
        *layout = Layout::new(places.len(), root);
    }
    for content in &mut layout.content {
        let place = places[content.link];
        *content = Place { link: place.link, pose: place.pose * content.pose };
    }
    for (link, place) in places.iter().enumerate() {
        layout.is_frame[link] |= place.link != link;
    }
}

/// The mass, centre and moments of inertia of bodies at these poses: masses add up, and moments about the common centre by
/// the parallel axis theorem. A mass below 0 counts as 0, whose centre is nowhere. `None` if a number is not finite.
fn lump(bodies: &[(Isometry3<f64>, &View)]) -> Option<Inertial> {
    let placed = bodies.iter().map(|(pose, of)| {
        let place = pose * of.origin.motion();
        (of.mass.unwrap_or(0.0).max(0.0), place, of.inertia.unwrap_or_default())
    });
    let placed: Vec<_> = placed.collect();
    let total: f64 = placed.iter().map(|(mass, ..)| mass).sum();
    let at = |place: &Isometry3<f64>| (place * Point3::origin()).coords;
    let centre: Vector3<f64> = if total > 0.0 {
        placed.iter().map(|(mass, place, _)| at(place) * (mass / total)).sum()
    } else {
        Vector3::zeros()
    };
    let mut sum = Matrix3::zeros();
    for (mass, place, inertia) in &placed {
        let turn = place.rotation.to_rotation_matrix();
        let own = tensor(*inertia);
        let arm = at(place) - centre;
        let steiner = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
        sum += turn * own * turn.transpose() + steiner * *mass;
    }
    let inertia = |row: usize, column: usize| Some(sum[(row, column)]);
    let is_finite = total.is_finite() && centre.iter().chain(&sum).all(|value| value.is_finite());
    is_finite.then(|| Inertial {
        origin: Some(origin(&Isometry3::from_parts(centre.into(), Default::default()))),
        mass: Some(Mass { value: total }),
        inertia: Some(Inertia {
            ixx: inertia(0, 0),
            ixy: inertia(0, 1),
            ixz: inertia(0, 2),
            iyy: inertia(1, 1),
            iyz: inertia(1, 2),
            izz: inertia(2, 2),
        }),
    })
}
