//! Pinocchio 4.1.0: `buildModelFromUrdf`, then `buildGeomFromUrdf` for collisions and visuals. It reads by urdfdom 6, makes
//! the model from what urdfdom has, and reads the file by a second parser for its geometry.

use crate::prelude::*;
use crate::urdfdom::{Joint, Link, Model, Release};
use crate::{tinyxml, urdfdom};

pub const ABOUT: About = About {
    id: "pinocchio",
    name: "Pinocchio",
    family: "Pinocchio",
    version: "4.1.0",
    settings: &[],
    is_asked: true,
    is_for: None,
    names: Names::Exact,
    never: &["mimic safety_controller calibration", FURTHER],
    read,
};

pub fn read(file: &File, effects: &mut Effects) -> Reading<()> {
    let tree = urdfdom::parse(file, effects)?;
    let model = urdfdom::model(tree, Release::Six, effects)?;
    let mut reader = PinocchioReader { file, effects };
    let is_reached = reader.model(&model)?;
    effects.parsed(tinyxml::check_by_rapidxml(file.counted))?;
    if let Some(link) = model.robot.named("link").find(|link| link.attribute("name").is_none()) {
        return effects.refuse(link, Fault::Missing("name"));
    }
    let textures = textures(&model);
    for kind in ["collision", "visual"] {
        for (name, link) in model.links.iter().filter(|(name, _)| is_reached.contains(*name)) {
            PinocchioReader { file, effects }.shapes(kind, name, link, &textures);
        }
    }
    Ok(())
}

struct PinocchioReader<'r> {
    file: &'r File<'r>,
    effects: &'r mut Effects,
}

