//! What it may cost to look for files: long names of them, in a part that is included very often, and manifests of models.

use super::bounds::{in_memory, refused};

/// A model that has another one a thousand times.
fn thousand(uri: &str) -> String {
    let include = |at| format!("<include><name>a{at}</name><uri>{uri}</uri></include>");
    let includes: String = (0..1000).map(include).collect();
    format!("<sdf version=\"1.9\"><model name=\"w\"><link name=\"l\"/>{includes}</model></sdf>")
}

#[test]
fn long_names_of_files_are_looked_for_very_often() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let model = "<sdf version=\"1.9\"><model name=\"c\"><link name=\"l\"/></model></sdf>";
    let dots = "./".repeat(30_000);
    let mesh = format!("<mesh><uri>{dots}a.obj</uri></mesh>");
    let link = "<link name=\"l\"/>";
    let include = format!("<include><uri>{dots}c.sdf</uri></include>");
    let visual = format!("<visual name=\"v\"><geometry>{mesh}</geometry></visual>");
    for inside in [format!("{link}{include}"), format!("<link name=\"l\">{visual}</link>")] {
        let part = format!("<sdf version=\"1.9\"><model name=\"b\">{inside}</model></sdf>");
        let files = [
            ("r.sdf", thousand("b.sdf")),
            ("b.sdf", part),
            ("c.sdf", model.to_owned()),
            ("a.obj", obj.to_owned()),
        ];
        let files = files.each_ref().map(|(name, text)| (*name, text.as_bytes()));
        refused("r.sdf", &in_memory(&files));
    }
}

#[test]
fn manifests_are_read_very_often() {
    let model = "<sdf version=\"1.9\"><model name=\"m\"><link name=\"l\"/></model></sdf>";
    let space = " ".repeat(900_000);
    let manifest = format!("<model><sdf version=\"1.9\">m.sdf</sdf>{space}</model>");
    let thousand = thousand("m");
    let files = [
        ("r.sdf", thousand.as_bytes()),
        ("m/m.sdf", model.as_bytes()),
        ("m/model.config", manifest.as_bytes()),
    ];
    refused("r.sdf", &in_memory(&files));
}
