//! Collision geometry: convex meshes, boxes and spheres, which are not rendered.

use nalgebra::{Isometry3, Translation3};

use super::super::error::{ExportError, Note};
use super::super::flat::FlatShapes;
use super::super::meshes::MeshFiles;
use super::super::mjcf::surface::is_flat;
use super::super::subject::Subject;
use super::super::urdf_elements::HALF_THICKNESS;
use super::filters::Filters;
use super::looks::LONGEST;
use super::names::{COLLISIONS, Paths, path_of_shape};
use super::prim::Prim;
use super::surface::{extent, set};
use super::value::{asset, doubles, wxyz};
use urdd_robot::{LinkShape, Solid};
use urdd_xml::number::number;

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
            let piece = shape.piece;
            let mut prim = shape_prim(link, shape, &flat, files, notes)?;
            prim.apply("PhysicsCollisionAPI");
            if let Some(targets) = filters.targets.get(&path_of_shape(&paths.links[link], piece)) {
                prim.apply("PhysicsFilteredPairsAPI");
                prim.relate("physics:filteredPairs", targets);
            }
            if let Some(material) = material {
                prim.apply("MaterialBindingAPI");
                prim.relate("material:binding:physics", std::slice::from_ref(material));
            }
            holder.push(prim);
        }
        links[link].push_filled(holder);
    }
    Ok(())
}

fn shape_prim(
    link: usize,
    shape: LinkShape,
    flat: &FlatShapes,
    files: &mut MeshFiles,
    notes: &mut Vec<Note>,
) -> Result<Prim, ExportError> {
    let name = format!("piece_{}", shape.piece);
    Ok(match shape.solid {
        Solid::Mesh(mesh) if is_flat(&mesh) => {
            let (pose, half_extents) = flat.cuboid(shape.piece, link, notes)?;
            cuboid(name, &pose, half_extents)
        }
        Solid::Mesh(mesh) => {
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
        Solid::Box { pose, half_extents } => cuboid(name, &pose, half_extents),
        Solid::Sphere { centre, radius } => {
            let radius = radius.max(HALF_THICKNESS);
            let mut prim = Prim::new("Sphere", name).with("double radius", number(radius));
            extent(&mut prim, &[[-radius; 3], [radius; 3]]);
            place(&mut prim, &Isometry3::from(Translation3::from(centre)), None);
            prim
        }
    })
}

/// A cube of 1 m, scaled.
fn cuboid(name: String, pose: &Isometry3<f64>, half_extents: [f64; 3]) -> Prim {
    let mut prim = Prim::new("Cube", name).with("double size", "1");
    extent(&mut prim, &[[-0.5; 3], [0.5; 3]]);
    let size = half_extents.map(|half| 2.0 * half.max(HALF_THICKNESS));
    place(&mut prim, pose, Some(size));
    prim
}

/// Sets the pose of a prim in the one that holds it, and its scale.
pub(super) fn place(prim: &mut Prim, pose: &Isometry3<f64>, scale: Option<[f64; 3]>) {
    prim.set("double3 xformOp:translate", doubles(pose.translation.vector.as_slice()));
    prim.set("quatd xformOp:orient", doubles(&wxyz(&pose.rotation)));
    let mut order = "[\"xformOp:translate\", \"xformOp:orient\"]";
    if let Some(scale) = scale {
        prim.set("double3 xformOp:scale", doubles(&scale));
        order = "[\"xformOp:translate\", \"xformOp:orient\", \"xformOp:scale\"]";
    }
    prim.set("uniform token[] xformOpOrder", order);
}
