//! Drake 1.51.1: `Parser.AddModels` into a plant with a scene graph, and `Finalize`. It reads as many numbers as a text
//! begins with, refuses every mesh that it does not find, and has collisions of few formats of meshes.

mod joints;
mod parts;

use crate::prelude::*;

pub const ABOUT: About = About {
    id: "drake",
    name: "Drake",
    family: "Drake",
    version: "1.51.1",
    settings: &[],
    is_asked: true,
    is_for: None,
    names: Names::Exact,
    never: &["safety_controller calibration version quat_xyzw", FURTHER],
    read,
};

/// The link that is Drake's own.
const WORLD: &str = "world";

pub fn read(file: &File, effects: &mut Effects) -> Reading<()> {
    let tree = effects.parsed(file.document.within(tinyxml::MAX_DEPTH))?;
    let robot = effects.robot(tree)?;
    let mut reader = DrakeReader { file, effects, materials: HashMap::new() };
    let _ = reader.named(robot, "robot");
    for material in robot.named("material") {
        reader.material(material, true);
    }
    let links = reader.links(robot)?;
    reader.collision_filters(robot, &links);
    reader.joints(robot, &links)
}

struct DrakeReader<'r> {
    file: &'r File<'r>,
    effects: &'r mut Effects,
    /// Those that have been defined up to here, in the robot or in a visual.
    materials: HashMap<String, Material>,
}

struct Material {
    rgba: Vec<f64>,
    texture: Option<String>,
    /// Where its colour is in the file.
    at: usize,
}

/// The links by their names, without that of the world.
type Links<'t> = HashMap<&'t str, Node<'t>>;

