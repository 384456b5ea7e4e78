//! Links, their geometry and materials, and joints.

use urdd_format::short::Short;
use urdd_format::urdf as v1;
use urdd_xml::element;

use super::reader::{Element, JointPlace, UrdfReader, element_of_numbers};
use crate::fault::Fault;
use crate::note::NoteKind;

const SHAPES: &[&str] = &["mesh", "box", "cylinder", "capsule", "sphere"];

impl UrdfReader {
    pub(super) fn link(&mut self, link: Element<'_>) -> Option<v1::Link> {
        let name = self.needed(link, "link", "name");
        let inertial = self.only(link, "inertial").map(|inertial| self.inertial(inertial));
        let unknown_elements = self.unknown(link, &["inertial", "visual", "collision"]);
        // Visual before collision: the order in which meshes are counted.
        let of = |kind| element::children(link).filter(move |(name, _)| *name == kind);
        let visual = of("visual")
            .map(|(_, element)| v1::Visual {
                name: self.text(element, "name"),
                origin: self.origin(element),
                geometry: self.geometry(element),
                material: self.only(element, "material").map(|material| self.material(material)),
            })
            .collect();
        let collision = of("collision")
            .map(|(_, element)| v1::Collision {
                name: self.text(element, "name"),
                origin: self.origin(element),
                geometry: self.geometry(element),
            })
            .collect();
        Some(v1::Link { name: name?, inertial, visual, collision, unknown_elements })
    }

    fn inertial(&mut self, inertial: Element<'_>) -> v1::Inertial {
        v1::Inertial {
            origin: self.origin(inertial),
            mass: self
                .only(inertial, "mass")
                .and_then(|mass| self.number(mass, "value"))
                .map(|value| v1::Mass { value }),
            inertia: element_of_numbers!(
                self,
                inertial,
                "inertia",
                Inertia { ixx, ixy, ixz, iyy, iyz, izz }
            ),
        }
    }

    /// The first valid shape. An incomplete shape is removed from the text, and the next one is used.
    fn geometry(&mut self, parent: Element<'_>) -> Option<v1::Geometry> {
        let geometry = self.only(parent, "geometry")?;
        let mut found = None;
        for (name, shape) in element::children(geometry).filter(|(name, _)| SHAPES.contains(name)) {
            if found.is_some() {
                let problem = format!("another shape, `<{name}>`, in one `<geometry>`");
                self.remark(NoteKind::Repeated, shape.range().start, problem, "the first is used");
                continue;
            }
            found = self.shape(name, shape);
            if found.is_none() {
                self.edit(shape.range(), "");
            }
        }
        found
    }

    fn shape(&mut self, name: &str, shape: Element<'_>) -> Option<v1::Geometry> {
        match name {
            "mesh" => {
                let Some(filename) = self.text(shape, "filename") else {
                    self.no_shape(shape, "filename");
                    return None;
                };
                self.reading.mesh_offsets.push(shape.range().start);
                let scale = self.vector(shape, "scale");
                Some(v1::Geometry::Mesh(v1::Mesh { filename, scale }))
            }
            "box" => Some(v1::Geometry::Box(v1::Cuboid { size: self.size(shape, "size")? })),
            "cylinder" | "capsule" => {
                let ([radius], [length]) =
                    (self.size(shape, "radius")?, self.size(shape, "length")?);
                Some(if name == "cylinder" {
                    v1::Geometry::Cylinder(v1::Cylinder { radius, length })
                } else {
                    v1::Geometry::Capsule(v1::Capsule { radius, length })
                })
            }
            _ => {
                let [radius] = self.size(shape, "radius")?;
                Some(v1::Geometry::Sphere(v1::Sphere { radius }))
            }
        }
    }

    /// A required size attribute.
    fn size<const N: usize>(&mut self, shape: Element<'_>, attribute: &str) -> Option<[f64; N]> {
        // The whole shape is removed, so edits of its attributes are dropped.
        let (edits, remarks) = (self.reading.edits.len(), self.reading.remarks.len());
        let size = self.vector(shape, attribute);
        if size.is_none() {
            self.reading.edits.truncate(edits);
            match self.reading.remarks.get_mut(remarks) {
                Some(remark) => {
                    remark.kind = NoteKind::Shape;
                    remark.assumed = "the shape is left out".to_owned();
                }
                None => self.no_shape(shape, attribute),
            }
        }
        size
    }

    fn no_shape(&mut self, shape: Element<'_>, attribute: &str) {
        let problem = format!("`<{}>` has no `{attribute}`", element::name(shape));
        self.remark(NoteKind::Shape, shape.range().start, problem, "the shape is left out");
    }

