//! The generator's URDF reader (SPEC 6.1). It keeps absent attributes distinct from zero, and checks that links and joints
//! form a valid kinematic tree (SPEC 6.1.3 to 6.1.6).
//!
//! A deviation from SPEC 6.1.8 with one meaning that any reader would agree on is repaired in the text: [`read`]
//! returns the edits with the remarks. The source in the URDD thus says the same as its modules.

mod parts;
mod reader;

use std::collections::{BTreeSet, HashMap};

use urdd_directory::position;
use urdd_format::short::Short;
use urdd_format::urdf::{Color, Joint, JointType, Material, Texture, UrdfModule};
use urdd_kinematics::rotation::unit_axis;
use urdd_kinematics::{has_axis, num_dofs};
use urdd_srdf::vocabulary::is_of_robot;
use urdd_xml::Xml;

use crate::fault::{Fault, PlacedFault};
use crate::macros::tags;
use crate::note::NoteKind;
use reader::UrdfReader;

pub use reader::{Reading, Tree, written_axis};

/// Reads a URDF. A robot without a name is named `file_stem`.
///
/// # Errors
/// If the text is not a valid robot: all faults, in the order of the text.
pub fn read(xml: &Xml<'_>, file_stem: &str) -> Result<Reading, Vec<PlacedFault>> {
    let document = xml.document().map_err(|error| vec![reader::fault(error, xml.text())])?;
    let mut reader = UrdfReader::default();
    reader.robot(document.root_element(), file_stem);
    if reader.faults.is_empty() {
        check(&mut reader, document.root_element().range().start);
    }
    check_materials(&mut reader);
    let UrdfReader { mut reading, mut faults, .. } = reader;
    reading.remarks.sort_by_key(|remark| remark.offset);
    if faults.is_empty() {
        return Ok(reading);
    }
    let lines = position::LineIndex::new(xml.text());
    faults.sort_by_key(|(offset, _)| *offset);
    let faults = faults.into_iter().map(|(offset, mut fault)| {
        let at = lines.position(offset);
        if let Fault::TwoLinks { first, .. } | Fault::TwoJoints { first, .. } = &mut fault {
            *first = lines.position(*first as usize).line;
        }
        PlacedFault { file: None, line: at.line, column: at.column, fault }
    });
    Err(faults.collect())
}

/// Checks the robot and fills in its tree. `robot_at` is the byte offset of `<robot>`.
fn check(reader: &mut UrdfReader, robot_at: usize) {
    same_names(reader);
    if reader.faults.is_empty() {
        ends(reader);
    }
    if reader.faults.is_empty() {
        one_root(reader, robot_at);
    }
    if reader.faults.is_empty() {
        axes(reader);
        mimics(reader);
        missing_limits(reader);
    }
}

fn same_names(reader: &mut UrdfReader) {
    let robot = &reader.reading.robot;
    let links = robot.links.iter().map(|link| &link.name);
    let links = links.zip(reader.link_places.iter().copied());
    let joints = robot.joints.iter().map(|joint| &joint.name);
    let joints = joints.zip(reader.joint_places.iter().map(|place| place.joint));
    let mut faults = twice(links, |name, first| Fault::TwoLinks { name, first });
    faults.extend(twice(joints, |name, first| Fault::TwoJoints { name, first }));
    reader.faults.extend(faults);
}

/// The faults of repeated names, each at its byte offset. `fault` takes the name and the byte offset of the first, until
/// [`read`] replaces it by the line.
fn twice<'a>(
    names: impl Iterator<Item = (&'a String, usize)>,
    fault: fn(Short, u32) -> Fault,
) -> Vec<(usize, Fault)> {
    let mut seen: HashMap<&str, usize> = HashMap::new();
    let mut found = Vec::new();
    for (name, offset) in names {
        let first = *seen.entry(name).or_insert(offset);
        if first != offset {
            let first = u32::try_from(first).unwrap_or(u32::MAX);
            found.push((offset, fault(Short::of(name), first)));
        }
    }
    found
}

fn ends(reader: &mut UrdfReader) {
    let robot = &reader.reading.robot;
    let names = robot.links.iter().enumerate();
    let links: HashMap<&str, usize> = names.map(|(idx, link)| (link.name.as_str(), idx)).collect();
    let mut moved_by: HashMap<usize, usize> = HashMap::new();
    let (mut tree, mut faults) = (Vec::new(), Vec::new());
    let mut plain_names = None;
    for (idx, (joint, place)) in robot.joints.iter().zip(&reader.joint_places).enumerate() {
        let sides = [
            ("parent", &joint.parent.link, place.parent),
            ("child", &joint.child.link, place.child),
        ];
        let found = sides.map(|(end, link, offset)| {
            let found = links.get(link.as_str()).copied();
            if found.is_none() {
                let plain_names = plain_names.get_or_insert_with(|| plain_names_of(robot));
                let meant = plain_names.get(&plain(link));
                let fault = Fault::UnknownLink {
                    joint: Short::of(&joint.name),
                    end,
                    link: Short::of(link),
                    hint: meant.map_or_else(String::new, |name| {
                        format!(" (there is `{}`)", Short::of(name))
                    }),
                };
                faults.push((offset, fault));
            }
            found
        });
        let [Some(parent), Some(child)] = found else {
            continue;
        };
        if let Some(first) = moved_by.insert(child, idx) {
            let fault = Fault::TwoParents {
                link: Short::of(&joint.child.link),
                joint: Short::of(&joint.name),
                first: Short::of(&robot.joints[first].name),
            };
            faults.push((place.child, fault));
        }
        tree.push([parent, child]);
    }
    reader.reading.tree.ends = tree;
    reader.faults.extend(faults);
}

