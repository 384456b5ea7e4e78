//! PyBullet 3.2.7: `loadURDF` with its default flags. It reads URDF by code of its own, which takes any text for a
//! number, and never reads mimics, calibrations, safety controllers and, by default, tensors of inertia.

mod parts;

use std::borrow::Cow;

use urdd_xml::{Counted, Kind};

use crate::effect::Color;
use crate::number;
use crate::prelude::*;
use crate::tinyxml::{Document, OLD_MAX_DEPTH};
use crate::tree::{BEYOND, Malformed};

/// Names up to this long do no harm. All are copied into 1,024 bytes, and the process ends soon above.
const LONGEST_NAMES: [(&str, usize); 3] = [("robot", 1024), ("joint", 1100), ("link", 2100)];
/// A robot of more links, its root aside, can be asked for nothing.
const MOST_LINKS: usize = 127;

pub const ABOUT: About = About {
    id: "pybullet",
    name: "PyBullet",
    family: "PyBullet",
    version: "3.2.7",
    settings: &[],
    is_asked: true,
    is_for: None,
    names: Names::Exact,
    never: &[
        "mimic safety_controller calibration version quat_xyzw texture",
        FURTHER,
        "inertia ixx ixy ixz iyy iyz izz",
    ],
    read,
};

pub fn read(file: &File, effects: &mut Effects) -> Reading<()> {
    let lines = Lines::of(file.bytes);
    let reading = read_lines(file, &lines, effects);
    for effect in effects.kept_mut() {
        effect.at = lines.place(effect.at).min(file.bytes.len());
    }
    reading
}

fn read_lines(file: &File, lines: &Lines<'_>, effects: &mut Effects) -> Reading<()> {
    let broken = match &lines.bytes {
        Cow::Borrowed(_) => None,
        Cow::Owned(bytes) => {
            let counted = Counted::new(bytes, Kind::Robot);
            let beyond = |_| Malformed { at: 0, why: BEYOND };
            Some(Document::of(effects.parsed(counted.map_err(beyond))?))
        }
    };
    let document = broken.as_ref().unwrap_or(&file.document);
    let parsed =
        document.within(OLD_MAX_DEPTH).map_err(|bad| match file.document.within(OLD_MAX_DEPTH) {
            Ok(_) => Malformed {
                why: "a line has more than 8,191 bytes, after which the program breaks it",
                ..bad
            },
            Err(_) => bad,
        });
    let tree = effects.parsed(parsed)?;
    let robot = effects.robot(tree)?;
    PybulletReader { file, effects, materials: HashMap::new() }.robot(robot)
}

/// The longest line, bytes.
const LONGEST: usize = 8191;

/// A file in lines, as PyBullet reads it. A longer one is broken, what follows a carriage return is lost, and a NUL ends a line.
struct Lines<'a> {
    bytes: Cow<'a, [u8]>,
    /// Where each piece of a line begins in `bytes`, and in the file; none if nothing was changed.
    pieces: Vec<(usize, usize)>,
}

impl Lines<'_> {
    fn of(file: &[u8]) -> Lines<'_> {
        let is_plain = file.split(|&byte| byte == b'\n').all(|line| {
            let end = line.iter().position(|&byte| byte == b'\r').unwrap_or(line.len());
            line.len() <= LONGEST && !line.contains(&0) && end + 1 >= line.len()
        });
        if is_plain {
            return Lines { bytes: file.into(), pieces: Vec::new() };
        }
        let (mut bytes, mut pieces, mut start) = (Vec::with_capacity(file.len()), Vec::new(), 0);
        for line in file.split(|&byte| byte == b'\n' || byte == 0) {
            for piece in line.chunks(LONGEST) {
                pieces.push((bytes.len(), start));
                let end = piece.iter().position(|&byte| byte == b'\r').unwrap_or(piece.len());
                bytes.extend_from_slice(&piece[..end]);
                bytes.push(b'\n');
                start += piece.len();
            }
            start += 1;
        }
        Lines { bytes: bytes.into(), pieces }
    }

    /// The place in the file of a place in the lines.
    fn place(&self, at: usize) -> usize {
        let after = self.pieces.partition_point(|(begin, _)| *begin <= at);
        let piece = after.checked_sub(1).and_then(|index| self.pieces.get(index));
        piece.map_or(at, |(begin, start)| start + (at - begin))
    }
}

