//! URDFs with what closes their loops: URDF+, and Extended URDF, which has a YAML beside it with pairs of links whose frames or
//! origins coincide.
//!
//! Facts: M. Chignoli et al., URDF+ (2024), and the parser of generalized_rbda. The axis of a loop is in the frames of both
//! ends; a coupling says that the joints down to its successor move `ratio` times as far as those down to its predecessor.
//! V. Batto et al., Extended URDF (2024), and the loader of example-parallel-robots, which is of Pinocchio: a joint of the URDF
//! that the YAML makes a ball is a hinge without it.

use std::collections::{BTreeMap, HashSet};

use nalgebra::{Isometry3, Translation3};

use crate::joints::{
    Closing, LeftOut, OTHER_KIND, closings, freedom, is_linear, joints_of_dofs, names,
};
use crate::layout::{Place, origin};
use crate::urdf_elements::element_of_origin;
use crate::yaml::quoted;
use crate::{Export, ExportError, Note, Subject, Taken, Yaml, urdf};
use urdd_format::loops::{Coupling, LoopKind};
use urdd_format::urdf::JointType;
use urdd_xml::number::number;
use urdd_xml::writer::Element;

const OTHER_SUM: &str = "a coupling of URDF+ is of the joints down to two links from their last common one: those of each side by the same factor, without a constant";
const PARTLY: &str =
    "some of its DOFs move freely and others follow, which URDF+ does not say: it is independent";

pub(super) fn plus(subject: &Subject) -> Result<Export, ExportError> {
    let mut notes = Vec::new();
    let (mut robot, files) = urdf::robot(subject, subject.shapes_by_link()?, &mut notes)?;
    say_independent(subject, &mut robot, &mut notes)?;
    let mut left_out = LeftOut::default();
    for closing in closings(subject, &mut left_out)? {
        robot.push(element(subject, &closing));
    }
    if let Some(module) = subject.robot.loops()? {
        let dofs = joints_of_dofs(subject)?;
        let names = names(subject.format, module).into_iter().skip(module.loops.len());
        for (coupling, name) in module.couplings.iter().zip(names) {
            match sides(subject, coupling, &dofs) {
                Some((links, ratio)) => {
                    let [predecessor, successor] = links.map(|link| subject.links[link].as_str());
                    let ratio = Element::new("ratio").with("value", number(ratio));
                    robot.push(
                        Element::new("coupling")
                            .with("name", name)
                            .holding(Element::new("predecessor").with("link", predecessor))
                            .holding(Element::new("successor").with("link", successor))
                            .holding(ratio),
                    );
                }
                None => left_out.coupling(&coupling.name, OTHER_SUM),
            }
        }
    }
    notes.extend(left_out.notes());
    let what = format!("Collision geometry: {}.", subject.shapes);
    let text = robot.document(&subject.comments(what, &notes)?);
    Ok(Export::of(text, files, notes))
}

/// Says of each joint whether it moves freely.
fn say_independent(
    subject: &Subject,
    robot: &mut Element,
    notes: &mut Vec<Note>,
) -> Result<(), ExportError> {
    let freedom = freedom(subject)?;
    let joints = robot.elements_mut().filter(|element| element.name() == "joint");
    for (joint, of) in joints.zip(freedom) {
        let word = of.map(|of| if of.all || of.any { "true" } else { "false" });
        joint.set("independent", word);
        if of.is_some_and(|of| of.any && !of.all) {
            let name = joint.attribute("name").unwrap_or_default().to_owned();
            notes.push(Note::joint(&name, PARTLY));
        }
    }
    Ok(())
}

fn element(subject: &Subject, closing: &Closing) -> Element {
    let kind = match closing.of.kind {
        LoopKind::Revolute => "revolute".to_owned(),
        other => other.as_str().to_ascii_lowercase(),
    };
    let end = |tag: &'static str, end: Place| {
        let link = Element::new(tag).with("link", subject.links[end.link].as_str());
        link.holding(element_of_origin(&origin(&end.pose)))
    };
    let [predecessor, successor] = closing.ends;
    Element::new("loop")
        .with("name", closing.name.as_str())
        .with("type", kind)
        .holding(end("predecessor", predecessor))
        .holding(end("successor", successor))
        .holding(Element::new("axis").with("xyz", "0 0 1"))
}

