//! Links, their geometry and materials.

use super::numbers::element_of_numbers;
use super::reader::UrdfReader;
use super::xml::{self, Element};
use crate::note::NoteKind;
use urdd_format::urdf as v1;

const SHAPES: &[&str] = &["mesh", "box", "cylinder", "capsule", "sphere"];

impl UrdfReader {
    pub(super) fn link(&mut self, link: Element<'_>) -> Option<v1::Link> {
        let name = self.needed(link, "link", "name");
        let inertial = self.only(link, "inertial").map(|inertial| self.inertial(inertial));
        let unknown_elements = self.unknown(link, &["inertial", "visual", "collision"]);
        // Visual before collision: the order in which meshes are counted.
        let of = |kind| xml::children(link).filter(move |(name, _)| *name == kind);
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
        for (name, shape) in xml::children(geometry).filter(|(name, _)| SHAPES.contains(name)) {
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
        let problem = format!("`<{}>` has no `{attribute}`", xml::name(shape));
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
