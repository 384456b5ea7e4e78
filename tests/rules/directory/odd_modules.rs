//! Modules that are listed and unknown, and a link in the place of a file.

use serde_json::json;
use urdd_validate::code::Code::*;

use super::{EXTENSION, VERSION};
use crate::{Case, invalid, near_miss};
use testkit::fixture::{Fixture, ROOT};

/// A module that is neither in the specification nor an extension, with this `VERSION`.
fn add_unknown(f: &mut Fixture, version: &str) {
    f.put_file("gripper_module/VERSION", version);
    f.add_module("gripper_module", json!({"grip": 1}));
}

pub fn cases() -> Vec<Case> {
    vec![
        invalid(DIR006, "ten-digits", |f| f.put_file(VERSION, *b"1.0.1000000000\n")),
        invalid(DIR006, "of-an-unknown-module", |f| add_unknown(f, "abc\n")),
        near_miss(DIR006, "nine-digits-of-an-unknown-module", |f| {
            add_unknown(f, "1.0.100000000\n");
            f.set(ROOT, "/modules/15/version", json!("1.0.100000000"));
        }),
        near_miss(DIR021, "extension-in-a-folder", |f| {
            f.add_module(&format!("tools/{EXTENSION}"), json!({"grip": 1}));
        }),
    ]
}

#[cfg(unix)]
pub fn links() -> Vec<Case> {
    vec![super::on_disk(DIR004, "link-to-nothing", true, |root| {
        let file = root.join("kinematics_samples_module/module.json");
        std::fs::remove_file(&file).expect("removed");
        std::os::unix::fs::symlink("nothing.json", &file).expect("a link");
    })]
}