/// The colours of a material's name.
struct Colors {
    first: Color,
    /// All of the name have it.
    last: Color,
    are_same: bool,
}

impl Colors {
    fn of(color: Color) -> Self {
        Colors { first: color.clone(), last: color, are_same: true }
    }
}

struct PybulletReader<'r> {
    file: &'r File<'r>,
    effects: &'r mut Effects,
    /// The materials that are defined anywhere, with the first and the last colour of each.
    materials: HashMap<String, Colors>,
}

/// The links in their order, and their places in it by their names.
#[derive(Default)]
struct Links<'t> {
    all: Vec<(&'t str, Node<'t>)>,
    places: HashMap<&'t str, usize>,
}

impl PybulletReader<'_> {
    fn robot(&mut self, robot: Node<'_>) -> Reading<()> {
        let _ = self.named(robot, "robot");
        for material in robot.named("material") {
            let name = material.value("name").unwrap_or_default();
            let part = Part::of("material", name);
            match self.materials.get(name) {
                Some(known) if known.first.text == rgba(material) => {}
                Some(_) => {
                    self.effects.drop(material, part, Fault::not_unique("material", name));
                }
                None => {
                    self.material(material, &part);
                    let color = Color::of(rgba(material));
                    self.materials.insert(name.to_owned(), Colors::of(color));
                }
            }
        }
        let visuals = robot.named("link").flat_map(|link| link.named("visual"));
        for material in visuals.filter_map(|visual| visual.child("material")) {
            if is_defined(material) {
                let name = material.value("name").unwrap_or_default().to_owned();
                let color = Color::of(rgba(material));
                let known = self.materials.entry(name);
                known.or_insert_with(|| Colors::of(color.clone())).last.clone_from(&color);
            }
        }
        for known in self.materials.values_mut() {
            known.are_same = known.first.is_same(&known.last);
        }
        let mut links = Links::default();
        let mut are_unique = Ok(());
        for link in robot.named("link") {
            let name = self.named(link, "link")?;
            if links.places.insert(name, links.all.len()).is_some() {
                are_unique = self.effects.refuse(link, Fault::not_unique("link", name));
            }
            links.all.push((name, link));
            self.link(link, name);
        }
        if links.all.is_empty() {
            return self.effects.refuse(robot, Fault::MissingElement("link"));
        }
        let joints = self.joints(robot, &links)?;
        are_unique?;
        self.tree(robot, &links, &joints)
    }

    /// The name of the robot, of a link or of a joint.
    fn named<'t>(&mut self, node: Node<'t>, kind: &'static str) -> Reading<&'t str> {
        let name = &*self.effects.needed(node, "name")?.value;
        let longest = LONGEST_NAMES.iter().find(|(one, _)| *one == kind);
        if longest.is_some_and(|(_, longest)| name.len() > *longest) {
            return self.effects.crash(node, Fault::name(kind, name, "the name is too long"));
        }
        Ok(name)
    }

    fn material(&mut self, material: Node<'_>, part: &Part) {
        if let Some(texture) = material.child("texture") {
            self.effects.unread(texture, part, "texture");
        }
        if let Some(rgba) = material.child("color").and_then(|color| color.attribute("rgba"))
            && pieces(&rgba.value).len() != 4
        {
            self.effects.read_as(rgba, part, Fault::count(rgba, 4), "0 0 0 0");
        }
    }

    fn link(&mut self, link: Node<'_>, name: &str) {
        let part = Part::of("link", name);
        let _ = match link.child("inertial") {
            Some(inertial) => self.inertial(inertial, &part.inside("inertial")),
            None if name == "world" => Ok(()),
            None if name.contains("%s") || name.contains("%n") => {
                let rule = "a warning about its missing inertial takes it for a format";
                self.effects.crash(link, Fault::name("link", name, rule))
            }
            None => {
                let fault = Fault::Way("the link has no `<inertial>`");
                self.effects.read_as(link, part.inside("inertial"), fault, "mass 1");
                Ok(())
            }
        };
        for kind in ["visual", "collision"] {
            for (shape, part) in part.shapes(link, kind) {
                let _ = self.shape(shape, &part);
            }
        }
        // PyBullet's own elements.
        let contact = link.child("contact");
        for of in contact.into_iter().flat_map(Node::children) {
            if CONTACT.split(' ').any(|one| one == of.name()) {
                let _ = self.effects.needed(of, "value");
            }
        }
        let data = link.named("bullet").flat_map(|bullet| bullet.named("user-data"));
        for data in data.filter(|data| data.attribute("key").is_none()) {
            let _ = self.effects.crash::<()>(data, Fault::Missing("key"));
        }
    }

    fn inertial(&mut self, inertial: Node<'_>, part: &Part) -> Reading<()> {
        self.pose(inertial, part);
        let mass = self.effects.needed_element(inertial, "mass")?;
        let mass = self.effects.needed(mass, "value")?;
        self.number(mass, part);
        let inertia = self.effects.needed_element(inertial, "inertia")?;
        for name in ["ixx", "iyy", "izz"] {
            self.effects.needed(inertia, name)?;
        }
        let makes = "that of its mass in the shape of its collisions";
        self.effects.read_as(inertia, part, Fault::NeverRead("inertia".into()), makes);
        Ok(())
    }

    fn pose(&mut self, parent: Node<'_>, part: &Part) {
        let Some(origin) = parent.child("origin") else { return };
        for value in ["xyz", "rpy"].into_iter().filter_map(|name| origin.attribute(name)) {
            self.vector(value, part);
        }
        if let Some(quaternion) = origin.attribute("quat_xyzw") {
            self.effects.unread(quaternion, part, "quat_xyzw");
        }
    }

    /// Three numbers. Fewer are none at all, and what follows is left out.
    fn vector(&mut self, value: &Attribute<'_>, part: &Part) {
        let pieces = pieces(&value.value);
        if pieces.len() < 3 {
            self.effects.read_as(value, part, Fault::count(value, 3), "0 0 0");
        } else if pieces.len() > 3 || pieces.iter().any(|piece| !is_whole(piece)) {
            let read: Vec<String> =
                pieces[..3].iter().map(|piece| atof(piece).to_string()).collect();
            self.effects.read_as(value, part, Fault::count(value, 3), read.join(" "));
        }
    }

    fn number(&mut self, value: &Attribute<'_>, part: &Part) {
        if !is_whole(&value.value) {
            let read = atof(&value.value).to_string();
            self.effects.read_as(value, part, Fault::not_a_number(value), read);
        }
    }
}

/// What needs a value in a link's `<contact>`.
const CONTACT: &str = "inertia_scaling lateral_friction rolling_friction restitution \
    spinning_friction stiffness damping";

/// Whether a visual's material is one, and not only the name of one.
fn is_defined(material: Node<'_>) -> bool {
    material.children().any(|child| matches!(child.name(), "color" | "texture" | "specular"))
}

fn rgba<'t>(material: Node<'t>) -> &'t str {
    material.child("color").and_then(|color| color.value("rgba")).unwrap_or_default()
}

/// Pieces between spaces alone.
fn pieces(text: &str) -> Vec<&str> {
    number::pieces(text).collect()
}

/// `atof`: the number that a text begins with, or 0.
fn atof(text: &str) -> f64 {
    strtod(text).map_or(0.0, |(number, _)| number)
}

/// Whether `atof` reads all of a text, and a finite number.
fn is_whole(text: &str) -> bool {
    strtod(text).is_some_and(|(number, rest)| {
        rest.trim_start_matches(is_space).is_empty() && number.is_finite()
    })
}
