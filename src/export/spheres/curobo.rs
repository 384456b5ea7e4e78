//! cuRobo's spheres: `collision_spheres` of each link, and beside them what else its robot file takes by link.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::super::Export;
use super::super::error::ExportError;
use super::super::numbers::{number, numbers};
use super::super::subject::Subject;
use crate::format::escape;

pub(in super::super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let spheres = super::spheres(subject)?;
    let mut text = String::new();
    for line in subject.origin()? {
        let _ = writeln!(text, "# {}", escape::line(&line));
    }
    text +=
        "# Lengths in metres, in the frame of the link. The spheres of a link hold all of it.\n";
    text += "collision_spheres:\n";
    let held = subject.links.iter().zip(&spheres);
    let held: Vec<_> = held.filter(|(_, spheres)| !spheres.is_empty()).collect();
    for (link, spheres) in &held {
        let _ = writeln!(text, "  {}:", quoted(link));
        for sphere in *spheres {
            let centre = numbers(&sphere.centre).replace(' ', ", ");
            let _ = writeln!(text, "    - center: [{centre}]");
            let _ = writeln!(text, "      radius: {}", number(sphere.radius));
        }
    }
    text += "collision_link_names:\n";
    for (link, _) in &held {
        let _ = writeln!(text, "  - {}", quoted(link));
    }
    let mut ignored: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for pair in subject.disabled() {
        let [a, b] = pair.links;
        ignored.entry(a).or_default().push(b);
    }
    text += match ignored.is_empty() {
        true => "self_collision_ignore: {}\n",
        false => "self_collision_ignore:\n",
    };
    for (link, others) in ignored {
        let others: Vec<String> = others
            .into_iter()
            .map(|other| quoted(&subject.links[other]))
            .collect();
        let link = quoted(&subject.links[link]);
        let _ = writeln!(text, "  {link}: [{}]", others.join(", "));
    }
    Ok(Export {
        text,
        files: Vec::new(),
        notes: subject.notes(),
    })
}

/// A string as YAML and JSON both read it.
fn quoted(name: &str) -> String {
    escape::json(&serde_json::Value::from(name).to_string()).into_owned()
}
