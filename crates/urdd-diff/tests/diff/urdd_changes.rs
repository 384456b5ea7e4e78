//! Single changes inside the modules of a URDD: each is named, and nothing else is.

use std::collections::BTreeSet;
use std::fs;

use serde_json::{Value, json};

use super::{few, open, places};
use testkit::fixture::Fixture;
use testkit::repository;
use urdd_diff::{Side, compare};
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_format::shape_kind::ShapeKind;
use urdd_generate::{Selection, Settings, generate};
use urdd_robot::Robot;

struct Bench {
    fixture: Fixture,
    folder: tempfile::TempDir,
    before: Side,
}

impl Bench {
    fn new() -> Bench {
        let mut fixture = Fixture::toy();
        // Reading YAML takes most of the time, and urdd diff does not compare it.
        fixture.files.retain(|path, _| !path.ends_with("/module.yaml"));
        let folder = testkit::temporary::folder();
        let before = folder.path().join("before");
        fixture.write_to(&before);
        fixture.write_to(&folder.path().join("after"));
        Bench { before: open(&before), fixture, folder }
    }

    /// The places that differ after values of a module are set. Hashes of documents stay: they make no
    /// difference.
    fn changed(&self, module: &str, values: &[(String, Value)]) -> Vec<String> {
        let mut document = self.fixture.doc(module).clone();
        for (pointer, new) in values {
            *document.pointer_mut(pointer).unwrap() = new.clone();
        }
        let after = self.folder.path().join("after");
        let path = format!("{}/module.json", self.fixture.folder(module));
        fs::write(after.join(&path), document.to_string()).unwrap();
        let found = places(&compare(&self.before, &open(&after), 0.0).unwrap());
        fs::write(after.join(&path), self.fixture.file(&path)).unwrap();
        found
    }
}

/// The pointer without the indices of lists: those of numbers of the same kind are alike.
fn pattern(pointer: &str) -> String {
    let words = pointer.split('/').map(|word| match word.parse::<usize>() {
        Ok(_) => "*",
        Err(_) => word,
    });
    words.collect::<Vec<_>>().join("/")
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
    let bench = Bench::new();
    let document = bench.fixture.doc("urdf_module").clone();
    let part = |pointer: &str| {
        let words: Vec<&str> = pointer.split('/').collect();
        (words[1].to_owned(), &document[words[1]][words[2].parse::<usize>().unwrap()])
    };
    let mut pointers = Vec::new();
    numbers(&document, "", &mut pointers);
    // The elements of a vector are kinds of their own, and so are joints of another type.
    let few = few(pointers.into_iter().map(|pointer| {
        let last = pointer.rsplit('/').next().unwrap();
        let joint_type = &part(&pointer).1["joint_type"];
        (format!("{} {last} {joint_type}", pattern(&pointer)), pointer)
    }));
    let mut count = 0;
    for pointer in few {
        let (list, part) = part(&pointer);
        let prefix = format!("{list}/{}/", part["name"].as_str().unwrap());
        let old = document.pointer(&pointer).unwrap().as_f64().unwrap();
        // The bounds of the module do not follow from the joint any more: they stay, which is no difference.
        let found = bench.changed("urdf_module", &[(pointer.clone(), json!(old + 0.37))]);
        let others: Vec<&String> = found.iter().filter(|it| !it.starts_with(&prefix)).collect();
        let same_direction = pointer.contains("/axis/") && found.is_empty();
        assert!(others.is_empty(), "{pointer}: {found:?}");
        assert!(found.len() == 1 || same_direction, "{pointer}: {found:?}");
        count += 1;
    }
    println!("{count} numbers");
    assert!(count > 50, "{count}");
}

#[test]
fn each_bound_is_named_at_its_dof() {
    let bench = Bench::new();
    let dofs = bench.fixture.doc("dof_module")["dofs"].clone();
    let dofs = dofs.as_array().unwrap().iter().enumerate();
    let limited = bench.fixture.get("bounds_module", "/dof_limited").clone();
    let few = few(dofs.map(|(index, dof)| {
        let kind = format!("{} {}", dof["quantity"], limited[index]);
        (kind, (index, dof["name"].as_str().unwrap().to_owned()))
    }));
    let mut count = 0;
    for (index, name) in few {
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
        let old = limited[index].as_bool().unwrap();
        let found = bench.changed("bounds_module", &[(pointer, json!(!old))]);
        assert_eq!(found, [format!("dofs/{name}/limited")]);
        count += 1;
    }
    println!("{count} bounds");
    assert!(count >= 10, "{count}");
}

