//! Extended URDF: a URDF, and a YAML beside it with pairs of links whose frames or origins coincide.
//!
//! Facts: V. Batto et al., Extended URDF (2024), and the loader of example-parallel-robots, which is of Pinocchio: a joint of
//! the URDF that the YAML makes a ball is a hinge without it.

use nalgebra::{Isometry3, Translation3};

use crate::layout::{Place, origin};
use crate::loops::{LeftOut, OTHER_KIND, closings, freedom};
use crate::urdf_elements::element_of_origin;
use crate::yaml::quoted;
use crate::{Export, ExportError, Subject, Taken, Yaml, urdf};
use urdd_format::loops::LoopKind;
use urdd_format::urdf::JointType;
use urdd_xml::writer::Element;

const NO_EQUATIONS: &str = "Extended URDF has no equations between joints";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
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
