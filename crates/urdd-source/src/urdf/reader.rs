//! Builds the robot from the XML.

use std::collections::HashSet;
use std::ops::Range;

use urdd_format::short::Short;
use urdd_format::urdf as v1;
use urdd_format::urdf::{Joint, UrdfModule};
use urdd_xml::element::{self, Edit};
use urdd_xml::{Node, XmlError};

use crate::fault::{Fault, PlacedFault};
use crate::note::{NoteKind, Remark};
use crate::origin::{from_xyzw, has_quaternions};

/// Maximum number of links, and of joints: indices have 32 bits.
const MOST: usize = 10_000_000;

#[derive(Debug, Clone, Default)]
pub(super) struct JointPlace {
    pub joint: usize,
    pub parent: usize,
    pub child: usize,
    pub axis: usize,
    pub mimic: Range<usize>,
}

#[derive(Default)]
pub(super) struct UrdfReader {
    pub(super) reading: Reading,
    pub(super) faults: Vec<(usize, Fault)>,
    pub(super) link_places: Vec<usize>,
    pub(super) joint_places: Vec<JointPlace>,
    /// Every material with its byte offset.
    pub(super) materials: Vec<(usize, v1::Material)>,
    /// Byte offsets of attributes whose names are repaired.
    mended: HashSet<usize>,
}

impl UrdfReader {
    pub(super) fn fault(&mut self, offset: usize, fault: Fault) {
        self.faults.push((offset, fault));
    }

    pub(super) fn remark(
        &mut self,
        kind: NoteKind,
        offset: usize,
        problem: String,
        assumed: impl Into<String>,
    ) {
        self.reading.remarks.push(Remark { kind, offset, problem, assumed: assumed.into() });
    }

    pub(super) fn edit(&mut self, range: Range<usize>, text: impl Into<String>) {
        let text = text.into();
        self.reading.edits.push(Edit { range, text });
    }

    /// Removes an attribute and the white space before it from the text.
    fn remove_attribute(&mut self, element: Element<'_>, attribute: Range<usize>) {
        let text = element.document().input_text();
        let before = text[..attribute.start].trim_end().len();
        self.edit(before..attribute.end, "");
    }

