//! `<gazebo>` elements, as libsdformat reads them.

use super::tree::Release;
use crate::prelude::*;

const NUMBERS: &str = "mu1 mu2 kp kd maxVel minDepth dampingFactor laserRetro springReference \
    springStiffness stopCfm stopErp fudgeFactor";

/// What is wrong in an element, if what it refers to is kept.
pub(super) struct Suspect<'t> {
    /// The link or joint; none for the robot.
    pub reference: &'t str,
    pub at: usize,
    pub fault: Fault,
    /// Whether it matters only if the link has collisions.
    pub of_collisions: bool,
}

/// What the elements say.
#[derive(Default)]
pub(super) struct Extensions<'t> {
    /// Fixed joints that stay joints.
    pub kept_joints: HashSet<&'t str>,
    /// Links and joints that are written as SDF.
    pub own: Vec<Node<'t>>,
    pub suspects: Vec<Suspect<'t>>,
}

/// Reads all `<gazebo>` of a robot. A number that is none ends the program.
pub(super) fn read<'t>(
    robot: Node<'t>,
    release: Release,
    effects: &mut Effects,
) -> Reading<Extensions<'t>> {
    let mut found = Extensions::default();
    for gazebo in robot.named("gazebo") {
        let reference = gazebo.value("reference").unwrap_or_default();
        for element in gazebo.children() {
            let name = element.name();
            if reference.is_empty() && matches!(name, "link" | "joint") {
                found.own.push(element);
            }
            let text = element.value("value").or(element.text()).unwrap_or_default();
            let text = text.trim_matches(crate::number::is_space);
            let is_true = matches!(&*text.to_ascii_lowercase(), "true" | "yes" | "1");
            let number = match name {
                "maxContacts" => Some(stoi(text)),
                _ if NUMBERS.split(' ').any(|one| one == name) => Some(stod(text)),
                _ => None,
            };
            let fault = match (name, number) {
                (_, Some(None)) => {
                    let fault = Fault::NotANumber { attribute: name.into(), text: text.into() };
                    return effects.crash(element, fault);
                }
                ("mu1" | "mu2", Some(Some(number))) if number < 0.0 => {
                    Some(Fault::range_of(name, text, "must not be negative"))
                }
                ("preserveFixedJoint" | "disableFixedJointLumping", _) if is_true => {
                    found.kept_joints.insert(reference);
                    None
                }
                ("plugin", _) if reference.is_empty() => incomplete(element, &["name", "filename"]),
                ("link", _) if reference.is_empty() => incomplete(element, &["name"]),
                ("joint", _) if reference.is_empty() => joint(element),
                ("sensor", _) if !reference.is_empty() => {
                    incomplete(element, &["name"]).or_else(|| {
                        let kind = element.value("type").unwrap_or_default();
                        (!is_sensor(kind)).then(|| Fault::value("type", kind))
                    })
                }
                _ => None,
            };
            let fault = fault.or_else(|| scoped(element, release));
            let of_collisions = number.is_some();
            let suspect =
                fault.map(|fault| Suspect { reference, at: element.at(), fault, of_collisions });
            found.suspects.extend(suspect);
        }
    }
    Ok(found)
}

/// A name in an element that SDF keeps for itself, but not in plugins.
fn scoped(element: Node<'_>, release: Release) -> Option<Fault> {
    let mut open = vec![element];
    while let Some(node) = open.pop() {
        if node.name() == "plugin" || node.name().contains(':') {
            continue;
        }
        if let Some(name) = node.value("name").filter(|name| release.keeps(name)) {
            return Some(super::names::scoped("part of `<gazebo>`", name));
        }
        open.extend(node.children());
    }
    None
}

/// Which of the needed attributes is missing or empty.
fn incomplete(element: Node<'_>, names: &[&'static str]) -> Option<Fault> {
    names.iter().find_map(|name| match element.value(name) {
        None => Some(Fault::Missing(name)),
        Some(value) => value.is_empty().then_some(Fault::Empty(name)),
    })
}

/// What is missing of a joint of SDF, which names its links in text.
fn joint(joint: Node<'_>) -> Option<Fault> {
    let is_named = |end: &str| joint.child(end).is_some_and(|end| end.text().is_some());
    let missing = ["parent", "child"].into_iter().find(|end| !is_named(end));
    incomplete(joint, &["name", "type"]).or(missing.map(Fault::MissingElement))
}

fn is_sensor(kind: &str) -> bool {
    const KINDS: &str = "altimeter camera contact depth_camera depth force_torque gps gpu_lidar gpu_ray imu \
        logical_camera magnetometer multicamera lidar ray rfid rfidtag sonar wireless_receiver \
        wireless_transmitter air_pressure rgbd_camera rgbd thermal_camera thermal navsat \
        segmentation_camera segmentation boundingbox_camera boundingbox custom wideanglecamera \
        wide_angle_camera";
    KINDS.split(' ').any(|one| one == kind)
}

/// `std::stod`: the number that a text begins with; none also if it is too large or too small for one.
pub(super) fn stod(text: &str) -> Option<f64> {
    let (number, rest) = strtod(text)?;
    let written = &text[..text.len() - rest.len()];
    let mantissa = written.split(['e', 'E', 'p', 'P']).next().unwrap_or_default();
    let is_word = written.contains(['i', 'I', 'n', 'N']);
    let is_nothing = !mantissa.contains(|digit| matches!(digit, '1'..='9'));
    let fits = number.is_normal() || is_word || number == 0.0 && is_nothing;
    fits.then_some(number)
}

/// `std::stoi`: the whole number that a text begins with.
fn stoi(text: &str) -> Option<f64> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let digits = unsigned.bytes().take_while(u8::is_ascii_digit).count();
    let number: i32 = text[..text.len() - unsigned.len() + digits].parse().ok()?;
    Some(f64::from(number))
}
