//! Words in names: what a chain is, and on which side.

/// What a name says of a part of a robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    Leg,
    Arm,
    Head,
    Torso,
    Hand,
}

const PARTS: &[(Part, &[&str])] = &[
    (Part::Leg, &["leg", "hip", "knee", "ankle", "thigh", "calf", "shank", "foot"]),
    (Part::Arm, &["arm", "shoulder", "elbow"]),
    (Part::Head, &["head", "neck"]),
    (Part::Torso, &["torso", "waist", "trunk", "spine", "lift"]),
    (Part::Hand, &["hand", "finger", "thumb", "knuckle", "gripper"]),
];

const SIDES: &[&str] = &[
    "left", "right", "l", "r", "front", "rear", "hind", "fl", "fr", "rl", "rr", "bl", "br", "lf",
    "rf", "lh", "rh", "hl", "hr",
];

const FINGERS: &[&str] = &["thumb", "index", "middle", "ring", "pinky", "little"];

const TOOLS: &[&str] = &["tool", "tool0", "tcp", "grasp", "grasping", "ee", "eef", "tip", "flange"];

/// The words of a name in lower case: `FL_hipJoint` has fl, hip and joint.
pub fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = '_';
    for c in name.chars() {
        if !c.is_alphanumeric() || (before.is_lowercase() && c.is_uppercase()) {
            words.push(String::new());
        }
        if c.is_alphanumeric()
            && let Some(word) = words.last_mut()
        {
            word.extend(c.to_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// What most of the names say that say something.
pub fn part<'n>(names: impl Iterator<Item = &'n str>) -> Option<Part> {
    let mut counts = [0; PARTS.len()];
    for name in names {
        let words = words(name);
        for ((_, of_part), count) in PARTS.iter().zip(&mut counts) {
            *count += usize::from(words.iter().any(|word| of_part.contains(&word.as_str())));
        }
    }
    let most = counts.iter().copied().max().filter(|most| *most > 0)?;
    let place = counts.iter().position(|count| *count == most)?;
    Some(PARTS[place].0)
}

/// The sides that all names have in common, such as `front_left`.
pub fn side<'n>(names: impl Iterator<Item = &'n str>) -> Option<String> {
    shared(names, SIDES)
}

/// The finger that all names mean.
pub(super) fn finger<'n>(names: impl Iterator<Item = &'n str>) -> Option<String> {
    shared(names, FINGERS)
}

fn shared<'n>(names: impl Iterator<Item = &'n str>, known: &[&str]) -> Option<String> {
    let mut common: Option<Vec<String>> = None;
    for name in names {
        let own = words(name);
        match &mut common {
            None => {
                let own = own.into_iter().filter(|word| known.contains(&word.as_str()));
                common = Some(own.collect());
            }
            Some(common) => common.retain(|word| own.contains(word)),
        }
    }
    common.filter(|common| !common.is_empty()).map(|common| common.join("_"))
}

/// Whether a name is that of a palm.
pub(super) fn is_hand(name: &str) -> bool {
    words(name).iter().any(|word| word == "hand" || word == "palm")
}

/// Whether a name is that of a tool frame.
pub fn is_tool(name: &str) -> bool {
    words(name).iter().any(|word| TOOLS.contains(&word.as_str()))
}

/// Whether a name is that of the tool frame of ROS-Industrial.
pub(super) fn is_tool0(name: &str) -> bool {
    words(name).iter().any(|word| word == "tool0")
}

/// Whether a name is that of an inertial measurement unit.
pub fn is_imu(name: &str) -> bool {
    words(name).iter().any(|word| word == "imu")
}
