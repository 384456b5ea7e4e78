//! A scene for the robot: floor and light.

use super::super::error::ExportError;
use super::super::output::Files;
use super::super::stand::Stand;
use super::super::subject::Subject;
use super::super::template::fill;
use urdd_xml::number::number;
use urdd_xml::writer::{escaped, head};

/// Names of our geoms have a slash: none is called as the floor.
const SCENE: &str = include_str!("scene.xml.in");

/// The scene that includes a file.
pub(super) fn scene(subject: &Subject, file: &str, stand: &Stand) -> Result<Files, ExportError> {
    let stem = file.strip_suffix(".xml").unwrap_or(file);
    let floor = number(stand.floor);
    let what = format!("The floor is at z = {floor} m.");
    let values =
        [("ROBOT", escaped(&subject.urdf.name)), ("FILE", escaped(file)), ("FLOOR", floor)];
    let text = head(&subject.comments(what, &[])?) + &fill(SCENE, &values);
    Ok(vec![(format!("{stem}_scene.xml"), text.into_bytes())])
}
