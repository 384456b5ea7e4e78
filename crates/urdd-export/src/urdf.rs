//! URDF: the robot as in its source, with the URDD's shapes as collision geometry.

use std::borrow::Cow;

use crate::joints::joints;
use crate::urdf_elements::{
    Geometry, IN_JOINT, IN_LINK, IN_ROBOT, add_attributes, element_of_joint, empty_robot, links,
    push_unknown, ros2_control, type_name,
};
use crate::{Export, ExportError, Files, Format, Note, Shape, Subject, xacro};
use urdd_xml::Kind;
use urdd_xml::other_parts::Owner;
use urdd_xml::writer::Element;

const STALE: &str = "the source's `<loop>` and `<coupling>` are left out, since links have other frames now: `urdf-plus` writes those of the file";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let mut notes = Vec::new();
    let (robot, files) = robot(subject, subject.shapes_by_link()?, &mut notes)?;
    let what = format!("Collision geometry: {}.", subject.shapes);
    let text = robot.document(&subject.comments(what, &notes)?);
    Ok(Export::of(text, files, notes))
}

/// The robot with these shapes of its links as collision geometry, and the files that it references.
pub(super) fn robot(
    subject: &Subject,
    shapes: Vec<Vec<Shape>>,
    notes: &mut Vec<Note>,
) -> Result<(Element, Files), ExportError> {
    let urdf = &subject.urdf;
    let mut robot = empty_robot(subject);
    let (links, files) = links(subject, Geometry::Plain, shapes, notes)?;
    let mut lost = 0;
    for (mut element, link) in links.into_iter().zip(&urdf.links) {
        lost += push_unknown(&mut element, &unknown(subject, &link.unknown_elements), IN_LINK);
        robot.push(element);
    }
    for joint in joints(subject, notes) {
        let mut element = element_of_joint(&joint, "joint", &type_name(joint.joint_type));
        add_attributes(subject, &Owner::Joint(joint.name.clone()), &mut element);
        lost += push_unknown(&mut element, &unknown(subject, &joint.unknown_elements), IN_JOINT);
        robot.push(element);
    }
    let mut own = Cow::Borrowed(urdf.unknown_elements.as_slice());
    if !keeps_loops(subject) {
        let all = own.len();
        own.to_mut().retain(|text| !is_of_loops(text));
        if subject.format == Format::Urdf && own.len() < all {
            notes.push(Note::Robot(STALE));
        }
    }
    if subject.format == Format::Moveit {
        // The package has hardware of its own.
        own.to_mut().retain(|text| ros2_control(text).is_none());
    }
    lost += push_unknown(&mut robot, &unknown(subject, &own), IN_ROBOT);
    if lost > 0 {
        notes.push(Note::Elements(lost));
    }
    Ok((robot, files))
}

/// Whether what URDF+ says in the source is true of the file: links have the frames that they have in the source, and the
/// format does not say it itself.
pub(super) fn keeps_loops(subject: &Subject) -> bool {
    subject.layout.is_empty() && !matches!(subject.format, Format::UrdfPlus | Format::ExtendedUrdf)
}

/// Whether an element of a robot is URDF+'s.
pub(super) fn is_of_loops(text: &str) -> bool {
    let document = urdd_xml::parse(text, Kind::Other);
    document.is_ok_and(|document| {
        ["loop", "coupling"].contains(&document.root_element().tag_name().name())
    })
}

/// Elements that URDF does not define, as the format needs them; empty where it cannot have one.
fn unknown<'a>(subject: &Subject, texts: &'a [String]) -> Cow<'a, [String]> {
    match subject.format {
        Format::Moveit => {
            texts.iter().map(|text| xacro::element(text).unwrap_or_default()).collect()
        }
        _ => Cow::Borrowed(texts),
    }
}
