//! What a mesh file has: where it was found, its size, its triangles and its extent.

use std::fs;

use crate::document::Snapshot;
use crate::robot::RobotModel;
use crate::shown::code;
use urdd_format::escape;
use urdd_format::readable::number;
use urdd_geometry::Mesh;

/// Significant digits of lengths.
const DIGITS: usize = 4;

/// What a mesh file has.
pub fn mesh(model: Option<&RobotModel>, snapshot: &Snapshot, name: &str, element: usize) -> String {
    let title = format!("**mesh {}**\n\n", code(name));
    let meshes = model.map(|model| model.source.meshes.iter());
    let mesh = meshes.and_then(|mut meshes| meshes.find(|mesh| mesh.filename == name));
    let (Some(model), Some(mesh)) = (model, mesh) else {
        return title + "Not looked for: the text does not describe a robot yet.";
    };
    let file = match &mesh.file {
        Ok(file) => file,
        Err(missing) => return title + "Not found: " + &escape::line(&missing.reason),
    };
    let mut lines = vec![format!("- file: {}", code(&file.display().to_string()))];
    match fs::metadata(file) {
        Ok(metadata) => lines.push(format!("- size: {} bytes", metadata.len())),
        Err(error) => lines.push(format!("- not readable: {error}")),
    }
    match model.source.read(file) {
        Ok(scene) => {
            lines.push(format!("- triangles: {}", scene.triangle_count()));
            let scale = scale(snapshot, element);
            lines.extend(extent(&scene.merged(), scale));
            if scale != [1.0; 3] {
                lines.push(format!("- scale: {}", triple(scale)));
            }
        }
        Err(reason) => lines.push(format!("- no usable surface: {}", escape::line(&reason))),
    }
    title + &lines.join("\n")
}

/// The extent of a scaled mesh.
fn extent(mesh: &Mesh, scale: [f64; 3]) -> Option<String> {
    let bounds = mesh.bounds()?;
    let ends = |pick: fn(f64, f64) -> f64| {
        let axes = [0, 1, 2];
        axes.map(|axis| pick(bounds.min[axis] * scale[axis], bounds.max[axis] * scale[axis]))
    };
    let (low, high) = (ends(f64::min), ends(f64::max));
    let size = [0, 1, 2].map(|axis| number(high[axis] - low[axis], DIGITS)).join(" × ");
    Some(format!("- bounding box: {size} m, from ({}) to ({})", triple(low), triple(high)))
}

fn triple(values: [f64; 3]) -> String {
    values.map(|x| number(x, DIGITS)).join(" ")
}

/// The scale that the element has; 1 where it has none that can be read.
fn scale(snapshot: &Snapshot, element: usize) -> [f64; 3] {
    let text = snapshot.text.as_str();
    let value = snapshot.markup().value(text, element, "scale");
    let numbers = value.as_deref().unwrap_or_default().split_whitespace();
    let numbers: Option<Vec<f64>> = numbers.map(|word| word.parse().ok()).collect();
    let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
    numbers.unwrap_or([1.0; 3])
}
