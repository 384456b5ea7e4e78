//! The static site, and what a user adds to it.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use sha2::{Digest, Sha256};
use testkit::files::below;
use testkit::robots::made_named;
use testkit::site::{OF_A_PERSON, json, listed, named, put, robot_files};
use urdd_directory::cancellation::Cancellation;
use urdd_format::hexadecimal::hexadecimal;
use urdd_view::{Collection, ExportError, export};

pub fn collection(path: &Path) -> Collection {
    let collection = Collection::default();
    collection.add(path).expect("a URDD");
    collection
}

fn exported(path: &Path, site: &Path) -> Result<Vec<PathBuf>, ExportError> {
    export(&collection(path), site, None, &Cancellation::default(), &mut |_| {})
}

#[test]
fn a_site_holds_what_urdd_json_lists_and_nothing_else() {
    let (folder, path) = made_named("welding_arm");
    let secrets = [
        (".env", "SECRET"),
        (".git/config", "SECRET"),
        ("notes.txt~", "SECRET"),
        ("dof_module/evil.html", "<script>SECRET</script>"),
        ("mesh_modules/evil.svg", "SECRET"),
        ("x_a_b_module/private", "SECRET"),
    ];
    let before = listed(&path);
    put(&path, &secrets);
    let site = folder.path().join("site");
    assert_eq!(exported(&path, &site).expect("written"), Vec::<PathBuf>::new());
    assert_eq!(robot_files(&site), before);
    for (name, bytes) in below(&site) {
        let is_page = ["html", "js", "css", "wasm"].iter().any(|end| name.ends_with(end));
        if is_page {
            continue;
        }
        let is_inert = ["bin", "json", "png"].iter().any(|end| name.ends_with(end));
        assert!(is_inert, "{name}");
        let text = String::from_utf8_lossy(&bytes);
        for (secret, content) in secrets {
            assert!(!text.contains(content), "{name} holds {secret}");
            assert!(!text.contains(secret), "{name} names {secret}");
        }
    }
    let page = fs::read_to_string(site.join("index.html")).expect("a page");
    assert!(page.contains(r#"content="static""#) && page.contains("default-src 'none'"), "{page}");
    let names = named(&site);
    assert!(page.contains(&format!("src=\"{}\"", names["app.js"])), "{page}");
    assert!(fs::read(site.join(&names["urdd.wasm"])).expect("it").starts_with(b"\0asm"));
    let robots = json(&site.join(&names["robots.json"]));
    assert_eq!(robots[0]["verdict"], "pass");
    assert_eq!((&robots[0]["links"], &robots[0]["writable"]), (&9.into(), &false.into()));
    let report = json(&site.join(robots[0]["report"].as_str().expect("a report")));
    assert_eq!(report["urdds"][0]["findings"], Value::from(Vec::<Value>::new()));
}

/// A listed SVG or HTML file keeps its content, and a server that derives types from names does not serve it as
/// anything that runs.
#[test]
fn a_listed_file_that_browsers_run_is_inert() {
    let (folder, path) = made_named("gripper");
    let evil = "<svg xmlns='http://www.w3.org/2000/svg'><script>alert(1)</script></svg>";
    put(&path, &[("dof_module/evil.svg", evil), ("dof_module/evil.html", evil)]);
    let mut metadata = json(&path.join("urdd.json"));
    for module in metadata["modules"].as_array_mut().expect("modules") {
        if module["path"] == "dof_module" {
            let files = module["files"].as_array_mut().expect("files");
            for name in ["dof_module/evil.html", "dof_module/evil.svg"] {
                files.push(serde_json::json!({ "path": name, "size": 0, "sha256": "0" }));
            }
        }
    }
    fs::write(path.join("urdd.json"), metadata.to_string()).expect("written");
    let site = folder.path().join("site");
    exported(&path, &site).expect("written");
    assert_eq!(robot_files(&site)["dof_module/evil.svg"], evil.as_bytes());
    for (name, bytes) in below(&site) {
        if String::from_utf8_lossy(&bytes).contains("alert(1)") {
            assert!(name.ends_with(".bin"), "{name}");
        }
    }
}

/// `urdd.json` is untrusted: naming a user's private file in it does not publish the file.
#[test]
fn urdd_json_cannot_name_files_outside_of_modules() {
    let (folder, path) = made_named("gripper");
    put(&path, &[(".env", "SECRET"), (".git/config", "SECRET")]);
    #[cfg(unix)]
    std::os::unix::fs::symlink("../.env", path.join("dof_module/link")).expect("a link");
    let mut metadata = json(&path.join("urdd.json"));
    let paths = [".env", ".git/config", "dof_module/link", "../gripper/.env"];
    let files = paths.map(|path| serde_json::json!({ "path": path, "size": 6, "sha256": "0" }));
    metadata["source"]["Urdf"] = files[0].clone();
    metadata["modules"][0]["path"] = ".git".into();
    metadata["modules"][0]["files"] = files.to_vec().into();
    fs::write(path.join("urdd.json"), metadata.to_string()).expect("written");
    let site = folder.path().join("site");
    exported(&path, &site).expect("written");
    for (name, bytes) in below(&site) {
        assert!(!String::from_utf8_lossy(&bytes).contains("SECRET"), "{name}");
    }
    let server = super::asking::Running::on(&path);
    for name in [".env", ".git/config", "dof_module/link"] {
        let answer = server.get(&format!("/robots/gripper/files/{name}"));
        assert_eq!(answer.status, 404, "{name}");
    }
}

/// For a URDD from before urdd.json: documents, the files that they name, and the URDF.
#[test]
fn a_urdd_without_urdd_json_has_the_files_that_its_modules_name() {
    let (folder, path) = made_named("gripper");
    let mut expected = listed(&path);
    expected.remove("urdd.json");
    fs::remove_file(path.join("urdd.json")).expect("removed");
    put(&path, &[(".env", "SECRET"), ("dof_module/notes.txt", "SECRET"), ("a/b.urdf", "SECRET")]);
    let site = folder.path().join("site");
    exported(&path, &site).expect("written");
    assert_eq!(robot_files(&site).keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
}

#[test]
fn a_second_export_replaces_its_own_files_alone() {
    let (folder, path) = made_named("gripper");
    let site = folder.path().join("site");
    exported(&path, &site).expect("written");
    let first = below(&site);
    put(&site, OF_A_PERSON);
    // The same robot again: nothing changes.
    exported(&path, &site).expect("written");
    let mut expected = first.clone();
    expected.extend(
        OF_A_PERSON.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec())),
    );
    assert_eq!(below(&site), expected);
    // Another robot: its files replace the old ones, and a user's files are unchanged.
    let (_other, other) = made_named("welding_arm");
    exported(&other, &site).expect("written");
    assert_eq!(robot_files(&site), listed(&other));
    let (_fresh, fresh) = (testkit::temporary::folder(), folder.path().join("fresh"));
    exported(&other, &fresh).expect("written");
    let mut expected = below(&fresh);
    expected.extend(
        OF_A_PERSON.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec())),
    );
    assert_eq!(below(&site), expected);
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 3, "nothing beside it");
}

