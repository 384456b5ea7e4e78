//! Meshes of collisions: binary STL and OBJ.

use super::link::Solid;
use super::reader::{MujocoReader, Release};
use crate::prelude::*;

/// The most triangles of an STL file.
const MAX_TRIANGLES: usize = 200_000;
const MAX_COORDINATE: f64 = (1 << 30) as f64;
const LEAST_VOLUME: f64 = 1e-15;

impl MujocoReader<'_> {
    pub fn mesh(&mut self, shape: Node<'_>, part: &Part) -> Reading<Solid> {
        let filename = self.effects.needed(shape, "filename")?;
        let scale = self.scale(shape)?;
        let name = &*filename.value;
        if name.is_empty() {
            return self.effects.refuse(filename, Fault::Empty("filename"));
        }
        let strips = self.settings.strips_paths.unwrap_or(self.release == Release::Three);
        if name.contains("://") && !strips {
            let why = "MuJoCo takes `scheme://` as a folder; write a path from the URDF's folder";
            return self.effects.refuse(filename, Fault::ForOthers(why));
        }
        if !self.has_known_ending(name) {
            return self.effects.refuse(filename, FORMAT);
        }
        let facts = match self.found(filename, part, strips) {
            Mesh::Unknown => return Ok(Solid::cuboid(1e-3, [0.1; 3])),
            Mesh::Missing => return self.missing(filename),
            Mesh::Found(facts) => facts,
        };
        let volume = facts.measures.volume * scale.iter().product::<f64>().abs();
        if let Some(why) = bad(&facts, volume, self.release) {
            return self.effects.refuse(filename, Fault::Mesh(why));
        }
        let size = [0, 1, 2].map(|axis| facts.measures.size[axis] * scale[axis]);
        // Without triangles the convex hull counts.
        let volume = match facts.triangles {
            0 => size.iter().product::<f64>().abs() / 6.0,
            _ => volume,
        };
        Ok(Solid::cuboid(volume, size))
    }

    fn missing<T>(&mut self, filename: &Attribute<'_>) -> Reading<T> {
        let is_moved = !self.settings.mesh_folder.is_empty()
            && matches!(self.file.mesh(&filename.value), Mesh::Found(_));
        let what = if is_moved { "mesh, in the folder of MuJoCo's `meshdir`," } else { "mesh" };
        self.effects.refuse(filename, Fault::NotFound(what))
    }

    /// Whether a name ends as those of formats that it reads.
    fn has_known_ending(&self, name: &str) -> bool {
        let ending = last(name).rsplit_once('.').map_or("", |(_, ending)| ending);
        match self.release {
            Release::Four => ["stl", "STL", "obj", "OBJ", "msh"].contains(&ending),
            Release::Three => {
                ["stl", "obj", "msh"].iter().any(|known| ending.eq_ignore_ascii_case(known))
            }
        }
    }

    /// The file of a mesh. Where names lose their folders, a person has put the file beside the URDF.
    fn found(&mut self, filename: &Attribute<'_>, part: &Part, strips: bool) -> Mesh {
        let name = &*filename.value;
        let folder = &self.settings.mesh_folder;
        let within = |name: &str| match folder.is_empty() || name.starts_with('/') {
            true => self.file.mesh(name),
            false => self.file.mesh(&format!("{}/{name}", folder.trim_end_matches('/'))),
        };
        if !strips {
            return within(&name.replace('\\', "/"));
        }
        let beside = within(last(name));
        if !matches!(beside, Mesh::Missing) {
            return beside;
        }
        let there = match folder.is_empty() {
            true => self.file.mesh(name),
            false => Mesh::Missing,
        };
        if !matches!(there, Mesh::Missing) {
            let why = "the mesh is looked for beside the URDF, and its folders do not count";
            self.effects.read_as(filename, part, Fault::ForOthers(why), last(name));
        }
        there
    }
}

/// What is behind the last slash.
fn last(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// Why a mesh is refused.
fn bad(facts: &MeshFacts, volume: f64, release: Release) -> Option<&'static str> {
    let measures = &facts.measures;
    if let Some(stl) = &facts.stl {
        match stl.binary {
            None => return Some("the mesh is no binary STL file"),
            Some(0) => return Some("the mesh has no triangle"),
            Some(count) if count > MAX_TRIANGLES => {
                return Some("the mesh has more than 200,000 triangles");
            }
            _ if measures.largest > MAX_COORDINATE => {
                return Some("the mesh has coordinates that are too large");
            }
            _ => {}
        }
    } else if let Some(obj) = &facts.obj {
        if obj.has_bad_index {
            return Some("the mesh has a face with a vertex that is not there");
        }
        if obj.lacks_normals && release == Release::Four {
            return Some("some faces of the mesh have normals, and others none");
        }
    } else {
        return Some("the mesh cannot be read");
    }
    if measures.has_infinite {
        Some("the mesh has a coordinate that is not finite")
    } else if measures.points < 4 {
        Some("the mesh has fewer than 4 vertices")
    } else if measures.spread[2] <= 1e-14 * measures.largest {
        Some("all vertices of the mesh are in one plane")
    } else if facts.triangles > 0 && volume < LEAST_VOLUME {
        Some("the volume of the mesh is too small")
    } else {
        None
    }
}
