//! What a URDF cannot say, in the files beside it: `NAME.srdf` for named configurations and pairs that never collide,
//! `NAME.export.toml` for what exports need, `NAME.loops.toml` for what closes chains.

use std::collections::{BTreeMap, HashMap, HashSet};

use nalgebra::{UnitQuaternion, Vector3};
use urdd_directory::export_toml::{ActuatorKind, File, JointGains, unplaced};
use urdd_directory::loops_toml::{self, CouplingTable, LoopTable};
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_kinematics::rotation::from_rotation_vector;
use urdd_source::loops::table;
use urdd_srdf::write;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

use super::model::{Joint, JointKind, Model};
use super::tree::{Edge, Tree};

/// The group whose states are the named configurations.
const GROUP: &str = "all";

/// The joints of the URDF that are DOFs: each with the values that it has in the configurations.
fn movable(tree: &Tree) -> impl Iterator<Item = &Edge> {
    tree.joints.iter().filter(|edge| edge.joint.is_some() && edge.mimic.is_none())
}

/// The values of the joints of the URDF in a configuration, by joint, with what its DOFs add to its name.
fn values<'t>(
    model: &Model,
    tree: &'t Tree,
    at: usize,
) -> Vec<(&'t str, Vec<f64>, &'static [&'static str])> {
    let configuration = &model.configurations[at].values;
    let by_joint: HashMap<(usize, usize), &[f64]> =
        configuration.iter().map(|value| (value.joint, &*value.values)).collect();
    let mut turns: HashMap<(usize, usize), usize> = HashMap::new();
    let mut all = Vec::new();
    for edge in movable(tree) {
        let Some((body, place)) = edge.joint else { continue };
        let joint = &model.bodies[body].joints[place];
        let Some(values) = by_joint.get(&(body, place)) else { continue };
        let is_split = joint.kind == JointKind::Ball && edge.kind != "spherical";
        let (own, dofs) = match (is_split, values) {
            (true, [x, y, z]) => {
                let turn = turns.entry((body, place)).or_default();
                let angles = in_turn([*x, *y, *z]);
                *turn += 1;
                (vec![angles[(*turn - 1).min(2)]], JointKind::Hinge.dofs())
            }
            _ => (values.to_vec(), joint.kind.dofs()),
        };
        all.push((&*edge.name, own, dofs));
    }
    all
}

/// The angles about x, then y, then z as they are turned, of a rotation vector.
fn in_turn(vector: [f64; 3]) -> [f64; 3] {
    let rotation: UnitQuaternion<f64> = from_rotation_vector(vector);
    // The inverse turns about z, then y, then x, as fixed axes do from behind: roll, pitch and yaw, negated.
    let columns = rotation.inverse().to_rotation_matrix();
    let [roll, pitch, yaw] = urdd_kinematics::rotation::to_rpy(columns.matrix());
    Vector3::new(-roll, -pitch, -yaw).into()
}

/// The named configurations, as a URDD has them.
pub fn configurations(model: &Model, tree: &Tree) -> Vec<ConfigurationEdit> {
    let edit = |at: usize| {
        let positions = values(model, tree, at).into_iter().flat_map(|(joint, values, dofs)| {
            let names = dofs.iter().map(move |dof| format!("{joint}{dof}"));
            names.zip(values).map(|(dof_name, position)| DofPosition { dof_name, position })
        });
        let name = ConfigurationName::new(&model.configurations[at].name)?;
        Some(ConfigurationEdit { name, positions: positions.collect() })
    };
    (0..model.configurations.len()).filter_map(edit).collect()
}

/// The pairs that are never checked, and those that are, as a URDD has them. That of neighbours needs no edit.
pub fn skips(model: &Model) -> Vec<SkipEdit> {
    let apart = model.apart.iter().filter(|apart| apart.reason != "Adjacent");
    let apart = apart.map(|apart| (apart, true));
    let checked = model.checked.iter().map(|pair| (pair, false));
    let edit = apart.chain(checked).map(|(pair, skip)| {
        let [link_a, link_b] = pair.bodies.map(|body| model.bodies[body].name.clone());
        SkipEdit { link_a, link_b, skip, reason: format!("imported: {}", pair.reason) }
    });
    edit.collect()
}

/// The text of `NAME.srdf`; none where it would say nothing.
pub fn srdf(model: &Model, tree: &Tree, original: &str) -> Option<String> {
    if model.configurations.is_empty() && model.apart.is_empty() {
        return None;
    }
    let mut robot = Element::new("robot").with("name", &*model.name);
    if !model.configurations.is_empty() {
        let mut group = write::group(GROUP);
        group.extend(movable(tree).map(|edge| write::joint(&edge.name)));
        robot.push(group);
    }
    for (at, configuration) in model.configurations.iter().enumerate() {
        let values = values(model, tree, at).into_iter();
        let values = values.map(|(joint, values, _)| (joint, numbers(&values)));
        robot.push(write::state(&configuration.name, GROUP, values));
    }
    for apart in &model.apart {
        let links = apart.bodies.map(|body| &*model.bodies[body].name);
        robot.push(write::disabled(links, apart.reason));
    }
    Some(robot.document(&[format!("`urdd import` made this file from {original}.")]))
}

/// The text of `NAME.loops.toml`; none where it would say nothing.
pub fn loops(model: &Model) -> Option<String> {
    let mut file = loops_toml::File::default();
    let mut names = HashSet::new();
    let mut named = |name: &Option<String>, kind: &str, place: usize| {
        let base = name.clone().unwrap_or_else(|| format!("{kind}{}", place + 1));
        let further = (2..).map(|number| format!("{base}_{number}"));
        let free = std::iter::once(base.clone()).chain(further).find(|name| !names.contains(name));
        let free = free.unwrap_or(base);
        names.insert(free.clone());
        free
    };
    for (place, closing) in model.closings.iter().enumerate() {
        let [a, b] = &closing.ends;
        file.loops.push(unplaced(LoopTable {
            name: named(&closing.name, "loop_", place),
            kind: closing.kind,
            link_a: unplaced(model.bodies[a.body].name.clone()),
            frame_a: table(&a.frame),
            link_b: unplaced(model.bodies[b.body].name.clone()),
            frame_b: table(&b.frame),
        }));
    }
    for (place, coupled) in model.couplings.iter().enumerate() {
        let mut terms = BTreeMap::new();
        for (joint, coefficients) in &coupled.terms {
            terms.insert(unplaced(joint.clone()), coefficients.clone());
        }
        let name = named(&coupled.name, "coupling_", place);
        file.couplings.push(unplaced(CouplingTable { name, constant: coupled.constant, terms }));
    }
    if file.is_empty() {
        return None;
    }
    let head = "# `urdd import` made this file: what closes the chains of the robot; `urdd generate` reads it.\n";
    file.to_text().ok().map(|text| head.to_owned() + &text)
}

/// The text of `NAME.export.toml`; none where it would say nothing.
pub fn setup(model: &Model, tree: &Tree) -> Option<String> {
    let mut file = File::of(&model.name);
    // Nothing drives a joint that follows another.
    for edge in movable(tree) {
        let Some((body, place)) = edge.joint else { continue };
        let gains = gains(&model.bodies[body].joints[place]);
        if gains != JointGains::default() {
            file.actuators.joint.insert(unplaced(edge.name.clone()), unplaced(gains));
        }
    }
    if file.actuators.joint.is_empty() && !model.is_floating && model.friction.is_none() {
        return None;
    }
    if model.is_floating {
        file.base.floating = true;
        let named = model.configurations.iter();
        let named = named.filter(|of| ConfigurationName::new(&of.name).is_some());
        let poses =
            named.filter_map(|of| Some((unplaced(of.name.clone()), unplaced(of.base?.to_vec()))));
        file.base.poses = poses.collect();
    }
    file.contact.friction = model.friction.map(unplaced);
    let head = "# `urdd import` made this file; `urdd export --setup` reads it.\n";
    file.to_text().ok().map(|text| head.to_owned() + &text)
}

/// What exports read of the actuator of a joint.
fn gains(joint: &Joint) -> JointGains {
    let actuator = &joint.actuator;
    JointGains {
        name: actuator.name.clone(),
        kind: actuator.is_of_speed.then_some(ActuatorKind::Velocity),
        kp: joint.kp,
        kv: joint.kv,
        armature: joint.armature,
        ctrlrange: actuator.control,
        // A force that is as great either way is the effort of the URDF.
        forcerange: actuator.force.filter(|[least, most]| *least != -*most),
    }
}
