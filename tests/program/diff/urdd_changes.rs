//! Single changes inside the modules of a URDD: each is named, and nothing else is.

use serde_json::{Value, json};

use super::{open, places};
use testkit::fixture::Fixture;
use testkit::folder::Folder;
use urdd::diff::{Side, compare};
use urdd_format::shape_kind::ShapeKind;

struct Bench {
    fixture: Fixture,
    folder: Folder,
    before: Side,
    _kept: tempfile::TempDir,
}

impl Bench {
    fn new() -> Bench {
        let fixture = Fixture::toy();
        let kept = tempfile::tempdir().unwrap();
        fixture.write_to(kept.path());
        Bench {
            before: open(kept.path()),
            fixture,
            folder: Folder::new(),
            _kept: kept,
        }
    }

    /// The places that differ after values of a module are set.
    fn changed(&mut self, module: &str, values: &[(String, Value)]) -> Vec<String> {
        let old: Vec<Value> = values
            .iter()
            .map(|(pointer, _)| self.fixture.get(module, pointer).clone())
            .collect();
        for (pointer, new) in values {
            self.fixture.set(module, pointer, new.clone());
        }
        self.fixture.seal();
        let after = open(self.folder.put(&self.fixture));
        for ((pointer, _), old) in values.iter().zip(old) {
            self.fixture.set(module, pointer, old);
        }
        places(&compare(&self.before, &after))
    }
}

/// Pointers to all numbers below a value.
fn numbers(value: &Value, pointer: &str, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(pointer.to_owned()),
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                numbers(item, &format!("{pointer}/{index}"), found);
            }
        }
        Value::Object(map) => {
            for (key, item) in map {
                numbers(item, &format!("{pointer}/{key}"), found);
            }
        }
        _ => {}
    }
}

#[test]
fn each_number_of_the_robot_is_named_at_its_part() {
    let mut bench = Bench::new();
    let mut pointers = Vec::new();
    let document = bench.fixture.doc("urdf_module").clone();
    numbers(&document, "", &mut pointers);
    let mut count = 0;
    for pointer in &pointers {
        let parts: Vec<&str> = pointer.split('/').collect();
        let (list, index) = (parts[1], parts[2]);
        let name = &document[list][index.parse::<usize>().unwrap()]["name"];
        let prefix = format!("{list}/{}/", name.as_str().unwrap());
        let old = document.pointer(pointer).unwrap().as_f64().unwrap();
        let found = bench.changed("urdf_module", &[(pointer.clone(), json!(old + 0.37))]);
        // The bounds of the module do not follow from the joint any more: they stay, which is no difference.
        let is_limit = pointer.contains("/limit/");
        let others: Vec<&String> = found.iter().filter(|it| !it.starts_with(&prefix)).collect();
        let same_direction = pointer.contains("/axis/") && found.is_empty();
        assert!(
            others.is_empty(),
            "{pointer} (limit: {is_limit}): {found:?}"
        );
        assert!(found.len() == 1 || same_direction, "{pointer}: {found:?}");
        count += 1;
    }
    println!("{count} numbers");
    assert!(count > 150, "{count}");
}

