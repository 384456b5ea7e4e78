//! urdf-loader 0.13.1 of three.js, with its defaults: visuals, no collisions. Any text is a number to it, perhaps NaN.
//! Names of elements may be in any case. Chromium reads a file that is not well-formed as far as the first error.

mod parts;

use crate::file::Text;
use crate::number::parse_float;
use crate::prelude::*;

pub const ABOUT: About = About {
    id: "urdf_loader",
    name: "three.js (urdf-loader)",
    family: "three.js",
    version: "0.13.1",
    settings: &["three"],
    is_asked: true,
    is_for: None,
    names: Names::AnyCase,
    never: &[
        "collision dynamics damping friction safety_controller calibration version quat_xyzw",
        FURTHER,
    ],
    read,
};

pub fn read(file: &File, effects: &mut Effects) -> Reading<()> {
    let (text, of_text);
    let [_, tree] = match &file.strict {
        Some(trees) => effects.parsed(trees.as_ref().map_err(|bad| *bad))?,
        None => {
            text = Text::utf8(file.bytes);
            of_text = effects.parsed(text.trees())?;
            &of_text
        }
    };
    let robot = effects.robot(tree)?;
    let mut reader =
        ThreeReader { file, effects, materials: HashMap::new(), whites: HashSet::new() };
    reader.robot(robot)
}

fn named<'t>(node: Node<'t>, name: &str) -> impl Iterator<Item = Node<'t>> {
    node.children().filter(move |child| child.name().eq_ignore_ascii_case(name))
}

fn name_of<'t>(node: Node<'t>) -> &'t str {
    node.value("name").unwrap_or("null")
}

struct ThreeReader<'r, 't> {
    file: &'r File<'r>,
    effects: &'r mut Effects,
    /// The robot's materials, the last of each name.
    materials: HashMap<&'t str, Option<Look>>,
    /// The materials that a visual defines as white.
    whites: HashSet<&'t str>,
}

struct Joint<'t> {
    node: Node<'t>,
    child: Option<&'t str>,
    mimic: Option<Node<'t>>,
}

