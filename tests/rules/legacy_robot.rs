//! A small legacy URDD with meshes, of module versions that were published.

use std::path::Path;

use serde_json::{Value, json};
use urdd_directory::canonical;

use testkit::meshes::{Point, TRIANGLES, glb, obj, stl};

/// The corners of the mesh that both links show: a box that extends half a metre from its centre.
pub fn corners() -> [Point; 8] {
    let half = [0.3, 0.24, 0.32].map(|x: f64| f64::from(x as f32));
    std::array::from_fn(|corner| {
        std::array::from_fn(|axis| if corner >> axis & 1 == 0 { -half[axis] } else { half[axis] })
    })
}

/// A robot of two links that show the same mesh, one fixed to the other; the second at `shift` along x.
pub struct LegacyRobot {
    /// Modules: folder, version, document.
    pub modules: Vec<(&'static str, &'static str, Value)>,
}

pub const STL: &str = "stl_link_mesh_relative_paths";
pub const OBJ: &str = "obj_link_mesh_relative_paths";
pub const GLB: &str = "glb_link_mesh_relative_paths";

impl LegacyRobot {
    /// Mesh paths begin with `folder`, which is relative to the folder above the URDD.
    pub fn new(folder: &str, shift: f64) -> Self {
        let origin = |x: f64| json!({ "xyz": [x, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0] });
        let link = |name: &str, x: f64| {
            json!({
                "name": name,
                "inertial": {
                    "origin": origin(0.0), "mass": { "value": 0.0 },
                    "inertia": { "ixx": 0.0, "ixy": 0.0, "ixz": 0.0, "iyy": 0.0, "iyz": 0.0, "izz": 0.0 },
                },
                "visual": [{
                    "name": null, "origin": origin(x), "material": null,
                    "geometry": { "Mesh": { "filename": "package://p/finger.dae", "scale": null } },
                }],
                "collision": [],
            })
        };
        let joint = json!({
            "name": "joint", "joint_type": "Fixed", "origin": origin(1.0),
            "parent": { "link": "left" }, "child": { "link": "right" },
            "axis": { "xyz": [1.0, 0.0, 0.0] },
            "limit": { "lower": 0.0, "upper": 0.0, "effort": 0.0, "velocity": 0.0 },
            "dynamics": null, "mimic": null, "safety_controller": null,
        });
        let urdf = json!({
            "name": "robot", "links": [link("left", 0.0), link("right", shift)],
            "joints": [joint], "materials": [],
        });
        let path = |module: &str, format: &str| {
            format!("{folder}/mesh_modules/{module}/meshes/{format}/finger.{format}")
        };
        let single = |module: &str| {
            let both = |format: &str| json!([path(module, format), path(module, format)]);
            json!({ STL: both("stl"), OBJ: both("obj"), GLB: both("glb") })
        };
        let pieces = |format: &str| {
            let module = "convex_decomposition_meshes_module";
            let piece = format!("{folder}/mesh_modules/{module}/meshes/{format}/finger/0.{format}");
            json!([[piece], [piece]])
        };
        let original = "mesh_modules/original_meshes_module/meshes/finger.dae";
        let original = format!("{folder}/{original}");
        LegacyRobot {
            modules: vec![
                ("urdf_module", "0.0.3", urdf),
                (
                    "mesh_modules/original_meshes_module",
                    "0.0.1",
                    json!({ "link_mesh_relative_paths": [original, original] }),
                ),
                ("mesh_modules/plain_meshes_module", "0.0.1", single("plain_meshes_module")),
                (
                    "mesh_modules/convex_hull_meshes_module",
                    "0.0.1",
                    single("convex_hull_meshes_module"),
                ),
                (
                    "mesh_modules/convex_decomposition_meshes_module",
                    "0.0.1",
                    json!({ STL: pieces("stl"), OBJ: pieces("obj"), GLB: pieces("glb") }),
                ),
            ],
        }
    }

    /// Removes the meshes that the URDF names.
    pub fn without_originals(mut self) -> Self {
        let is_original = |folder: &str| folder.ends_with("original_meshes_module");
        self.modules.retain(|(folder, ..)| !is_original(folder));
        self
    }

    /// Adds a joint that slides along x within these limits, and the core modules that describe it.
    pub fn sliding(mut self, lower: f64, upper: f64) -> Self {
        let joint = &mut self.doc("urdf_module")["joints"][0];
        joint["joint_type"] = json!("Prismatic");
        joint["limit"] = json!({ "lower": lower, "upper": upper, "effort": 1.0, "velocity": 1.0 });
        let dof = json!({
            "num_dofs": 1,
            "dof_idx_to_joint_idx_mapping": [0],
            "joint_idx_to_dof_idxs_mapping": [[0]],
        });
        let link = |name: &str, at: u32| {
            let (above, below) = match at {
                0 => (Value::Null, json!([1])),
                _ => (json!(0), json!([])),
            };
            let joint = |links: &Value| match links.as_array() {
                Some(links) => json!(vec![0; links.len()]),
                None => links.clone(),
            };
            json!({
                "name": name, "link_idx": at,
                "parent_joint_idx": above, "parent_link_idx": above,
                "children_joint_idxs": joint(&below), "children_link_idxs": below,
            })
        };
        let chain = json!({
            "links_in_chain": [link("left", 0), link("right", 1)],
            "joints_in_chain": [{
                "joint_name": "joint", "joint_idx": 0,
                "parent_link_name": "left", "parent_link_idx": 0,
                "child_link_name": "right", "child_link_idx": 1,
            }],
            "kinematic_hierarchy": [[0], [1]],
            "root_idx": 0,
        });
        let bounds = json!({
            "bounds": [[lower, upper]], "dof_lower_bounds": [lower], "dof_upper_bounds": [upper],
        });
        self.modules.extend([
            ("dof_module", "0.0.2", dof),
            ("chain_module", "0.0.1", chain),
            ("bounds_module", "0.0.1", bounds),
        ]);
        self
    }

