//! Links, their geometry and materials.

use super::reader::{Element, UrdfReader, numbers};
use super::xml;
use urdd_format::urdf as v1;

const LINK_ELEMENTS: &[&str] = &["inertial", "visual", "collision"];
const SHAPES: &[&str] = &["mesh", "box", "cylinder", "capsule", "sphere"];

impl UrdfReader {
    pub(super) fn link(&mut self, link: Element<'_>, at: &str) -> Option<v1::Link> {
        let name = self.needed_text(link, "name", at);
        let inertial =
            self.only(link, "inertial", at).map(|(inertial, at)| self.inertial(inertial, &at));
        let mut visual = Vec::new();
        let mut collision = Vec::new();
        for element in xml::elements(link) {
            match xml::name(element) {
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
        let inertia = self
            .only(inertial, "inertia", at)
            .map(|inertia| numbers!(self, inertia, Inertia { ixx, ixy, ixz, iyy, iyz, izz }));
        v1::Inertial { origin, mass, inertia }
    }

    fn geometry(&mut self, parent: Element<'_>, at: &str) -> Option<v1::Geometry> {
        let (geometry, at) = self.only(parent, "geometry", at)?;
        let shape = self.first(geometry, SHAPES)?;
        match xml::name(shape) {
            "mesh" => {
                let at = format!("{at}/Mesh");
                let filename = self.needed_text(shape, "filename", &at);
                let scale = self.vector(shape, "scale", &at);
                Some(v1::Geometry::Mesh(v1::Mesh { filename: filename?, scale }))
            }
            "box" => {
                let size = self.size(shape, "size", &format!("{at}/Box"))?;
                Some(v1::Geometry::Box(v1::Cuboid { size }))
            }
            "cylinder" => {
                let (radius, length) = self.round(shape, &format!("{at}/Cylinder"))?;
                Some(v1::Geometry::Cylinder(v1::Cylinder { radius, length }))
            }
            "capsule" => {
                let (radius, length) = self.round(shape, &format!("{at}/Capsule"))?;
                Some(v1::Geometry::Capsule(v1::Capsule { radius, length }))
            }
            "sphere" => {
                let [radius] = self.size(shape, "radius", &format!("{at}/Sphere"))?;
                Some(v1::Geometry::Sphere(v1::Sphere { radius }))
            }
            _ => None,
        }
    }

    /// Radius and length.
    fn round(&mut self, shape: Element<'_>, at: &str) -> Option<(f64, f64)> {
        let radius = self.size(shape, "radius", at);
        let length = self.size(shape, "length", at);
        let ([radius], [length]) = (radius?, length?);
        Some((radius, length))
    }

    pub(super) fn material(&mut self, material: Element<'_>, at: &str) -> v1::Material {
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
}
