//! What a robot looks like by its URDF, for a URDD without plain meshes.

use std::collections::{BTreeMap, HashMap};

use super::Robot;
use super::error::RobotError;
use super::mesh::{LinkVisual, read};
use super::source_elements::{Place, paths};
use urdd_document::robot::Element;
use urdd_document::urdd::Urdd;
use urdd_format::colors::Colors;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::{ModuleKind, Profile};
use urdd_format::urdf::Geometry;
use urdd_geometry::mesh::placement;
use urdd_geometry::primitives;
use urdd_geometry::read::{GltfUp, Part};

/// Maximum number of triangles: elements may name one large mesh many times. Those beyond are left out.
const MAX_TRIANGLES: usize = 1_000_000;

impl Robot {
    /// The URDF's visual elements of each link in its frame, or its collision elements if it has no visual shape.
    /// Meshes are those that the URDD carries. What cannot be read is left out.
    ///
    /// # Errors
    /// If `urdf_module` is missing or unusable.
    #[doc(hidden)]
    pub fn source_visuals(&self) -> Result<Vec<LinkVisual>, RobotError> {
        let part = self.part_as_it_is(&[ModuleKind::Urdf, ModuleKind::OriginalMeshes])?;
        let urdf = self.description()?;
        let colors = Colors::of(&urdf);
        let mut carried = Carried { urdd: &part, paths: paths(&part), read: HashMap::new() };
        let mut room = MAX_TRIANGLES;
        let mut visuals = Vec::new();
        let links = part.robot().map_or(&[][..], |robot| &robot.links);
        for (link, of) in links.iter().enumerate() {
            let has_visual = of.visual.iter().any(|element| element.geometry.is_some());
            let kind = if has_visual { GeometryKind::Visual } else { GeometryKind::Collision };
            let mut parts = Vec::new();
            for (index, element) in of.elements(kind).iter().enumerate() {
                let own = urdf.links.get(link).filter(|_| has_visual);
                let material = own.and_then(|link| link.visual.get(index)?.material.as_ref());
                let mesh = carried.of((link, kind, index));
                // It is not copied to be left out.
                if triangles(mesh) > room {
                    continue;
                }
                let added = placed(element, mesh, colors.get(material));
                let Some(left) = room.checked_sub(triangles(&added)) else { continue };
                room = left;
                parts.extend(added);
            }
            visuals.push(LinkVisual { link, parts });
        }
        Ok(visuals)
    }
}

fn triangles(parts: &[Part]) -> usize {
    parts.iter().map(|part| part.mesh.triangles.len()).sum()
}

/// The parts of an element in the link's frame. `mesh` is the one that it names.
fn placed(element: &Element, mesh: &[Part], color: Option<[f64; 4]>) -> Vec<Part> {
    let mut scale = [1.0; 3];
    let mut parts: Vec<Part> = match &element.geometry {
        None => return Vec::new(),
        Some(Geometry::Box(of)) => vec![primitives::cuboid(of.size).into()],
        Some(Geometry::Cylinder(of)) => vec![primitives::cylinder(of.radius, of.length).into()],
        Some(Geometry::Capsule(of)) => vec![primitives::capsule(of.radius, of.length).into()],
        Some(Geometry::Sphere(of)) => vec![primitives::sphere(of.radius).into()],
        Some(Geometry::Mesh(of)) => {
            scale = of.scale.unwrap_or(scale);
            mesh.to_vec()
        }
    };
    let rotation = element.origin.rotation();
    let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| rotation[(row, column)]));
    for part in &mut parts {
        part.mesh.transform(&placement(scale, rows, element.origin.xyz));
        part.color = part.color.or(color);
    }
    parts
}

/// The meshes that the URDF names, of those that the URDD carries. Each file is read once.
struct Carried<'a> {
    urdd: &'a Urdd,
    paths: BTreeMap<Place, &'a str>,
    read: HashMap<&'a str, Vec<Part>>,
}

impl<'a> Carried<'a> {
    /// The mesh of an element; nothing if it names none, or one that cannot be read.
    fn of(&mut self, place: Place) -> &[Part] {
        let Some(&path) = self.paths.get(&place) else { return &[] };
        self.read.entry(path).or_insert_with(|| {
            let scene = read(self.urdd, Profile::V1, path, GltfUp::Turn);
            scene.map(|scene| scene.parts).unwrap_or_default()
        })
    }
}
