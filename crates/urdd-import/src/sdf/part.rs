//! A part of a mesh by its name, as `<submesh>` names it: a node of COLLADA, an object or group of OBJ.

use std::collections::{BTreeMap, HashSet};
use std::ops::Range;

use urdd_xml::element::{Edit, apply};
use urdd_xml::{Kind, Node, parse};

/// A mesh of which parts are wanted.
#[derive(Debug)]
pub struct Parts {
    text: String,
    /// Of COLLADA; none of OBJ.
    scene: Option<Scene>,
}

/// What a COLLADA file places, and its geometries.
#[derive(Debug)]
struct Scene {
    placed: Vec<Placed>,
    /// By their ids.
    geometries: Vec<(String, Range<usize>)>,
}

#[derive(Debug)]
struct Placed {
    /// The name of the node.
    node: String,
    /// What is placed, `#ID`.
    url: String,
    is_geometry: bool,
    range: Range<usize>,
}

impl Parts {
    /// Of a mesh; `None` if its format has no names.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let text = std::str::from_utf8(bytes).ok()?.trim_start_matches('\u{feff}');
        if !text.trim_start().starts_with('<') {
            // A line may go on behind a backslash.
            let text = text.replace("\\\r\n", " ").replace("\\\n", " ");
            return Some(Parts { text, scene: None });
        }
        let scene = Some(scene(text)?);
        Some(Parts { text: text.to_owned(), scene })
    }

    /// What passing it once costs.
    pub fn cost(&self) -> usize {
        self.text.len()
    }

    /// The mesh with one part alone, and without what only others need; `None` if it has none of this name.
    pub fn part(&self, name: &str) -> Option<Vec<u8>> {
        let part = match &self.scene {
            Some(scene) => of_collada(&self.text, scene, name),
            None => of_obj(&self.text, name),
        };
        part.map(String::into_bytes)
    }
}

fn scene(text: &str) -> Option<Scene> {
    let document = parse(text, Kind::Other).ok()?;
    let (mut placed, mut geometries) = (Vec::new(), Vec::new());
    let of = |node: Node, key: &str| node.attribute(key).unwrap_or_default().to_owned();
    for node in document.descendants().filter(Node::is_element) {
        let range = node.range();
        match (node.tag_name().name(), node.parent()) {
            ("geometry", _) => geometries.push((of(node, "id"), range)),
            (kind @ ("instance_geometry" | "instance_controller"), Some(parent)) => {
                let name = parent.attribute("name").or(parent.attribute("id"));
                placed.push(Placed {
                    node: name.unwrap_or_default().to_owned(),
                    url: of(node, "url"),
                    is_geometry: kind == "instance_geometry",
                    range,
                });
            }
            _ => {}
        }
    }
    Some(Scene { placed, geometries })
}

fn of_collada(text: &str, scene: &Scene, name: &str) -> Option<String> {
    let (kept, others): (Vec<_>, Vec<_>) = scene.placed.iter().partition(|of| of.node == name);
    let needed: HashSet<&str> = kept.iter().map(|of| of.url.trim_start_matches('#')).collect();
    // A controller names its geometry itself.
    let has_controllers = kept.iter().any(|of| !of.is_geometry);
    let is_needed = |id: &str| has_controllers || needed.contains(id);
    let geometries = scene.geometries.iter().filter(|(id, _)| !is_needed(id));
    let left_out = others.iter().map(|of| &of.range).chain(geometries.map(|(_, range)| range));
    let edits = left_out.map(|range| Edit { range: range.clone(), text: String::new() });
    (!kept.is_empty()).then(|| apply(text, edits.collect()))
}

/// The words for what a corner of a face names, in their order in it.
const POINTS: [&str; 3] = ["v", "vt", "vn"];

/// The faces of an object or group, with their points and materials.
fn of_obj(text: &str, name: &str) -> Option<String> {
    let mut points: [Vec<&str>; 3] = Default::default();
    // The new number of each point that is used, by its old one.
    let mut used: [BTreeMap<usize, usize>; 3] = Default::default();
    let (mut head, mut faces) = (String::new(), Vec::new());
    let (mut is_inside, mut material) = (false, "");
    for line in text.lines() {
        let line = line.trim();
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match word {
            "o" | "g" => is_inside = rest.trim() == name,
            "usemtl" => material = line,
            "mtllib" => head = head + line + "\n",
            "f" if is_inside => {
                let corners: Option<Vec<[Option<usize>; 3]>> =
                    rest.split_whitespace().map(|corner| of_corner(corner, &points)).collect();
                let corners = corners?;
                for (place, index) in corners.iter().flat_map(|of| of.iter().enumerate()) {
                    index.map(|index| used[place].insert(index, 0));
                }
                faces.push((material, corners));
            }
            _ => {
                if let Some(place) = POINTS.iter().position(|point| *point == word) {
                    points[place].push(line);
                }
            }
        }
    }
    if faces.is_empty() {
        return None;
    }
    let mut part = format!("{head}o {name}\n");
    for (used, points) in used.iter_mut().zip(&points) {
        for (number, (index, new)) in used.iter_mut().enumerate() {
            *new = number + 1;
            part = part + points.get(*index)? + "\n";
        }
    }
    let mut last = "";
    for (material, corners) in faces {
        if material != last {
            part = part + material + "\n";
            last = material;
        }
        part.push('f');
        for corner in corners {
            let new = |place: usize| {
                corner[place].and_then(|index| used[place].get(&index)).map(usize::to_string)
            };
            let corner = [0, 1, 2].map(|place| new(place).unwrap_or_default()).join("/");
            part = part + " " + corner.trim_end_matches('/');
        }
        part.push('\n');
    }
    Some(part)
}

/// The points of a corner, from 0; `None` if a number is none of a point so far.
fn of_corner(corner: &str, points: &[Vec<&str>; 3]) -> Option<[Option<usize>; 3]> {
    let mut found = [None; 3];
    for (place, text) in corner.split('/').enumerate().filter(|(_, text)| !text.is_empty()) {
        let number: i64 = text.parse().ok()?;
        let count = points.get(place)?.len();
        let index = match number {
            1.. => usize::try_from(number).ok()?.checked_sub(1)?,
            _ => count.checked_sub(usize::try_from(number.unsigned_abs()).ok()?)?,
        };
        *found.get_mut(place)? = Some(index);
    }
    Some(found)
}
