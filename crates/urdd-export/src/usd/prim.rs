//! Prims: a small tree of them and its text, their names and paths, and which are not checked with each other.
//!
//! Names are letters, digits and `_` of ASCII, no digit first, which every version of USD takes. Prims in one place have
//! different names. What USD has no place for is custom data of a prim under `urdd`: named configurations, and elements of the
//! source that URDF does not define.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::fmt::Write;

use nalgebra::UnitQuaternion;

use crate::pairs::ascending;
use crate::{ExportError, Subject, Taken};
use urdd_format::escape::is_hidden;
use urdd_format::named_configurations::NamedConfiguration;
use urdd_kinematics::rotation::canonical;
use urdd_xml::number::number;

/// A prim that the file defines.
#[derive(Debug, Clone, Default)]
pub(super) struct Prim {
    kind: &'static str,
    name: String,
    schemas: Vec<String>,
    /// Metadata as `key = value`.
    metadata: Vec<String>,
    /// Attributes and relationships as they are written.
    properties: Vec<String>,
    children: Vec<Prim>,
}

impl Prim {
    pub fn new(kind: &'static str, name: impl Into<String>) -> Self {
        Prim { kind, name: name.into(), ..Prim::default() }
    }

    /// Applies a schema, once.
    pub fn apply(&mut self, schema: impl Into<String>) {
        let schema = schema.into();
        if !self.schemas.contains(&schema) {
            self.schemas.push(schema);
        }
    }

    #[must_use]
    pub fn applying(mut self, schemas: &[&str]) -> Self {
        schemas.iter().for_each(|schema| self.apply(*schema));
        self
    }

    pub fn describe(&mut self, key: &str, value: &str) {
        self.metadata.push(format!("{key} = {value}"));
    }

    /// The name that a person gave it, where USD cannot have that name.
    pub fn show(&mut self, name: &str) {
        if name != self.name {
            self.describe("displayName", &string(name));
        }
    }

    /// Sets an attribute, which is declared with its type: `float physics:mass`.
    pub fn set(&mut self, attribute: &str, value: impl AsRef<str>) {
        self.properties.push(format!("{attribute} = {}", value.as_ref()));
    }

    /// Declares an attribute without a value.
    pub fn declare(&mut self, attribute: &str) {
        self.properties.push(attribute.to_owned());
    }

    /// Points a relationship at other prims.
    pub fn relate(&mut self, relationship: &str, paths: &[String]) {
        let target = |path: &String| format!("<{path}>");
        let value = match paths {
            [path] => target(path),
            _ => array(paths.iter().map(target)),
        };
        self.properties.push(format!("rel {relationship} = {value}"));
    }

    /// Gives it the material of a path, by `material:binding` or another relationship.
    pub fn bind(&mut self, relationship: &str, material: &String) {
        self.apply("MaterialBindingAPI");
        self.relate(relationship, std::slice::from_ref(material));
    }

    pub fn push(&mut self, child: Prim) {
        self.children.push(child);
    }

    #[must_use]
    pub fn holding(mut self, child: Prim) -> Self {
        self.push(child);
        self
    }

    /// Adds a child, unless nothing is in it.
    pub fn push_filled(&mut self, child: Prim) {
        if !child.children.is_empty() || !child.metadata.is_empty() {
            self.push(child);
        }
    }

    fn write(&self, text: &mut String, depth: usize) {
        let indent = "    ".repeat(depth);
        let mut line = |line: &str| {
            *text += &indent;
            *text += line;
            text.push('\n');
        };
        let schemas = (!self.schemas.is_empty()).then(|| {
            let names = self.schemas.iter().map(|schema| string(schema));
            format!("prepend apiSchemas = {}", array(names))
        });
        let metadata: Vec<&String> = schemas.iter().chain(&self.metadata).collect();
        let head = format!("def {} \"{}\"", self.kind, self.name);
        if metadata.is_empty() {
            line(&head);
        } else {
            line(&format!("{head} ("));
            metadata.iter().for_each(|one| line(&format!("    {one}")));
            line(")");
        }
        line("{");
        self.properties.iter().for_each(|property| line(&format!("    {property}")));
        for child in &self.children {
            child.write(text, depth + 1);
        }
        *text += &indent;
        *text += "}\n";
    }

