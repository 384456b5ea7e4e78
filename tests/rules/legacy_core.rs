//! LEG004 and LEG006, and the rules of the core modules on legacy URDDs: a small one, whose documents are like those of
//! the published converter.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::{Value, json};
use urdd_directory::canonical;
use urdd_validate::code::Code;
use urdd_validate::code::Code::*;

use crate::{Case, in_folder};

/// A legacy URDD: documents and versions by module.
struct Legacy(BTreeMap<&'static str, (Option<&'static str>, Value)>);

fn joint(name: &str, kind: &str, child: &str, limit: [f64; 4], mimic: Value) -> Value {
    let [lower, upper, effort, velocity] = limit;
    json!({
        "name": name, "joint_type": kind,
        "origin": { "xyz": [0.0, 0.0, 0.1], "rpy": [0.0, 0.0, 0.0] },
        "parent": { "link": "base" }, "child": { "link": child },
        "axis": { "xyz": [0.0, 0.0, 1.0] },
        "limit": { "lower": lower, "upper": upper, "effort": effort, "velocity": velocity },
        "dynamics": null, "mimic": mimic, "safety_controller": null,
    })
}

fn link(name: &str) -> Value {
    json!({
        "name": name,
        "inertial": {
            "origin": { "xyz": [0.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0] },
            "mass": { "value": 1.0 },
            "inertia": { "ixx": 0.1, "ixy": 0.0, "ixz": 0.0, "iyy": 0.1, "iyz": 0.0, "izz": 0.1 },
        },
        "visual": [], "collision": [],
    })
}

impl Legacy {
    /// A base with a turning joint, a locked one, a mimic and a continuous joint with limits.
    fn new() -> Legacy {
        let names = ["base", "a", "b", "c", "d"];
        let follow = json!({ "joint": "turn", "multiplier": -1.0, "offset": null });
        let joints = vec![
            joint("turn", "Revolute", "a", [-1.0, 1.0, 10.0, 2.0], Value::Null),
            joint("locked", "Prismatic", "b", [0.3, 0.3, 10.0, 2.0], Value::Null),
            joint("follow", "Revolute", "c", [-1.0, 1.0, 10.0, 2.0], follow),
            joint("spin", "Continuous", "d", [-3.0, 3.0, 10.0, 2.0], Value::Null),
        ];
        let chain_link = |i: usize| {
            let root = i == 0;
            json!({
                "name": names[i], "link_idx": i,
                "parent_joint_idx": if root { Value::Null } else { json!(i - 1) },
                "parent_link_idx": if root { Value::Null } else { json!(0) },
                "children_joint_idxs": if root { json!([0, 1, 2, 3]) } else { json!([]) },
                "children_link_idxs": if root { json!([4, 3, 2, 1]) } else { json!([]) },
            })
        };
        let chain_joint = |i: usize| {
            json!({
                "joint_name": joints[i]["name"], "joint_idx": i,
                "parent_link_name": "base", "parent_link_idx": 0,
                "child_link_name": names[i + 1], "child_link_idx": i + 1,
            })
        };
        let path = |i: usize, j: usize| match (i, j) {
            (0, _) => json!([j]),
            (i, j) if i == j => json!([i]),
            _ => Value::Null,
        };
        let paths: Vec<Vec<Value>> = (0..5).map(|i| (0..5).map(|j| path(i, j)).collect()).collect();
        let urdf = json!({
            "name": "robot", "links": names.map(link), "joints": &joints, "materials": [],
        });
        let dof = json!({
            "num_dofs": 3,
            "dof_idx_to_joint_idx_mapping": [0, 1, 3],
            "joint_idx_to_dof_idxs_mapping": [[0], [1], [], [2]],
        });
        let chain = json!({
            "links_in_chain": (0..5).map(chain_link).collect::<Vec<_>>(),
            "joints_in_chain": (0..4).map(chain_joint).collect::<Vec<_>>(),
            "kinematic_hierarchy": [[0], [4, 3, 2, 1]],
            "root_idx": 0,
        });
        let bounds = json!({
            "bounds": [[-1.0, 1.0], [0.3, 0.3], [-3.0, 3.0]],
            "dof_lower_bounds": [-1.0, 0.3, -3.0],
            "dof_upper_bounds": [1.0, 0.3, 3.0],
        });
        Legacy(BTreeMap::from([
            ("urdf_module", (Some("0.0.3"), urdf)),
            ("dof_module", (Some("0.0.2"), dof)),
            ("chain_module", (Some("0.0.1"), chain)),
            ("connections_module", (Some("0.0.1"), json!({ "link_connection_paths": paths }))),
            ("bounds_module", (Some("0.0.1"), bounds)),
        ]))
    }

    /// The same, cut out of a robot that has one more link and joint, each second in its list.
    fn adjusted() -> Legacy {
        let mut legacy = Legacy::new();
        let module = json!({
            "name": "robot", "base_robot_name": "whole", "dead_end_link_names": ["gone"],
            "fixed_base_joints": [], "deleted_base_links": ["gone"], "deleted_base_joints": ["off"],
            "adjusted_link_idx_to_base_link_idx_mapping": [0, 2, 3, 4, 5],
            "base_link_idx_to_adjusted_link_idx_mapping": [0, null, 1, 2, 3, 4],
            "adjusted_joint_idx_to_base_joint_idx_mapping": [0, 2, 3, 4],
            "base_joint_idx_to_adjusted_joint_idx_mapping": [0, null, 1, 2, 3],
        });
        legacy.0.insert("adjusted_robot_module", (None, module));
        legacy
    }