    /// The first child element with this name; others are noted and ignored.
    pub(super) fn only<'a>(&mut self, parent: Element<'a>, name: &str) -> Option<Element<'a>> {
        let mut found = element::children(parent).filter(|(found, _)| *found == name);
        let (_, first) = found.next()?;
        for (_, again) in found {
            let problem = format!("another `<{name}>` in one `<{}>`", element::name(parent));
            self.remark(NoteKind::Repeated, again.range().start, problem, "the first is used");
        }
        Some(first)
    }

    /// An attribute. A name in another case is accepted and repaired.
    pub(super) fn attribute<'a>(
        &mut self,
        element: Element<'a>,
        name: &str,
    ) -> Option<urdd_xml::Attribute<'a, 'a>> {
        if let Some(found) = element::attribute(element, name) {
            return Some(found);
        }
        let mut others = element.attributes();
        let found = others
            .find(|other| other.namespace().is_none() && other.name().eq_ignore_ascii_case(name))?;
        let offset = found.range().start;
        // Some attributes are read twice.
        if self.mended.insert(offset) {
            let element = element::name(element);
            let problem = format!("`{}` of `<{element}>` is not spelled as in URDF", found.name());
            self.remark(NoteKind::Case, offset, problem, format!("read as `{name}`"));
            self.edit(found.range_qname(), name);
        }
        Some(found)
    }

    pub(super) fn text(&mut self, element: Element<'_>, attribute: &str) -> Option<String> {
        self.attribute(element, attribute).map(|found| found.value().to_owned())
    }

    pub(super) fn needed(
        &mut self,
        element: Element<'_>,
        name: &'static str,
        attribute: &'static str,
    ) -> Option<String> {
        let text = self.text(element, attribute);
        if text.is_none() {
            let fault = Fault::MissingAttribute { element: name, attribute };
            self.fault(element.range().start, fault);
        }
        text
    }

    /// An attribute of `N` numbers. A malformed one counts as absent and is removed from the text. One with a
    /// non-finite number counts as absent too (SPEC 6.1.8).
    pub(super) fn vector<const N: usize>(
        &mut self,
        element: Element<'_>,
        attribute: &str,
    ) -> Option<[f64; N]> {
        let found = self.attribute(element, attribute)?;
        let what = || {
            let element = element::name(element);
            format!("`{attribute}` of `<{element}>` is `{}`", Short::of(found.value()))
        };
        match parse(found.value()) {
            Numbers::Finite(numbers) => Some(numbers),
            Numbers::NotFinite => {
                let problem = format!("{}, which is not finite", what());
                let assumed = absent(element::name(element), attribute);
                self.remark(NoteKind::NotFinite, found.range().start, problem, assumed);
                None
            }
            Numbers::Wrong => {
                let problem = format!("{}, but should be {}", what(), wanted(N));
                if let Some(numbers) = completed::<N>(attribute, found.value()) {
                    let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
                    let text = words.join(" ");
                    let assumed = format!("read as `{text}`");
                    self.remark(NoteKind::Numbers, found.range().start, problem, assumed);
                    self.edit(found.range_value(), text);
                    return Some(numbers);
                }
                let assumed = absent(element::name(element), attribute);
                self.remark(NoteKind::Numbers, found.range().start, problem, assumed);
                self.remove_attribute(element, found.range());
                None
            }
        }
    }

    pub(super) fn number(&mut self, element: Element<'_>, attribute: &str) -> Option<f64> {
        self.vector::<1>(element, attribute).map(|[number]| number)
    }

    /// The source text of elements that URDF does not define.
    pub(super) fn unknown(&mut self, parent: Element<'_>, known: &[&str]) -> Vec<String> {
        let mut unknown = Vec::new();
        for (name, element) in element::children(parent) {
            if known.contains(&name) {
                continue;
            }
            if name.starts_with("xacro:") {
                self.reading.has_xacro = true;
                let problem = format!("`<{name}>` is a macro that was not expanded");
                let assumed = "kept as text, without effect";
                self.remark(NoteKind::XacroLeftOver, element.range().start, problem, assumed);
            }
            let lower = name.to_ascii_lowercase();
            if known.contains(&lower.as_str()) {
                let problem = format!("`<{name}>` is not an element of URDF, but `<{lower}>` is");
                let assumed = "kept as text, without effect";
                self.remark(NoteKind::Case, element.range().start, problem, assumed);
            }
            unknown.push(element.document().input_text()[element.range()].to_owned());
        }
        unknown
    }

    pub(super) fn robot(&mut self, robot: Element<'_>, file_stem: &str) {
        let offset = robot.range().start;
        let name = element::name(robot);
        if name != "robot" {
            self.fault(offset, Fault::NotRobot(Short::of(name)));
            return;
        }
        let name = self.text(robot, "name").unwrap_or_else(|| {
            let problem = "`<robot>` has no name".to_owned();
            let assumed = format!("named `{file_stem}`, after the file");
            self.remark(NoteKind::RobotName, offset, problem, assumed);
            let start = offset + "<robot".len();
            self.edit(start..start, format!(" name=\"{}\"", escaped(file_stem)));
            file_stem.to_owned()
        });
        self.reading.robot.name = name;
        self.reading.robot.version = self.text(robot, "version");
        self.reading.robot.unknown_elements = self.unknown(robot, &["link", "joint", "material"]);
        for (name, element) in element::children(robot) {
            match name {
                "link" => {
                    if let Some(link) = self.link(element) {
                        self.reading.robot.links.push(link);
                        self.link_places.push(element.range().start);
                    }
                }
                "joint" => self.joint(element),
                "material" => {
                    let material = self.material(element);
                    self.reading.robot.materials.push(material);
                }
                _ => {}
            }
        }
        let robot = &self.reading.robot;
        if robot.links.len() > MOST || robot.joints.len() > MOST {
            self.fault(offset, Fault::TooMany(MOST as u32));
        }
    }

    pub(super) fn origin(&mut self, parent: Element<'_>) -> Option<v1::Origin> {
        let origin = self.only(parent, "origin")?;
        let read = v1::Origin {
            xyz: self.vector(origin, "xyz"),
            rpy: self.vector(origin, "rpy"),
            quat_xyzw: self.vector(origin, "quat_xyzw"),
        };
        let offset = origin.range().start;
        let both = self.attribute(origin, "rpy").is_some()
            && self.attribute(origin, "quat_xyzw").is_some();
        if !has_quaternions(self.reading.robot.version.as_deref()) {
            if read.quat_xyzw.is_some() {
                let problem = "`quat_xyzw` of `<origin>` needs URDF 1.1, but this version is older";
                let assumed =
                    "kept, without effect; to use it, write `version=\"1.1\"` on `<robot>`";
                self.remark(NoteKind::Numbers, offset, problem.to_owned(), assumed);
            }
        } else if both {
            self.fault(offset, Fault::TwoRotations);
        } else if read.quat_xyzw.is_some_and(|xyzw| from_xyzw(xyzw).is_none()) {
            let problem = "`quat_xyzw` of `<origin>` has length 0".to_owned();
            self.remark(NoteKind::Numbers, offset, problem, "treated as no rotation");
        }
        Some(read)
    }
}

