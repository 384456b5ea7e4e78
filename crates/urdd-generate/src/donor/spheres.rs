//! Spheres that a person gave to the URDD that is replaced. They are kept: SPEC 8.9.8.

use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use super::Donor;
use super::decided::{Decided, Fault, names};
use crate::error::{EditsFault, Result};
use crate::selection::Selection;
use urdd_directory::root::Root;
use urdd_format::link_shapes_spheres::{SphereLevel, SphereOrigin};
use urdd_format::registry::ModuleKind;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_spheres::list::SphereList;

const LEVELS: &str = "levels";

/// The lists of given spheres in a folder that is to be replaced.
///
/// # Errors
/// If there may be some and they cannot be read, or if the selected modules would not hold them.
pub(crate) fn given(
    folder: &Path,
    selection: &Selection,
    replaced: Option<&Donor>,
) -> Result<Vec<SphereList>> {
    let kind = ModuleKind::LinkShapesSpheres;
    let decided = Decided { folder, kind, what: "given spheres", keys: &[LEVELS] };
    let lists = decided.read(replaced, lists)?.unwrap_or_default();
    let count = lists.iter().map(SphereList::count).sum();
    if count > 0 && !selection.has(kind) {
        let fault = EditsFault::SpheresNotAskedFor(count);
        return Err(decided.refused(&decided.path("module.json"), None, fault));
    }
    Ok(lists)
}

fn lists(root: &Root, document: &Value) -> Result<Vec<SphereList>, Fault> {
    let at = |level: Option<usize>| match level {
        Some(level) => format!("/{LEVELS}/{level}"),
        None => format!("/{LEVELS}"),
    };
    let levels = document.get(LEVELS).and_then(Value::as_array);
    let levels = levels.ok_or_else(|| (at(None), "this list is missing".to_owned()))?;
    let mut lists = Vec::new();
    for (number, level) in levels.iter().enumerate() {
        let origin = level.get("origin").and_then(Value::as_str);
        if origin == Some("Computed") {
            continue;
        }
        let level = SphereLevel::deserialize(level).map_err(|error| {
            (at(Some(number)), format!("the spheres of this level cannot be used: {error}"))
        })?;
        if level.origin != SphereOrigin::Given {
            continue;
        }
        let names = names(root, ModuleKind::Urdf, "links").ok_or_else(|| {
            let words = "the spheres of this level cannot be used: urdf_module, which names their links, cannot be read";
            (at(Some(number)), words.to_owned())
        })?;
        let links = names.into_iter().zip(&level.spheres).filter(|(_, own)| !own.is_empty());
        let links = links.map(|(name, own)| {
            let one = own
                .iter()
                .map(|sphere| BoundingSphere { centre: sphere.offset_xyz, radius: sphere.radius });
            (name, one.collect())
        });
        lists.push(SphereList { links: links.collect(), left_out: Vec::new() });
    }
    Ok(lists)
}
