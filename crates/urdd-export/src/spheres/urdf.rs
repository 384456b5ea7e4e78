//! URDF with the spheres as collision geometry.

use super::super::error::ExportError;
use super::super::options::SpherizedOptions;
use super::super::output::Export;
use super::super::subject::{Subject, by_link};
use super::super::urdf;
use super::{Model, said};
use urdd_robot::{LinkShape, Solid};

pub(in super::super) fn export(
    subject: &Subject,
    options: &SpherizedOptions,
) -> Result<Export, ExportError> {
    let model = Model::new(subject, &options.spheres)?;
    let mut shapes: Vec<LinkShape> = Vec::new();
    for (link, spheres) in &model.links {
        let spheres = spheres.iter().enumerate().map(|(piece, sphere)| LinkShape {
            link: *link,
            piece,
            solid: Solid::Sphere { centre: sphere.centre, radius: sphere.radius },
        });
        shapes.extend(spheres);
    }
    let shapes = by_link(&subject.described, shapes);
    let mut notes = said::note(&model, subject).into_iter().collect();
    let (robot, files) = urdf::robot(subject, &options.meshes, shapes, &mut notes)?;
    let said = model.said(&subject.links, options.spheres.cover).join(" ");
    let text = robot.document(&subject.comments(said, &notes)?);
    Ok(Export::of(text, files, notes))
}
