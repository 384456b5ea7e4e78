//! A small tree of prims, and its text. What USD has no place for is custom data of a prim under `urdd`: named configurations,
//! and elements of the source that URDF does not define.

use std::fmt::Write;

use nalgebra::UnitQuaternion;

use crate::{ExportError, Subject};
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

/// An array.
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
