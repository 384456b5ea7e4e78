//! Collision geometry: convex meshes, boxes and spheres, which are not rendered.

use super::looks::LONGEST;
use super::names::{COLLISIONS, Filters, Paths, path_of_shape};
use super::prim::{Prim, asset};
use super::surface::{primitive, set};
use crate::mjcf::surface::is_flat;
use crate::{ExportError, FlatShapes, MeshFiles, Note, Shape, Solid, Subject};

/// Adds the shapes to the links, in link order. They have the material of that path.
pub(super) fn add(
    subject: &Subject,
    links: &mut [Prim],
    material: Option<&String>,
    (filters, paths): (&Filters, &Paths),
    files: &mut MeshFiles,
    notes: &mut Vec<Note>,
) -> Result<(), ExportError> {
    let shapes = subject.shapes_by_link()?;
    if shapes.iter().all(Vec::is_empty) {
        notes.push(Note::NoShapes(subject.shapes));
    }
    let flat = FlatShapes::new(subject)?;
    for (link, shapes) in shapes.into_iter().enumerate() {
        let mut holder = Prim::new("Xform", COLLISIONS);
        holder.set("uniform token purpose", "\"guide\"");
        for shape in shapes {
            let piece = shape.number;
            let mut prim = shape_prim(link, shape, &flat, files, notes)?;
            prim.apply("PhysicsCollisionAPI");
            filters.apply(&path_of_shape(&paths.links[link], piece), &mut prim);
            if let Some(material) = material {
                prim.bind("material:binding:physics", material);
            }
            holder.push(prim);
        }
        links[link].push_filled(holder);
    }
    Ok(())
}

fn shape_prim(
    link: usize,
    shape: Shape,
    flat: &FlatShapes,
    files: &mut MeshFiles,
    notes: &mut Vec<Note>,
) -> Result<Prim, ExportError> {
    let name = format!("piece_{}", shape.number);
    Ok(match shape.solid {
        Solid::Convex(mesh) | Solid::Mesh(mesh) if is_flat(&mesh) => {
            let (pose, cuboid) = flat.cuboid(&mesh, shape.number, link, notes);
            primitive(name, &pose, cuboid)
        }
        Solid::Convex(mesh) | Solid::Mesh(mesh) => {
            let mut inline = Prim::new("Mesh", name.as_str());
            set(&mut inline, &mesh, &[]);
            let text = inline.file(&[]);
            let mut prim = if text.len() > LONGEST {
                let mut prim = Prim::new("Mesh", name.as_str());
                let path = files.add_text(link, &name, text);
                prim.describe("prepend references", &asset(&path));
                prim
            } else {
                inline
            };
            prim.apply("PhysicsMeshCollisionAPI");
            prim.set("uniform token physics:approximation", "\"convexHull\"");
            prim
        }
        Solid::Primitive(pose, of) => primitive(name, &pose, of),
    })
}
