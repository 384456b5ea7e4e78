//! COLLADA.

use urdd_xml::{Kind, Node};

/// What is in a COLLADA file that is well-formed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ColladaFacts {
    /// How many triangles its geometries have; polygons are counted as fans.
    pub triangles: usize,
    /// Whether a geometry or a controller has a place.
    pub has_instance: bool,
    /// Whether a scene has a geometry or a controller in it.
    pub has_scene: bool,
    /// Whether it has `<asset>` and `<library_geometries>`.
    pub is_complete: bool,
    /// What its unit is in metres; 1 if it does not say.
    pub meters: f64,
    /// Its axis that is up, such as `Y_UP`; empty if it does not say.
    pub up: String,
    /// The most `<node>` elements around a geometry.
    pub depth: usize,
    /// Whether white space stands before `<?xml`: assimp and tinyxml2 skip it, strict readers refuse the file.
    pub begins_late: bool,
}

pub(super) fn read(bytes: &[u8]) -> Option<ColladaFacts> {
    let text = std::str::from_utf8(bytes).ok()?.trim_start_matches('\u{feff}');
    let begins_late = text.trim_start().starts_with("<?xml ") && !text.starts_with('<');
    let text = if begins_late { text.trim_start() } else { text };
    let document = urdd_xml::parse(text, Kind::Lenient).ok()?;
    let root = document.root_element();
    let child = |name| root.children().find(|node| node.has_tag_name(name_of(root, name)));
    let asset = child("asset");
    let of_asset = |name| asset?.children().find(|node| node.has_tag_name(name_of(root, name)));
    let unit = of_asset("unit").and_then(|unit| unit.attribute("meter")?.trim().parse().ok());
    let up = of_asset("up_axis").and_then(|up| up.text()).map(|up| up.trim().to_owned());
    let mut facts = ColladaFacts {
        is_complete: asset.is_some() && child("library_geometries").is_some(),
        meters: unit.unwrap_or(1.0),
        up: up.unwrap_or_default(),
        begins_late,
        ..ColladaFacts::default()
    };
    let mut open = vec![(root, 0)];
    while let Some((node, depth)) = open.pop() {
        match node.tag_name().name() {
            "triangles" | "polylist" | "polygons" | "tristrips" | "trifans" => {
                facts.triangles = facts.triangles.saturating_add(triangles(node));
                continue;
            }
            "instance_geometry" | "instance_controller" => {
                facts.has_instance = true;
                facts.depth = facts.depth.max(depth);
            }
            _ => {}
        }
        let depth = depth + usize::from(node.tag_name().name() == "node");
        open.extend(node.children().filter(Node::is_element).map(|child| (child, depth)));
    }
    facts.has_scene =
        facts.has_instance && child("scene").is_some_and(|scene| scene.has_children());
    Some(facts)
}

fn name_of<'a>(root: Node<'a, '_>, name: &'a str) -> (&'a str, &'a str) {
    (root.tag_name().namespace().unwrap_or_default(), name)
}

/// The triangles of a primitive.
fn triangles(primitive: Node<'_, '_>) -> usize {
    let texts = |name: &'static str| {
        let children = primitive.children().filter(move |child| child.tag_name().name() == name);
        children.map(|child| child.text().unwrap_or_default())
    };
    let count = primitive.attribute("count").and_then(|count| count.trim().parse().ok());
    match primitive.tag_name().name() {
        "triangles" => {
            let is_empty = texts("p").all(|text| text.trim().is_empty());
            if is_empty { 0 } else { count.unwrap_or(0) }
        }
        "polylist" => {
            let counts = texts("vcount").flat_map(str::split_ascii_whitespace);
            counts
                .map(|count| count.parse().unwrap_or(0_usize).saturating_sub(2))
                .fold(0, usize::saturating_add)
        }
        _ => texts("p").filter(|text| !text.trim().is_empty()).count(),
    }
}
