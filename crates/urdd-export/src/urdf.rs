//! URDF: the robot as in its source, with the URDD's shapes as collision geometry.

use super::error::{ExportError, Note};
use super::joints::joints;
use super::output::Export;
use super::subject::Subject;
use super::urdf_elements::{
    Geometry, IN_JOINT, IN_LINK, IN_ROBOT, element_of_joint, links, push_unknown, robot, type_name,
};

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let urdf = &subject.urdf;
    let mut robot = robot(subject);
    let mut notes = Vec::new();
    let (links, files) = links(subject, Geometry::Plain, &mut notes)?;
    let mut lost = 0;
    for (mut element, link) in links.into_iter().zip(&urdf.links) {
        lost += push_unknown(&mut element, &link.unknown_elements, IN_LINK);
        robot.push(element);
    }
    for joint in joints(subject, &mut notes) {
        let mut element = element_of_joint(&joint, "joint", &type_name(joint.joint_type));
        lost += push_unknown(&mut element, &joint.unknown_elements, IN_JOINT);
        robot.push(element);
    }
    lost += push_unknown(&mut robot, &urdf.unknown_elements, IN_ROBOT);
    if lost > 0 {
        notes.push(Note::Elements(lost));
    }
    let shapes = subject.options.shapes;
    Ok(Export {
        text: robot.document(&subject.comments(format!("Collision geometry: {shapes}."), &notes)?),
        files,
        notes,
    })
}
