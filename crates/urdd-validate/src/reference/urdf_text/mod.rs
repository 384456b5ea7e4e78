//! The carried URDF, read by a small reader of the validator's own, as the data of `urdf_module`.
//!
//! It reads the XML literally, so that missing values differ from zeros, and every value has its place in the file. It
//! does not fill in, drop or repair values, as a URDF library would. Elements have their names as written: one with a
//! prefix (`xacro:link`) is not a URDF name, whatever the prefix means; a default namespace changes no name.

pub mod compare;
mod reading;

pub use compare::as_legacy;
pub use reading::{Fault, Problem, Reading, Repeated, numbers};

use urdd_document::pose::has_quaternions;
use urdd_format::urdf as v1;
use urdd_xml::{Node, Xml, element};

type Element<'a> = Node<'a, 'a>;

pub fn read(text: &str) -> Reading {
    of(&Xml::new(text))
}

/// The same, of a text that others read too.
pub fn of(xml: &Xml<'_>) -> Reading {
    let mut reader = UrdfReader::default();
    match xml.document() {
        Ok(document) => reader.robot(document.root_element()),
        Err(error) => reader.reading.problems.push(reading::not_xml(error, xml.text())),
    }
    let mut reading = reader.reading;
    reading.problems.sort_by_key(|problem| problem.offset);
    reading
}

fn elements<'a>(parent: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    parent.children().filter(Node::is_element)
}

/// The data of the only element of a name, whose attributes are numbers, each with its attribute's name.
macro_rules! numbers {
    ($reader:ident, $parent:ident, $at:ident, $name:literal, $data:ident { $($number:ident),+ }) => {
        $reader.only($parent, $name, $at).map(|(element, at)| {
            v1::$data { $($number: $reader.number(element, stringify!($number), &at)),+ }
        })
    };
}

const LINK_ELEMENTS: &[&str] = &["inertial", "visual", "collision"];
const SHAPES: &[&str] = &["mesh", "box", "cylinder", "capsule", "sphere"];
const JOINT_ELEMENTS: &[&str] = &[
    "origin",
    "parent",
    "child",
    "axis",
    "limit",
    "dynamics",
    "mimic",
    "safety_controller",
    "calibration",
];

#[derive(Default)]
struct UrdfReader {
    reading: Reading,
    /// Whether `quat_xyzw` counts.
    quaternions: bool,
}

impl UrdfReader {
    fn problem(&mut self, offset: usize, fault: Fault, actual: Option<&str>) {
        self.reading.problems.push(Problem { offset, fault, actual: actual.map(str::to_owned) });
    }

    fn place(&mut self, pointer: &str, offset: usize) {
        self.reading.places.insert(pointer.to_owned(), offset);
    }

