//! What programs look at in a mesh file.

pub mod formats;

use std::sync::Arc;

use self::formats::{ColladaFacts, Measures, ObjFacts, StlFacts};
use crate::fault::{BEGINS_LATE, FORMAT, Fault, HAS_MORE, RARE_FORMAT};

/// A mesh file that a URDF names.
#[derive(Debug, Clone)]
pub enum Mesh {
    /// Not known. It is taken to be right.
    Unknown,
    /// Its package is not here.
    NoPackage,
    /// There is no such file.
    Missing,
    /// It is there.
    Found(Arc<MeshFacts>),
}

/// What is in a mesh file. Its size and its first bytes say more than the name does: a file may have a wrong ending.
#[derive(Debug, Clone, Default)]
pub struct MeshFacts {
    /// Its first bytes, at most 200.
    pub head: Vec<u8>,
    /// Its size, bytes.
    pub size: usize,
    /// How many triangles the file has, by its format's rules; 0 also if it cannot be read.
    pub triangles: usize,
    /// Of an STL file, by its ending or content.
    pub stl: Option<StlFacts>,
    /// Of an OBJ file, by its ending or content.
    pub obj: Option<ObjFacts>,
    /// Of a COLLADA file, by its ending or content; none also if it is not well-formed.
    pub collada: Option<ColladaFacts>,
    /// Of an STL or OBJ file.
    pub measures: Measures,
}

/// A format of meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// Of STL; both kinds.
    Stl,
    /// Wavefront OBJ.
    Obj,
    /// COLLADA, `.dae`.
    Collada,
    /// Stanford PLY.
    Ply,
    /// glTF as JSON.
    Gltf,
    /// glTF as one binary file.
    Glb,
}

impl MeshFacts {
    /// Reads a file. `name` is the one that the URDF gives it.
    pub fn of(name: &str, bytes: &[u8]) -> MeshFacts {
        const HEAD: usize = 200;
        let head: Vec<u8> = bytes.iter().take(HEAD).copied().collect();
        let mut facts = MeshFacts { head, size: bytes.len(), ..MeshFacts::default() };
        match by_ending(name).or_else(|| facts.content()) {
            Some(Format::Stl) => {
                let (stl, measures) = formats::stl(bytes);
                facts.triangles = stl.binary.unwrap_or(stl.corners / 3);
                (facts.stl, facts.measures) = (Some(stl), measures);
            }
            Some(Format::Obj) => {
                let (obj, measures) = formats::obj(bytes);
                facts.triangles = obj.triangles;
                (facts.obj, facts.measures) = (Some(obj), measures);
            }
            Some(Format::Collada) => {
                facts.collada = formats::collada(bytes);
                facts.triangles = facts.collada.as_ref().map_or(0, |collada| collada.triangles);
            }
            _ => {}
        }
        facts
    }

    /// The format that the first bytes look like, whatever the file's name is.
    pub fn content(&self) -> Option<Format> {
        const OBJ: [&[u8]; 6] = [b"v ", b"vn ", b"vt ", b"mtllib ", b"o ", b"g "];
        let has = |mark: &[u8]| self.head.windows(mark.len()).any(|window| window == mark);
        if self.is_binary_stl() || self.head.starts_with(b"solid") {
            Some(Format::Stl)
        } else if self.head.starts_with(b"ply") {
            Some(Format::Ply)
        } else if self.head.starts_with(b"glTF") {
            Some(Format::Glb)
        } else if has(b"<COLLADA") {
            Some(Format::Collada)
        } else if self.head.trim_ascii_start().starts_with(b"{") {
            Some(Format::Gltf)
        } else {
            let mut lines = self.head.split(|&byte| byte == b'\n');
            lines.any(|line| OBJ.iter().any(|mark| line.starts_with(mark))).then_some(Format::Obj)
        }
    }

    /// Why it is a COLLADA file that lenient readers of XML alone take.
    pub fn leniency(&self) -> Option<Fault> {
        let collada = self.collada.as_ref()?;
        match collada {
            _ if collada.begins_late => Some(BEGINS_LATE),
            _ if collada.has_more => Some(HAS_MORE),
            _ => None,
        }
    }

    /// Whether neither its ending nor its content is that of STL, OBJ or COLLADA.
    pub fn is_of_no_format(&self) -> bool {
        self.stl.is_none() && self.obj.is_none() && self.collada.is_none()
    }

    /// Whether it is as long as a binary STL file of its number of triangles.
    pub fn is_binary_stl(&self) -> bool {
        let count = formats::written_count(&self.head).and_then(|count| count.checked_mul(50));
        count.is_some_and(|body| self.size.checked_sub(84) == Some(body))
    }
}

/// Why a program does not read the format of a name. Some formats are for others, and some for hardly any program.
pub fn format_fault(name: &str) -> Fault {
    const KNOWN: [&str; 7] = ["stl", "obj", "dae", "gltf", "glb", "msh", "vtk"];
    let file = name.trim().rsplit('/').next().unwrap_or_default();
    let ending = file.rsplit_once('.').map_or("", |(_, ending)| ending);
    match KNOWN.iter().any(|known| known.eq_ignore_ascii_case(ending)) {
        true => FORMAT,
        false => RARE_FORMAT,
    }
}

/// The format that a name's ending says, in any case.
fn by_ending(name: &str) -> Option<Format> {
    let (_, ending) = name.rsplit_once('.')?;
    match &*ending.to_ascii_lowercase() {
        "stl" => Some(Format::Stl),
        "obj" => Some(Format::Obj),
        "dae" => Some(Format::Collada),
        "ply" => Some(Format::Ply),
        "gltf" => Some(Format::Gltf),
        "glb" => Some(Format::Glb),
        _ => None,
    }
}