/// Parses numbers in a nonstandard form with only one meaning: commas between all of them; one scale factor for all
/// axes; a colour without alpha, which is opaque.
fn completed<const N: usize>(attribute: &str, text: &str) -> Option<[f64; N]> {
    let between_commas = || {
        let words = text.split(',').map(|word| word.trim().parse().ok());
        words.collect::<Option<Vec<f64>>>()
    };
    let mut numbers = words(text).or_else(between_commas)?;
    match (attribute, numbers.len()) {
        ("scale", 1) => numbers = vec![numbers[0]; 3],
        ("rgba", 3) => numbers.push(1.0),
        _ => {}
    }
    let all_finite = numbers.iter().all(|x| x.is_finite());
    <[f64; N]>::try_from(numbers).ok().filter(|_| all_finite)
}

/// The effect of an absent attribute.
fn absent(element: &str, attribute: &str) -> String {
    let means = match (element, attribute) {
        ("origin", "xyz" | "rpy") => "0 0 0",
        ("axis", "xyz") => "1 0 0",
        ("mesh", "scale") => "1 1 1",
        ("mimic", "multiplier") => "1",
        ("mimic", "offset") => "0",
        ("limit", "lower" | "upper") => "0 beside another limit",
        _ => return "treated as absent".to_owned(),
    };
    format!("treated as absent, which means {means}")
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('"', "&quot;")
}

/// The result of reading a URDF.
#[derive(Debug, Default)]
pub struct Reading {
    /// The robot.
    pub robot: UrdfModule,
    /// The link tree; valid if there are no faults.
    pub tree: Tree,
    /// Deviations, in the order of the text.
    pub remarks: Vec<Remark>,
    /// Edits that repair the text where it differs from what was read.
    pub edits: Vec<Edit>,
    /// Byte offset of each mesh element: links ascending, visual before collision, elements ascending.
    pub mesh_offsets: Vec<usize>,
    /// Whether there are xacro elements.
    pub has_xacro: bool,
}

/// The kinematic tree, by link and joint indices.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tree {
    /// The root link.
    pub root: usize,
    /// For each joint, its parent link and child link.
    pub ends: Vec<[usize; 2]>,
    /// For each joint, the joint that it mimics.
    pub drivers: Vec<Option<usize>>,
}

/// The axis of SPEC 5.7, not normalised.
pub fn written_axis(joint: &Joint) -> [f64; 3] {
    let axis = joint.axis.as_ref().and_then(|axis| axis.xyz);
    axis.unwrap_or([1.0, 0.0, 0.0])
}

/// The result of parsing an attribute of `N` numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Numbers<const N: usize> {
    /// `N` finite numbers.
    Finite([f64; N]),
    /// `N` numbers, at least one of them infinite or NaN.
    NotFinite,
    /// Anything else.
    Wrong,
}

/// The words of an attribute as numbers; `None` if one is not a number.
pub(super) fn words(text: &str) -> Option<Vec<f64>> {
    text.split_ascii_whitespace().map(|word| word.parse().ok()).collect()
}

pub(super) fn parse<const N: usize>(text: &str) -> Numbers<N> {
    match words(text).and_then(|words| <[f64; N]>::try_from(words).ok()) {
        Some(numbers) if numbers.iter().all(|x| x.is_finite()) => Numbers::Finite(numbers),
        Some(_) => Numbers::NotFinite,
        None => Numbers::Wrong,
    }
}

/// What an attribute of `count` numbers should be.
pub(super) fn wanted(count: usize) -> String {
    match count {
        1 => "one number".to_owned(),
        _ => format!("{count} numbers with white space between them"),
    }
}

/// The numbers of a parent's only element of a name, each in the attribute of its field's name.
macro_rules! element_of_numbers {
    ($reader:ident, $parent:expr, $element:literal, $type:ident { $($field:ident),* }) => {
        $reader.only($parent, $element).map(|element| v1::$type {
            $($field: $reader.number(element, stringify!($field)),)*
        })
    };
}

pub(super) use element_of_numbers;

pub(super) type Element<'a> = Node<'a, 'a>;

/// A parser error as a fault with its position.
pub(super) fn fault(error: &XmlError, text: &str) -> PlacedFault {
    let at = error.pos();
    let fault = match error {
        XmlError::Entities(_) => Fault::Entities,
        _ => Fault::NotXml(error.sentence(text)),
    };
    PlacedFault { file: None, line: at.row, column: at.col, fault }
}
