//! cuRobo's spheres: `collision_spheres` of each link, and the other entries by link of its robot file. The keys are
//! those of `robot_cfg: kinematics:`. cuRobo also reads `collision_spheres` from a separate file.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::super::error::ExportError;
use super::super::numbers::{number, numbers};
use super::super::output::Export;
use super::super::subject::Subject;
use super::{Model, said};
use urdd_format::escape;

pub(in super::super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let model = Model::new(subject)?;
    let mut lines = subject.origin()?;
    lines.extend(model.said(&subject.links, subject.options.cover));
    let mut text = String::new();
    for line in lines {
        let _ = writeln!(text, "# {}", escape::line(&line));
    }
    let name = |link: usize| {
        subject
            .links
            .get(link)
            .map_or_else(String::new, |name| quoted(name))
    };
    let mut ignored: BTreeMap<usize, Vec<String>> = BTreeMap::new();
    for [a, b] in &model.ignored {
        ignored.entry(*a).or_default().push(name(*b));
    }
    text += key("collision_link_names", "[]", model.links.is_empty()).as_str();
    for (link, _) in &model.links {
        let _ = writeln!(text, "  - {}", name(*link));
    }
    text += key("collision_spheres", "{}", model.links.is_empty()).as_str();
    for (link, spheres) in &model.links {
        let _ = writeln!(text, "  {}:", name(*link));
        for sphere in spheres {
            let centre = numbers(&sphere.centre).replace(' ', ", ");
            let _ = writeln!(text, "    - center: [{centre}]");
            let _ = writeln!(text, "      radius: {}", number(sphere.radius));
        }
    }
    text += "# Added to all radii, for obstacles; what is measured holds for 0.\n";
    text += "collision_sphere_buffer: 0.0\n";
    text += key("self_collision_ignore", "{}", ignored.is_empty()).as_str();
    for (link, others) in ignored {
        let _ = writeln!(text, "  {}: [{}]", name(link), others.join(", "));
    }
    text += "# Added to the radii of a link, for self-collision; what is measured holds for 0.\n";
    text += key("self_collision_buffer", "{}", model.links.is_empty()).as_str();
    for (link, _) in &model.links {
        let _ = writeln!(text, "  {}: 0.0", name(*link));
    }
    Ok(Export {
        text,
        files: Vec::new(),
        notes: said::note(&model, subject).into_iter().collect(),
    })
}

/// A key, with its value if that is empty.
fn key(key: &str, empty: &str, is_empty: bool) -> String {
    match is_empty {
        true => format!("{key}: {empty}\n"),
        false => format!("{key}:\n"),
    }
}

/// A double-quoted string that every YAML reader decodes exactly. It is JSON's, except for characters beyond U+FFFF
/// that are escaped: JSON uses two surrogates, which YAML does not combine.
fn quoted(name: &str) -> String {
    let mut text = String::new();
    for c in serde_json::Value::from(name).to_string().chars() {
        match escape::is_hidden(c) {
            true if c > '\u{ffff}' => _ = write!(text, "\\U{:08x}", u32::from(c)),
            true => _ = write!(text, "\\u{:04x}", u32::from(c)),
            false => text.push(c),
        }
    }
    text
}