    pub(super) fn material(&mut self, material: Element<'_>) -> v1::Material {
        let read = v1::Material {
            name: self.text(material, "name"),
            color: self
                .only(material, "color")
                .and_then(|color| self.vector(color, "rgba"))
                .map(|rgba| v1::Color { rgba }),
            texture: self
                .only(material, "texture")
                .and_then(|texture| self.text(texture, "filename"))
                .map(|filename| v1::Texture { filename }),
        };
        self.materials.push((material.range().start, read.clone()));
        read
    }
}

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

impl UrdfReader {
    /// Reads a joint and adds it to the robot.
    pub(super) fn joint(&mut self, joint: Element<'_>) {
        let at = joint.range().start;
        let mut place = JointPlace { joint: at, ..JointPlace::default() };
        let name = self.needed(joint, "joint", "name");
        let shown = name.as_deref().unwrap_or("?");
        let joint_type = self.joint_type(joint, shown);
        let parent = self.end(joint, shown, "parent", &mut place.parent);
        let child = self.end(joint, shown, "child", &mut place.child);
        let origin = self.origin(joint);
        let axis = self.only(joint, "axis").map(|axis| {
            place.axis = axis.range().start;
            v1::Axis { xyz: self.vector(axis, "xyz") }
        });
        let limit = element_of_numbers!(
            self,
            joint,
            "limit",
            Limit { lower, upper, effort, velocity, acceleration, deceleration, jerk }
        );
        let dynamics = element_of_numbers!(self, joint, "dynamics", Dynamics { damping, friction });
        let mimic = self.only(joint, "mimic").and_then(|mimic| {
            place.mimic = mimic.range();
            self.mimic(mimic, shown)
        });
        let safety_controller = element_of_numbers!(
            self,
            joint,
            "safety_controller",
            SafetyController { soft_lower_limit, soft_upper_limit, k_position, k_velocity }
        );
        let calibration =
            element_of_numbers!(self, joint, "calibration", Calibration { rising, falling });
        let unknown_elements = self.unknown(joint, JOINT_ELEMENTS);
        let (Some(name), Some(joint_type), Some(parent), Some(child)) =
            (name, joint_type, parent, child)
        else {
            return;
        };
        self.joint_places.push(place);
        self.reading.robot.joints.push(v1::Joint {
            name,
            joint_type,
            origin,
            parent,
            child,
            axis,
            limit,
            dynamics,
            mimic,
            safety_controller,
            calibration,
            unknown_elements,
        });
    }

    fn joint_type(&mut self, joint: Element<'_>, name: &str) -> Option<v1::JointType> {
        let word = self.needed(joint, "joint", "type")?;
        let plain = word.trim().to_ascii_lowercase();
        let mut kinds = v1::JointType::ALL.iter().copied();
        let found = kinds.find(|kind| kind.as_str().to_ascii_lowercase() == plain);
        let attribute = self.attribute(joint, "type")?;
        match found {
            None => {
                let fault = Fault::UnknownJointType { joint: name.into(), found: Short::of(&word) };
                self.fault(attribute.range().start, fault);
            }
            Some(_) if plain != word => {
                let problem =
                    format!("the joint type `{}` is not spelled as in URDF", Short::of(&word));
                let assumed = format!("read as `{plain}`");
                self.remark(NoteKind::JointType, attribute.range().start, problem, assumed);
                self.edit(attribute.range_value(), plain);
            }
            Some(_) => {}
        }
        found
    }

    /// The parent or child link.
    fn end(
        &mut self,
        joint: Element<'_>,
        shown: &str,
        end: &'static str,
        place: &mut usize,
    ) -> Option<v1::LinkName> {
        let Some(element) = self.only(joint, end) else {
            let fault = Fault::MissingElement { joint: shown.into(), element: end };
            self.fault(joint.range().start, fault);
            return None;
        };
        *place = element.range().start;
        let link = self.needed(element, end, "link")?;
        Some(v1::LinkName { link })
    }

    fn mimic(&mut self, mimic: Element<'_>, shown: &str) -> Option<v1::Mimic> {
        let Some(joint) = self.text(mimic, "joint") else {
            let problem = format!("the mimic of joint `{shown}` names no joint");
            self.remark(NoteKind::Mimic, mimic.range().start, problem, "the mimic is left out");
            self.edit(mimic.range(), "");
            return None;
        };
        Some(v1::Mimic {
            joint,
            multiplier: self.number(mimic, "multiplier"),
            offset: self.number(mimic, "offset"),
        })
    }
}