    /// The first element with a name; a further one is ignored and recorded.
    fn only<'a>(
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
    fn first<'a>(&mut self, parent: Element<'a>, names: &[&str]) -> Option<Element<'a>> {
        let mut found = elements(parent).filter(|child| names.contains(&element::name(*child)));
        let first = found.next()?;
        for again in found {
            self.reading.repeated.push(Repeated {
                range: again.range(),
                first: first.range().start,
                element: element::name(again).to_owned(),
                parent: element::name(parent).to_owned(),
            });
        }
        Some(first)
    }

    /// The pointer of the next element of a list, which is recorded.
    fn next_of(&mut self, list: &str, index: usize, element: Element<'_>) -> String {
        let pointer = format!("{list}/{index}");
        self.place(&pointer, element.range().start);
        pointer
    }

    fn text(&mut self, element: Element<'_>, attribute: &str, at: &str) -> Option<String> {
        let found = element::attribute(element, attribute)?;
        self.place(&format!("{at}/{attribute}"), found.range().start);
        Some(found.value().to_owned())
    }

    fn needed_text(
        &mut self,
        element: Element<'_>,
        attribute: &'static str,
        at: &str,
    ) -> Option<String> {
        let text = self.text(element, attribute, at);
        if text.is_none() {
            let fault =
                Fault::MissingAttribute { element: element::name(element).to_owned(), attribute };
            self.problem(element.range().start, fault, None);
        }
        text
    }

    /// An attribute of `N` numbers; null if it is missing or one of them is not finite.
    fn vector<const N: usize>(
        &mut self,
        element: Element<'_>,
        attribute: &'static str,
        at: &str,
    ) -> Option<[f64; N]> {
        let text = self.text(element, attribute, at)?;
        let vector = numbers(&text);
        if vector.is_none() {
            let place = element::attribute(element, attribute)?.range().start;
            let element = element::name(element).to_owned();
            self.problem(place, Fault::NotNumbers { element, attribute, count: N }, Some(&text));
        }
        vector.filter(|vector| vector.iter().all(|x| x.is_finite()))
    }

    fn number(&mut self, element: Element<'_>, attribute: &'static str, at: &str) -> Option<f64> {
        self.vector::<1>(element, attribute, at).map(|[number]| number)
    }

    /// Like [`UrdfReader::vector`], for a required attribute of a shape.
    fn size<const N: usize>(
        &mut self,
        element: Element<'_>,
        attribute: &'static str,
        at: &str,
    ) -> Option<[f64; N]> {
        let problems = self.reading.problems.len();
        let vector = self.vector(element, attribute, at);
        if vector.is_none() && self.reading.problems.len() == problems {
            let text = element::attribute(element, attribute).map(|found| found.value());
            let (start, element) = (element.range().start, element::name(element).to_owned());
            let fault = match text {
                Some(_) => Fault::NotFinite { element, attribute },
                None => Fault::MissingAttribute { element, attribute },
            };
            self.problem(start, fault, text);
        }
        vector
    }

    fn unknown(&mut self, parent: Element<'_>, known: &[&str], at: &str) -> Vec<String> {
        let document = parent.document().input_text();
        let unknown = elements(parent).filter(|child| !known.contains(&element::name(*child)));
        let keep = |(index, element)| {
            self.next_of(&format!("{at}/unknown_elements"), index, element);
            document.get(element.range()).unwrap_or_default().to_owned()
        };
        unknown.enumerate().map(keep).collect()
    }

    fn robot(&mut self, robot: Element<'_>) {
        self.place("", robot.range().start);
        if element::name(robot) != "robot" {
            let found = format!("<{}>", element::name(robot));
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
        for element in elements(robot) {
            match element::name(element) {
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

    fn origin(&mut self, parent: Element<'_>, at: &str) -> Option<v1::Origin> {
        let (origin, at) = self.only(parent, "origin", at)?;
        let quaternion = element::attribute(origin, "quat_xyzw");
        if let (Some(quaternion), Some(_), true) =
            (quaternion, element::attribute(origin, "rpy"), self.quaternions)
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

    fn link(&mut self, link: Element<'_>, at: &str) -> Option<v1::Link> {
        let name = self.needed_text(link, "name", at);
        let inertial =
            self.only(link, "inertial", at).map(|(inertial, at)| self.inertial(inertial, &at));
        let mut visual = Vec::new();
        let mut collision = Vec::new();
        for element in elements(link) {
            match element::name(element) {
                "visual" => {
                    let at = self.next_of(&format!("{at}/visual"), visual.len(), element);
                    visual.push(v1::Visual {
                        name: self.text(element, "name", &at),
                        origin: self.origin(element, &at),
                        geometry: self.geometry(element, &at),
                        material: self
                            .only(element, "material", &at)
                            .map(|(material, at)| self.material(material, &at)),
                    });
                }
                "collision" => {
                    let at = self.next_of(&format!("{at}/collision"), collision.len(), element);
                    collision.push(v1::Collision {
                        name: self.text(element, "name", &at),
                        origin: self.origin(element, &at),
                        geometry: self.geometry(element, &at),
                    });
                }
                _ => {}
            }
        }
        let unknown_elements = self.unknown(link, LINK_ELEMENTS, at);
        Some(v1::Link { name: name?, inertial, visual, collision, unknown_elements })
    }

    fn inertial(&mut self, inertial: Element<'_>, at: &str) -> v1::Inertial {
        let origin = self.origin(inertial, at);
        // A mass without a value means the same as no mass.
        let mass = self
            .only(inertial, "mass", at)
            .and_then(|(mass, at)| self.number(mass, "value", &at))
            .map(|value| v1::Mass { value });
        let inertia = numbers! {
            self, inertial, at, "inertia", Inertia { ixx, ixy, ixz, iyy, iyz, izz }
        };
        v1::Inertial { origin, mass, inertia }
    }

    fn geometry(&mut self, parent: Element<'_>, at: &str) -> Option<v1::Geometry> {
        let (geometry, at) = self.only(parent, "geometry", at)?;
        let shape = self.first(geometry, SHAPES)?;
        let at = |kind: &str| format!("{at}/{kind}");
        Some(match element::name(shape) {
            "mesh" => {
                let filename = self.needed_text(shape, "filename", &at("Mesh"));
                let scale = self.vector(shape, "scale", &at("Mesh"));
                v1::Geometry::Mesh(v1::Mesh { filename: filename?, scale })
            }
            "box" => v1::Geometry::Box(v1::Cuboid { size: self.size(shape, "size", &at("Box"))? }),
            "cylinder" => {
                let (radius, length) = self.round(shape, &at("Cylinder"))?;
                v1::Geometry::Cylinder(v1::Cylinder { radius, length })
            }
            "capsule" => {
                let (radius, length) = self.round(shape, &at("Capsule"))?;
                v1::Geometry::Capsule(v1::Capsule { radius, length })
            }
            _ => {
                let [radius] = self.size(shape, "radius", &at("Sphere"))?;
                v1::Geometry::Sphere(v1::Sphere { radius })
            }
        })
    }

    fn round(&mut self, shape: Element<'_>, at: &str) -> Option<(f64, f64)> {
        let radius = self.size(shape, "radius", at);
        let length = self.size(shape, "length", at);
        let ([radius], [length]) = (radius?, length?);
        Some((radius, length))
    }

    fn material(&mut self, material: Element<'_>, at: &str) -> v1::Material {
        // A colour without numbers, or a texture without a file, means nothing (as in iCub).
        v1::Material {
            name: self.text(material, "name", at),
            color: self
                .only(material, "color", at)
                .and_then(|(color, at)| self.vector(color, "rgba", &at))
                .map(|rgba| v1::Color { rgba }),
            texture: self
                .only(material, "texture", at)
                .and_then(|(texture, at)| self.text(texture, "filename", &at))
                .map(|filename| v1::Texture { filename }),
        }
    }

    fn joint(&mut self, joint: Element<'_>, at: &str) -> Option<v1::Joint> {
        let name = self.needed_text(joint, "name", at);
        let joint_type = self.joint_type(joint, at);
        let origin = self.origin(joint, at);
        let parent = self.joint_link(joint, "parent", at);
        let child = self.joint_link(joint, "child", at);
        // The rest is read first: all its faults are reported, also those of a joint without a name.
        Some(v1::Joint {
            origin,
            axis: self
                .only(joint, "axis", at)
                .map(|(axis, at)| v1::Axis { xyz: self.vector(axis, "xyz", &at) }),
            limit: numbers! {
                self, joint, at, "limit",
                Limit { lower, upper, effort, velocity, acceleration, deceleration, jerk }
            },
            dynamics: numbers!(self, joint, at, "dynamics", Dynamics { damping, friction }),
            mimic: self.only(joint, "mimic", at).and_then(|(mimic, at)| self.mimic(mimic, &at)),
            safety_controller: numbers! {
                self, joint, at, "safety_controller",
                SafetyController { soft_lower_limit, soft_upper_limit, k_position, k_velocity }
            },
            calibration: numbers!(self, joint, at, "calibration", Calibration { rising, falling }),
            unknown_elements: self.unknown(joint, JOINT_ELEMENTS, at),
            name: name?,
            joint_type: joint_type?,
            parent: parent?,
            child: child?,
        })
    }

    fn joint_type(&mut self, joint: Element<'_>, at: &str) -> Option<v1::JointType> {
        let word = self.needed_text(joint, "type", at)?;
        let mut types = v1::JointType::ALL.iter().copied();
        let found = types.find(|kind| kind.as_str().to_ascii_lowercase() == word);
        let attribute = element::attribute(joint, "type")?.range().start;
        self.place(&format!("{at}/joint_type"), attribute);
        if found.is_none() {
            self.problem(attribute, Fault::UnknownJointType, Some(&word));
        }
        found
    }

    fn joint_link(
        &mut self,
        joint: Element<'_>,
        name: &'static str,
        at: &str,
    ) -> Option<v1::LinkName> {
        let Some((element, at)) = self.only(joint, name, at) else {
            let fault = Fault::MissingElement { element: name, parent: "joint" };
            let joint_name = element::attribute(joint, "name").map(|name| name.value());
            self.problem(joint.range().start, fault, joint_name);
            return None;
        };
        Some(v1::LinkName { link: self.needed_text(element, "link", &at)? })
    }

    fn mimic(&mut self, mimic: Element<'_>, at: &str) -> Option<v1::Mimic> {
        let joint = self.needed_text(mimic, "joint", at);
        let multiplier = self.number(mimic, "multiplier", at);
        let offset = self.number(mimic, "offset", at);
        Some(v1::Mimic { joint: joint?, multiplier, offset })
    }
}
