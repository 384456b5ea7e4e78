use urdd_validate::code::Code::{self, *};

use crate::{Case, invalid, near_miss};
use testkit::fixture::{Fixture, ROOT};

const FILE: &str = "kinematics_samples_module/module.json";

/// Changes the text of a file as it is sealed.
pub fn edit_text(f: &mut Fixture, file: &str, change: impl Fn(Vec<u8>) -> Vec<u8>) {
    f.seal();
    let bytes = f.file(file).to_vec();
    f.put_file(file, change(bytes));
}

pub fn replaced(bytes: Vec<u8>, from: &str, to: &str) -> Vec<u8> {
    let text = String::from_utf8(bytes).expect("UTF-8");
    assert!(text.contains(from), "{from:?} is not in the text");
    text.replacen(from, to, 1).into_bytes()
}

fn replace(code: Code, name: &'static str, from: &'static str, to: &'static str) -> Case {
    invalid(code, name, move |f| {
        edit_text(f, FILE, |bytes| replaced(bytes, from, to));
    })
}

fn nested(depth: usize) -> String {
    format!("\"x_deep\": {}1{}, \"samples\"", "[".repeat(depth), "]".repeat(depth))
}

pub fn cases() -> Vec<Case> {
    vec![
        invalid(JSN001, "cut-off", |f| {
            edit_text(f, FILE, |bytes| bytes[..bytes.len() / 2].to_vec());
        }),
        invalid(JSN001, "empty", |f| f.put_file(FILE, Vec::new())),
        invalid(JSN001, "root-metadata-cut-off", |f| {
            edit_text(f, ROOT, |bytes| bytes[..bytes.len() / 2].to_vec());
        }),
        replace(JSN001, "comment", "\"samples\"", "/* samples */ \"samples\""),
        near_miss(JSN001, "another-layout", |f| {
            edit_text(f, FILE, |bytes| {
                let text = String::from_utf8(bytes).expect("UTF-8");
                text.replace('\n', " \t\r\n").into_bytes()
            });
        }),
        replace(
            JSN001,
            "half-a-surrogate-pair",
            "\"samples\"",
            "\"x_a\": \"\\ud83e\", \"samples\"",
        ),
        replace(
            JSN002,
            "same-value",
            "\"kind\": \"Zero\",",
            "\"kind\": \"Zero\", \"kind\": \"Zero\",",
        ),
        near_miss(JSN002, "same-key-in-another-object", |f| {
            f.set("kinematics_samples_module", "/x_a", serde_json::json!({"samples": 1}));
        }),
        invalid(JSN003, "latin-1", |f| {
            edit_text(f, FILE, |mut bytes| {
                let at = bytes.iter().position(|b| *b == b'"').expect("a quote");
                bytes.insert(at + 1, 0xE4);
                bytes
            });
        }),
        near_miss(JSN003, "beyond-ascii", |f| {
            f.set("kinematics_samples_module", "/x_ä", serde_json::json!("\u{1F916}"));
        }),
        invalid(JSN004, "mark", |f| {
            edit_text(f, FILE, |bytes| [b"\xEF\xBB\xBF".to_vec(), bytes].concat());
        }),
        near_miss(JSN004, "within-a-string", |f| {
            f.set("kinematics_samples_module", "/x_a", serde_json::json!("a\u{FEFF}b"));
        }),
        replace(JSN005, "nan", "\"samples\"", "\"x_a\": NaN, \"samples\""),
        replace(JSN005, "too-large", "\"samples\"", "\"x_a\": 1e999, \"samples\""),
        // The middle between the largest number and 2^1024 is 1.79769313486231581e308.
        replace(
            JSN005,
            "just-beyond-binary64",
            "\"samples\"",
            "\"x_a\": 1.7976931348623159e308, \"samples\"",
        ),
        near_miss(JSN005, "largest", |f| {
            f.set("kinematics_samples_module", "/x_a", serde_json::json!(f64::MAX));
        }),
        invalid(JSN006, "one-hundred-and-one", |f| {
            edit_text(f, FILE, |bytes| replaced(bytes, "\"samples\"", &nested(100)));
        }),
        near_miss(JSN006, "one-hundred", |f| {
            let mut deep = serde_json::json!(1);
            for _ in 0..99 {
                deep = serde_json::json!([deep]);
            }
            f.set("kinematics_samples_module", "/x_deep", deep);
        }),
    ]
}