#[test]
fn each_pair_that_is_checked_or_skipped_is_named_with_its_kind() {
    let bench = Bench::new();
    let module = "link_shapes_skips_module";
    let document = bench.fixture.doc(module).clone();
    let urdf = bench.fixture.doc("urdf_module").clone();
    let link = |index: &Value| {
        let index = usize::try_from(index.as_u64().unwrap()).unwrap();
        urdf["links"][index]["name"].as_str().unwrap().to_owned()
    };
    let mut changes = Vec::new();
    for kind in ShapeKind::ALL {
        let key = format!("{}_skips", kind.key());
        let rows = document[&key].as_array().unwrap();
        for (i, row) in rows.iter().enumerate() {
            for (j, skip) in row.as_array().unwrap().iter().enumerate().skip(i + 1) {
                let [a, b] = [i, j].map(|shape| match kind.is_of_links() {
                    true => link(&document["full_shapes"][shape]),
                    false => link(&document["decomposition_shapes"][shape]["link_idx"]),
                });
                let old = skip.as_bool().unwrap();
                let alike = format!("{key} {old} {}", a == b);
                changes.push((alike, (kind, key.clone(), [i, j], [a, b], old)));
            }
        }
    }
    let mut words = BTreeSet::new();
    let mut count = 0;
    for (kind, key, [i, j], [a, b], old) in few(changes) {
        let at = |i: usize, j: usize| (format!("/{key}/{i}/{j}"), json!(!old));
        let found = bench.changed(module, &[at(i, j), at(j, i)]);
        let right = [if old { "gained" } else { "lost" }, "pieces"]
            .into_iter()
            .find(|word| found == [format!("pairs/{a}-{b}/{word}/{}", kind.name())]);
        words.insert(right.unwrap_or_else(|| panic!("{key} {i} {j}: {found:?}")));
        count += 1;
    }
    assert_eq!(Vec::from_iter(words), ["gained", "lost", "pieces"]);
    println!("{count} pairs");
    assert!(count >= 10, "{count}");
}

#[test]
fn each_number_of_a_derived_module_is_named_by_its_module() {
    let bench = Bench::new();
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
        let document = bench.fixture.doc(module).clone();
        let mut pointers = Vec::new();
        numbers(&document, "", &mut pointers);
        for pointer in few(pointers.into_iter().map(|it| (pattern(&it), it))) {
            let old = document.pointer(&pointer).unwrap();
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
    assert!(count > 15, "{count}");
}

#[test]
fn a_module_that_is_gone_is_named() {
    let mut bench = Bench::new();
    bench.fixture.remove_module("kinematics_samples_module");
    bench.fixture.seal();
    let after = bench.folder.path().join("without");
    bench.fixture.write_to(&after);
    let after = open(&after);
    assert_eq!(
        places(&compare(&bench.before, &after, 0.0).unwrap()),
        ["modules/kinematics_samples_module/removed"]
    );
    assert_eq!(
        places(&compare(&after, &bench.before, 0.0).unwrap()),
        ["modules/kinematics_samples_module/added"]
    );
}

#[test]
fn each_named_configuration_is_named_with_the_dofs_that_moved() {
    let folder = testkit::temporary::folder();
    let write = |name: &str, named: &[(&str, f64)]| {
        let path = folder.path().join(name);
        let urdf = repository().join("conformance/robots/gripper.urdf");
        let selection = Selection::parse(["core"]).unwrap();
        let settings = Settings { selection, ..Settings::default() };
        generate(&urdf, &path, &settings, &()).unwrap();
        let edits = named.iter().map(|(name, position)| ConfigurationEdit {
            name: ConfigurationName::new(*name).unwrap(),
            positions: vec![DofPosition { dof_name: "motor".to_owned(), position: *position }],
        });
        let edits: Vec<_> = edits.collect();
        if !edits.is_empty() {
            let robot = Robot::open(&path).unwrap();
            for (file, bytes) in robot.with_named_configurations(&edits).unwrap().files {
                let file = path.join(file);
                fs::create_dir_all(file.parent().unwrap()).unwrap();
                fs::write(file, bytes).unwrap();
            }
        }
        open(&path)
    };
    let none = write("none", &[]);
    let two = write("two", &[("home", 0.1), ("away", 0.0)]);
    let other = write("other", &[("home", 0.2), ("ready", 0.0)]);
    let report = compare(&two, &other, 0.0).unwrap();
    let expected =
        ["configurations/home/motor", "configurations/away/removed", "configurations/ready/added"];
    assert_eq!(places(&report), expected);
    let [home, ..] = report.configurations.as_deref().unwrap() else {
        panic!("none differ");
    };
    let change = &home.changes[0];
    assert_eq!(
        (change.before.as_deref(), change.after.as_deref(), &*change.unit),
        (Some("0.1"), Some("0.2"), "rad")
    );
    assert!(!report.same && compare(&two, &two, 0.0).unwrap().same);
    // Within the tolerance they are equal.
    let near = compare(&two, &other, 0.11).unwrap();
    assert_eq!(places(&near), expected[1..]);
    assert!(near.notes.iter().any(|note| note.contains("at most 0.11")));
    // The module is new as well where a robot had none.
    let news = [
        "configurations/home/added",
        "configurations/away/added",
        "modules/named_configurations_module/added",
    ];
    assert_eq!(places(&compare(&none, &two, 0.0).unwrap()), news);
}