/// What a walk through the tree has still to do.
enum Step<'m> {
    Enter(&'m str),
    Leave(&'m str),
}

impl PinocchioReader<'_> {
    /// Walks from the root. Returns the links that it comes to.
    fn model<'m>(&mut self, model: &'m Model<'_>) -> Reading<HashSet<&'m str>> {
        let mut above = HashMap::new();
        let mut below: HashMap<&str, Vec<&str>> = HashMap::new();
        for joint in model.joints.values() {
            // Of two joints the last is the link's.
            above.insert(joint.child, joint);
            below.entry(joint.parent).or_default().push(joint.child);
        }
        let root = model.links.keys().copied().find(|name| !above.contains_key(name));
        let mut reached: HashSet<&str> = root.into_iter().collect();
        let mut on_path = HashSet::new();
        let mut steps: Vec<Step> = root.into_iter().map(Step::Enter).collect();
        while let Some(step) = steps.pop() {
            let link = match step {
                Step::Enter(link) => link,
                Step::Leave(link) => {
                    on_path.remove(link);
                    continue;
                }
            };
            if let Some(joint) = above.get(link) {
                if !reached.contains(joint.parent) {
                    let fault = Fault::Tree("the joint's parent comes after its child");
                    return self.effects.refuse(joint.node, fault);
                }
                self.joint(joint);
                if on_path.contains(link) {
                    return self.effects.crash(joint.node, Fault::Tree("the links are in a loop"));
                }
                if !reached.insert(link) {
                    let part = Part::of("link", link);
                    self.effects.read_as(joint.node, part, TWO_PARENTS, "two links");
                    continue;
                }
            }
            on_path.insert(link);
            steps.push(Step::Leave(link));
            let children = below.get(link).into_iter().flatten().rev();
            steps.extend(children.map(|child| Step::Enter(child)));
        }
        self.unreached(model, &reached);
        for (name, joint) in model.joints.iter().filter(|(_, joint)| reached.contains(joint.child))
        {
            self.unread(joint, name);
        }
        Ok(reached)
    }

    /// Links and joints that hang on no root.
    fn unreached(&mut self, model: &Model<'_>, reached: &HashSet<&str>) {
        for (name, link) in model.links.iter().filter(|(name, _)| !reached.contains(*name)) {
            self.effects.drop(link.node, Part::of("link", name), UNREACHED);
        }
        for (name, joint) in &model.joints {
            if !reached.contains(joint.child) {
                self.effects.drop(joint.node, Part::of("joint", name), UNREACHED);
            }
        }
    }

    /// The limits that a joint cannot have.
    fn joint(&mut self, joint: &Joint<'_>) {
        if !matches!(joint.kind, "revolute" | "continuous" | "prismatic") {
            return;
        }
        for (element, attribute) in
            [("limit", "effort"), ("dynamics", "friction"), ("limit", "velocity")]
        {
            let Some(value) = joint.node.child(element).and_then(|node| node.attribute(attribute))
            else {
                continue;
            };
            if number(&value.value) < 0.0 {
                let fault = Fault::range(value, "must not be negative");
                self.effects.refuse_mendable(value, fault);
            }
        }
    }

    /// What it does not read of a joint, or otherwise.
    fn unread(&mut self, joint: &Joint<'_>, name: &str) {
        let part = Part::of("joint", name);
        self.effects.unread_elements(joint.node, "mimic safety_controller calibration", &part);
        if matches!(joint.kind, "planar" | "floating") {
            self.effects.unread_elements(joint.node, "limit dynamics", &part);
        }
        let axis = joint.node.child("axis");
        let xyz = axis.map(|axis| axis.value("xyz").unwrap_or_default());
        let numbers: Vec<f64> = xyz.unwrap_or("1 0 0").split(' ').map(number).collect();
        let (at, part) = (axis.unwrap_or(joint.node), part.inside("axis"));
        match joint.kind {
            "planar" if !matches!(numbers[..], [0.0, 0.0, z] if z > 0.0) => {
                let fault = Fault::Other("the plane of a planar joint is always that of x and y");
                self.effects.read_as(at, part, fault, "0 0 1");
            }
            "revolute" | "continuous" | "prismatic" if !has_length(&numbers) => {
                let text = xyz.unwrap_or_default();
                let fault = Fault::range_of("xyz", text, "an axis has a length above 0");
                self.effects.read_as(at, part, fault, "a joint that does not move");
            }
            _ => {}
        }
    }

    fn shapes(
        &mut self,
        kind: &'static str,
        name: &str,
        link: &Link<'_>,
        materials: &HashMap<&str, Node<'_>>,
    ) {
        let (kept, is_all) = link.kept[usize::from(kind == "collision")];
        let part = Part::of("link", name);
        if !is_all {
            for (shape, part) in part.shapes(link.node, kind).take(kept) {
                self.effects.drop(shape, part, Fault::Way("another one of the link is faulty"));
            }
            return;
        }
        let [capsules, convex] = ["capsule", "convex"].map(|kind| Entries::of(link.node, kind));
        for (shape, part) in part.shapes(link.node, kind) {
            let form = shape.child("geometry").and_then(|geometry| geometry.children().next());
            let Some(form) = form else { continue };
            if form.name() == "mesh" {
                self.mesh(form);
            }
            let unnamed = match form.name() {
                "cylinder" => capsules.unnamed(shape),
                "mesh" => convex.unnamed(shape),
                _ => None,
            };
            if let Some(entry) = unnamed {
                self.effects.refuse_mendable(entry, Fault::Missing("name"));
            }
            let own = shape.child("material").filter(|_| kind == "visual");
            let name = own.and_then(|material| material.value("name")).unwrap_or_default();
            let material = materials.get(name).copied().or(own.filter(|_| name.is_empty()));
            let texture = material.and_then(|material| material.child("texture"));
            if let Some(image) = texture.and_then(|texture| texture.attribute("filename")) {
                match scheme_fault(image) {
                    Some(fault) => self.effects.refuse_mendable(image, fault),
                    None if image.value.is_empty() => {}
                    None if matches!(self.file.mesh(&image.value), Mesh::Missing) => {
                        let fault = Fault::NotFound("texture");
                        self.effects.drop(image, part.inside("material"), fault);
                    }
                    None => {}
                }
            }
        }
    }

    fn mesh(&mut self, mesh: Node<'_>) {
        let Some(filename) = mesh.attribute("filename") else { return };
        let fault = match self.file.mesh(&filename.value) {
            _ if scheme_fault(filename).is_some() => scheme_fault(filename),
            _ if filename.value.is_empty() => Some(Fault::Empty("filename")),
            Mesh::Missing => Some(Fault::NotFound("mesh")),
            Mesh::NoPackage => Some(NO_PACKAGE),
            Mesh::Found(facts) if !is_read(&filename.value, &facts) => match facts.content() {
                None if facts.is_of_no_format() => Some(format_fault(&filename.value)),
                _ => Some(Fault::Mesh("the mesh cannot be read")),
            },
            Mesh::Unknown | Mesh::Found(_) => None,
        };
        if let Some(fault) = fault {
            self.effects.refuse_mendable(filename, fault);
        }
    }
}

