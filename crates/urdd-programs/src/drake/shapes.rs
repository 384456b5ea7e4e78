//! How Drake reads visuals and collisions.

use std::sync::Arc;

use super::DrakeReader;
use crate::prelude::*;

/// The shapes in the order in which Drake looks for them, and their sizes.
const SHAPES: [(&str, &[&str]); 7] = [
    ("box", &["size"]),
    ("sphere", &["radius"]),
    ("cylinder", &["radius", "length"]),
    ("capsule", &["radius", "length"]),
    ("drake:capsule", &["radius", "length"]),
    ("mesh", &[]),
    ("drake:ellipsoid", &["a", "b", "c"]),
];

impl DrakeReader<'_> {
    pub(super) fn shape(&mut self, shape: Node<'_>, part: &Part) -> Reading<()> {
        let geometry = self.effects.needed_element(shape, "geometry")?;
        self.pose(shape, part)?;
        let known = SHAPES.iter().find_map(|(name, sizes)| Some((geometry.child(name)?, *sizes)));
        let Some((form, sizes)) = known else {
            return self.effects.shapeless(geometry);
        };
        for name in sizes {
            let value = self.effects.needed(form, name)?;
            let count = if *name == "size" { 3 } else { 1 };
            let numbers = self.numbers(value, count, part)?;
            let may_be_zero = form.name() == "sphere";
            if numbers.iter().any(|&size| size < 0.0 || (size == 0.0 && !may_be_zero)) {
                return self.effects.refuse(value, Fault::range(value, "a size must be above 0"));
            }
        }
        if shape.name() == "visual" {
            self.color(shape, &part.inside("material"))?;
        }
        if let Some(name) = shape.attribute("name")
            && name.value.trim_matches(is_space).is_empty()
        {
            return self.effects.refuse(name, Fault::Empty("name"));
        }
        match form.name() {
            "mesh" => self.mesh(form, part, shape.name() == "collision"),
            _ => Ok(()),
        }
    }

    fn color(&mut self, visual: Node<'_>, part: &Part) -> Reading<()> {
        let Some(material) = self.first(visual, "material", part) else { return Ok(()) };
        let Some((at, rgba)) = self.material(material, false)? else { return Ok(()) };
        if rgba.iter().all(|number| (0.0..=1.0).contains(number)) {
            return Ok(());
        }
        let text: Vec<String> = rgba.iter().map(f64::to_string).collect();
        self.effects.refuse(at, Fault::range_of("rgba", &text.join(" "), COLOR_RULE))
    }

    fn mesh(&mut self, mesh: Node<'_>, part: &Part, is_collision: bool) -> Reading<()> {
        let filename = self.effects.needed(mesh, "filename")?;
        let facts = self.found(filename, "mesh")?;
        if let Some(scale) = mesh.attribute("scale") {
            // One number stands for all three.
            let count = if scale.value.contains(' ') { 3 } else { 1 };
            let numbers = self.numbers(scale, count, part)?;
            if numbers.iter().any(|number| number.abs() < 1e-8) {
                return self.effects.refuse(scale, Fault::range(scale, "a scale must not be 0"));
            }
        }
        match is_collision {
            true => self.hull(filename, facts.as_deref()),
            false => Ok(()),
        }
    }

    /// The convex hull of a collision's mesh.
    fn hull(&mut self, filename: &Attribute<'_>, facts: Option<&MeshFacts>) -> Reading<()> {
        let name = filename.value.rsplit('/').next().unwrap_or_default();
        let end = name.rsplit_once('.').filter(|(stem, _)| !stem.is_empty());
        let end = end.map(|(_, end)| end.to_ascii_lowercase()).unwrap_or_default();
        let why = match &*end {
            "obj" => match facts.and_then(|facts| Some((facts.obj.as_ref()?, &facts.measures))) {
                Some((obj, _)) if obj.vertices < 3 => "the mesh has fewer than three vertices",
                Some((obj, _)) if obj.faces == 0 => "the mesh has no face",
                Some((_, measures)) if measures.spread[0] < 1e-12 => "the mesh is a point",
                Some((_, measures)) if measures.spread[1] < 1e-12 => "the mesh is a line",
                _ => return Ok(()),
            },
            "vtk" | "gltf" => return Ok(()),
            _ => {
                let why = "a collision can only have a mesh in OBJ, glTF (.gltf) or VTK";
                return self.effects.refuse(filename, Fault::ForOthers(why));
            }
        };
        self.effects.refuse(filename, Fault::Mesh(why))
    }

    /// What is in a file that must be there; none if it is not known.
    pub(super) fn found(
        &mut self,
        filename: &Attribute<'_>,
        kind: &'static str,
    ) -> Reading<Option<Arc<MeshFacts>>> {
        let name = &*filename.value;
        let mesh = match uri(name) {
            Some(("file", _, path)) => self.file.mesh(&format!("file:///{path}")),
            Some(("package" | "model", package, _)) if !package.is_empty() => self.file.mesh(name),
            None if name.is_empty() => Mesh::Unknown,
            None if !name.contains("://") => self.file.mesh(name),
            _ => Mesh::Missing,
        };
        match mesh {
            Mesh::Unknown => Ok(None),
            Mesh::Found(facts) => Ok(Some(facts)),
            Mesh::Missing => self.effects.refuse(filename, Fault::NotFound(kind)),
        }
    }
}

/// Scheme, authority and path of a URI. `file://part.stl` is none to Drake.
fn uri(name: &str) -> Option<(&str, &str, &str)> {
    let (scheme, rest) = name.split_once("://")?;
    let (authority, path) = rest.split_once('/')?;
    let is_scheme =
        |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"+.-".contains(&byte);
    let fits = !scheme.is_empty() && scheme.bytes().all(is_scheme);
    fits.then(|| (scheme, authority, path.trim_start_matches('/')))
}