#[test]
fn a_file_of_a_persons_in_the_way_stops_the_export() {
    let (folder, path) = made_named("gripper");
    let site = folder.path().join("site");
    exported(&path, &site).expect("written");
    let (_other, other) = made_named("welding_arm");
    let page = site.join("index.html");
    let text = fs::read_to_string(&page).expect("a page");
    fs::write(&page, format!("{text}<p>mine</p>")).expect("written");
    let before = below(&site);
    match exported(&other, &site) {
        Err(ExportError::InTheWay(files)) => assert_eq!(files.len(), 1, "{files:?}"),
        other => panic!("{other:?}"),
    }
    assert_eq!(below(&site), before, "nothing was changed");
    fs::write(&page, text).expect("written");
    // A file that is no longer needed, but was changed: it is kept, and a message names it.
    let is_own =
        |bytes: &[u8]| String::from_utf8_lossy(bytes).contains("\"robot_name\": \"gripper\"");
    let mut own = before.iter().filter(|(_, bytes)| is_own(bytes));
    let changed = site.join(own.next().expect("urdd.json").0);
    fs::write(&changed, "mine").expect("written");
    let stay = exported(&other, &site).expect("written");
    let place = changed.canonicalize().expect("it stays");
    assert_eq!(stay, [place]);
    assert_eq!(fs::read_to_string(&changed).expect("it"), "mine");
    assert_eq!(robot_files(&site), listed(&other));
}

