//! Spheres in Foam's format (`mean`, `best`, `worst`, `spheres`), by link, with additional metadata.

use serde_json::{Map, Value, json};

use super::super::error::ExportError;
use super::super::options::SphereOptions;
use super::super::output::Export;
use super::super::subject::Subject;
use super::said::{self, Stand};
use super::{Model, Sphere};
use urdd_format::escape;

pub(in super::super) fn export(
    subject: &Subject,
    options: &SphereOptions,
) -> Result<Export, ExportError> {
    let model = Model::new(subject, options)?;
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
        "about": model.said(&subject.links, options.cover),
        "measured": model.measured.json(),
        "ignored_pairs": model.ignored.iter().map(|pair| pair.map(name)).collect::<Vec<_>>(),
        "links": links,
    });
    let text = serde_json::to_string_pretty(&document).unwrap_or_default() + "\n";
    let text = escape::json(&text).into_owned();
    Ok(Export::of(text, Vec::new(), said::note(&model, subject).into_iter().collect()))
}
