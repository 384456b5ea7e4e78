//! File names of derived meshes: SPEC 7.3.

use urdd_format::registry::ModuleKind;
use urdd_generate::MeshFormats;
use urdd_generate::meshes::*;

#[test]
fn slugs_are_ascii_and_short() {
    assert_eq!(slug("arm/left_link-2"), "arm_left_link-2");
    assert_eq!(slug("a \u{e9}\u{4f60}b"), "a_b");
    assert_eq!(slug(""), "link");
    assert_eq!(slug("\u{4f60}"), "_");
    assert_eq!(slug(&"x".repeat(99)), "x".repeat(64));
}

#[test]
fn pieces_lie_in_a_folder_of_their_link() {
    let files = mesh_files(ModuleKind::PlainMeshes, 3, "a b", None, MeshFormats::default());
    assert_eq!(files.obj.as_deref(), Some("mesh_modules/plain_meshes_module/meshes/obj/3_a_b.obj"));
    let kind = ModuleKind::ConvexDecompositionMeshes;
    let files = mesh_files(kind, 3, "a", Some(12), MeshFormats::default());
    assert_eq!(files.glb, "mesh_modules/convex_decomposition_meshes_module/meshes/glb/3_a/12.glb");
}
