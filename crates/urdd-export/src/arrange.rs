//! Another tree of the same robot: with another root, and with one body for links that are fixed to each other. It is made
//! before a format sees the robot, as a URDF and where everything of the URDD is in it.
//!
//! Links and joints keep names, order and values. A frame of the source that no body has is a link without mass and shapes
//! on a fixed joint, which formats with frames write as one.
//!
//! A joint that is turned round has its links exchanged, and its axis turned: with the same value, they are in the same pose to
//! each other. URDF has the frame of a link at the joint that moves it, so that of the link that was the parent of a hinge goes
//! there, by the shortest way and without turning. Links that are fixed to each other become one body, that nearest to the root.
//! Nothing becomes part of a root called `world`, which has neither mass nor shapes in programs.

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, Vector3};

use crate::error::unknown;
use crate::inertia::tensor;
use crate::layout::{Place, origin};
use crate::{Choices, ExportError, Layout, Members, Note, Setup, Structure, Taken};
use urdd_document::robot::{Inertial as InertialView, Joint as View, Link as ViewOfLink};
use urdd_format::urdf::{Axis, Inertia, Inertial, Joint, JointType, Link, Mass, UrdfModule};
use urdd_kinematics::rotation::unit_axis;

pub(super) struct Arranged {
    pub urdf: UrdfModule,
    pub structure: Structure,
    pub layout: Layout,
    pub notes: Vec<Note>,
}

impl Arranged {
    pub fn new(urdf: UrdfModule, choices: &Choices) -> Result<Self, ExportError> {
        let structure = Structure::of(&urdf)?;
        let (layout, notes) = (Layout::default(), Vec::new());
        let mut made = Arranged { urdf, structure, layout, notes };
        if let Some(name) = &choices.root {
            let links = || made.structure.view.links.iter().map(|link| link.name.as_str());
            let root = links().position(|link| link == name);
            let root = root.ok_or_else(|| unknown("link", name, links()))?;
            if root != made.structure.tree.root {
                let notes = &mut made.notes;
                made.layout = turn(&mut made.urdf, &made.structure, root, notes)?;
                made.structure = Structure::of(&made.urdf)?;
            }
        }
        if choices.merge_fixed {
            merge(&mut made.urdf, &made.structure, &mut made.layout, &mut made.notes)?;
            made.structure = Structure::of(&made.urdf)?;
        }
        Ok(made)
    }
}

const CHAIN: &str = "its chain runs another way now; it is a group of joints, for which MoveIt solves no inverse kinematics";

/// What is said of the robot of a URDD, of another tree of it.
pub(crate) fn setup(
    setup: &Setup,
    source: &Structure,
    now: &Structure,
    layout: &Layout,
    notes: &mut Vec<Note>,
) -> Setup {
    let mut setup = setup.clone();
    let links = setup.tools.value.iter_mut().chain(&mut setup.imus.value);
    let links = links.chain(setup.end_effectors.iter_mut().map(|end| &mut end.value.parent_link));
    links.for_each(|link| *link = layout.frame(*link));
    for group in &mut setup.groups {
        let Members::Chain { base, tip } = group.value.members else { continue };
        let moving = |of: &Structure, base: usize, tip: usize| {
            let mut joints = of.between(base, tip);
            joints.retain(|joint| of.view.joints[*joint].num_dofs() > 0);
            joints
        };
        let mut joints = moving(source, base, tip);
        let (base, tip) = (layout.body(base), layout.frame(tip));
        group.value.members = if moving(now, base, tip) == joints {
            Members::Chain { base, tip }
        } else {
            notes.push(Note::Group { group: group.value.name.clone(), what: CHAIN });
            joints.sort_unstable();
            Members::Joints(joints)
        };
    }
    setup
}

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

const NEGATIVE: &str = "its mass is negative; in the link that it is joined with, it counts as 0 kg, and its moments of inertia stay";

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
fn lump(bodies: &[(Isometry3<f64>, &InertialView)]) -> Option<Inertial> {
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