impl DrakeReader<'_> {
    /// The name of the robot or of a link. Empty, it ends the process in C++.
    fn named<'t>(&mut self, node: Node<'t>, kind: &'static str) -> Reading<&'t str> {
        let name = self.effects.needed(node, "name")?;
        let rule = "the program keeps this name for itself";
        match &*name.value {
            "" => self.effects.refuse(name, Fault::Empty("name")),
            "WorldModelInstance" | "DefaultModelInstance" if kind == "robot" => {
                self.effects.refuse(name, Fault::name(kind, &name.value, rule))
            }
            name => Ok(name),
        }
    }

    fn links<'t>(&mut self, robot: Node<'t>) -> Reading<Links<'t>> {
        let mut links = HashMap::new();
        for link in robot.named("link") {
            if self.is_ignored(link) {
                continue;
            }
            let name = self.named(link, "link")?;
            let part = Part::of("link", name);
            let inertial = self.first(link, "inertial", &part.inside("inertial"));
            if name == WORLD {
                let fault = Fault::Way("a link `world` is the world of the program");
                self.effects.read_as(link, &part, fault, "the world");
                if let Some(inertial) = inertial {
                    self.effects.unread(inertial, part.inside("inertial"), "inertial");
                }
            } else {
                if let Some(inertial) = inertial {
                    let _ = self.inertial(inertial, &part.inside("inertial"));
                }
                if links.insert(name, link).is_some() {
                    self.effects.refuse_mendable(link, Fault::not_unique("link", name));
                }
            }
            for kind in ["visual", "collision"] {
                for (shape, part) in part.shapes(link, kind) {
                    let _ = self.shape(shape, &part);
                }
            }
        }
        Ok(links)
    }

    /// An inertial. One that no body can have is a solid sphere of water of its mass, or of 1 kg.
    fn inertial(&mut self, inertial: Node<'_>, part: &Part) -> Reading<()> {
        let before = self.effects.unread_parts();
        self.pose(inertial, part);
        let mut written = None;
        if let Some(node) = inertial.child("mass") {
            written = self.number(node, "value", part).ok().flatten();
        }
        let mass = written.unwrap_or_default();
        let mut tensor = [0.0; 6];
        if let Some(node) = inertial.child("inertia") {
            let names = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];
            for (name, value) in names.into_iter().zip(&mut tensor) {
                *value = self.number(node, name, part).ok().flatten().unwrap_or_default();
            }
        }
        self.effects.are_read(before)?;
        let fault = if mass < 0.0 {
            Fault::Other("the mass is negative")
        } else if !can_be(tensor) {
            Fault::Inertia(
                "no body has this inertia: two moments are less than the third, or one is negative",
            )
        } else if mass == 0.0 && tensor != [0.0; 6] {
            Fault::Inertia("the mass is 0 or missing, and the inertia is not 0")
        } else {
            if written.is_none() {
                self.effects.read_as(inertial, part, Fault::MissingElement("mass"), "no mass");
            }
            return Ok(());
        };
        let mass = if mass > 0.0 { mass } else { 1.0 };
        self.effects.read_as(inertial, part, fault, format!("a sphere of water of {mass} kg"));
        Ok(())
    }

    fn collision_filters(&mut self, robot: Node<'_>, links: &Links<'_>) {
        let groups = || robot.named("drake:collision_filter_group");
        let names: HashSet<&str> = groups().filter_map(|group| group.value("name")).collect();
        for group in groups() {
            let _ = self.effects.needed(group, "name");
            for member in group.named("drake:member") {
                let Ok(link) = self.effects.needed(member, "link") else { continue };
                if !links.contains_key(&*link.value) {
                    self.effects.refuse_mendable(link, Fault::unknown("link", &link.value));
                }
            }
            for ignored in group.named("drake:ignored_collision_filter_group") {
                let Ok(name) = self.effects.needed(ignored, "name") else { continue };
                if !names.contains(&*name.value) {
                    self.effects.refuse_mendable(name, Fault::unknown("group", &name.value));
                }
            }
        }
    }

    /// Whether a link or joint says that Drake has to leave it out.
    fn is_ignored(&mut self, node: Node<'_>) -> bool {
        let ignored = node.attribute("drake_ignore").filter(|ignored| ignored.value == "true");
        if let Some(ignored) = ignored {
            let part = Part::of(node.name(), node.value("name").unwrap_or_default());
            self.effects.drop(ignored, part, Fault::Way("`drake_ignore` is `true`"));
        }
        ignored.is_some()
    }

    /// The colour of a material. In a visual it may be a name that was defined before.
    fn material(&mut self, node: Node<'_>, is_global: bool) -> Option<(usize, Vec<f64>)> {
        let name = node.value("name").unwrap_or_default();
        if name.is_empty() && is_global {
            self.effects.refuse_mendable(node, Fault::Missing("name"));
        }
        if let Some(map) = node.child("drake:diffuse_map") {
            let fault = Fault::Other("`<drake:diffuse_map>` is not for URDF");
            self.effects.refuse_mendable(map, fault);
        }
        let texture = node.child("texture").and_then(|texture| texture.attribute("filename"));
        let texture = texture.filter(|filename| !filename.value.is_empty());
        if let Some(filename) = texture {
            self.found(filename, "texture");
        }
        let color = node.child("color").map(|of| {
            let Ok(rgba) = self.effects.needed(of, "rgba") else { return (of.start(), vec![]) };
            // Any colour, if these are no numbers.
            let numbers = self.numbers(rgba, 4, &"material".into());
            (rgba.range.start, numbers.unwrap_or_default())
        });
        if name.is_empty() {
            return color;
        }
        if let Some(known) = self.materials.get(name) {
            let is_other = |color: &[f64]| {
                let squares = color.iter().zip(&known.rgba).map(|(a, b)| (a - b).powi(2));
                squares.sum::<f64>().sqrt() > 1e-10
            };
            if is_global
                || texture.is_some_and(|one| known.texture.as_deref() != Some(&*one.value))
                || color.as_ref().is_some_and(|(_, color)| is_other(color))
            {
                self.effects.refuse_mendable(node, Fault::not_unique("material", name));
                return color;
            }
            return Some((known.at, known.rgba.clone()));
        }
        if color.is_none() && texture.is_none() {
            let fault = match is_global {
                true => Fault::Other("the material has no colour and no texture"),
                false => Fault::unknown("material", name),
            };
            self.effects.refuse_mendable(node, fault);
        }
        // One that is refused may have any colour.
        let refused = if texture.is_some() { vec![0.0; 4] } else { vec![] };
        let (at, rgba) = color.unwrap_or_else(|| (node.start(), refused));
        let texture = texture.map(|filename| filename.value.to_string());
        self.materials.insert(name.to_owned(), Material { rgba: rgba.clone(), texture, at });
        Some((at, rgba))
    }

    /// The first child of a name, which is the one that counts: also if it is empty, and another one is not.
    fn first<'t>(&mut self, parent: Node<'t>, name: &str, part: &Part) -> Option<Node<'t>> {
        let mut all = parent.named(name);
        let first = all.next()?;
        if first.is_empty() && all.any(|other| !other.is_empty()) {
            self.effects.drop(first, part, Fault::Repeated(name.into()));
        }
        Some(first)
    }

    fn pose(&mut self, parent: Node<'_>, part: &Part) {
        let Some(origin) = self.first(parent, "origin", part) else { return };
        for name in ["xyz", "rpy"] {
            let _ = self.vector(origin, name, 3, part);
        }
        if let Some(quaternion) = origin.attribute("quat_xyzw") {
            self.effects.unread(quaternion, part, "quat_xyzw");
        }
    }

    /// A number that may be left out.
    fn number(&mut self, node: Node<'_>, name: &str, part: &Part) -> Reading<Option<f64>> {
        Ok(self.vector(node, name, 1, part)?.and_then(|numbers| numbers.first().copied()))
    }

    /// Numbers that may be left out.
    fn vector(
        &mut self,
        node: Node<'_>,
        name: &str,
        count: usize,
        part: &Part,
    ) -> Reading<Option<Vec<f64>>> {
        node.attribute(name).map(|value| self.numbers(value, count, part)).transpose()
    }

    /// As many numbers as the text begins with: what follows them is left out.
    fn numbers(&mut self, value: &Attribute<'_>, count: usize, part: &Part) -> Reading<Vec<f64>> {
        let (mut numbers, mut rest) = (Vec::new(), &*value.value);
        while let Some((number, behind)) = istream(rest) {
            numbers.push(number);
            rest = behind;
        }
        let is_only_numbers = rest.trim_start_matches(is_space).is_empty();
        if numbers.len() != count {
            let fault = match is_only_numbers && !numbers.is_empty() {
                true => Fault::count(value, count),
                false => Fault::not_a_number(value),
            };
            return self.effects.refuse(value, fault);
        }
        if !is_only_numbers {
            let read: Vec<String> = numbers.iter().map(f64::to_string).collect();
            self.effects.read_as(value, part, Fault::not_a_number(value), read.join(" "));
        }
        Ok(numbers)
    }
}