/// The first link for each name, with case and surrounding white space ignored.
fn plain_names_of(robot: &UrdfModule) -> HashMap<String, &str> {
    let mut names = HashMap::new();
    for link in &robot.links {
        names.entry(plain(&link.name)).or_insert(link.name.as_str());
    }
    names
}

fn plain(name: &str) -> String {
    name.trim().to_lowercase()
}

fn one_root(reader: &mut UrdfReader, robot_at: usize) {
    let robot = &reader.reading.robot;
    let ends = &reader.reading.tree.ends;
    if robot.links.is_empty() {
        let mut elements = robot.unknown_elements.iter().filter_map(|text| tags(text).next());
        let fault = match elements.any(is_of_robot) {
            _ if reader.reading.has_xacro => Fault::OnlyMacros,
            true => Fault::IsSrdf,
            false => Fault::NoLinks,
        };
        reader.fault(robot_at, fault);
        return;
    }
    let mut parent = vec![None; robot.links.len()];
    for [above, below] in ends {
        parent[*below] = Some(*above);
    }
    let roots: Vec<usize> = (0..parent.len()).filter(|link| parent[*link].is_none()).collect();
    let named = |links: &[usize]| {
        let names = links.iter().map(|link| format!("`{}`", Short::of(&robot.links[*link].name)));
        names.collect::<Vec<_>>()
    };
    if let Some(ring) = ring(&parent) {
        let mut names = named(&ring[..ring.len().min(8)]);
        if ring.len() > 8 {
            names.push(format!("… ({} links)", ring.len()));
        } else {
            names.extend(named(&ring[..1]));
        }
        let at = ends.iter().position(|[_, below]| *below == ring[0]);
        let offset = at.map_or(robot_at, |joint| reader.joint_places[joint].joint);
        reader.fault(offset, Fault::Cycle(names.join(" – ")));
    } else if roots.len() > 1 {
        let mut names = named(&roots[..roots.len().min(5)]);
        if roots.len() > 5 {
            names.push("…".to_owned());
        }
        let fault = Fault::ManyRoots { count: roots.len(), names: names.join(", ") };
        reader.fault(reader.link_places[roots[1]], fault);
    } else {
        reader.reading.tree.root = roots[0];
    }
}

/// Links in a cycle, each the parent of the next, starting with the one that comes first in the file.
fn ring(parent: &[Option<usize>]) -> Option<Vec<usize>> {
    let mut ring = cycles(parent).into_iter().next()?;
    ring.reverse();
    let first = (0..ring.len()).min_by_key(|at| ring[*at]);
    ring.rotate_left(first.unwrap_or_default());
    Some(ring)
}

fn axes(reader: &mut UrdfReader) {
    let mut faults = Vec::new();
    for (joint, place) in reader.reading.robot.joints.iter().zip(&reader.joint_places) {
        let axis = written_axis(joint);
        // As in SPEC 6.1.6: its squared length is a normal number.
        let square: f64 = axis.iter().map(|x| x * x).sum();
        let fine = square.is_normal() && unit_axis(axis).is_some();
        if has_axis(joint.joint_type) && !fine {
            let fault = Fault::ZeroAxis {
                joint: Short::of(&joint.name),
                joint_type: joint.joint_type.as_str().to_ascii_lowercase(),
                axis: axis.map(|x| x.to_string()).join(" "),
            };
            faults.push((place.axis, fault));
        }
    }
    reader.faults.extend(faults);
}

