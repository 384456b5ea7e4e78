//! The visuals in its scene, with their colours and meshes.

use super::Reader;
use crate::effect::Reading;
use crate::fault::Fault;
use crate::mesh::{Mesh, StlFacts};
use crate::tree::Node;

impl<'t> Reader<'_, 't> {
    /// A visual in the scene.
    pub(super) fn shown(&mut self, visual: Node<'t>, part: &str) -> Reading<()> {
        let form = visual.child("geometry").and_then(|geometry| geometry.children().next());
        if let Some(mesh) = form.filter(|form| form.name() == "mesh")
            && !self.mesh(mesh, part)?
        {
            return Ok(());
        }
        let Some(material) = visual.child("material") else { return Ok(()) };
        let of_robot = material.value("name").and_then(|name| self.materials.get(name));
        if let Some(texture) =
            material.child("texture").or(of_robot.and_then(|one| one.child("texture")))
        {
            let fault = Fault::NeverRead("texture".into());
            self.effects.drop(texture, format!("{part}/material"), fault);
        }
        let own = material.child("color");
        let color = own.or_else(|| of_robot.and_then(|material| material.child("color")));
        if own.is_none()
            && of_robot.is_none()
            && let Some(name) = material.value("name")
        {
            let part = format!("{part}/material");
            self.effects.drop(material, part, Fault::unknown("material of the robot", name));
        }
        let Some(rgba) = color.and_then(|color| color.attribute("rgba")) else { return Ok(()) };
        let size = form.and_then(|form| form.attribute("size"));
        if let Some(size) = size
            && size.value.replace(',', " ").split_whitespace().count() != 3
        {
            return self.effects.refuse(size, Fault::count("size", 3, &size.value));
        }
        let numbers = self.vector(rgba, &rgba.value)?;
        if !matches!(numbers.len(), 1 | 4) {
            return self.effects.refuse(rgba, Fault::count("rgba", 4, &rgba.value));
        }
        // Each is kept as a whole number from 0 to 255.
        if !numbers
            .iter()
            .all(|number| (255.0 * number).trunc().abs() <= 255.0 && 255.0 * number > -1.0)
        {
            let fault = Fault::range("rgba", &rgba.value, "a colour is of numbers from 0 to 1");
            return self.effects.refuse(rgba, fault);
        }
        Ok(())
    }

    /// Whether a mesh is shown.
    fn mesh(&mut self, mesh: Node<'t>, part: &str) -> Reading<bool> {
        let name = self.needed(mesh, "filename")?;
        let packaged = name.value.strip_prefix("package://");
        if packaged.is_some_and(|path| !path.trim_end_matches('/').contains('/')) {
            let fault = Fault::Mesh("the name of the mesh has a package, and no file in it");
            return self.effects.refuse(name, fault);
        }
        let Mesh::Found(facts) = self.file.mesh(&name.value) else {
            if matches!(self.file.mesh(&name.value), Mesh::Missing) {
                let fault = Fault::Mesh("the file of the mesh was not found");
                self.effects.drop(name, part, fault);
            }
            return Ok(false);
        };
        let ending = name.value.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
        let is_stl = |stl: &StlFacts| stl.binary.is_some_and(|count| count > 0) || stl.corners > 0;
        let (is_refused, is_empty) = match &*ending {
            "stl" => (false, !facts.stl.as_ref().is_some_and(is_stl)),
            "obj" => (false, facts.obj.as_ref().is_none_or(|obj| obj.vertices == 0)),
            "dae" => (facts.collada.is_none(), false),
            "ply" | "glb" | "gltf" | "off" | "3mf" | "zae" => (false, false),
            // A folder.
            _ if facts.size == 0 => (false, true),
            _ => (true, false),
        };
        let scale = self.scale(mesh)?;
        // The size of nothing cannot be changed evenly.
        let is_even = !scale.is_empty() && scale.iter().all(|one| *one == scale[0]);
        if is_refused || (is_empty && is_even) {
            let fault = Fault::Mesh("the program cannot read the mesh");
            return self.effects.refuse(name, fault);
        }
        if let Some(value) = mesh.attribute("scale") {
            if !matches!(scale.len(), 0 | 1 | 3) {
                return self.effects.refuse(value, Fault::count("scale", 3, &value.value));
            }
            if is_even && scale.first() == Some(&0.0) {
                let fault = Fault::range("scale", &value.value, "a mesh cannot have the size 0");
                return self.effects.refuse(value, fault);
            }
        }
        if is_empty {
            self.effects.drop(name, part, Fault::Mesh("the program finds nothing in the mesh"));
            return Ok(false);
        }
        Ok(true)
    }
}