#[cfg(unix)]
#[test]
fn a_list_of_somebody_elses_removes_nothing() {
    let (folder, path) = made_named("gripper");
    let site = folder.path().join("site");
    exported(&path, &site).expect("written");
    put(&site, OF_A_PERSON);
    put(folder.path(), &[("outside", "mine")]);
    let hash = hexadecimal(&Sha256::digest("mine"));
    let mut list = json(&site.join("urdd-site.json"));
    for name in ["robots/notes.txt", "../outside", "CNAME", "urdd-site/../robots/notes.txt"] {
        let entry = serde_json::json!({ "path": name, "sha256": hash });
        list["files"].as_array_mut().expect("files").push(entry);
    }
    fs::write(site.join("urdd-site.json"), list.to_string()).expect("written");
    exported(&path, &site).expect("written");
    for (name, text) in OF_A_PERSON {
        assert_eq!(fs::read_to_string(site.join(name)).expect(name), *text);
    }
    assert!(folder.path().join("outside").is_file());
    // A link in place of the folder leads elsewhere.
    let elsewhere = folder.path().join("elsewhere");
    fs::rename(site.join("urdd-site"), &elsewhere).expect("moved");
    std::os::unix::fs::symlink(&elsewhere, site.join("urdd-site")).expect("a link");
    let before = below(&elsewhere);
    let result = exported(&path, &site);
    assert!(matches!(result, Err(ExportError::InTheWay { .. })), "{result:?}");
    assert_eq!(below(&elsewhere), before);
}

/// 0.2.0 kept no list, so the user's files cannot be told apart.
#[test]
fn a_site_of_0_2_0_is_left_alone_until_its_files_are_gone() {
    let (folder, path) = made_named("gripper");
    let site = folder.path().join("site");
    let mark = r#"{"made by":"urdd view --export","version":"0.2.0"}"#;
    put(&site, &[("urdd-site.json", mark), ("index.html", "old"), ("robots.json", "[]")]);
    put(&site, &[("robots/gripper/files/.env", "old"), ("CNAME", "mine")]);
    let before = below(&site);
    let error = exported(&path, &site).expect_err("refused");
    assert!(matches!(error, ExportError::Unlisted { .. }), "{error}");
    let words = error.to_string();
    for name in ["index.html", "robots.json", "robots"] {
        assert!(words.contains(&site.join(name).display().to_string()), "{words}");
    }
    assert_eq!(below(&site), before);
    for name in ["index.html", "robots.json"] {
        fs::remove_file(site.join(name)).expect("removed");
    }
    fs::remove_dir_all(site.join("robots")).expect("removed");
    exported(&path, &site).expect("written");
    assert_eq!(fs::read_to_string(site.join("CNAME")).expect("it"), "mine");
    assert_eq!(robot_files(&site), listed(&path));
}

#[test]
fn a_folder_with_something_else_is_left_alone() {
    let (folder, path) = made_named("gripper");
    let site = folder.path().join("site");
    for files in [&[("mine", "mine")][..], &[("urdd-site.json", "{}")]] {
        put(&site, files);
        let before = below(&site);
        let result = exported(&path, &site);
        assert!(matches!(result, Err(ExportError::Occupied(_))), "{result:?}");
        assert_eq!(below(&site), before);
    }
}