impl<'t> ThreeReader<'_, 't> {
    fn robot(&mut self, robot: Node<'t>) -> Reading<()> {
        let visuals = named(robot, "link").flat_map(|link| named(link, "visual"));
        let of_visuals = visuals.flat_map(|visual| named(visual, "material"));
        let of_visuals: Vec<Node<'t>> = of_visuals.collect();
        let used: HashSet<&str> = of_visuals.iter().copied().map(name_of).collect();
        for material in named(robot, "material") {
            let known = self.effects.mark();
            let is_read = self.material(material, &Part::of("material", name_of(material)));
            if is_read && !used.contains(name_of(material)) {
                // Nothing shows it.
                self.effects.forget(known);
            }
            self.materials.insert(name_of(material), Look::of(material));
        }
        let is_white = |material: &Node<'t>| {
            let rgba = material.child("color").and_then(|color| color.value("rgba"));
            rgba.is_some_and(|rgba| rgba.split_whitespace().all(|one| one.parse() == Ok(1.0)))
        };
        self.whites = of_visuals.into_iter().filter(is_white).map(name_of).collect();
        let children = named_as_children(robot);
        let mut links = HashMap::new();
        let mut root: Option<Node<'t>> = None;
        for link in named(robot, "link") {
            let name = name_of(link);
            if name.contains(['"', '\n', '\r', '\u{c}']) {
                let rule = "a name cannot have a quote or an end of a line";
                self.effects.refuse_mendable(link, Fault::name("link", name, rule));
            }
            self.link(link, &Part::of("link", name));
            let is_root = !children.contains(name) || name.contains('\\');
            if let Some(root) = root.filter(|_| is_root) {
                self.effects.drop(link, Part::of("link", name_of(root)), TWO_ROOTS);
                let part = Part::of("link", name);
                self.effects.read_as(link, part, TWO_ROOTS, "one with the others");
            }
            root = if is_root { Some(link) } else { root };
            if links.insert(name, link).is_some_and(|other| !other.is_like(link)) {
                let fault = Fault::not_unique("link", name);
                self.effects.read_as(link, Part::of("link", name), fault, "the last");
            }
        }
        let mut joints = HashMap::new();
        let mut all = Vec::new();
        for node in named(robot, "joint") {
            let joint = self.joint(node, &links);
            if let Some(other) = joints.insert(name_of(node), all.len())
                && all.get(other).is_some_and(|other: &Joint| !other.node.is_like(node))
            {
                let fault = Fault::not_unique("joint", name_of(node));
                self.effects.read_as(node, Part::of("joint", name_of(node)), fault, "the last");
            }
            all.push(joint);
        }
        self.children(&all);
        self.mimics(&all, &joints)
    }

    fn number(&mut self, value: &Attribute<'_>, part: &Part, none: &str) -> f64 {
        let number = parse_float(&value.value);
        let is_whole = value.value.trim().parse().is_ok_and(|whole: f64| whole == number);
        if !is_whole || !number.is_finite() {
            let makes = if number.is_nan() { none.to_owned() } else { number.to_string() };
            self.effects.read_as(value, part, Fault::not_a_number(value), makes);
        }
        number
    }

    fn numbers(&mut self, node: Node<'_>, names: &[&str], part: &Part, none: &str) {
        for value in names.iter().filter_map(|name| node.attribute(name)) {
            if !value.value.is_empty() {
                self.number(value, part, none);
            }
        }
    }

    /// Numbers between white space.
    fn vector<'v>(
        &mut self,
        value: &Attribute<'_>,
        pieces: impl Iterator<Item = &'v str>,
        count: usize,
        part: &Part,
    ) {
        let (mut found, mut is_whole, mut are_numbers) = (0, true, true);
        let mut read = vec![f64::NAN; count];
        for piece in pieces {
            if let Some(read) = read.get_mut(found) {
                *read = parse_float(piece);
            }
            found += 1;
            let is_number = piece.parse().is_ok_and(f64::is_finite);
            is_whole &= is_number;
            are_numbers &= is_number || piece.is_empty();
        }
        if found != count || !is_whole {
            // Between two white spaces is an empty piece.
            let fault = match are_numbers {
                true => Fault::count(value, count),
                false => Fault::not_a_number(value),
            };
            let read: Vec<String> = read.iter().map(f64::to_string).collect();
            self.effects.read_as(value, part, fault, read.join(" "));
        }
    }

    fn pose(&mut self, parent: Node<'t>, part: &Part) {
        let Some(origin) = self.last(parent, "origin", part) else { return };
        let part = part.inside("origin");
        for value in ["xyz", "rpy"].into_iter().filter_map(|name| origin.attribute(name)) {
            if !value.value.is_empty() {
                let text = value.value.trim();
                let pieces = text.split_whitespace().chain(text.is_empty().then_some(""));
                self.vector(value, pieces, 3, &part);
            }
        }
        if let Some(unread) = origin.attribute("quat_xyzw") {
            self.effects.unread(unread, part, "quat_xyzw");
        }
    }

    /// Of elements that repeat, the last counts.
    fn last(&mut self, parent: Node<'t>, name: &str, part: &Part) -> Option<Node<'t>> {
        let mut all = named(parent, name);
        let first = all.next()?;
        let Some(last) = all.last() else { return Some(first) };
        let is_empty = first.attributes().is_empty() && first.children().next().is_none();
        if !is_empty && !last.is_like(first) {
            self.effects.read_as(last, part.inside(name), Fault::Repeated(name.into()), "the last");
        }
        Some(last)
    }

    /// Whether a material is not refused.
    fn material(&mut self, material: Node<'t>, part: &Part) -> bool {
        let mut is_read = true;
        for color in named(material, "color") {
            match color.attribute("rgba") {
                Some(rgba) => {
                    self.vector(rgba, rgba.value.split(char::is_whitespace), 4, part);
                }
                None => {
                    is_read = false;
                    self.effects.refuse_mendable(color, Fault::Missing("rgba"));
                }
            }
        }
        for texture in named(material, "texture") {
            match texture.attribute("filename").filter(|name| !name.value.is_empty()) {
                None => self.effects.drop(texture, part, Fault::Empty("filename")),
                Some(name) if matches!(self.file.mesh(&name.value), Mesh::Missing) => {
                    self.effects.drop(name, part, Fault::NotFound("texture"));
                }
                Some(_) => {}
            }
        }
        is_read
    }

    fn link(&mut self, link: Node<'t>, part: &Part) {
        if let Some(inertial) = named(link, "inertial").next() {
            let part = part.inside("inertial");
            self.pose(inertial, &part);
            for mass in named(inertial, "mass") {
                self.numbers(mass, &["value"], &part, "0");
            }
            for inertia in named(inertial, "inertia") {
                self.numbers(inertia, &MOMENTS, &part, "0");
            }
        }
        for (index, visual) in named(link, "visual").enumerate() {
            self.visual(visual, &part.inside(format_args!("visual/{index}")));
        }
        for (index, collision) in named(link, "collision").enumerate() {
            let part = part.inside(format_args!("collision/{index}"));
            self.effects.unread(collision, part, "collision");
        }
    }

    fn visual(&mut self, visual: Node<'t>, part: &Part) {
        if let Some(material) = named(visual, "material").next() {
            let name = material.value("name").unwrap_or_default();
            let part = part.inside("material");
            if let Some(read) = self.materials.get(name).filter(|_| !name.is_empty()) {
                Look::compare(read.as_ref(), material, &part, self.effects);
            } else {
                self.material(material, &part);
                if material.children().next().is_none() && !self.whites.contains(name) {
                    let fault = Fault::unknown("material directly in `<robot>`", name);
                    self.effects.read_as(material, part, fault, "white");
                }
            }
        }
        self.pose(visual, part);
        if named(visual, "geometry").next().is_none() {
            self.effects.drop(visual, part, Fault::MissingElement("geometry"));
        }
        for geometry in named(visual, "geometry") {
            let Some(form) = geometry.children().next() else {
                self.effects.refuse_mendable(geometry, NO_SHAPE);
                continue;
            };
            self.shape(form, part);
            self.own_colours(visual, form, part);
        }
    }

    fn shape(&mut self, form: Node<'t>, part: &Part) {
        let sizes: &[&'static str] = match &*form.name().to_ascii_lowercase() {
            "mesh" => return self.mesh(form, part),
            "box" => {
                match form.attribute("size") {
                    Some(size) => self.vector(size, size.value.split_whitespace(), 3, part),
                    None => self.effects.read_as(form, part, Fault::Missing("size"), "0 0 0"),
                }
                return;
            }
            "sphere" => &["radius"],
            "cylinder" => &["radius", "length"],
            _ => return self.effects.drop(form, part, Fault::Shape(form.name().into())),
        };
        for name in sizes {
            match form.attribute(name) {
                Some(size) => drop(self.number(size, part, "0")),
                None => self.effects.read_as(form, part, Fault::Missing(name), "0"),
            }
        }
    }
}

/// What is named by a `<child>` anywhere: no such link is a root.
fn named_as_children<'t>(robot: Node<'t>) -> HashSet<&'t str> {
    let mut found = HashSet::new();
    let mut open = vec![robot];
    while let Some(node) = open.pop() {
        if node.name().rsplit(':').next() == Some("child") {
            found.extend(node.value("link"));
        }
        open.extend(node.children());
    }
    found
}
