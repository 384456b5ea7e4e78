//! The meshes that it shows.

use super::ThreeReader;
use crate::mesh::ColladaFacts;
use crate::prelude::*;

impl<'t> ThreeReader<'_, 't> {
    pub(super) fn mesh(&mut self, mesh: Node<'t>, part: &Part) {
        let Some(name) = mesh.attribute("filename") else {
            return self.effects.drop(mesh, part, Fault::Missing("filename"));
        };
        if let Some(scale) = mesh.attribute("scale").filter(|scale| !scale.value.is_empty()) {
            self.vector(scale, scale.value.split_whitespace(), 3, part);
        }
        let packaged = name.value.starts_with("package://");
        let ending = name.value.rsplit('.').next().unwrap_or_default();
        let ending = ending.to_ascii_lowercase();
        let fault = match self.file.mesh(&as_path(&name.value)) {
            _ if !matches!(&*ending, "stl" | "dae") => FORMAT,
            _ if !packaged && (name.value.contains("://") || name.value.starts_with('/')) => {
                Fault::ForOthers("only `package://` names a file that is not beside the URDF")
            }
            Mesh::Missing => Fault::NotFound("mesh"),
            Mesh::Found(facts) if facts.begins_late() => BEGINS_LATE,
            Mesh::Found(facts) if !is_mesh(&facts, &ending) => {
                Fault::Mesh("the program cannot read the mesh")
            }
            _ => return,
        };
        self.effects.drop(name, part, fault);
    }

    /// A COLLADA mesh is not painted with the material of the visual.
    pub(super) fn own_colours(&mut self, visual: Node<'t>, form: Node<'t>, part: &Part) {
        let name = form.value("filename").unwrap_or_default().to_ascii_lowercase();
        if form.name().eq_ignore_ascii_case("mesh") && name.ends_with(".dae") {
            let part = part.inside("material");
            let fault = Fault::Way("a COLLADA mesh keeps its own colours");
            match visual.child("material") {
                Some(material) => self.effects.drop(material, part, fault),
                // There is none to lose: other meshes would be white.
                None => self.effects.read_as(form, part, fault, "the colours of the mesh"),
            }
        }
    }
}

/// The file of a name that is taken for a part of a URL.
fn as_path(name: &str) -> String {
    let mut bytes = Vec::with_capacity(name.len());
    let mut rest = name.replace('\\', "/").replace(['\n', '\t', '\r'], "").into_bytes().into_iter();
    while let Some(byte) = rest.next() {
        let hex = |byte: &u8| char::from(*byte).to_digit(16);
        let pair = rest.as_slice().get(..2).map(|pair| (hex(&pair[0]), hex(&pair[1])));
        match pair {
            Some((Some(high), Some(low))) if byte == b'%' => {
                bytes.push(u8::try_from(16 * high + low).unwrap_or_default());
                rest.nth(1);
            }
            _ => bytes.push(byte),
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Whether it reads a mesh.
fn is_mesh(facts: &MeshFacts, ending: &str) -> bool {
    if ending == "dae" {
        let shows = |collada: &ColladaFacts| collada.is_complete && collada.has_scene;
        return facts.collada.as_ref().is_some_and(shows);
    }
    let Some(count) = facts.stl.as_ref().and_then(|stl| stl.written) else { return false };
    let is_text = facts.head.starts_with(b"solid") && !facts.is_binary_stl();
    is_text || count.checked_mul(50).is_some_and(|size| size + 84 <= facts.size)
}
