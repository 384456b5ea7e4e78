//! The exported suite, for programs in any language.

use std::collections::BTreeSet;
use std::fs;

use serde_json::Value;
use testkit::trials::sample;
use urdd_conformance::export::export;
use urdd_conformance::suite::Case;
use urdd_conformance::tree::Node;

use crate::suite;

#[test]
fn everything_that_is_listed_is_there() {
    let folder = testkit::temporary::folder();
    let out = folder.path().join("suite");
    let mut suite = suite();
    let all = suite.cases.len();
    // The cases that are named below or to be refused, and a few of the others.
    let (named, others): (Vec<Case>, Vec<Case>) = suite.cases.into_iter().partition(|case| {
        ["DOF001/joint-missing", "DIR001/packed-in-a-folder"].contains(&case.id().as_str())
            || ("URD002"..="URD012").contains(&case.code.as_str())
    });
    suite.cases = sample(others, 60).chain(named).collect();
    suite.unreadable.retain(|case| ["empty-folder", "comment"].contains(&case.name.as_str()));
    let written = suite.all_cases().count();
    let exported = export(&suite, &out).expect("an export");
    assert!(written > all / 60 && exported.cases + exported.left_out.len() == written);
    let text = fs::read(out.join("suite.json")).expect("suite.json");
    let list: Value = serde_json::from_slice(&text).expect("JSON");
    let cases = list["cases"].as_array().expect("a list");
    assert_eq!(cases.len(), exported.valid + suite.cases.len() - exported.left_out.len());
    let verdicts = cases.iter().map(|case| case["verdict"].as_str());
    assert!(verdicts.flatten().all(|verdict| ["accept", "reject"].contains(&verdict)));
    assert!(list.get("version").is_none() && cases[0].get("profiles").is_none());
    assert_eq!(exported.valid, 9);
    for case in cases {
        let place = out.join(case["folder"].as_str().expect("a folder"));
        assert!(place.is_dir() || place.extension().is_some_and(|end| end == "zip"), "{case}");
        assert!(place.exists(), "{case}");
    }
    let named = |id: &str| {
        let found = cases.iter().find(|case| case["id"] == id);
        found.unwrap_or_else(|| panic!("no {id}"))
    };
    let valid = named("valid/gripper");
    assert_eq!(valid["verdict"], "accept");
    let meshes = "valid/gripper/mesh_modules/plain_meshes_module/meshes/stl";
    assert!(out.join(meshes).is_dir());
    let wrong = named("DOF001/joint-missing");
    assert_eq!((&wrong["kind"], &wrong["verdict"]), (&"invalid".into(), &"reject".into()));
    assert_eq!(wrong["findings"][0]["code"], "DOF001");
    let packed = named("DIR001/packed-in-a-folder");
    assert_eq!(packed["folder"], "invalid/DIR001/packed-in-a-folder/robot.zip");
    let bytes = fs::read(out.join("invalid/DIR001/packed-in-a-folder/robot.zip"));
    let mut archive = zip::ZipArchive::new(std::io::Cursor::new(bytes.expect("an archive")));
    let archive = archive.as_mut().expect("another reader of zip archives opens it");
    for at in 0..archive.len() {
        let mut entry = archive.by_index(at).expect("an entry");
        std::io::copy(&mut entry, &mut std::io::sink()).expect("its content");
    }
    assert!(archive.by_name("robot/urdd.json").is_ok());
    // The newer list has the same, and what cannot be read.
    let text = fs::read(out.join("suite-1.1.json")).expect("suite-1.1.json");
    let newer: Value = serde_json::from_slice(&text).expect("JSON");
    let newer_cases = newer["cases"].as_array().expect("a list");
    assert_eq!(newer["version"], "1.1");
    assert_eq!(newer_cases.len(), exported.valid + exported.cases);
    for (older, newer) in cases.iter().zip(newer_cases) {
        let mut newer = newer.clone();
        let profiles = newer.as_object_mut().and_then(|case| case.remove("profiles"));
        assert!(profiles.is_some_and(|profiles| profiles.is_array()), "{older}");
        assert_eq!(&newer, older);
    }
    let empty = newer_cases.iter().find(|case| case["id"] == "unreadable/empty-folder");
    let empty = empty.expect("a case about what cannot be read");
    assert_eq!((&empty["verdict"], &empty["code"]), (&"unreadable".into(), &Value::Null));
    assert_eq!(empty["profiles"], serde_json::json!(["core-json", "core", "geometry", "shapes"]));
    let folder = out.join(empty["folder"].as_str().expect("a folder"));
    assert_eq!(fs::read_dir(folder).expect("a folder").count(), 0);
    assert!(out.join("robots/gripper.urdf").is_file());
    assert!(out.join("README.md").is_file());
    for refused in ["KIN001/poses-beyond-numbers", "URD005/link-held-by-two-joints"] {
        assert!(out.join("refused").join(format!("{refused}.urdf")).is_file());
    }
}

/// The README says how much an export is: counted by the bases, which cases change little, in blocks of 4 KiB.
#[test]
fn the_readme_says_how_large_an_export_is() {
    const BLOCK: usize = 4096;
    let suite = suite();
    let (mut files, mut bytes, mut folders) = (0, 0, 0);
    for case in suite.all_cases().filter(|case| case.packed.is_none()) {
        let nodes = &suite.bases[&case.base].nodes;
        let contents = nodes.values().filter_map(|node| match node {
            Node::File(bytes) => Some(bytes.len()),
            Node::Link(_) | Node::Folder => None,
        });
        for size in contents {
            files += 1;
            bytes += size.div_ceil(BLOCK) * BLOCK;
        }
        let paths = nodes.keys().filter_map(|path| path.as_str());
        let parents: BTreeSet<&str> =
            paths.filter_map(|path| Some(path.rsplit_once('/')?.0)).collect();
        folders += parents.len() + 2;
    }
    let (thousands, size) = (files as f64 / 1e3, (bytes + folders * BLOCK) as f64 / 1e9);
    let readme = String::from_utf8_lossy(suite.data.file("README.md").expect("it is there"));
    let stated = |before: &str, after: &str| -> f64 {
        let (_, rest) = readme.split_once(before).unwrap_or_else(|| panic!("no {before:?}"));
        let (number, _) = rest.split_once(after).unwrap_or_else(|| panic!("no {after:?}"));
        number.replace(',', "").parse().expect("a number")
    };
    let (stated_size, stated_files) =
        (stated("with a list (", " GB"), stated("its folders, in ", " small files") / 1e3);
    let near = |stated: f64, found: f64| (stated / found - 1.0).abs() < 0.05;
    assert!(near(stated_size, size), "README.md says {stated_size} GB, and it is {size:.2} GB");
    assert!(
        near(stated_files, thousands),
        "README.md says {stated_files} thousand files, and there are {thousands:.0}"
    );
}