    /// Adds boxes and spheres of half a metre around both links, and their maximum distances from the origin: `sphere`
    /// for the spheres.
    pub fn with_shapes(mut self, sphere: f64) -> Self {
        let zero = [0.0; 3];
        let cuboid =
            json!({ "half_extents": [0.3, 0.24, 0.32], "offset_xyz": zero, "offset_rpy": zero });
        let ball = json!({ "radius": 0.5, "offset_xyz": zero, "offset_rpy": zero });
        let approximations = json!({
            "full_obbs": [cuboid, cuboid],
            "full_bounding_spheres": [ball, ball],
            "decomposition_obbs": [[cuboid], [cuboid]],
            "decomposition_bounding_spheres": [[ball], [ball]],
        });
        let reach = json!({
            "full_convex_hulls_maximum_distances": [0.5, 0.5],
            "full_obbs_maximum_distances": [0.5, 0.5],
            "full_bounding_spheres_maximum_distances": [sphere, sphere],
            "decomposition_convex_hulls_maximum_distances": [[0.5], [0.5]],
            "decomposition_obbs_maximum_distances": [[0.5], [0.5]],
            "decomposition_bounding_spheres_maximum_distances": [[sphere], [sphere]],
        });
        self.modules.extend([
            ("link_shapes_modules/link_shapes_approximations_module", "0.0.3", approximations),
            ("link_shapes_modules/link_shapes_max_distance_from_origin_module", "0.0.3", reach),
        ]);
        self
    }

    /// Adds statistics of two links at this distance, and skips edited to these.
    pub fn with_matrices(mut self, max: f64, simple: bool, skips: [[bool; 2]; 2]) -> Self {
        let kinds = ["convex_hulls", "obbs", "bounding_spheres"];
        let names = ["full", "decomposition"].into_iter();
        let names: Vec<String> =
            names.flat_map(|set| kinds.map(|kind| format!("{set}_{kind}"))).collect();
        let matrix = |off: f64| json!([[0.0, off], [off, 0.0]]);
        let (mut statistics, mut simples, mut edited) = (json!({}), json!({}), json!({}));
        for name in &names {
            statistics[name] = json!({
                "averages": matrix(max), "maximums": matrix(max), "minimums": matrix(max),
            });
            simples[format!("{name}_simple_skips")] = json!([[true, simple], [simple, true]]);
            edited[format!("{name}_skips")] = json!(skips);
        }
        self.modules.extend([
            ("link_shapes_modules/link_shapes_distance_statistics_module", "0.0.3", statistics),
            ("link_shapes_modules/link_shapes_simple_skips_module", "0.0.5", simples),
            ("link_shapes_modules/link_shapes_skips_module", "0.0.2", edited),
        ]);
        self
    }

    /// The document of a module.
    pub fn doc(&mut self, module: &str) -> &mut Value {
        let mut modules = self.modules.iter_mut();
        let found = modules.find(|(folder, ..)| folder.ends_with(module));
        &mut found.expect("a module").2
    }

    /// Writes the URDD to `root`, and every mesh file to the place that its path names. The `.glb` files are binary, so
    /// that nothing else is found.
    pub fn write(&self, root: &Path) {
        for (folder, version, document) in &self.modules {
            let folder = root.join(folder);
            std::fs::create_dir_all(&folder).expect("a folder");
            let put = |name: &str, bytes: Vec<u8>| {
                std::fs::write(folder.join(name), bytes).expect("a file");
            };
            put("VERSION", version.as_bytes().to_vec());
            put("module.json", canonical::json_string(document).into_bytes());
            put("module.yaml", canonical::yaml_string(document).into_bytes());
            each_path(document, &mut |path| {
                let parent = root.parent().expect("a folder above");
                let file = parent.join(path);
                std::fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
                let bytes = match path.rsplit('.').next() {
                    Some("glb") => glb(&corners(), None),
                    Some("obj") => obj(&corners(), None),
                    Some("dae") => dae(&corners()),
                    _ => stl(&corners()),
                };
                std::fs::write(file, bytes).expect("a file");
            });
        }
    }
}

/// COLLADA: one geometry on one node.
fn dae(corners: &[Point; 8]) -> Vec<u8> {
    let numbers: Vec<String> = corners.as_flattened().iter().map(f64::to_string).collect();
    let indices: Vec<String> = TRIANGLES.as_flattened().iter().map(u16::to_string).collect();
    let (numbers, indices) = (numbers.join(" "), indices.join(" "));
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="finger"><mesh>
<source id="p"><float_array id="a" count="24">{numbers}</float_array>
<technique_common><accessor source="#a" count="8" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#finger"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"##
    )
    .into_bytes()
}

fn each_path(value: &Value, take: &mut impl FnMut(&str)) {
    match value {
        Value::String(text) if text.contains("/mesh_modules/") => take(text),
        Value::Array(items) => items.iter().for_each(|item| each_path(item, take)),
        Value::Object(map) => map.values().for_each(|item| each_path(item, take)),
        _ => {}
    }
}