    fn set(&mut self, module: &str, pointer: &str, value: Value) {
        let (_, document) = self.0.get_mut(module).expect("a module");
        *document.pointer_mut(pointer).expect("a place") = value;
    }

    /// Bounds of a DOF, in all three places.
    fn bound(&mut self, dof: usize, lower: f64, upper: f64) {
        self.set("bounds_module", &format!("/bounds/{dof}"), json!([lower, upper]));
        self.set("bounds_module", &format!("/dof_lower_bounds/{dof}"), json!(lower));
        self.set("bounds_module", &format!("/dof_upper_bounds/{dof}"), json!(upper));
    }

    fn write_to(&self, root: &Path) {
        for (name, (version, document)) in &self.0 {
            let folder = root.join(name);
            std::fs::create_dir(&folder).expect("a folder");
            let write = |file: &str, bytes: Vec<u8>| {
                std::fs::write(folder.join(file), bytes).expect("a file");
            };
            write("module.json", canonical::json_string(document).into_bytes());
            write("module.yaml", canonical::yaml_string(document).into_bytes());
            if let Some(version) = version {
                write("VERSION", version.as_bytes().to_vec());
            }
        }
    }
}

fn case(
    code: Code,
    name: &'static str,
    caught: bool,
    base: fn() -> Legacy,
    change: fn(&mut Legacy),
) -> Case {
    in_folder(code, name, caught, move |folder| {
        let mut legacy = base();
        change(&mut legacy);
        legacy.write_to(folder);
    })
}

pub fn cases() -> Vec<Case> {
    const ADJUSTED: &str = "adjusted_robot_module";
    let invalid = |code, name, change| case(code, name, true, Legacy::new, change);
    let near_miss = |code, name, change| case(code, name, false, Legacy::new, change);
    vec![
        case(LEG004, "another-link", true, Legacy::adjusted, |l| {
            let pointer = "/adjusted_link_idx_to_base_link_idx_mapping/1";
            l.set(ADJUSTED, pointer, json!(1));
        }),
        case(LEG004, "deleted-joint-kept", true, Legacy::adjusted, |l| {
            let pointer = "/base_joint_idx_to_adjusted_joint_idx_mapping/1";
            l.set(ADJUSTED, pointer, json!(3));
        }),
        case(LEG004, "stale", true, Legacy::adjusted, |l| {
            l.set(ADJUSTED, "/deleted_base_links", json!([]));
        }),
        case(LEG004, "right", false, Legacy::adjusted, |_| {}),
        invalid(LEG006, "locked-and-widened", |l| l.bound(1, 0.3, 0.3 + 1e-7)),
        near_miss(LEG006, "locked-and-equal", |_| {}),
        // What is a defect now was a defect then.
        invalid(BND001, "legacy-stale", |l| {
            l.set("bounds_module", "/bounds", json!([[-1.0, 1.0], [0.3, 0.3]]));
        }),
        invalid(BND003, "legacy-locked-far-off", |l| l.bound(1, 0.3, 0.31)),
        invalid(BND006, "legacy-frozen", |l| {
            l.set("urdf_module", "/joints/3/limit/lower", json!(0.0));
            l.set("urdf_module", "/joints/3/limit/upper", json!(0.0));
            l.bound(2, 0.0, 1e-7);
        }),
        invalid(BND006, "legacy-from-nowhere", |l| l.bound(2, -2.0, 2.0)),
        near_miss(BND006, "legacy-as-version-1", |l| {
            l.bound(2, -std::f64::consts::PI, std::f64::consts::PI);
        }),
        invalid(DOF004, "legacy-mimic-with-a-dof", |l| {
            l.set("dof_module", "/joint_idx_to_dof_idxs_mapping/2", json!([2]));
        }),
        near_miss(DOF004, "legacy-0.0.1-mimics-have-dofs", |l| {
            l.0.insert(
                "dof_module",
                (
                    Some("0.0.1"),
                    json!({
                        "num_dofs": 4,
                        "dof_idx_to_joint_idx_mapping": [0, 1, 2, 3],
                        "joint_idx_to_dof_idxs_mapping": [[0], [1], [2], [3]],
                    }),
                ),
            );
            l.0.insert(
                "bounds_module",
                (
                    Some("0.0.1"),
                    json!({
                        "bounds": [[-1.0, 1.0], [0.3, 0.3], [-1.0, 1.0], [-3.0, 3.0]],
                        "dof_lower_bounds": [-1.0, 0.3, -1.0, -3.0],
                        "dof_upper_bounds": [1.0, 0.3, 1.0, 3.0],
                    }),
                ),
            );
        }),
        invalid(CHN004, "legacy-child-twice", |l| {
            l.set("chain_module", "/links_in_chain/0/children_link_idxs", json!([4, 3, 2, 2]));
        }),
        invalid(CON005, "legacy-path-upwards", |l| {
            l.set("connections_module", "/link_connection_paths/1/0", json!([0]));
        }),
    ]
}
