//! The inputs of modules besides other modules. A module of the replaced URDD is kept if its text here and the modules
//! that it depends on are the same.

use crate::context::Context;
use crate::meshes::derived::{DECOMPOSITION, decomposition};
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::ModuleKind;
use urdd_learned::train::VERSION;

/// The inputs of a module as text; `None` if it is always built, because that takes no time. The text changes whenever the
/// stage builds something else from the same modules.
pub(super) fn text(kind: ModuleKind, context: &Context) -> Option<String> {
    let settings = context.settings;
    let formats = match (settings.mesh_formats.stl, settings.mesh_formats.obj) {
        (true, true) => "",
        (true, false) => "; no obj",
        (false, true) => "; no stl",
        (false, false) => "; glb only",
    };
    Some(match kind {
        // With hundreds of links this is megabytes of text.
        ModuleKind::Connections => "2".to_owned(),
        ModuleKind::PlainMeshes => {
            let geometry = match settings.preferred_geometry {
                GeometryKind::Visual => "visual",
                GeometryKind::Collision => "collision",
            };
            format!("{geometry}; smooth normals{formats}")
        }
        ModuleKind::ConvexHullMeshes => formats.to_owned(),
        ModuleKind::ConvexDecompositionMeshes => {
            format!("{DECOMPOSITION} {:?}{formats}", decomposition(settings))
        }
        ModuleKind::LinkShapesApproximations | ModuleKind::LinkShapesMaxDistanceFromOrigin => {
            String::new()
        }
        ModuleKind::LinkShapesDistanceStatistics => {
            format!("{} samples, 7 digits; 2", settings.num_samples)
        }
        ModuleKind::LinkShapesSimpleSkips => "2".to_owned(),
        ModuleKind::LinkShapesSkips => {
            let text =
                serde_json::json!((context.skipped_reasons(), &context.edits.kept)).to_string();
            with_reference(context, text)
        }
        ModuleKind::SelfCollisionModel => format!("{VERSION} {:?}", settings.model_effort),
        ModuleKind::LinkShapesSpheres => {
            let text = format!("{} {:?}", urdd_spheres::module::VERSION, context.spheres);
            with_reference(context, text)
        }
        _ => return None,
    })
}

/// For what depends on the reference configuration, where a person chose one, or loops have one.
fn with_reference(context: &Context, text: String) -> String {
    match &context.reference {
        None => text,
        Some(of) => format!("{text}; {}", serde_json::json!((&of.name, &of.configuration))),
    }
}
