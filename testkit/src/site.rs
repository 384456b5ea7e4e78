//! The static site of `urdd view --export`, as a browser reads it, and a user's own files in it.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;
use sha2::{Digest, Sha256};
use urdd_format::hexadecimal::hexadecimal;

/// A JSON file.
pub fn json(path: &Path) -> Value {
    let text = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_slice(&text).expect("JSON")
}

/// The files that the page names.
pub fn named(site: &Path) -> BTreeMap<String, String> {
    let page = fs::read_to_string(site.join("index.html")).expect("a page");
    let rest = page.split_once(r#"name="urdd-files" content=""#).expect("names").1;
    let words: Vec<&str> = rest.split_once('"').expect("an end").0.split(' ').collect();
    let pairs = words.chunks(2).map(|pair| (pair[0].to_owned(), pair[1].to_owned()));
    pairs.collect()
}

/// The files of the first robot of a site, by path. Each has the content that its name implies.
pub fn robot_files(site: &Path) -> BTreeMap<String, Vec<u8>> {
    let robots = json(&site.join(&named(site)["robots.json"]));
    let files = json(&site.join(robots[0]["files"].as_str().expect("a list")));
    let mut found = BTreeMap::new();
    for file in files["files"].as_array().expect("a list") {
        let at = file["at"].as_str().expect("a place");
        let bytes = fs::read(site.join(at)).expect(at);
        let hash = hexadecimal(&Sha256::digest(&bytes));
        assert_eq!(at, format!("urdd-site/{hash}.bin"));
        assert_eq!(file["size"], bytes.len());
        found.insert(file["path"].as_str().expect("a path").to_owned(), bytes);
    }
    found
}

/// The paths that urdd.json lists, its own path and that of the source.
pub fn listed(urdd: &Path) -> BTreeMap<String, Vec<u8>> {
    let metadata = json(&urdd.join("urdd.json"));
    let mut paths = vec!["urdd.json".to_owned()];
    let text = |value: &Value| value["path"].as_str().expect("a path").to_owned();
    paths.push(text(&metadata["source"]["Urdf"]));
    for module in metadata["modules"].as_array().expect("modules") {
        paths.extend(module["files"].as_array().expect("files").iter().map(text));
    }
    let read = |path: String| {
        let bytes = fs::read(urdd.join(&path)).expect("a file");
        (path, bytes)
    };
    paths.into_iter().map(read).collect()
}

/// Puts a user's own files into a folder.
pub fn put(folder: &Path, files: &[(&str, &str)]) {
    for (name, text) in files {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("written");
    }
}

/// What a user keeps in the folder of a site.
pub const OF_A_PERSON: &[(&str, &str)] = &[
    ("CNAME", "robots.example"),
    (".git/HEAD", "ref: refs/heads/main\n"),
    ("robots/notes.txt", "mine"),
    ("urdd-site/notes.txt", "mine too"),
    ("news/index.html", "<p>mine</p>"),
];
