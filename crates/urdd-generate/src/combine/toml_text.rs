//! Writes a recipe as TOML.

use std::path::Path;

use super::recipe::{JointDescription, Recipe, Word};
use super::recipe_fault::joint_type_word;
use urdd_format::urdf::JointType;

impl Recipe {
    /// The TOML text of this recipe for a file in `folder`. Sources inside `folder` are written relative to it.
    pub fn to_toml(&self, folder: &Path) -> String {
        let mut text = format!("name = {}\n", string(&self.name.text));
        if let Some(base) = &self.base {
            text += &format!("\n[base]\nlink = {}\n", string(&base.link.text));
            for (key, value) in joint(&base.joint) {
                text += &format!("{key} = {value}\n");
            }
        }
        for part in &self.parts {
            let source = part.source.strip_prefix(folder).unwrap_or(&part.source);
            let source = source.to_string_lossy();
            text += &format!(
                "\n[[part]]\nid = {}\nsource = {}\nprefix = {}\n",
                string(&part.id.text),
                string(&source),
                string(&part.prefix.text)
            );
            let words = |words: &[Word]| {
                let words: Vec<String> = words.iter().map(|word| string(&word.text)).collect();
                format!("[{}]", words.join(", "))
            };
            for (key, list) in [("drop", &part.drop), ("names", &part.names)] {
                if !list.is_empty() {
                    text += &format!("{key} = {}\n", words(list));
                }
            }
            if !part.freeze.is_empty() {
                let freeze = part.freeze.iter().map(|(joint, values)| {
                    format!("{} = {}", string(&joint.text), numbers(values))
                });
                let freeze: Vec<String> = freeze.collect();
                text += &format!("freeze = {{ {} }}\n", freeze.join(", "));
            }
            if !part.skip.is_empty() {
                let pairs: Vec<String> = part.skip.iter().map(|pair| words(pair)).collect();
                text += &format!("skip = [{}]\n", pairs.join(", "));
            }
            if let Some(attach) = &part.attach {
                let joint = joint(&attach.joint).into_iter();
                let joint = joint.map(|(key, value)| format!("{key} = {value}"));
                let all: Vec<String> = [format!("to = {}", string(&attach.to.text))]
                    .into_iter()
                    .chain(joint)
                    .collect();
                text += &format!("attach = {{ {} }}\n", all.join(", "));
            }
        }
        text
    }
}

fn string(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

fn numbers(values: &[f64]) -> String {
    let values: Vec<String> =
        values.iter().map(|value| toml::Value::Float(*value).to_string()).collect();
    match values.as_slice() {
        [one] => one.clone(),
        _ => format!("[{}]", values.join(", ")),
    }
}

/// The keys of a joint and their values.
fn joint(of: &JointDescription) -> Vec<(&'static str, String)> {
    let mut keys = vec![("name", string(&of.name.text))];
    if of.joint_type != JointType::Fixed {
        keys.push(("joint", string(&joint_type_word(of.joint_type))));
    }
    for (key, value) in [("xyz", of.xyz), ("rpy", of.rpy)] {
        if value != [0.0; 3] {
            keys.push((key, numbers(&value)));
        }
    }
    if let Some(axis) = of.axis {
        keys.push(("axis", numbers(&axis)));
    }
    if let Some(limit) = &of.limit {
        let said = [
            ("lower", limit.lower),
            ("upper", limit.upper),
            ("effort", limit.effort),
            ("velocity", limit.velocity),
        ];
        let said = said
            .into_iter()
            .filter_map(|(key, value)| Some(format!("{key} = {}", numbers(&[value?]))));
        let said: Vec<String> = said.collect();
        keys.push(("limit", format!("{{ {} }}", said.join(", "))));
    }
    keys
}
