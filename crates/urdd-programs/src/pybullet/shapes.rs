//! How PyBullet reads visuals and collisions.

use super::{PybulletReader, atof, is_defined, pieces, rgba};
use crate::look::is_same;
use crate::prelude::*;

/// In how many folders above the file it looks for a mesh; they are all in truth.
const FOLDERS: usize = 8;

impl PybulletReader<'_> {
    pub(super) fn shape(&mut self, shape: Node<'_>, part: &Part) -> Reading<()> {
        self.pose(shape, part);
        let geometry = self.effects.needed_element(shape, "geometry")?;
        let Some(form) = geometry.children().next() else {
            return self.effects.refuse(geometry, NO_SHAPE);
        };
        let needed: &[&'static str] = match form.name() {
            "sphere" => &["radius"],
            "box" => &["size"],
            "cylinder" | "capsule" => &["radius", "length"],
            "plane" => &["normal"],
            "mesh" | "cdf" => &["filename"],
            other => return self.effects.refuse(form, Fault::Shape(other.into())),
        };
        for &name in needed {
            let value = self.effects.needed(form, name)?;
            match name {
                "size" => self.vector(value, part),
                "radius" | "length" => self.number(value, part),
                "filename" => self.mesh(form, value, part)?,
                _ => {}
            }
        }
        let material = shape.child("material").filter(|_| shape.name() == "visual");
        let Some(material) = material else { return Ok(()) };
        let name = &*self.effects.needed(material, "name")?.value;
        let part = part.inside("material");
        self.material(material, &part);
        let Some((first, last)) = self.materials.get(name) else {
            if !name.is_empty() {
                self.effects.drop(material, part, Fault::unknown("material", name));
            }
            return Ok(());
        };
        let own = if is_defined(material) { rgba(material) } else { first };
        if !is_same(own, last) {
            // All of a name have the last colour.
            self.effects.read_as(material, part, Fault::not_unique("material", name), last);
        }
        Ok(())
    }

    fn mesh(&mut self, mesh: Node<'_>, filename: &Attribute<'_>, part: &Part) -> Reading<()> {
        if let Some(scale) = mesh.attribute("scale") {
            match pieces(&scale.value).len() {
                0..3 => {
                    let one = atof(&scale.value);
                    let read = format!("{one} {one} {one}");
                    self.effects.read_as(scale, part, Fault::count(scale, 3), read);
                }
                _ => self.vector(scale, part),
            }
        }
        let name = &*filename.value;
        let end = name.len().checked_sub(4).and_then(|at| name.get(at..)).unwrap_or("");
        let end = end.to_ascii_lowercase();
        if name.len() <= 4 || ![".dae", ".stl", ".obj", ".cdf", ".vtk"].contains(&&*end) {
            return self.effects.refuse(filename, FORMAT);
        }
        let fault = match self.found(name) {
            Mesh::Unknown => return Ok(()),
            Mesh::Missing if matches!(self.file.mesh(name), Mesh::Found(_)) => {
                let why =
                    "its package is in no folder above the file, and only there the program looks";
                Fault::ForOthers(why)
            }
            Mesh::Missing => Fault::NotFound("mesh"),
            Mesh::Found(facts) => return self.content(filename, &end, &facts, part),
        };
        self.effects.refuse(filename, fault)
    }

    /// A mesh by its path, without scheme, in the folder of the file and in those above.
    fn found(&self, name: &str) -> Mesh {
        let path = name.strip_prefix("file://").unwrap_or(name);
        let in_package = ["package://", "model://"].iter().find_map(|one| path.strip_prefix(one));
        let path = in_package.unwrap_or(path);
        if path.contains("://") {
            return Mesh::Missing;
        }
        // The root is one of these folders.
        let absolute = path.starts_with('/').then(|| self.file.mesh(path));
        let path = path.trim_start_matches('/');
        let places = (0..FOLDERS).map(|up| self.file.mesh(&format!("{}{path}", "../".repeat(up))));
        let found = absolute.into_iter().chain(places).find(|mesh| !matches!(mesh, Mesh::Missing));
        match (found, in_package.map(|_| self.file.mesh(name))) {
            (Some(mesh), _) | (None, Some(mesh @ Mesh::Unknown)) => mesh,
            _ => Mesh::Missing,
        }
    }

    /// What is wrong in a mesh file loses the mesh.
    fn content(
        &mut self,
        filename: &Attribute<'_>,
        end: &str,
        facts: &MeshFacts,
        part: &Part,
    ) -> Reading<()> {
        let why = match (end, &facts.stl, &facts.obj, &facts.collada) {
            (".stl", Some(stl), ..) if stl.binary.is_some_and(|count| count > 0) => return Ok(()),
            (".stl", ..) => "the mesh is no binary STL file with triangles",
            (".obj", _, Some(obj), _) if obj.triangles > 0 && !obj.has_bad_index => return Ok(()),
            (".obj", ..) => "the mesh is no OBJ file with triangles of its vertices",
            (".dae", .., Some(collada)) if !collada.is_complete => {
                let why = "the mesh has no `<asset>` or no `<library_geometries>`";
                return self.effects.crash(filename, Fault::Mesh(why));
            }
            (".dae", .., Some(collada)) if collada.triangles > 0 && collada.has_scene => {
                return Ok(());
            }
            (".dae", ..) => "the mesh is no COLLADA file with a scene of triangles",
            _ => {
                let fault = Fault::ForOthers("the format is not for meshes of links");
                self.effects.drop(filename, part, fault);
                return Ok(());
            }
        };
        self.effects.drop(filename, part, Fault::Mesh(why));
        Ok(())
    }
}
