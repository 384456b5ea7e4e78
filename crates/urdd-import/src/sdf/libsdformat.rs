//! What libsdformat refuses of a file, and an import takes: Gazebo does not load the original. `docs/import.md` names the
//! version that it is held to.

use std::collections::HashSet;

use nalgebra::Matrix3;

use super::super::features::Tally;
use super::tag::Tag;

/// How what is said of it begins.
pub const REFUSED: &str = "Gazebo refuses the file: ";
/// Elements of which a scope has one of a name.
const SCOPED: &[&str] = &["model", "link", "joint", "frame"];
/// Elements that have names, and for which a name is not looked for when they are read.
const NAMED: &[&str] = &["visual", "collision", "sensor", "light", "plugin", "world"];
/// Elements of links, models and shapes that say yes or no.
const FLAGS: &[&str] =
    &["static", "self_collide", "allow_auto_disable", "enable_wind", "kinematic", "cast_shadows"];
/// Elements that are looked into. In others, such as `<contact>` and `<state>`, `<collision>` and `<model>` mean other things.
const READ: &[&str] = &[
    "world",
    "model",
    "include",
    "link",
    "joint",
    "frame",
    "inertial",
    "visual",
    "collision",
    "material",
    "sensor",
    "light",
];
/// The first minor version in which what is in a model has names of its own, and the first without `::` in names.
const ONE_NAME: u32 = 7;
const NO_SCOPES: u32 = 8;

/// Says what libsdformat refuses in a file.
pub fn say_refusals(root: Tag, tally: &mut Tally) {
    let mut say = |tag: Tag, why: String| {
        tally.remark(tag.place(), format!("{REFUSED}{why}"));
    };
    let is_outermost = |child: &Tag| matches!(child.name(), "model" | "light" | "actor");
    if let Some(second) = root.children().filter(is_outermost).nth(1) {
        say(second, "outside of worlds is another model, light or actor".to_owned());
    }
    for model in root.children().filter(|child| child.name() == "model") {
        if let Ok((_, Some(name))) = model.pose() {
            say(model, format!("the outermost model is put relative to `{name}`"));
        }
    }
    let mut open = vec![root];
    while let Some(tag) = open.pop() {
        siblings(tag, &mut say);
        let is_read = |child: &Tag| READ.contains(&child.name());
        let inside: Vec<Tag> = tag.children().filter(is_read).collect();
        open.extend(inside.into_iter().rev());
    }
}

/// What is wrong among the elements in another.
fn siblings(parent: Tag, say: &mut impl FnMut(Tag, String)) {
    let mut names = HashSet::new();
    for tag in parent.children() {
        let kind = tag.name();
        let is_scoped = SCOPED.contains(&kind);
        if is_scoped || NAMED.contains(&kind) {
            let name = tag.attribute("name");
            if let Some(why) = name.map_or(Some("has no name"), |name| fault_of(tag, name)) {
                // What has to have a name is refused without it.
                if name.is_some() || !is_scoped {
                    say(tag, format!("`<{kind}>` {}{why}", quoted(name)));
                }
            }
            let scope = if is_scoped && tag.version >= ONE_NAME { "" } else { kind };
            let is_new = names.insert((scope, name.unwrap_or_default()));
            if kind != "plugin" && name.is_some() && !is_new {
                say(tag, format!("`<{kind}>` {}has the name of another", quoted(name)));
            }
        }
        let needed = match kind {
            "plugin" => Some("filename"),
            "sensor" | "light" => Some("type"),
            _ => None,
        };
        if let Some(missing) = needed.filter(|needed| tag.attribute(needed).is_none()) {
            say(tag, format!("`<{kind}>` has no `{missing}`"));
        }
        let text = || tag.text().to_lowercase();
        if FLAGS.contains(&kind) && !["", "0", "1", "true", "false"].contains(&&*text()) {
            say(tag, format!("`<{kind}>` is `{}`, which is neither true nor false", tag.text()));
        }
        match kind {
            "model" => placement(tag, say),
            "pose" => rotation(tag, say),
            "script" if parent.name() == "material" && tag.words("uri").is_none() => {
                say(tag, "`<script>` has no `<uri>`".to_owned());
            }
            "ambient" | "diffuse" | "specular" | "emissive" if parent.name() == "material" => {
                let is_part = |word: &str| word.parse().is_ok_and(|one| (0.0..=1.0).contains(&one));
                if !tag.text().split_whitespace().all(is_part) {
                    say(tag, format!("`<{kind}>` is `{}`, not numbers from 0 to 1", tag.text()));
                }
            }
            _ => {}
        }
    }
}

/// A model without links, or one that is put by what is not in it.
fn placement(model: Tag, say: &mut impl FnMut(Tag, String)) {
    let mut inside = model.children();
    if !model.flag("static") && !inside.any(|of| matches!(of.name(), "link" | "model" | "include"))
    {
        say(model, "a model that is not static has no link".to_owned());
    }
    for attribute in ["canonical_link", "placement_frame"] {
        let Some(name) = model.attribute(attribute).filter(|name| *name != "__model__") else {
            continue;
        };
        let first = name.split("::").next();
        let mut inside = model.children();
        if !inside.any(|child| child.name() == "include" || child.attribute("name") == first) {
            say(model, format!("`{attribute}` names `{name}`, which is not in the model"));
        }
    }
}

/// A rotation in no format that there is.
fn rotation(pose: Tag, say: &mut impl FnMut(Tag, String)) {
    let format = pose.attribute("rotation_format").unwrap_or("euler_rpy");
    match (format, pose.says("degrees")) {
        ("quat_xyzw", true) => say(pose, "a quaternion is not in degrees".to_owned()),
        ("euler_rpy" | "quat_xyzw", _) => {}
        _ => say(pose, format!("`rotation_format` is `{format}`: `euler_rpy` or `quat_xyzw`")),
    }
}

fn fault_of(tag: Tag, name: &str) -> Option<&'static str> {
    let is_reserved = name.len() >= 4 && name.starts_with("__") && name.ends_with("__");
    if is_reserved || name == "world" && SCOPED.contains(&tag.name()) {
        return Some("has a name that is reserved");
    }
    // The name of a plugin is that of a class.
    let has_scope = tag.name() != "plugin" && name.contains("::");
    (tag.version >= NO_SCOPES && has_scope).then_some("has `::` in its name")
}

fn quoted(name: Option<&str>) -> String {
    name.map_or_else(String::new, |name| format!("`{name}` "))
}

/// Whether libsdformat takes a mass, with its inertia about the centre.
pub fn takes_mass(mass: f64, inertia: &Matrix3<f64>) -> bool {
    const ROUNDING: f64 = 1e-12;
    let moments = inertia.symmetric_eigenvalues();
    let near = ROUNDING * moments.amax();
    let [a, b, c]: [f64; 3] = moments.into();
    let is_triangle = [[a, b, c], [b, c, a], [c, a, b]].iter().all(|[a, b, c]| a + b + near >= *c);
    mass >= 0.0 && moments.iter().all(|moment| moment + near >= 0.0) && is_triangle
}
