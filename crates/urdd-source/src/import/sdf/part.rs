//! A part of a mesh by its name, as `<submesh>` names it: a node of COLLADA, an object or group of OBJ.

use urdd_xml::Node;
use urdd_xml::element::{Edit, apply};
use urdd_xml::{Kind, parse};

/// The mesh with one part alone; `None` if it has none of this name, or its format has no names.
pub fn part(bytes: &[u8], name: &str) -> Option<Vec<u8>> {
    let text = std::str::from_utf8(bytes).ok()?;
    let text = text.trim_start_matches('\u{feff}');
    let found = match text.trim_start().starts_with('<') {
        true => of_collada(text, name),
        false => of_obj(text, name),
    };
    found.map(String::into_bytes)
}

/// Leaves out the geometries that other nodes place.
fn of_collada(text: &str, name: &str) -> Option<String> {
    let document = parse(text, Kind::Other).ok()?;
    let is_placed = |node: &Node| {
        node.is_element()
            && matches!(node.tag_name().name(), "instance_geometry" | "instance_controller")
    };
    let is_of_part = |placed: &Node| {
        placed.parent().is_some_and(|node| {
            node.attribute("name").or(node.attribute("id")).is_some_and(|found| found == name)
        })
    };
    let all = document.descendants().filter(is_placed);
    let (kept, others): (Vec<Node>, Vec<Node>) = all.partition(is_of_part);
    let edits = others.iter().map(|node| Edit { range: node.range(), text: String::new() });
    (!kept.is_empty()).then(|| apply(text, edits.collect()))
}

/// Leaves out the faces of other objects and groups.
fn of_obj(text: &str, name: &str) -> Option<String> {
    let (mut is_inside, mut is_found) = (false, false);
    let mut kept = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let (word, rest) = line.trim().split_once(char::is_whitespace).unwrap_or((line.trim(), ""));
        match word {
            "o" | "g" => is_inside = rest.trim() == name,
            "f" if !is_inside => continue,
            "f" => is_found = true,
            _ => {}
        }
        kept.push_str(line);
    }
    is_found.then_some(kept)
}
