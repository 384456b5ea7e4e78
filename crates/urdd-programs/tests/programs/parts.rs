//! The parts of a robot that facts and claims are about.

use std::collections::{BTreeSet, HashMap};

use urdd_programs::{Deed, Effect, Effects, Fault};

/// What a reader says of a part.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
pub struct Claim {
    pub part: String,
    /// Without names and texts of the file.
    pub kind: String,
    /// Whether it says of a plain number that it is none.
    pub is_doubtful: bool,
}

/// What a reader says of parts in a file that it loads.
pub fn claims(effects: &Effects) -> BTreeSet<Claim> {
    let claims = effects.kept().iter().filter(|effect| effect.deed < Deed::Refuses);
    claims
        .map(|effect| Claim {
            part: effect.part.to_string(),
            kind: kind_of(effect),
            is_doubtful: match &effect.fault {
                Fault::NotANumber { text, .. } => numbers(text) == Some(1),
                Fault::Count { text, expected, .. } => numbers(text) == Some(*expected),
                _ => true,
            },
        })
        .collect()
}

/// What a reader says of a part, whatever its name.
pub fn kind_of(effect: &Effect) -> String {
    format!("{} {:?}", kind(&effect.part), effect.fault)
}

/// How many numbers a text is, if it is nothing else.
fn numbers(text: &str) -> Option<usize> {
    let words = text.split_ascii_whitespace();
    let finite = |word: &str| word.parse().ok().filter(|number: &f64| number.is_finite());
    words.clone().all(|word| finite(word).is_some()).then(|| words.count())
}

/// The part without the name of its link or joint.
fn kind(part: &str) -> String {
    let owner = part.split('/').next().unwrap_or_default();
    let last = part.rsplit('/').next().unwrap_or_default();
    let named = ["visual", "collision"].iter().find(|kind| part.contains(&format!("/{kind}/")));
    match part.matches('/').count() {
        0 | 1 => owner.to_owned(),
        _ => format!("{owner} {} {last}", named.unwrap_or(&"")),
    }
}

/// Whether one of the claims is about a part, or about what it is in.
pub fn covers(claims: &BTreeSet<Claim>, part: &str) -> bool {
    claims.iter().any(|claim| are_near(&claim.part, part))
}

/// Whether a claim's part and another are one in the other. `robot/?` is about all; materials of the robot are seen in the visuals that have them.
pub fn are_near(one: &str, other: &str) -> bool {
    let is_material = |part: &str| part.starts_with("material/") || part.ends_with("/material");
    let are_materials = is_material(one) && is_material(other);
    let is_of_robot = |part: &str| part.starts_with("material/");
    one == "robot/?"
        || is_in(one, other)
        || is_in(other, one)
        || are_materials && (is_of_robot(one) || is_of_robot(other))
}

/// Whether a part is in another, or the same. `joint/elbow/?` is something in the joint that no program knows, and
/// `link/arm…` a link whose name is longer than effects have it.
fn is_in(part: &str, whole: &str) -> bool {
    let whole = whole.strip_suffix("/?").unwrap_or(whole);
    let begins =
        |one: &str, other: &str| one.strip_suffix('…').is_some_and(|one| other.starts_with(one));
    let mut names = part.split('/');
    whole.split('/').all(|name| {
        names
            .next()
            .is_some_and(|other| name == other || begins(name, other) || begins(other, name))
    })
}

/// The element that a fact of the table is about: `-joint/elbow/upper` is about `joint/elbow/limit`. Names of visuals and
/// collisions, and what is not of a link or joint, are no parts.
pub fn of_fact(fact: &str) -> Option<String> {
    let fact = fact.strip_prefix('-').unwrap_or(fact).split('=').next()?;
    let fact = fact.strip_suffix('/').unwrap_or(fact);
    if !fact.starts_with("link/") && !fact.starts_with("joint/") {
        return None;
    }
    let (above, last) = fact.rsplit_once('/')?;
    let is_shape = above.contains("/visual/") || above.contains("/collision/");
    let element = match last {
        _ if !above.contains('/') => return Some(fact.to_owned()),
        "lower" | "upper" | "velocity" | "effort" | "acceleration" | "deceleration" | "jerk" => {
            "limit"
        }
        "damping" | "friction" => "dynamics",
        "safety" => "safety_controller",
        "mass" | "com" | "inertia" => return Some(above.to_owned()),
        // URDF has none in a collision.
        "color" | "texture" if above.contains("/collision/") => return None,
        "color" | "texture" => "material",
        "name" if is_shape => return None,
        "geometry" | "origin" if is_shape => return Some(above.to_owned()),
        _ => return Some(fact.to_owned()),
    };
    Some(format!("{above}/{element}"))
}

/// The links and joints that a file has by these names, such as `link/base`, and what is in them. One that is renamed is
/// not lost.
pub fn written(bytes: &[u8]) -> HashMap<String, String> {
    let text = String::from_utf8_lossy(bytes);
    let mut found = HashMap::new();
    for kind in ["link", "joint"] {
        for element in text.split(&format!("<{kind}")).skip(1) {
            let tag = element.split('>').next().unwrap_or_default();
            let Some((_, behind)) = tag.split_once("name") else { continue };
            let behind = behind.trim_start().trim_start_matches('=').trim_start();
            let Some(quote @ ('"' | '\'')) = behind.chars().next() else { continue };
            let name = behind[1..].split(quote).next().unwrap_or_default();
            let name = name.replace("&#10;", "\n").replace("&#13;", "\r").replace("&#9;", "\t");
            let name = name.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"");
            let name = name.replace("&apos;", "'").replace("&amp;", "&");
            // Joints of transmissions have no type.
            if kind == "link" || tag.to_lowercase().contains("type") {
                let inside = element.split(&format!("</{kind}")).next().unwrap_or_default();
                found.insert(format!("{kind}/{name}"), inside.to_owned());
            }
        }
    }
    found
}

/// Whether a part is of a link or joint that a file has. What is in a joint is also in that of the unchanged file, or is
/// written there now.
pub fn is_written(
    part: &str,
    written: &HashMap<String, String>,
    unchanged: &HashMap<String, String>,
) -> bool {
    let mut owners = part.match_indices('/').map(|(end, _)| &part[..end]).chain([part]);
    let Some(owner) = owners.rfind(|owner| written.contains_key(*owner)) else { return false };
    let Some(element) = part[owner.len()..].strip_prefix('/').filter(|_| part.starts_with("joint"))
    else {
        return true;
    };
    let has = |of: &HashMap<String, String>| {
        of.get(owner).is_some_and(|text| text.contains(&format!("<{element}")))
    };
    has(written) || has(unchanged)
}