/// Why a name of a file is refused: it is too long, or has another scheme than those that it knows.
fn scheme_fault(file: &Attribute<'_>) -> Option<Fault> {
    const LONGEST: usize = 255;
    if file.value.split('/').any(|name| name.len() > LONGEST) {
        return Some(Fault::Mesh("its name has a part of more than 255 bytes"));
    }
    let (scheme, _) = file.value.split_once("://")?;
    let is_known = matches!(scheme, "package" | "model" | "file");
    let why = "the scheme of its name is none of package, model and file";
    (!is_known).then_some(Fault::ForOthers(why))
}

/// Entries of a kind of Pinocchio's own `<collision_checking>`, which are looked through until one names the shape: the names
/// before one that has none.
struct Entries<'t> {
    names: HashSet<&'t str>,
    unnamed: Option<Node<'t>>,
}

impl<'t> Entries<'t> {
    fn of(link: Node<'t>, kind: &str) -> Self {
        let checking = link.child("collision_checking");
        let all = || checking.into_iter().flat_map(|one| one.named(kind));
        Entries {
            names: all().map_while(|entry| entry.value("name")).collect(),
            unnamed: all().find(|entry| entry.value("name").is_none()),
        }
    }

    /// The entry without a name that is before one of a shape's.
    fn unnamed(&self, shape: Node<'_>) -> Option<Node<'t>> {
        self.unnamed.filter(|_| !self.names.contains(shape.value("name").unwrap_or_default()))
    }
}

/// The materials by their names: those of the robot, then the first of a visual.
fn textures<'t>(model: &Model<'t>) -> HashMap<&'t str, Node<'t>> {
    let mut links: Vec<Node<'t>> = model.links.values().map(|link| link.node).collect();
    links.sort_unstable_by_key(|link| link.index);
    let visuals = links.iter().flat_map(|link| link.named("visual"));
    let own = visuals.filter_map(|visual| visual.child("material"));
    let own = own.filter(|one| one.child("color").or(one.child("texture")).is_some());
    let mut named = HashMap::new();
    for material in model.robot.named("material").chain(own) {
        let name = material.value("name").unwrap_or_default();
        if !name.is_empty() {
            named.entry(name).or_insert(material);
        }
    }
    named
}

/// A number that urdfdom took.
fn number(text: &str) -> f64 {
    istream(text).map_or(0.0, |(number, _)| number)
}

fn has_length(axis: &[f64]) -> bool {
    let square = axis.iter().map(|number| number * number).sum::<f64>();
    square > 0.0 && square.is_finite()
}

/// Whether assimp reads a mesh.
fn is_read(name: &str, facts: &MeshFacts) -> bool {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
    let is_stl = facts.is_binary_stl();
    match &*ending {
        "stl" if is_stl => facts.size > 84,
        "stl" => facts.head.starts_with(b"solid") && facts.triangles > 0,
        "obj" => facts.size >= 16 && facts.triangles > 0,
        "dae" if facts.collada.is_some() => {
            facts.triangles > 0 && facts.collada.as_ref().is_some_and(|collada| collada.has_scene)
        }
        "ply" | "glb" | "gltf" | "off" | "3ds" | "fbx" | "step" => facts.size > 0,
        // A file without an ending that is known is guessed by what is in it.
        _ => facts.triangles > 0 && !is_stl,
    }
}