/// Finds the joint that each mimic joint follows. A mimic element that cannot be resolved is dropped.
fn mimics(reader: &mut UrdfReader) {
    let robot = &reader.reading.robot;
    let names = robot.joints.iter().enumerate();
    let joints: HashMap<&str, usize> =
        names.map(|(idx, joint)| (joint.name.as_str(), idx)).collect();
    let mut drivers = vec![None; robot.joints.len()];
    let mut dropped = Vec::new();
    for (idx, joint) in robot.joints.iter().enumerate() {
        let Some(mimic) = &joint.mimic else { continue };
        let (name, driver) = (Short::of(&joint.name), Short::of(&mimic.joint));
        let found = joints.get(mimic.joint.as_str()).copied();
        let many = |idx: usize| num_dofs(robot.joints[idx].joint_type) > 1;
        let problem = match found {
            None => format!("joint `{name}` mimics `{driver}`, which does not exist"),
            Some(_) if many(idx) => {
                let kind = joint.joint_type.as_str().to_ascii_lowercase();
                format!(
                    "joint `{name}` is {kind} and mimics another: its position is not one number"
                )
            }
            Some(found) if many(found) => {
                format!("joint `{name}` mimics `{driver}`, whose position is not one number")
            }
            Some(found) => {
                drivers[idx] = Some(found);
                continue;
            }
        };
        dropped.push((idx, problem));
    }
    for (idx, problem) in dropped {
        let place = reader.joint_places[idx].mimic.clone();
        let assumed = "the mimic is left out: the joint moves on its own";
        reader.remark(NoteKind::Mimic, place.start, problem, assumed);
        reader.edit(place, "");
        reader.reading.robot.joints[idx].mimic = None;
    }
    let mut circling = cycles(&drivers).concat();
    circling.sort_unstable();
    for idx in circling {
        let name = Short::of(&reader.reading.robot.joints[idx].name);
        let place = reader.joint_places[idx].mimic.start;
        reader.fault(place, Fault::MimicCircle(name));
    }
    reader.reading.tree.drivers = drivers;
}

fn missing_limits(reader: &mut UrdfReader) {
    let mut found = Vec::new();
    for (joint, place) in reader.reading.robot.joints.iter().zip(&reader.joint_places) {
        let is_limited = |joint: &Joint| {
            let limit = joint.limit.as_ref();
            limit.is_some_and(|limit| limit.lower.is_some() || limit.upper.is_some())
        };
        let bounds = match joint.joint_type {
            JointType::Revolute => "[-pi, pi] rad",
            JointType::Prismatic => "[-1, 1] m",
            _ => continue,
        };
        if joint.mimic.is_none() && !is_limited(joint) {
            let kind = joint.joint_type.as_str().to_ascii_lowercase();
            let problem = format!("joint `{}` is {kind} and has no limits", Short::of(&joint.name));
            let assumed = format!("treated as unlimited; its bounds are {bounds}");
            found.push((place.joint, problem, assumed));
        }
    }
    for (offset, problem, assumed) in found {
        reader.remark(NoteKind::NoLimits, offset, problem, assumed);
    }
}

/// How a material looks, if it says so.
fn look(material: &Material) -> Option<(&Option<Color>, &Option<Texture>)> {
    let look = (&material.color, &material.texture);
    (look != (&None, &None)).then_some(look)
}

/// Notes conflicting looks under one name, materials without a name, and names without a look. (A link may reference a
/// material that is declared later.)
fn check_materials(reader: &mut UrdfReader) {
    let materials = std::mem::take(&mut reader.materials);
    let mut looks = HashMap::new();
    for (_, material) in &materials {
        if let (Some(name), Some(look)) = (&material.name, look(material)) {
            looks.entry(name.as_str()).or_insert(look);
        }
    }
    let mut told = BTreeSet::new();
    let mut notes = Vec::new();
    for (offset, material) in &materials {
        let look = look(material);
        // Some programs write an empty name for a material without one.
        if material.name.as_deref() == Some("") {
            continue;
        }
        let (problem, assumed) = match &material.name {
            None => ("a material has no name".to_owned(), "it applies only to its element"),
            Some(name) => match looks.get(name.as_str()) {
                Some(first) if look.is_some_and(|look| look != *first) && told.insert(name) => (
                    format!("material `{}` is defined again, and looks different", Short::of(name)),
                    "each element keeps its own; a name alone means the first",
                ),
                None if told.insert(name) => (
                    format!("no material `{}` has a colour or texture", Short::of(name)),
                    "the name is kept, without a look",
                ),
                _ => continue,
            },
        };
        notes.push((*offset, problem, assumed));
    }
    for (offset, problem, assumed) in notes {
        reader.remark(NoteKind::Material, offset, problem, assumed);
    }
}

/// The cycles of `next`, in the order in which walks from 0, 1, … meet them. Each begins where its walk enters it; those
/// that only lead into a cycle are not part of it. Visits nothing twice.
pub fn cycles(next: &[Option<usize>]) -> Vec<Vec<usize>> {
    // For each, the walk that visited it first. A walk that meets itself has found a cycle.
    let mut walk_of = vec![usize::MAX; next.len()];
    let mut found = Vec::new();
    for start in 0..next.len() {
        let mut now = start;
        while walk_of[now] == usize::MAX {
            walk_of[now] = start;
            match next[now] {
                Some(other) => now = other,
                None => break,
            }
        }
        if walk_of[now] == start && next[now].is_some() {
            let around = std::iter::successors(next[now], |at| next[*at]);
            let others = around.take_while(|at| *at != now);
            found.push(std::iter::once(now).chain(others).collect());
        }
    }
    found
}
