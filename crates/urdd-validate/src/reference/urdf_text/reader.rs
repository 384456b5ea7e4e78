//! Converts the XML tree to the data of `urdf_module`.

use urdd_xml::{Document, Node};

use super::reading::{Fault, Problem, Reading, Repeated};
use super::xml;
use urdd_document::pose::has_quaternions;
use urdd_format::urdf as v1;

pub(super) type Element<'a> = Node<'a, 'a>;

pub(super) fn read(document: &Document<'_>) -> Reading {
    let mut reader = UrdfReader::default();
    reader.robot(document.root_element());
    let mut reading = reader.reading;
    reading.problems.sort_by_key(|problem| problem.offset);
    reading
}

/// The data of an element whose attributes are numbers, each with its attribute's name.
macro_rules! numbers {
    ($reader:expr, $found:expr, $data:ident { $($number:ident),+ }) => {{
        let (element, at) = $found;
        v1::$data { $($number: $reader.number(element, stringify!($number), &at)),+ }
    }};
}
pub(super) use numbers;

#[derive(Default)]
pub(super) struct UrdfReader {
    pub(super) reading: Reading,
    /// Whether `quat_xyzw` counts.
    quaternions: bool,
}

impl UrdfReader {
    pub(super) fn problem(&mut self, offset: usize, fault: Fault, actual: Option<&str>) {
        self.reading.problems.push(Problem { offset, fault, actual: actual.map(str::to_owned) });
    }

    pub(super) fn place(&mut self, pointer: &str, offset: usize) {
        self.reading.places.insert(pointer.to_owned(), offset);
    }

    /// The first element with a name; a further one is ignored and recorded.
    pub(super) fn only<'a>(
        &mut self,
        parent: Element<'a>,
        name: &'static str,
        at: &str,
    ) -> Option<(Element<'a>, String)> {
        let first = self.first(parent, &[name])?;
        let pointer = format!("{at}/{name}");
        self.place(&pointer, first.range().start);
        Some((first, pointer))
    }

    /// The first element with one of the names; further ones are ignored and recorded.
    pub(super) fn first<'a>(&mut self, parent: Element<'a>, names: &[&str]) -> Option<Element<'a>> {
        let mut found = xml::elements(parent).filter(|child| names.contains(&xml::name(*child)));
        let first = found.next()?;
        for again in found {
            self.reading.repeated.push(Repeated {
                range: again.range(),
                first: first.range().start,
                element: xml::name(again).to_owned(),
                parent: xml::name(parent).to_owned(),
            });
        }
        Some(first)
    }

    /// The pointer of the next element of a list, which is recorded.
    pub(super) fn next_of(&mut self, list: &str, index: usize, element: Element<'_>) -> String {
        let pointer = format!("{list}/{index}");
        self.place(&pointer, element.range().start);
        pointer
    }

    pub(super) fn text(
        &mut self,
        element: Element<'_>,
        attribute: &str,
        at: &str,
    ) -> Option<String> {
        let found = xml::attribute(element, attribute)?;
        self.place(&format!("{at}/{attribute}"), found.range().start);
        Some(found.value().to_owned())
    }

    pub(super) fn needed_text(
        &mut self,
        element: Element<'_>,
        attribute: &'static str,
        at: &str,
    ) -> Option<String> {
        let text = self.text(element, attribute, at);
        if text.is_none() {
            let fault =
                Fault::MissingAttribute { element: xml::name(element).to_owned(), attribute };
            self.problem(element.range().start, fault, None);
        }
        text
    }

    /// An attribute of `N` numbers; null if it is missing or one of them is not finite.
    pub(super) fn vector<const N: usize>(
        &mut self,
        element: Element<'_>,
        attribute: &'static str,
        at: &str,
    ) -> Option<[f64; N]> {
        let text = self.text(element, attribute, at)?;
        match xml::numbers(&text) {
            Some(vector) => vector.iter().all(|x| x.is_finite()).then_some(vector),
            None => {
                let offset = xml::attribute(element, attribute)
                    .map_or(element.range().start, |found| found.range().start);
                let element = xml::name(element).to_owned();
                self.problem(
                    offset,
                    Fault::NotNumbers { element, attribute, count: N },
                    Some(&text),
                );
                None
            }
        }
    }

    pub(super) fn number(
        &mut self,
        element: Element<'_>,
        attribute: &'static str,
        at: &str,
    ) -> Option<f64> {
        self.vector::<1>(element, attribute, at).map(|[number]| number)
    }

    /// Like [`UrdfReader::vector`], for a required attribute of a shape.
    pub(super) fn size<const N: usize>(
        &mut self,
        element: Element<'_>,
        attribute: &'static str,
        at: &str,
    ) -> Option<[f64; N]> {
        let problems = self.reading.problems.len();
        let vector = self.vector(element, attribute, at);
        if vector.is_none() && self.reading.problems.len() == problems {
            let text = xml::attribute(element, attribute).map(|found| found.value());
            let (start, element) = (element.range().start, xml::name(element).to_owned());
            let fault = match text {
                Some(_) => Fault::NotFinite { element, attribute },
                None => Fault::MissingAttribute { element, attribute },
            };
            self.problem(start, fault, text);
        }
        vector
    }

    pub(super) fn unknown(&mut self, parent: Element<'_>, known: &[&str], at: &str) -> Vec<String> {
        let unknown = xml::elements(parent).filter(|child| !known.contains(&xml::name(*child)));
        let keep = |(index, element)| {
            self.next_of(&format!("{at}/unknown_elements"), index, element);
            xml::verbatim(element)
        };
        unknown.enumerate().map(keep).collect()
    }

    pub(super) fn robot(&mut self, robot: Element<'_>) {
        self.place("", robot.range().start);
        if xml::name(robot) != "robot" {
            let found = format!("<{}>", xml::name(robot));
            self.problem(robot.range().start, Fault::NotRobot, Some(&found));
            return;
        }
        let mut module = v1::UrdfModule {
            name: self.needed_text(robot, "name", "").unwrap_or_default(),
            version: self.text(robot, "version", ""),
            links: Vec::new(),
            joints: Vec::new(),
            materials: Vec::new(),
            unknown_elements: self.unknown(robot, &["link", "joint", "material"], ""),
        };
        self.quaternions = has_quaternions(module.version.as_deref());
        for element in xml::elements(robot) {
            match xml::name(element) {
                "link" => {
                    let at = self.next_of("/links", module.links.len(), element);
                    module.links.extend(self.link(element, &at));
                }
                "joint" => {
                    let at = self.next_of("/joints", module.joints.len(), element);
                    module.joints.extend(self.joint(element, &at));
                }
                "material" => {
                    let at = self.next_of("/materials", module.materials.len(), element);
                    module.materials.push(self.material(element, &at));
                }
                _ => {}
            }
        }
        self.reading.robot = Some(module);
    }

    pub(super) fn origin(&mut self, parent: Element<'_>, at: &str) -> Option<v1::Origin> {
        let (origin, at) = self.only(parent, "origin", at)?;
        let quaternion = xml::attribute(origin, "quat_xyzw");
        if let (Some(quaternion), Some(_), true) =
            (quaternion, xml::attribute(origin, "rpy"), self.quaternions)
        {
            let place = quaternion.range().start;
            self.problem(place, Fault::TwoRotations, Some(quaternion.value()));
        }
        Some(v1::Origin {
            xyz: self.vector(origin, "xyz", &at),
            rpy: self.vector(origin, "rpy", &at),
            quat_xyzw: self.vector(origin, "quat_xyzw", &at),
        })
    }
}
