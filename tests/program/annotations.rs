//! The annotations of the published schemas (SPEC 11.3): every field has those that it needs, and they are true.

mod bases;
mod walk;

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};
use testkit::fixture::Fixture;
use urdd_format::annotations::{self, FRAME, INDEX, KEYWORDS, LENGTH, Thing, UNIT};
use urdd_format::schema::{Subject, Variant};
use urdd_validate::settings::Settings;
use urdd_validate::validate;

use bases::{Urdd, bases};
use walk::{Place, walk};

/// Lists whose length no count of the robot's decides, by schema and key; with `[]`, the lists in them.
const FREE: &[&str] = &[
    "chain_module children_joint_idxs",
    "chain_module children_link_idxs",
    "chain_module kinematic_hierarchy",
    "chain_module kinematic_hierarchy[]",
    "composition_module dropped_joints",
    "composition_module dropped_links",
    "composition_module frozen_joints",
    "composition_module joints",
    "composition_module links",
    // Of the parts of a part.
    "composition_module parts",
    "composition_module position",
    "connections_module joints",
    "connections_module link_connection_paths[][]",
    "connections_module links",
    "dof_module joint_idx_to_dof_idxs_mapping[]",
    "kinematics_samples_module samples",
    "link_shapes_skips_module edits",
    "link_shapes_skips_module skipped_reasons",
    "link_shapes_spheres_module always_pairs",
    "link_shapes_spheres_module ignored_pairs",
    "link_shapes_spheres_module levels",
    "link_shapes_spheres_module sometimes_pairs",
    "link_shapes_spheres_module spheres[]",
    "loops_module closed_samples",
    "loops_module couplings",
    "loops_module independent_dof_idxs",
    "loops_module loops",
    "loops_module terms",
    "named_configurations_module configurations",
    "named_configurations_module positions",
    "original_meshes_module files",
    "original_meshes_module references",
    "original_meshes_module side_files",
    "root_metadata depends_on",
    "root_metadata files",
    "root_metadata modules",
    "self_collision_model_module biases",
    "self_collision_model_module inputs",
    "self_collision_model_module layers",
    "self_collision_model_module other_pairs",
    "self_collision_model_module test_vectors",
    "self_collision_model_module weights",
    "self_collision_model_module weights[]",
    "urdf_module collision",
    "urdf_module materials",
    "urdf_module unknown_elements",
    "urdf_module visual",
];

/// Keys of positions, directions and rotations.
const FRAMED: &[&str] = &[
    "axis",
    "half_extents",
    "inertia",
    "ixx",
    "ixy",
    "ixz",
    "iyy",
    "iyz",
    "izz",
    "length",
    "offset_rpy",
    "offset_xyz",
    "position",
    "quat_xyzw",
    "quaternion_wxyz",
    "radius",
    "rpy",
    "scale",
    "size",
    "xyz",
];
/// Of those: what is no position here.
const NOT_FRAMED: &[&str] = &[
    // Joint values.
    "composition_module position",
    "named_configurations_module position",
    // The sphere's; its centre has a frame.
    "link_shapes_approximations_module radius",
    "link_shapes_spheres_module radius",
];

/// A field, as its schema describes it.
struct Field<'a> {
    subject: Subject,
    key: String,
    schema: &'a Value,
    /// Whether it or what it is in has a unit, a frame.
    unit: bool,
    frame: bool,
}

fn each_field<'a>(
    field: Field<'a>,
    root: &'a Value,
    open: &mut Vec<&'a str>,
    see: &mut impl FnMut(&Field<'a>),
) {
    let has = |keyword: &str| field.schema.get(keyword).is_some();
    let field = Field { unit: field.unit || has(UNIT), frame: field.frame || has(FRAME), ..field };
    see(&field);
    let inside = |key: String, schema: &'a Value| Field {
        subject: field.subject,
        key,
        schema,
        unit: field.unit,
        frame: field.frame,
    };
    if let Some(reference) = field.schema["$ref"].as_str() {
        // A schema within itself: once is enough.
        if !open.contains(&reference) {
            open.push(reference);
            let target = root.pointer(reference.trim_start_matches('#')).expect("a definition");
            each_field(inside(field.key.clone(), target), root, open, see);
            open.pop();
        }
    }
    for keyword in ["allOf", "anyOf", "oneOf"] {
        for schema in field.schema[keyword].as_array().into_iter().flatten() {
            each_field(inside(field.key.clone(), schema), root, open, see);
        }
    }
    if let Some(items) = field.schema.get("items") {
        each_field(inside(format!("{}[]", field.key), items), root, open, see);
    }
    for (key, schema) in field.schema["properties"].as_object().into_iter().flatten() {
        each_field(inside(key.clone(), schema), root, open, see);
    }
}