/// Whether a body can have moments of inertia xx, yy, zz, xy, xz, yz.
fn can_be(tensor: [f64; 6]) -> bool {
    let moments = principal(tensor);
    let half = tensor[..3].iter().sum::<f64>() / 2.0;
    let near = 16.0 * f64::EPSILON * half.max(1.0);
    moments[0] >= -near && moments[0] + moments[1] + near >= moments[2]
}

/// The principal moments, the smallest first, by Jacobi's rotations.
fn principal([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [f64; 3] {
    let mut of = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    const TURNS: usize = 30;
    for turn in 0..TURNS {
        let (p, q) = [(0, 1), (0, 2), (1, 2)][turn % 3];
        if of[p][q] == 0.0 {
            continue;
        }
        let theta = (of[q][q] - of[p][p]) / (2.0 * of[p][q]);
        let tangent = theta.signum() / (theta.abs() + theta.hypot(1.0));
        let cosine = 1.0 / tangent.hypot(1.0);
        let sine = tangent * cosine;
        let change = tangent * of[p][q];
        of[p][p] -= change;
        of[q][q] += change;
        of[p][q] = 0.0;
        of[q][p] = 0.0;
        let r = 3 - p - q;
        let (rp, rq) = (of[r][p], of[r][q]);
        of[r][p] = cosine * rp - sine * rq;
        of[r][q] = sine * rp + cosine * rq;
        of[p][r] = of[r][p];
        of[q][r] = of[r][q];
    }
    let mut moments = [of[0][0], of[1][1], of[2][2]];
    moments.sort_unstable_by(f64::total_cmp);
    moments
}
