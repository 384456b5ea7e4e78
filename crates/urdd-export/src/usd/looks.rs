//! Visual geometry: a mesh for each link, with a subset of faces for each of its colours and textures.
//!
//! What is long or is there several times has a file of its own, with its materials. Links share it as an instance.

use std::collections::HashMap;

use super::names::{VISUAL_PRIMITIVES, VISUALS};
use super::prim::{Prim, array, asset, float};
use super::surface::{coordinates, material, primitive, set};
use crate::meshes::{Look, Looks};
use crate::names::last;
use crate::{MeshFiles, Painted};
use urdd_geometry::Mesh;

/// The longest mesh that is in the file itself, bytes of text.
pub(super) const LONGEST: usize = 1 << 15;

/// Materials in one place, each once.
pub(super) struct Materials {
    path: String,
    pub scope: Prim,
    names: HashMap<String, String>,
}

impl Materials {
    pub fn new(above: &str, name: &str) -> Self {
        let path = format!("{above}/{name}");
        Materials { path, scope: Prim::new("Scope", name), names: HashMap::new() }
    }

    /// Adds what all shapes are made of, and returns its path.
    pub fn contact(&mut self, friction: f64) -> String {
        let mut material = Prim::new("Material", "contact").applying(&["PhysicsMaterialAPI"]);
        material.set("float physics:staticFriction", float(friction));
        material.set("float physics:dynamicFriction", float(friction));
        self.scope.push(material);
        format!("{}/contact", self.path)
    }

    /// The path of the material of a look; `None` if it has neither colour nor texture.
    fn of(&mut self, color: Option<[f64; 4]>, texture: Option<&str>) -> Option<String> {
        if texture.is_none() && color.is_none() {
            return None;
        }
        let color = color.unwrap_or([1.0; 4]);
        let key = format!("{texture:?} {color:?}");
        let count = self.names.len();
        let name = self.names.entry(key).or_insert_with(|| {
            let kind = if texture.is_some() { "texture" } else { "colour" };
            let name = format!("{kind}_{count}");
            let path = format!("{}/{name}", self.path);
            self.scope.push(material(&path, &name, color, texture));
            name
        });
        Some(format!("{}/{name}", self.path))
    }
}

/// Adds the visual geometry to the links, in link order.
pub(super) fn add(
    all: &Looks,
    links: &mut [Prim],
    materials: &mut Materials,
    files: &mut MeshFiles,
) {
    let looks = &all.meshes;
    let mut texts = Vec::new();
    let mut count: HashMap<String, usize> = HashMap::new();
    let mut images = Vec::new();
    for (link, looks) in looks.iter().enumerate() {
        let names = files.add_images(link, looks);
        let text = if looks.is_empty() {
            String::new()
        } else {
            let mut own = Materials::new(&format!("/{VISUALS}"), "Looks");
            // Textures are beside the file.
            let beside = |path: &String| last(path).to_owned();
            let names: Vec<_> = names.iter().map(|name| name.as_ref().map(beside)).collect();
            let mut prim = visuals(looks, &names, &mut own);
            prim.push_filled(own.scope);
            prim.file(&[])
        };
        *count.entry(text.clone()).or_default() += 1;
        texts.push(text);
        images.push(names);
    }
    for (link, (looks, text)) in looks.iter().zip(texts).enumerate() {
        if looks.is_empty() {
            continue;
        }
        if text.len() > LONGEST || count[&text] > 1 {
            let path = files.add_text(link, VISUALS, text);
            let mut prim = Prim::new("Xform", VISUALS);
            prim.describe("instanceable", "true");
            prim.describe("prepend payload", &asset(&path));
            links[link].push(prim);
        } else {
            links[link].push(visuals(looks, &images[link], materials));
        }
    }
    add_primitives(&all.primitives, links, materials);
}

/// Adds the primitives of visual geometry, in link order.
fn add_primitives(primitives: &[Vec<Painted>], links: &mut [Prim], materials: &mut Materials) {
    for (own, link) in primitives.iter().zip(links) {
        let mut holder = Prim::new("Xform", VISUAL_PRIMITIVES);
        for (place, of) in own.iter().enumerate() {
            let mut prim = primitive(format!("primitive_{place}"), &of.pose, of.primitive);
            if let Some(material) = materials.of(of.color, None) {
                prim.bind("material:binding", &material);
            }
            holder.push(prim);
        }
        link.push_filled(holder);
    }
}

/// The mesh of a link's looks.
fn visuals(looks: &[Look], images: &[Option<String>], materials: &mut Materials) -> Prim {
    let mut mesh = Mesh::default();
    let mut uv = Vec::new();
    let mut subsets = Vec::new();
    for (place, (look, image)) in looks.iter().zip(images).enumerate() {
        let first = mesh.triangles.len();
        mesh.append(&look.part.mesh);
        if images.iter().any(Option::is_some) {
            uv.extend(coordinates(look.part.texture.as_ref(), look.part.mesh.vertices.len()));
        }
        let texture = image.as_ref().map(|path| asset(path));
        let Some(material) = materials.of(look.part.color, texture.as_deref()) else {
            continue;
        };
        let mut subset = Prim::new("GeomSubset", format!("subset_{place}"));
        subset.set("uniform token elementType", "\"face\"");
        subset.set("uniform token familyName", "\"materialBind\"");
        let faces = first..mesh.triangles.len();
        subset.set("int[] indices", array(faces.map(|face| face.to_string())));
        subset.bind("material:binding", &material);
        subsets.push((material, subset));
    }
    let mut prim = Prim::new("Mesh", "mesh");
    set(&mut prim, &mesh, &uv);
    prim.set("uniform bool doubleSided", "1");
    if let ([(material, _)], 1) = (&subsets[..], looks.len()) {
        prim.bind("material:binding", material);
    } else if !subsets.is_empty() {
        prim.set("uniform token subsetFamily:materialBind:familyType", "\"nonOverlapping\"");
        subsets.into_iter().for_each(|(_, subset)| prim.push(subset));
    }
    Prim::new("Xform", VISUALS).holding(prim)
}
