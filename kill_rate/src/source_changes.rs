//! Mutations of the source URDF: one attribute's value, or one number in it.

use std::collections::BTreeMap;
use std::ops::Range;

use super::dice::Dice;
use super::file_bytes::Damage;
use super::free::Ground;
use super::mutation::{Change, FileChange, Files, Mutation, shortened};
use super::number_changes;
use super::original::Original;
use super::plan::Plan;
use super::sample;
use super::text_changes;

/// Name of the source URDF in reports.
const SOURCE: &str = "source";

/// Element and attribute names that `urdf_module` represents (SPEC 6.1.1: others are only in the source file), and
/// whether they contain numbers.
const ATTRIBUTES: &[(&str, &str, bool)] = &[
    ("robot", "name", false),
    ("link", "name", false),
    ("joint", "name", false),
    ("joint", "type", false),
    ("visual", "name", false),
    ("collision", "name", false),
    ("material", "name", false),
    ("parent", "link", false),
    ("child", "link", false),
    ("mimic", "joint", false),
    ("mimic", "multiplier", true),
    ("mimic", "offset", true),
    ("origin", "xyz", true),
    ("origin", "rpy", true),
    ("origin", "quat_xyzw", true),
    ("axis", "xyz", true),
    ("mass", "value", true),
    ("inertia", "ixx", true),
    ("inertia", "ixy", true),
    ("inertia", "ixz", true),
    ("inertia", "iyy", true),
    ("inertia", "iyz", true),
    ("inertia", "izz", true),
    ("mesh", "filename", false),
    ("mesh", "scale", true),
    ("box", "size", true),
    ("cylinder", "radius", true),
    ("cylinder", "length", true),
    ("capsule", "radius", true),
    ("capsule", "length", true),
    ("sphere", "radius", true),
    ("color", "rgba", true),
    ("texture", "filename", false),
    ("limit", "lower", true),
    ("limit", "upper", true),
    ("limit", "effort", true),
    ("limit", "velocity", true),
    ("limit", "acceleration", true),
    ("limit", "deceleration", true),
    ("limit", "jerk", true),
    ("dynamics", "damping", true),
    ("dynamics", "friction", true),
    ("safety_controller", "soft_lower_limit", true),
    ("safety_controller", "soft_upper_limit", true),
    ("safety_controller", "k_position", true),
    ("safety_controller", "k_velocity", true),
    ("calibration", "rising", true),
    ("calibration", "falling", true),
];

/// An attribute of the text.
struct Attribute {
    value: Range<usize>,
    numbers: bool,
}

/// Mutations of the source URDF, one list per attribute.
pub(crate) fn mutations(original: &Original, plan: &Plan) -> Vec<Vec<Mutation>> {
    let Some((path, text)) = original.source().and_then(|path| {
        let text = std::str::from_utf8(original.files.get(path)?).ok()?;
        Some((path, text))
    }) else {
        return Vec::new();
    };
    let mut lists = Vec::new();
    for (field, places) in attributes(text) {
        let mut dice = Dice::new(plan.seed, &field);
        lists.push(sample::draw(plan, places.len(), &mut dice, |index, dice| {
            let place = &places[index];
            let changed = changed(original.reach, &text[place.value.clone()], place.numbers, dice);
            let value = place.value.clone();
            changed
                .into_iter()
                .map(|(kind, to)| mutation(path, &field, kind, replaced(path, value.clone(), to)))
                .collect()
        }));
    }
    let cut = [("its second half left out", Damage::Half), ("emptied", Damage::All)];
    let cut = cut.map(|(kind, damage)| {
        let path_of = path.to_owned();
        let make = move |original: &Original| {
            let (after, to) = damage.of(original.files.get(&path_of)?)?;
            let files = Files::from([(path_of.clone(), Some(after))]);
            Some(FileChange::new(files, "the file", to))
        };
        mutation(path, "the file", kind, Change::Files(Box::new(make)))
    });
    lists.push(cut.into());
    lists
}

/// The attributes of the text that `urdf_module` represents, by the names of the enclosing elements.
fn attributes(text: &str) -> BTreeMap<String, Vec<Attribute>> {
    let mut found: BTreeMap<String, Vec<Attribute>> = BTreeMap::new();
    let Ok(document) = urdd_xml::parse(text, urdd_xml::Kind::Other) else {
        return found;
    };
    for node in document.descendants().filter(urdd_xml::Node::is_element) {
        let names: Vec<&str> = node
            .ancestors()
            .filter(urdd_xml::Node::is_element)
            .map(|node| node.tag_name().name())
            .collect();
        // Elements that URDF does not define are kept as text with all their contents.
        const TOP: [&str; 4] = ["robot", "link", "joint", "material"];
        let near_top = names.iter().rev().take(2).all(|name| TOP.contains(name));
        for attribute in node.attributes() {
            let of = |(element, name, _): &&(&str, &str, bool)| {
                *element == names[0] && *name == attribute.name()
            };
            let Some((_, _, numbers)) = ATTRIBUTES.iter().find(of).filter(|_| near_top) else {
                continue;
            };
            let path: Vec<&str> = names.iter().rev().copied().collect();
            let field = format!("{}@{}", path.join("/"), attribute.name());
            found
                .entry(field)
                .or_default()
                .push(Attribute { value: attribute.range_value(), numbers: *numbers });
        }
    }
    found
}

fn changed(reach: f64, value: &str, numbers: bool, dice: &mut Dice) -> Vec<(&'static str, String)> {
    if !numbers {
        let spelled = text_changes::spellings(value, dice);
        return spelled.into_iter().filter(|(_, to)| to != value).collect();
    }
    let words: Vec<&str> = value.split_ascii_whitespace().collect();
    let at = dice.below(words.len());
    let Some(from) = words.get(at).and_then(|word| word.parse::<f64>().ok()) else {
        return Vec::new();
    };
    let ground = Ground { module: "urdf_module", field: "", reach, shapes: reach };
    let mut out: Vec<(&'static str, String)> = number_changes::numbers(&ground, from, dice)
        .into_iter()
        .filter_map(|(kind, to)| {
            let to = to.as_f64().filter(|to| ground.counts(from, *to))?;
            let mut words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
            words[at] = to.to_string();
            Some((kind, words.join(" ")))
        })
        .collect();
    if let [first, second, ..] = words[..]
        && let (Ok(a), Ok(b)) = (first.parse::<f64>(), second.parse::<f64>())
        && ground.counts(a, b)
    {
        let mut exchanged = words.clone();
        exchanged.swap(0, 1);
        out.push(("two numbers exchanged", exchanged.join(" ")));
    }
    out
}

fn replaced(path: &str, value: Range<usize>, to: String) -> Change {
    let path = path.to_owned();
    Change::Files(Box::new(move |original| {
        let mut text = String::from_utf8(original.files.get(&path)?.clone()).ok()?;
        let from = text.get(value.clone())?.to_owned();
        text.replace_range(value.clone(), &to);
        let files = Files::from([(path.clone(), Some(text.into_bytes()))]);
        Some(FileChange::new(files, shortened(&from), shortened(&to)))
    }))
}

fn mutation(path: &str, field: &str, kind: &'static str, change: Change) -> Mutation {
    Mutation::of_file(SOURCE, path, field, kind, change)
}