    /// A file in which this prim is the only one, in metres and kilograms, with z up.
    pub fn file(&self, said: &[String]) -> String {
        let mut text = String::from("#usda 1.0\n(\n");
        text += &format!("    defaultPrim = {}\n", string(&self.name));
        if !said.is_empty() {
            text += &format!("    doc = {}\n", string(&said.join("\n")));
        }
        text += "    kilogramsPerUnit = 1\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n\n";
        self.write(&mut text, 0);
        text
    }
}

/// A binary32: the shortest text that denotes it.
pub(super) fn float(value: f64) -> String {
    let value = value as f32 + 0.0;
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}

/// A tuple of binary32.
pub(super) fn floats(values: &[f64]) -> String {
    tuple(values.iter().map(|value| float(*value)))
}

/// A tuple of binary64.
pub(super) fn doubles(values: &[f64]) -> String {
    tuple(values.iter().map(|value| number(*value)))
}

fn tuple(values: impl Iterator<Item = String>) -> String {
    format!("({})", values.collect::<Vec<_>>().join(", "))
}

/// The components of a rotation's canonical quaternion: w, x, y, z.
pub(super) fn wxyz(rotation: &UnitQuaternion<f64>) -> [f64; 4] {
    let q = canonical(rotation).into_inner();
    [q.w, q.i, q.j, q.k]
}

pub(super) fn array(values: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", values.into_iter().collect::<Vec<_>>().join(", "))
}

/// A string in quotes, on one line. Control characters are escaped.
pub(super) fn string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                quoted.push('\\');
                quoted.push(c);
            }
            '\n' => quoted += "\\n",
            '\t' => quoted += "\\t",
            // USD has escapes of bytes alone, and its text is UTF-8.
            _ if is_hidden(c) => {
                for byte in c.encode_utf8(&mut [0; 4]).bytes() {
                    let _ = write!(quoted, "\\x{byte:02x}");
                }
            }
            _ => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// A file, relative to the file that names it unless the path says otherwise.
pub(super) fn asset(path: &str) -> String {
    let here = if path.starts_with(['/', '.']) || path.contains(':') { "" } else { "./" };
    // Three delimiters where the path has one.
    let at = if path.contains('@') { "@@@" } else { "@" };
    format!("{at}{here}{path}{at}")
}

/// Adds elements of the source, each as it is written there.
pub(super) fn elements(prim: &mut Prim, elements: &[String]) {
    data(prim, elements, String::new());
}

/// Adds elements and named configurations: for each, the value of each DOF, rad or m.
pub(super) fn robot(subject: &Subject, prim: &mut Prim) -> Result<(), ExportError> {
    let dofs = subject.robot.dof_names()?;
    let one = |named: &NamedConfiguration| {
        let each = dofs.iter().zip(&named.configuration);
        let values =
            each.map(|(dof, value)| format!("double {} = {}", string(dof), number(*value)));
        format!(
            "dictionary {} = {{ {} }}",
            string(named.name.as_str()),
            values.collect::<Vec<_>>().join("; ")
        )
    };
    let named: Vec<String> = subject.robot.named_configurations()?.iter().map(one).collect();
    let named = match named.is_empty() {
        true => String::new(),
        false => format!("dictionary configurations = {{ {} }}; ", named.join("; ")),
    };
    data(prim, &subject.urdf.unknown_elements, named);
    Ok(())
}

fn data(prim: &mut Prim, elements: &[String], mut all: String) {
    if !elements.is_empty() {
        let texts = array(elements.iter().map(|text| string(text)));
        all += &format!("string[] elements = {texts}");
    }
    if !all.is_empty() {
        prim.describe("customData", &format!("{{ dictionary urdd = {{ {all} }} }}"));
    }
}

pub(super) struct Paths {
    /// The name of the default prim, which holds all others.
    pub root: String,
    pub links: Vec<String>,
    pub joints: Vec<String>,
    /// The names of what holds joints, and materials.
    pub scopes: [String; 2],
    /// What the joint to the world is called.
    pub world: String,
    /// The names beside joints that are taken.
    pub taken_joints: Taken,
    /// Names that are written in another way.
    pub mended: Vec<String>,
}

