//! `<gazebo>` elements, as libsdformat reads them, and names that SDF cannot have, or that are of nothing.

use crate::prelude::*;
use crate::sdformat::tree::{Release, Tree};

const NUMBERS: &str = "mu1 mu2 kp kd maxVel minDepth dampingFactor laserRetro springReference \
    springStiffness stopCfm stopErp fudgeFactor";

/// What is wrong in an element, if what it refers to is kept.
pub struct Suspect<'t> {
    /// The link or joint; none for the robot.
    pub reference: &'t str,
    pub at: usize,
    pub fault: Fault,
    /// Whether it matters only if the link has collisions.
    pub of_collisions: bool,
}

/// What the elements say.
#[derive(Default)]
pub struct Extensions<'t> {
    /// Fixed joints that stay joints.
    pub kept_joints: HashSet<&'t str>,
    /// Links and joints that are written as SDF.
    pub own: Vec<Node<'t>>,
    pub suspects: Vec<Suspect<'t>>,
}

/// Reads all `<gazebo>` of a robot. A number that is none ends the program.
pub fn read<'t>(
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
            return Some(reserved("part of `<gazebo>`", name));
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
pub fn stod(text: &str) -> Option<f64> {
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

/// The names of the robot, and of links and joints that are kept, or are SDF in a `<gazebo>`: `own`.
pub fn names(robot: Node<'_>, links: &Tree<'_>, own: &[Node<'_>], effects: &mut Effects) {
    let release = links.release;
    let one = |node, kind, name, effects: &mut Effects| one(node, kind, name, release, effects);
    one(robot, "robot", robot.value("name").unwrap_or_default(), effects);
    let mut names = HashSet::new();
    let bodies = || links.bodies.iter().filter(|body| body.is_made);
    let joints = bodies().filter_map(|body| body.joint.as_ref());
    let joints = joints.filter(|joint| !joint.has_no_type());
    let all = bodies().map(|body| (body.node, "link", body.name));
    for (node, kind, name) in all.chain(joints.map(|joint| (joint.node, "joint", joint.name))) {
        let is_fine = one(node, kind, name, effects);
        let read = release.read(name);
        if read != name && is_fine {
            let rule = match release {
                Release::Twelve => "white space around it is cut off, `true` is 1 and `false` 0",
                Release::Fourteen => "white space around it is cut off",
            };
            effects.read_as(node, Part::of(kind, name), Fault::name(kind, name, rule), read);
        }
        if !names.insert(read) {
            effects.refuse_mendable(node, Fault::not_unique("link or joint", name));
        }
    }
    let of_name = |name| {
        let mut all = links.bodies.iter().filter_map(|body| body.joint.as_ref());
        all.find(|joint| joint.name == name).map(|joint| joint.node)
    };
    for (body, from) in links.frames() {
        for (node, kind, name) in [(body.node, "link", body.name), (from.node, "joint", from.name)]
        {
            one(node, kind, name, effects);
            if !names.insert(release.read(name)) {
                // Where a joint and a link have one name, the joint is named.
                let fault = Fault::not_unique("link or joint", name);
                effects.refuse_mendable(of_name(name).unwrap_or(node), fault);
            }
        }
    }
    let own = || own.iter().filter_map(|&node| Some((node, node.value("name")?)));
    for (node, name) in own() {
        one(node, if node.name() == "link" { "link" } else { "joint" }, name, effects);
        if !names.insert(release.read(name)) {
            effects.refuse_mendable(node, Fault::not_unique("link or joint", name));
        }
    }
    for (node, name) in own().filter(|(node, _)| node.name() == "joint") {
        let _ = own_joint(node, name, &names, release, effects);
    }
}

/// A joint of SDF: its type, and the links, or joints in their place, that it connects.
fn own_joint(
    node: Node<'_>,
    name: &str,
    names: &HashSet<&str>,
    release: Release,
    effects: &mut Effects,
) -> Reading<()> {
    const KINDS: &str =
        "ball continuous fixed gearbox prismatic revolute revolute2 screw universal";
    if let Some(kind) = node.attribute("type")
        && !KINDS.split(' ').any(|known| known.eq_ignore_ascii_case(&kind.value))
    {
        return effects.refuse(kind, Fault::value("type", &kind.value));
    }
    let ends = ["parent", "child"].map(|end| {
        let end = node.child(end)?;
        Some((end, release.read(end.text()?)))
    });
    let [Some(parent), Some(child)] = ends else { return Ok(()) };
    for (end, link) in [parent, child] {
        let is_world = link == "world" && end.name() == "parent";
        if !is_world && (link == release.read(name) || !names.contains(link)) {
            return effects.refuse(end, Fault::unknown("link or joint", link));
        }
    }
    if parent.1 == child.1 {
        return effects.refuse(child.0, Fault::Tree("a joint has one link on both sides"));
    }
    Ok(())
}

/// Whether a name is one that a part can have.
fn one(
    node: Node<'_>,
    kind: &'static str,
    name: &str,
    release: Release,
    effects: &mut Effects,
) -> bool {
    let read = release.read(name);
    let is_reserved = name == "world"
        || read == "world"
        || read.len() >= 4 && read.starts_with("__") && read.ends_with("__");
    let at = node.attribute("name").map_or(node.start(), |name| name.range.start);
    let fault = if read.is_empty() {
        Fault::Empty("name")
    } else if release.keeps(name) {
        reserved(kind, name)
    } else if is_reserved {
        Fault::name(kind, name, "the name is one of SDF's own")
    } else {
        return true;
    };
    effects.refuse_mendable(at, fault);
    false
}

/// Why a name of a kind of thing is refused that has `::` in it.
pub fn reserved(kind: &'static str, name: &str) -> Fault {
    Fault::name(kind, name, "SDF has `::` between names")
}
