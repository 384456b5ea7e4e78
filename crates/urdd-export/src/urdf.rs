//! URDF: the robot as in its source, with the URDD's shapes as collision geometry.

use std::borrow::Cow;

use crate::joints::joints;
use crate::urdf_elements::{
    Geometry, IN_JOINT, IN_LINK, IN_ROBOT, add_attributes, element_of_joint, empty_robot, links,
    push_unknown, ros2_control, type_name,
};
use crate::{Export, ExportError, Files, Format, Note, Shape, Subject, xacro};
use urdd_xml::other_parts::Owner;
use urdd_xml::writer::Element;

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

/// Elements that URDF does not define, as the format needs them; empty where it cannot have one.
fn unknown<'a>(subject: &Subject, texts: &'a [String]) -> Cow<'a, [String]> {
    match subject.format {
        Format::Moveit => {
            texts.iter().map(|text| xacro::element(text).unwrap_or_default()).collect()
        }
        _ => Cow::Borrowed(texts),
    }
}