impl Paths {
    pub fn new(subject: &Subject) -> Self {
        let mut mended = Vec::new();
        let root = mend(&subject.urdf.name);
        if root != subject.urdf.name {
            mended.push(subject.urdf.name.clone());
        }
        let mut taken = Taken::default();
        if subject.layout.is_frame.contains(&true) {
            // Frames are beside what holds the shapes of their body.
            for holder in [COLLISIONS, VISUALS, VISUAL_PRIMITIVES] {
                taken.insert(holder);
            }
        }
        let links = names(&subject.links, &mut taken, &mut mended);
        let path = |(link, name): (usize, &String)| match subject.tree.parent_link[link] {
            Some(body) if subject.is_frame(link) => format!("/{root}/{}/{name}", links[body]),
            _ => format!("/{root}/{name}"),
        };
        let scopes = ["Joints", "Looks"].map(|scope| taken.free(scope.to_owned()));
        let mut taken = Taken::default();
        let joints = names(&subject.names.joints, &mut taken, &mut mended);
        let world = taken.free("world_fixed".to_owned());
        Paths {
            links: links.iter().enumerate().map(path).collect(),
            joints: joints.iter().map(|joint| format!("/{root}/{}/{joint}", scopes[0])).collect(),
            root,
            scopes,
            world,
            taken_joints: taken,
            mended,
        }
    }
}

/// What holds the shapes of a link.
pub(super) const COLLISIONS: &str = "collisions";

/// What holds the visual geometry of a link.
pub(super) const VISUALS: &str = "visuals";
/// What holds the primitives of visual geometry of a link.
pub(super) const VISUAL_PRIMITIVES: &str = "visual_primitives";

/// The path of a shape of a link.
pub(super) fn path_of_shape(link: &str, piece: usize) -> String {
    format!("{link}/{COLLISIONS}/piece_{piece}")
}

pub(crate) fn names_of_joints(joints: &[String]) -> Vec<String> {
    names(joints, &mut Taken::default(), &mut Vec::new())
}

/// The names of prims in one place, in order. A name that USD can have stays, so that another one with the same mended
/// name gets a number.
fn names(wanted: &[String], taken: &mut Taken, mended: &mut Vec<String>) -> Vec<String> {
    let is_kept = |name: &&String| mend(name) == **name;
    let kept: HashMap<&String, String> =
        wanted.iter().filter(is_kept).map(|name| (name, taken.free(name.clone()))).collect();
    let name = |name: &String| {
        kept.get(name).cloned().unwrap_or_else(|| {
            mended.push(name.clone());
            taken.free(mend(name))
        })
    };
    wanted.iter().map(name).collect()
}

/// The nearest name that a prim can have.
pub fn mend(name: &str) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let mut mended: String = name.chars().map(kept).collect();
    if mended.is_empty() || mended.starts_with(|c: char| c.is_ascii_digit()) {
        mended.insert(0, '_');
    }
    mended
}

/// Pairs that need no collision check: of two bodies, or, where a person keeps pairs of which the URDD checks some pieces,
/// of two of their shapes. MuJoCo, by which Newton simulates, has 32 bits for pairs of shapes, which do not suffice for
/// most robots; pairs of bodies it leaves out exactly.
///
/// The two bodies of a joint are not checked unless the joint says so: a joint whose links the URDD checks does.
#[derive(Default)]
pub(super) struct Filters {
    /// For the path of a link or a shape, those that it is not checked with.
    targets: BTreeMap<String, Vec<String>>,
    /// The joints whose links are checked with each other, at least in part.
    pub checked: HashSet<usize>,
}

impl Filters {
    pub fn new(subject: &Subject, paths: &Paths) -> Self {
        let mut filters = Filters::default();
        let joints = &subject.tree.joint_links;
        let joint = |links: [usize; 2]| {
            joints.iter().position(|&(parent, child)| ascending(parent, child) == links)
        };
        for pair in &subject.pairs {
            let joint = joint(pair.links);
            let [a, b] = pair.links.map(|link| &paths.links[link]);
            if pair.disabled {
                if joint.is_none() {
                    filters.add(a.clone(), b.clone());
                }
                continue;
            }
            filters.checked.extend(joint);
            for [one, other] in pair.mixed.iter().flat_map(|mixed| &mixed.skipped) {
                filters.add(path_of_shape(a, *one), path_of_shape(b, *other));
            }
        }
        filters
    }

    /// Says on the prim of a path what it is not checked with.
    pub fn apply(&self, path: &str, prim: &mut Prim) {
        if let Some(targets) = self.targets.get(path) {
            prim.apply("PhysicsFilteredPairsAPI");
            prim.relate("physics:filteredPairs", targets);
        }
    }

    fn add(&mut self, from: String, to: String) {
        self.targets.entry(from).or_default().push(to);
    }
}