#[test]
fn each_bound_is_named_at_its_dof() {
    let mut bench = Bench::new();
    let names: Vec<String> = bench.fixture.doc("dof_module")["dofs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|dof| dof["name"].as_str().unwrap().to_owned())
        .collect();
    let mut count = 0;
    for (index, name) in names.iter().enumerate() {
        for (pointer, field) in [
            (format!("/bounds/{index}/0"), "lower"),
            (format!("/bounds/{index}/1"), "upper"),
            (format!("/dof_lower_bounds/{index}"), "lower"),
            (format!("/dof_upper_bounds/{index}"), "upper"),
            (format!("/dof_velocity_limits/{index}"), "velocity limit"),
            (format!("/dof_effort_limits/{index}"), "effort limit"),
        ] {
            let found = bench.changed("bounds_module", &[(pointer.clone(), json!(0.123))]);
            assert_eq!(found, [format!("dofs/{name}/{field}")], "{pointer}");
            count += 1;
        }
        let pointer = format!("/dof_limited/{index}");
        let old = bench
            .fixture
            .get("bounds_module", &pointer)
            .as_bool()
            .unwrap();
        let found = bench.changed("bounds_module", &[(pointer, json!(!old))]);
        assert_eq!(found, [format!("dofs/{name}/limited")]);
        count += 1;
    }
    println!("{count} bounds");
    assert!(count > 70, "{count}");
}

#[test]
fn each_pair_that_is_checked_or_skipped_is_named_with_its_kind() {
    let mut bench = Bench::new();
    let module = "link_shapes_skips_module";
    let document = bench.fixture.doc(module).clone();
    let urdf = bench.fixture.doc("urdf_module").clone();
    let link = |index: &Value| {
        let index = usize::try_from(index.as_u64().unwrap()).unwrap();
        urdf["links"][index]["name"].as_str().unwrap().to_owned()
    };
    let mut count = 0;
    for kind in ShapeKind::ALL {
        let key = format!("{}_skips", kind.key());
        let rows = document[&key].as_array().unwrap();
        for i in 0..rows.len() {
            // Of pieces there are many pairs.
            let step = if kind.is_of_links() { 1 } else { 3 };
            for j in (i + 1..rows.len()).step_by(step) {
                let [a, b] = [i, j].map(|shape| match kind.is_of_links() {
                    true => link(&document["full_shapes"][shape]),
                    false => link(&document["decomposition_shapes"][shape]["link_idx"]),
                });
                let old = rows[i][j].as_bool().unwrap();
                let at = |i: usize, j: usize| (format!("/{key}/{i}/{j}"), json!(!old));
                let found = bench.changed(module, &[at(i, j), at(j, i)]);
                assert_eq!(found.len(), 1, "{key} {i} {j}: {found:?}");
                let [gained, lost, pieces] = ["gained", "lost", "pieces"]
                    .map(|word| format!("pairs/{a}-{b}/{word}/{}", kind.name()));
                let is_right = found[0] == pieces || found[0] == if old { gained } else { lost };
                assert!(is_right, "{key} {i} {j}: {found:?}");
                count += 1;
            }
        }
    }
    println!("{count} pairs");
    assert!(count > 200, "{count}");
}

#[test]
fn each_number_of_a_derived_module_is_named_by_its_module() {
    let mut bench = Bench::new();
    let mut count = 0;
    for module in [
        "chain_module",
        "connections_module",
        "kinematics_samples_module",
        "convex_hull_meshes_module",
        "link_shapes_approximations_module",
        "link_shapes_max_distance_from_origin_module",
        "link_shapes_distance_statistics_module",
        "link_shapes_simple_skips_module",
    ] {
        let mut pointers = Vec::new();
        let document = bench.fixture.doc(module).clone();
        numbers(&document, "", &mut pointers);
        let step = pointers.len().div_ceil(40);
        for pointer in pointers.iter().step_by(step.max(1)) {
            let old = document.pointer(pointer).unwrap();
            let new = match old.as_u64() {
                Some(old) => json!(old + 1),
                None => json!(old.as_f64().unwrap() + 0.37),
            };
            let found = bench.changed(module, &[(pointer.clone(), new)]);
            assert_eq!(found, [format!("modules/{module}/changed")], "{pointer}");
            count += 1;
        }
    }
    println!("{count} numbers");
    assert!(count > 150, "{count}");
}

#[test]
fn a_module_that_is_gone_is_named() {
    let mut bench = Bench::new();
    bench.fixture.remove_module("kinematics_samples_module");
    bench.fixture.seal();
    let after = open(bench.folder.put(&bench.fixture));
    assert_eq!(
        places(&compare(&bench.before, &after)),
        ["modules/kinematics_samples_module/removed"]
    );
    assert_eq!(
        places(&compare(&after, &bench.before)),
        ["modules/kinematics_samples_module/added"]
    );
}