/// The predecessor, the successor and the ratio of a coupling; `None` if URDF+ does not hold it.
fn sides(
    subject: &Subject,
    coupling: &Coupling,
    dofs: &[(Option<usize>, bool)],
) -> Option<([usize; 2], f64)> {
    let tree = &subject.tree;
    let mut terms = BTreeMap::new();
    for term in &coupling.terms {
        let (joint, _) = *dofs.get(term.dof_idx.get())?;
        let factor = Some(term.coefficients[0]).filter(|_| is_linear(&term.coefficients))?;
        terms.insert(joint?, factor);
    }
    let down_to = |link: usize| subject.between(tree.root, link);
    let child = |joint: usize| tree.joint_links[joint].1;
    let deepest = |joints: &mut dyn Iterator<Item = usize>| {
        joints.max_by_key(|joint| (tree.depth[child(*joint)], std::cmp::Reverse(*joint)))
    };
    let one = deepest(&mut terms.keys().copied())?;
    let chain = down_to(child(one));
    let of_chain: HashSet<usize> = chain.iter().copied().collect();
    let other = deepest(&mut terms.keys().copied().filter(|joint| !of_chain.contains(joint)));
    let ends = match other {
        Some(other) if other < one => [child(other), child(one)],
        Some(other) => [child(one), child(other)],
        None => {
            let first = chain.iter().find(|joint| terms.contains_key(joint))?;
            [tree.joint_links[*first].0, child(one)]
        }
    };
    // A mimic joint on the way would add a term of another joint.
    let [to_a, to_b] = ends.map(down_to);
    let common = to_a.iter().zip(&to_b).take_while(|(a, b)| a == b).count();
    let [to_a, to_b] = [&to_a[common..], &to_b[common..]];
    let factor_of = |joints: &[usize]| -> Option<Option<f64>> {
        let mut factor = None;
        for joint in joints.iter().filter(|joint| subject.view.joints[**joint].num_dofs() > 0) {
            let own = *terms.get(joint)?;
            (*factor.get_or_insert(own) == own).then_some(())?;
        }
        Some(factor)
    };
    let (a, b) = (factor_of(to_a)?, factor_of(to_b)?);
    let between: HashSet<&usize> = to_a.iter().chain(to_b).collect();
    let is_whole = terms.keys().all(|joint| between.contains(joint));
    let ratio = a.map_or(1.0, |a| -a / b.unwrap_or(1.0));
    let is_usable = ratio.is_finite() && coupling.constant == 0.0 && b.is_some() && is_whole;
    is_usable.then_some((ends, ratio))
}

const NO_EQUATIONS: &str = "Extended URDF has no equations between joints";

pub(super) fn extended(subject: &Subject) -> Result<Export, ExportError> {
    let mut notes = Vec::new();
    let (mut robot, mut files) = urdf::robot(subject, subject.shapes_by_link()?, &mut notes)?;
    let mut left_out = LeftOut::default();
    let joints = subject.view.joints.iter().map(|joint| &joint.name);
    let mut ends =
        Ends { taken: Taken::new(subject.links.iter().chain(joints)), elements: Vec::new() };
    let (mut pairs, mut types) = (Vec::new(), Vec::new());
    for closing in closings(subject, &mut left_out)? {
        let Some(points) = closing.points() else {
            left_out.of_loop(&closing.of.name, OTHER_KIND);
            continue;
        };
        let word = if closing.of.kind == LoopKind::Fixed { "6d" } else { "3d" };
        for along in points {
            let [a, b] = [("A", closing.ends[0]), ("B", closing.ends[1])].map(|(end, at)| {
                let pose = at.pose * Translation3::new(0.0, 0.0, *along);
                let name = format!("{}_{end}", closing.name);
                ends.link(subject, Place { pose, ..at }, name, word == "3d")
            });
            pairs.push(list([a.as_str(), b.as_str()]));
            types.push(word);
        }
    }
    let couplings = subject.robot.loops()?.into_iter().flat_map(|module| &module.couplings);
    couplings.for_each(|of| left_out.coupling(&of.name, NO_EQUATIONS));
    let mut balls = Vec::new();
    let freedom = freedom(subject)?;
    let mut motors = Vec::new();
    let elements = robot.elements_mut().filter(|element| element.name() == "joint");
    for ((element, view), freedom) in elements.zip(&subject.view.joints).zip(freedom) {
        element.set("independent", None);
        if freedom.is_some_and(|of| of.any) {
            motors.push(view.name.as_str());
        }
        if view.joint_type == JointType::Spherical {
            element.set("type", Some("continuous"));
            balls.push(view.name.as_str());
        }
    }
    robot.extend(ends.elements);
    notes.extend(left_out.notes());
    let what = format!("Collision geometry: {}.", subject.shapes);
    let text = robot.document(&subject.comments(what, &notes)?);
    let types = list(types);
    let kinds = list(vec!["SPHERICAL"; balls.len()]);
    let yaml = Yaml::map([
        ("closed_loop", Yaml::List(pairs)),
        ("type", types),
        ("name_mot", list(motors)),
        ("joint_name", list(balls)),
        ("joint_type", kinds),
    ]);
    let file = subject.options.file.as_deref().unwrap_or("robot.urdf");
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    files.push((format!("{stem}.yaml"), yaml.document(&subject.origin()?).into_bytes()));
    Ok(Export::of(text, files, notes))
}

fn list<'t>(texts: impl IntoIterator<Item = &'t str>) -> Yaml {
    let texts: Vec<String> = texts.into_iter().map(quoted).collect();
    Yaml::Plain(format!("[{}]", texts.join(", ")))
}

/// The ends of loops as links of their own.
struct Ends {
    /// The names of links and joints.
    taken: Taken,
    elements: Vec<Element>,
}

impl Ends {
    /// The name of a link at a place: the link itself, or one that is fixed to it. Of a point, the origin counts alone.
    fn link(&mut self, subject: &Subject, at: Place, name: String, is_point: bool) -> String {
        let own = subject.links[at.link].as_str();
        let is_own = match is_point {
            true => at.pose.translation.vector.iter().all(|x| *x == 0.0),
            false => at.pose == Isometry3::identity(),
        };
        if is_own {
            return own.to_owned();
        }
        let name = self.taken.free(name);
        let joint = self.taken.free(format!("{name}_joint"));
        self.elements.push(Element::new("link").with("name", name.as_str()));
        self.elements.push(
            Element::new("joint")
                .with("name", joint)
                .with("type", "fixed")
                .holding(element_of_origin(&origin(&at.pose)))
                .holding(Element::new("parent").with("link", own))
                .holding(Element::new("child").with("link", name.as_str())),
        );
        name
    }
}
