//! Spheres in Foam's format (`mean`, `best`, `worst`, `spheres`), by link, with additional metadata.

use serde_json::{Map, Value, json};

use super::Model;
use super::said::{self, Stand};
use crate::subject::by_link;
use crate::{Export, ExportError, Subject, urdf};
use urdd_format::escape;
use urdd_robot::{LinkShape, Solid};
use urdd_spheres::model::Sphere;

pub(in super::super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let model = Model::new(subject)?;
    let name = |link: usize| subject.links.get(link).cloned().unwrap_or_default();
    let sphere = |sphere: &Sphere| json!({ "origin": sphere.centre, "radius": sphere.radius });
    let links = model.links.iter().zip(&model.surface).map(|((link, spheres), surface)| {
        let stand = Stand::new(spheres, surface);
        let spheres: Vec<Value> = spheres.iter().map(sphere).collect();
        let value = json!({
            "mean": stand.mean,
            "best": stand.best,
            "worst": stand.worst,
            "spheres": spheres,
        });
        (name(*link), value)
    });
    let links: Map<String, Value> = links.collect();
    let document = json!({
        "made_from": subject.origin()?,
        "about": model.said(&subject.links, subject.options.chosen.cover),
        "measured": model.measured.json(),
        "ignored_pairs": model.ignored.iter().map(|pair| pair.map(name)).collect::<Vec<_>>(),
        "links": links,
    });
    let text = serde_json::to_string_pretty(&document).unwrap_or_default() + "\n";
    let text = escape::json(&text).into_owned();
    Ok(Export::of(text, Vec::new(), said::note(&model, subject).into_iter().collect()))
}

/// URDF with the spheres as collision geometry.
pub(in super::super) fn spherized(subject: &Subject) -> Result<Export, ExportError> {
    let model = Model::new(subject)?;
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
    let (robot, files) = urdf::robot(subject, shapes, &mut notes)?;
    let said = model.said(&subject.links, subject.options.chosen.cover).join(" ");
    let text = robot.document(&subject.comments(said, &notes)?);
    Ok(Export::of(text, files, notes))
}
