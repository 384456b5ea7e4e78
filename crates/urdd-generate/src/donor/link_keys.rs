//! What identifies the geometry of a link.

use std::collections::HashMap;

use serde_json::{Value, json};

use urdd_format::original_meshes::OriginalMeshesModule;
use urdd_format::urdf::{Geometry, Material, UrdfModule};
use urdd_source::origin::has_quaternions;

/// For each link, a key that is equal for equal plain meshes: the contents of its elements, with the content of mesh
/// files instead of their names. `digest` returns the SHA-256 of a file of the URDD. `None` if a file is unknown.
pub(super) fn link_keys(
    robot: &UrdfModule,
    original: &OriginalMeshesModule,
    digest: &dyn Fn(&str) -> Option<String>,
) -> Vec<Option<String>> {
    let mut contents: HashMap<&str, Option<String>> = HashMap::new();
    for file in &original.files {
        let of = |path: &String| Some(format!("{} {}\n", extension(path), digest(path)?));
        let mut parts: Vec<Option<String>> = file.side_files.iter().map(of).collect();
        parts.push(Some(format!("{}\n", file.usable)));
        parts.push(of(&file.path));
        contents.insert(&file.path, parts.into_iter().collect());
    }
    let mut meshes: HashMap<(usize, String), Option<String>> = HashMap::new();
    for of in &original.references {
        let content = match &of.path {
            None => Some("none".to_owned()),
            Some(path) => contents.get(path.as_str()).cloned().flatten(),
        };
        meshes.insert((of.link_idx.get(), of.filename.clone()), content);
    }
    let quaternions = has_quaternions(robot.version.as_deref());
    let links = robot.links.iter().enumerate().map(|(idx, link)| {
        let geometry = |geometry: &Option<Geometry>| match geometry {
            Some(Geometry::Mesh(mesh)) => {
                let content = meshes.get(&(idx, mesh.filename.clone()))?.clone()?;
                Some(json!({ "content": content, "scale": mesh.scale }))
            }
            other => serde_json::to_value(other).ok(),
        };
        let visual = link.visual.iter().map(|visual| {
            let color = look(visual.material.as_ref(), robot);
            Some(json!([visual.origin, geometry(&visual.geometry)?, color]))
        });
        let collision = link
            .collision
            .iter()
            .map(|collision| Some(json!([collision.origin, geometry(&collision.geometry)?])));
        let visual: Option<Vec<Value>> = visual.collect();
        let collision: Option<Vec<Value>> = collision.collect();
        Some(json!([quaternions, visual?, collision?]).to_string())
    });
    links.collect()
}

/// The colours of all materials that an element may refer to: those of the same name, and its own.
fn look(material: Option<&Material>, robot: &UrdfModule) -> Value {
    let Some(material) = material else {
        return Value::Null;
    };
    let named = robot.materials.iter().filter(|of| of.name.is_some() && of.name == material.name);
    let colors: Vec<_> = named.map(|of| &of.color).collect();
    json!([material.color, colors])
}

fn extension(path: &str) -> String {
    path.rsplit_once('.').map(|(_, ending)| ending).unwrap_or_default().to_ascii_lowercase()
}
