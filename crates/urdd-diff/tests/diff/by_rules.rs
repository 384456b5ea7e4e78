//! Where a change of a URDF's text belongs: a second description of what `urdd diff` names, by the XML alone.

use urdd_xml::Node;

/// Where an attribute belongs: the list, the part, the field. `None` if it has no meaning of its own.
pub struct Place {
    pub list: &'static str,
    pub part: String,
    pub field: String,
}

impl Place {
    pub fn text(&self) -> String {
        format!("{}/{}/{}", self.list, self.part, self.field)
    }
}

fn index_among(node: Node) -> usize {
    let same = |other: &Node| other.tag_name() == node.tag_name();
    node.prev_siblings().skip(1).filter(Node::is_element).filter(same).count()
}

/// The elements from below the robot to this one.
fn chain<'a>(node: Node<'a, 'a>) -> Vec<Node<'a, 'a>> {
    let mut chain: Vec<Node> = node.ancestors().filter(Node::is_element).collect();
    chain.pop();
    chain.reverse();
    chain
}

/// The place of an attribute.
pub fn place(node: Node, attribute: &str) -> Option<Place> {
    let chain = chain(node);
    let Some(part) = chain.first() else {
        let field = attribute.to_owned();
        return matches!(attribute, "name" | "version").then_some(Place {
            list: "robot",
            part: String::new(),
            field,
        });
    };
    let tags: Vec<&str> = chain.iter().map(|node| node.tag_name().name()).collect();
    let field = match (tags.as_slice(), attribute) {
        (["link", "inertial", "origin"], of @ ("xyz" | "rpy")) => format!("inertial.origin.{of}"),
        (["link", "inertial", "mass"], "value") => "inertial.mass".to_owned(),
        (["link", "inertial", "inertia"], of) => format!("inertial.{of}"),
        (["link", kind @ ("visual" | "collision"), rest @ ..], of) => {
            let index = index_among(chain[1]);
            let field = match (rest, of) {
                ([], "name") => "name".to_owned(),
                (["origin"], of @ ("xyz" | "rpy")) => format!("origin.{of}"),
                (["geometry", "mesh"], "filename") => "mesh".to_owned(),
                (["geometry", "mesh"], "scale") => "scale".to_owned(),
                (["geometry", "box" | "cylinder" | "sphere" | "capsule"], of) => of.to_owned(),
                (["material"], "name") => "material.name".to_owned(),
                (["material", "color"], "rgba") => "material.rgba".to_owned(),
                (["material", "texture"], "filename") => "material.texture".to_owned(),
                _ => return None,
            };
            format!("{kind}[{index}].{field}")
        }
        (["joint"], "type") => "type".to_owned(),
        (["joint", of @ ("parent" | "child")], "link") => (*of).to_owned(),
        (["joint", "origin"], of @ ("xyz" | "rpy")) => format!("origin.{of}"),
        (["joint", "axis"], "xyz") => {
            let has_axis = ["revolute", "continuous", "prismatic", "planar"];
            let joint_type = part.attribute("type").unwrap_or_default();
            has_axis.contains(&joint_type).then(|| "axis".to_owned())?
        }
        (
            ["joint", of @ ("limit" | "dynamics" | "mimic" | "safety_controller" | "calibration")],
            attribute,
        ) => format!("{of}.{attribute}"),
        (["material", "color"], "rgba") => "rgba".to_owned(),
        (["material", "texture"], "filename") => "texture".to_owned(),
        _ => return None,
    };
    let list = match tags[0] {
        "link" => "links",
        "joint" => "joints",
        _ => "materials",
    };
    Some(Place { list, part: part.attribute("name").unwrap_or_default().to_owned(), field })
}

/// Whether a value is what an absent one means.
pub fn is_default(field: &str, value: &str) -> bool {
    let numbers: Option<Vec<f64>> = value.split_whitespace().map(|w| w.parse().ok()).collect();
    let Some(numbers) = numbers else {
        return false;
    };
    let last = field.rsplit('.').next().unwrap_or_default();
    match last {
        "xyz" | "rpy" | "damping" | "friction" | "offset" => numbers.iter().all(|n| *n == 0.0),
        "lower" | "upper" => numbers == [0.0],
        "multiplier" => numbers == [1.0],
        "scale" => numbers == [1.0; 3],
        "axis" => numbers == [1.0, 0.0, 0.0],
        _ => false,
    }
}