fn each_field_of_all(mut see: impl FnMut(&Field<'_>)) {
    for subject in Subject::all().filter(|subject| subject.is_version_1()) {
        let schema = subject.schema(Variant::Strict);
        let root =
            Field { subject, key: String::new(), schema: &schema, unit: false, frame: false };
        each_field(root, &schema, &mut Vec::new(), &mut see);
    }
}

fn is(schema: &Value, kind: &str) -> bool {
    let kinds = &schema["type"];
    kinds == kind || kinds.as_array().is_some_and(|kinds| kinds.contains(&json!(kind)))
}

#[test]
fn every_field_says_unit_frame_index_and_length() {
    let mut missing = BTreeSet::new();
    let (mut free, mut unframed) = (BTreeSet::new(), BTreeSet::new());
    let mut seen = 0;
    each_field_of_all(|field| {
        let Field { schema, key, .. } = field;
        let name = format!("{} {key}", field.subject.name());
        let has = |keyword: &str| schema.get(keyword).is_some();
        let mut lacks = |keyword: &str| missing.insert(format!("{name}: {keyword}"));
        if is(schema, "number") && !field.unit {
            lacks(UNIT);
        }
        if is(schema, "integer") && !has(INDEX) && !field.unit {
            lacks("x-index or x-unit");
        }
        if is(schema, "array") && !has(LENGTH) && schema.get("maxItems").is_none() {
            if FREE.contains(&name.as_str()) {
                free.insert(name.clone());
            } else {
                lacks(LENGTH);
            }
        }
        let is_number = is(schema, "number") || is(&schema["items"], "number");
        if is_number && FRAMED.contains(&key.as_str()) && !field.frame {
            if NOT_FRAMED.contains(&name.as_str()) {
                unframed.insert(name.clone());
            } else {
                lacks(FRAME);
            }
        }
        let faults = schema.as_object().map(annotations::faults).unwrap_or_default();
        assert!(faults.is_empty(), "{name}: {faults:?}");
        seen += KEYWORDS.iter().filter(|keyword| has(keyword)).count();
    });
    assert_eq!(missing, BTreeSet::new(), "annotate them in crates/urdd-format/src");
    assert_eq!(free, FREE.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<String>>());
    assert_eq!(
        unframed,
        NOT_FRAMED.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<String>>()
    );
    assert!(seen > 150, "{seen} annotations");
}

#[test]
fn other_schemas_have_none() {
    for subject in Subject::all().filter(|subject| !subject.is_version_1()) {
        let text = subject.text(Variant::Strict);
        for keyword in KEYWORDS {
            assert!(!text.contains(&format!("\"{keyword}\"")), "{}", subject.id());
        }
    }
}

/// The number of each thing that a place may name; `None` where any number is right.
fn numbers(place: &Place, things: &[Thing], urdd: &Urdd) -> Option<Vec<usize>> {
    // What the description alone names has no number.
    let numbers = things.iter().map(|thing| urdd.count(*thing, place.link));
    numbers.collect::<Option<Vec<usize>>>().filter(|numbers| !numbers.is_empty())
}

/// The things that a place names. `other` is for what is inside a part's own composition.
fn of_this_robot(place: &Place) -> Vec<Thing> {
    let is_foreign = place.pointer.contains("/composition/");
    let things = place.things.iter().copied();
    let things = things.filter(|thing| is_foreign || *thing != Thing::Other);
    things.collect()
}

#[test]
fn the_annotations_are_true_of_the_suites_bases() {
    let mut met: BTreeMap<String, usize> = BTreeMap::new();
    let bases = bases();
    assert!(bases.len() > 50, "{} bases", bases.len());
    for urdd in &bases {
        for (subject, document) in &urdd.documents {
            let schema = subject.schema(Variant::Strict);
            for place in walk(&schema, document) {
                let shown =
                    || format!("{} {} {}: {place:?}", urdd.name, subject.name(), place.pointer);
                *met.entry(format!("{} {}", subject.name(), place.schema)).or_default() += 1;
                let Some(numbers) = numbers(&place, &of_this_robot(&place), urdd) else {
                    continue;
                };
                let right = |number: &usize| match place.keyword {
                    INDEX => place.found < *number,
                    _ => place.found == *number,
                };
                assert!(numbers.iter().any(right), "{}, of {numbers:?}", shown());
            }
        }
    }
    // Each annotation was met by data.
    let mut unmet = BTreeSet::new();
    for subject in Subject::all().filter(|subject| subject.is_version_1()) {
        for place in walk::annotated(&subject.schema(Variant::Strict)) {
            let name = format!("{} {place}", subject.name());
            if !met.contains_key(&name) {
                unmet.insert(name);
            }
        }
    }
    assert_eq!(unmet, BTreeSet::new());
}

/// Puts the URDD's own modules beside it, as extensions with the published schemas.
fn as_extensions(urdd: &Urdd, documents: &BTreeMap<&str, Value>) -> BTreeSet<(String, String)> {
    let mut fixture = urdd.fixture.clone().expect("a fixture");
    for (name, document) in documents {
        let subject =
            Subject::all().find(|subject| subject.name() == *name && subject.is_version_1());
        let folder = format!("x_own_{name}");
        let schema = subject.expect("a module").schema(Variant::Strict).to_string();
        fixture.put_file(&format!("{folder}/schema.json"), schema);
        fixture.add_module(&folder, document.clone());
    }
    fixture.canonical = true;
    fixture.seal();
    let folder = testkit::temporary::folder();
    let root = folder.path().join("robot");
    fixture.write_to(&root);
    let run = validate(&[&root], &Settings::default()).expect("something to examine");
    let findings = run.report.urdds.into_iter().flat_map(|urdd| urdd.findings);
    let of_extensions = findings.filter(|finding| finding.code.starts_with("EXT"));
    let mut found = BTreeSet::new();
    for finding in of_extensions {
        // Further places of the same kind are folded into one finding.
        let others = finding.places.into_iter();
        let others = others.map(|place| (place.file, place.pointer));
        for (file, pointer) in others.chain([(finding.file, finding.pointer)]) {
            let place = format!("{} {}", file.unwrap_or_default(), pointer.unwrap_or_default());
            found.insert((finding.code.clone(), place));
        }
    }
    found
}

/// EXT003 and EXT004 find what this test finds, in the modules of the suite's own robots as extensions.
#[test]
fn the_validator_judges_as_this_test_does() {
    for fixture in [Fixture::toy(), testkit::model::fixture()] {
        let urdd = Urdd::of_fixture("toy", fixture);
        let documents: BTreeMap<&str, Value> = (urdd.documents.iter())
            .filter(|(subject, _)| !matches!(subject, Subject::RootMetadata))
            .map(|(subject, document)| (subject.name(), document.clone()))
            .collect();
        assert_eq!(as_extensions(&urdd, &documents), BTreeSet::new());

        for (keyword, code) in [(INDEX, "EXT003"), (LENGTH, "EXT004")] {
            let mut wrong = documents.clone();
            let mut expected = BTreeSet::new();
            for (subject, document) in &urdd.documents {
                let Some(changed) = wrong.get_mut(subject.name()) else {
                    continue;
                };
                let mut places = walk(&subject.schema(Variant::Strict), document);
                let mut of_schema: BTreeMap<String, usize> = BTreeMap::new();
                // What is inside first: pointers stay right.
                places.reverse();
                for place in places.iter().filter(|place| place.keyword == keyword) {
                    // A few of each annotation: a rule stops at a thousand places.
                    let number = of_schema.entry(place.schema.clone()).or_insert(0);
                    *number += 1;
                    if *number > 3 {
                        continue;
                    }
                    let value = changed.pointer_mut(&place.pointer).expect("a value");
                    // A list of pieces may have the length of another link's.
                    let is_sure = !place.things.contains(&Thing::Piece) || keyword == INDEX;
                    let limited = numbers(place, &place.things, &urdd)
                        .is_some_and(|_| place.things != [Thing::Sample]);
                    if !is_sure || !limited {
                        continue;
                    }
                    match value {
                        Value::Array(list) => match list.last().cloned() {
                            Some(last) => list.push(last),
                            None => continue,
                        },
                        value => *value = json!(u32::MAX),
                    }
                    let folder = format!("x_own_{}/module.json", subject.name());
                    expected.insert((code.to_owned(), format!("{folder} {}", place.pointer)));
                }
            }
            // The added last element of a list is a copy, whose own places are as wrong.
            let found: BTreeSet<_> = as_extensions(&urdd, &wrong);
            let others: Vec<_> = found.iter().filter(|(found, _)| found != code).collect();
            assert_eq!(others, Vec::<&(String, String)>::new());
            let missed: Vec<_> = expected.difference(&found).collect();
            assert_eq!(missed, Vec::<&(String, String)>::new());
            assert!(expected.len() > 50, "{} places", expected.len());
        }
    }
}

#[test]
fn the_specification_lists_every_word() {
    let spec =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/SPEC.md")).expect("SPEC.md");
    let begin = spec.find("**11.4 Words.**").expect("11.4");
    let clause = &spec[begin..begin + spec[begin..].find("**11.5**").expect("11.5")];
    let rows = |columns: usize| -> Vec<Vec<String>> {
        let rows = clause.lines().filter(|line| line.starts_with("| `") && !line.contains("`x-"));
        let cells = rows.map(|row| {
            row.split('|').skip(1).map(|cell| cell.trim().trim_matches('`').to_owned()).collect()
        });
        cells.filter(|row: &Vec<String>| row.len() == columns + 1).collect()
    };
    let frames: Vec<String> = rows(2).into_iter().map(|row| row[0].clone()).collect();
    assert_eq!(frames, annotations::FRAMES);
    let things: Vec<(String, String)> =
        rows(4).into_iter().map(|row| (row[0].clone(), row[1].clone())).collect();
    let all = annotations::THINGS.iter();
    let all = all.map(|(thing, ..)| {
        (thing.index().to_owned(), thing.length().unwrap_or_default().to_owned())
    });
    assert_eq!(things, all.collect::<Vec<_>>());
    let symbols = clause.lines().find(|line| line.starts_with("The symbols are")).expect("symbols");
    let symbols: Vec<&str> =
        symbols.split('.').next().unwrap_or_default().split('`').skip(1).step_by(2).collect();
    assert_eq!(symbols, annotations::UNITS);
}
