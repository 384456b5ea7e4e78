use serde_json::json;
use urdd_validate::code::Code::{self, *};

use crate::json::{edit_text, replaced};
use crate::{Case, in_folder, invalid, legacy, near_miss};

const FILE: &str = "dof_module/module.yaml";

fn replace(code: Code, name: &'static str, from: &'static str, to: &'static str) -> Case {
    invalid(code, name, move |f| {
        edit_text(f, FILE, |bytes| replaced(bytes, from, to));
    })
}

fn same(code: Code, name: &'static str, from: &'static str, to: &'static str) -> Case {
    near_miss(code, name, move |f| {
        edit_text(f, FILE, |bytes| replaced(bytes, from, to));
    })
}

/// A value of the document whose scalar is written differently in the YAML.
fn written(
    code: Code,
    name: &'static str,
    caught: bool,
    value: serde_json::Value,
    from: &'static str,
    to: &'static str,
) -> Case {
    let change = move |f: &mut testkit::fixture::Fixture| {
        f.set("dof_module", "/x_a", value.clone());
        edit_text(f, FILE, |bytes| replaced(bytes, &format!("x_a: {from}"), &format!("x_a: {to}")));
    };
    match caught {
        true => invalid(code, name, change),
        false => near_miss(code, name, change),
    }
}

pub fn cases() -> Vec<Case> {
    vec![
        replace(YML001, "unclosed", "num_dofs: ", "num_dofs: ["),
        invalid(YML001, "several-documents", |f| {
            edit_text(f, FILE, |bytes| [bytes, b"---\n{}\n".to_vec()].concat());
        }),
        invalid(YML001, "directive", |f| {
            edit_text(f, FILE, |bytes| [b"%YAML 1.1\n---\n".to_vec(), bytes].concat());
        }),
        invalid(YML001, "byte-order-mark", |f| {
            edit_text(f, FILE, |bytes| [b"\xEF\xBB\xBF".to_vec(), bytes].concat());
        }),
        written(
            YML001,
            "escaped-surrogates",
            true,
            json!("\u{1F916}"),
            "\"\u{1F916}\"",
            "\"\\ud83e\\udd16\"",
        ),
        invalid(YML001, "key-that-is-a-number", |f| {
            f.set("dof_module", "/x_a", json!({"1": 2}));
            edit_text(f, FILE, |bytes| replaced(bytes, "\"1\": 2", "1: 2"));
        }),
        written(YML001, "tab-in-a-block-scalar", true, json!("a\tb"), "\"a\\tb\"", "|-\n  a\tb"),
        written(YML001, "tab-in-quotes", false, json!("a\tb"), "\"a\\tb\"", "\"a\tb\""),
        written(
            YML001,
            "tab-in-the-comment-of-a-block-scalar",
            false,
            json!("ab"),
            "ab",
            "|- # a\tb\n  ab",
        ),
        near_miss(YML001, "document-markers", |f| {
            edit_text(f, FILE, |bytes| [b"---\n".to_vec(), bytes, b"...\n".to_vec()].concat());
        }),
        near_miss(YML001, "comments", |f| {
            edit_text(f, FILE, |bytes| [b"# toy\n".to_vec(), bytes, b"# end\n".to_vec()].concat());
        }),
        replace(YML002, "integer-tag", "num_dofs: ", "num_dofs: !!int "),
        same(YML002, "exclamation-mark-in-a-comment", "num_dofs: ", "# !a\nnum_dofs: "),
        replace(YML003, "anchor", "num_dofs: ", "num_dofs: &n "),
        same(YML003, "ampersand-in-a-comment", "num_dofs: ", "# &a *a\nnum_dofs: "),
        replace(YML004, "merge", "num_dofs: ", "<<: {}\nnum_dofs: "),
        near_miss(YML004, "quoted", |f| {
            f.set("dof_module", "/x_a", json!({"<<": 1}));
        }),
        replace(YML005, "same-value", "num_dofs: 18\n", "num_dofs: 18\nnum_dofs: 18\n"),
        near_miss(YML005, "same-key-in-another-mapping", |f| {
            f.set("dof_module", "/x_a", json!({"num_dofs": 1}));
        }),
        invalid(YML006, "exponent-without-sign", |f| {
            f.set("dof_module", "/x_a", json!(1e-7));
            edit_text(f, FILE, |bytes| replaced(bytes, "1.0e-7", "1e-7"));
        }),
        written(YML006, "letter-y", true, json!("y"), "\"y\"", "y"),
        written(YML006, "no-digit-after-a-sign", true, json!(-0.5), "-0.5", "-.5"),
        written(YML006, "octal", true, json!(17), "17", "017"),
        written(YML006, "no-digit-before-the-point", false, json!(0.5), "0.5", ".5"),
        written(YML006, "hexadecimal-number", false, json!(31), "31", "0x1F"),
        written(YML007, "hexadecimal-for-a-string", true, json!("0x1"), "\"0x1\"", "0x1"),
        written(YML006, "underscore", true, json!("1_000"), "\"1_000\"", "1_000"),
        written(YML006, "minutes", true, json!("1:30"), "\"1:30\"", "1:30"),
        written(YML006, "no-in-capitals", true, json!("NO"), "\"NO\"", "NO"),
        written(YML007, "infinity-for-a-string", true, json!(".inf"), "\".inf\"", ".inf"),
        written(YML007, "tilde-for-a-string", true, json!("~"), "\"~\"", "~"),
        written(YML007, "tilde-for-null", false, json!(null), "null", "~"),
        near_miss(YML006, "quoted", |f| {
            f.set(
                "dof_module",
                "/x_a",
                json!(["no", "1:30", "0x1", "1e-7", "2024-01-01", "~", "="]),
            );
        }),
        invalid(YML006, "key-no", |f| {
            f.set("dof_module", "/x_a", json!({"no": 2}));
            edit_text(f, FILE, |bytes| replaced(bytes, "\"no\": 2", "no: 2"));
        }),
        invalid(YML006, "line-separator-in-a-comment", |f| {
            edit_text(f, FILE, |bytes| [bytes, "# a\u{2028}b\n".as_bytes().to_vec()].concat());
        }),
        invalid(YML007, "empty", |f| edit_text(f, FILE, |_| Vec::new())),
        replace(YML007, "stale", "num_dofs: ", "num_dofs: 1"),
        invalid(YML007, "key-missing", |f| {
            f.set("dof_module", "/x_a", json!(1));
            edit_text(f, FILE, |bytes| replaced(bytes, "x_a: 1\n", ""));
        }),
        near_miss(YML007, "another-layout", |f| {
            f.set("dof_module", "/x_a", json!(1.5e22));
            edit_text(f, FILE, |bytes| replaced(bytes, "1.5e+22", "+15000000000000000000000.00"));
        }),
        in_folder(YML007, "legacy", true, |root| {
            legacy::write_legacy(root);
            let file = root.join(FILE);
            let text = std::fs::read(&file).expect("read");
            std::fs::write(&file, replaced(text, "num_dofs: 1", "num_dofs: 2")).expect("written");
        }),
        invalid(YML008, "one-hundred-and-one", |f| {
            let deep = format!("x_a: {}{}\nnum_dofs: ", "[".repeat(100), "]".repeat(100));
            edit_text(f, FILE, |bytes| replaced(bytes, "num_dofs: ", &deep));
        }),
        near_miss(YML008, "one-hundred", |f| {
            let mut deep = json!([]);
            for _ in 0..98 {
                deep = json!([deep]);
            }
            f.set("dof_module", "/x_a", deep);
        }),
        invalid(YML008, "two-hundred", |f| {
            let deep = format!("x_a: {}{}\nnum_dofs: ", "[".repeat(200), "]".repeat(200));
            edit_text(f, FILE, |bytes| replaced(bytes, "num_dofs: ", &deep));
        }),
        near_miss(YML008, "ninety", |f| {
            let mut deep = json!(1);
            for _ in 0..90 {
                deep = json!([deep]);
            }
            f.set("dof_module", "/x_a", deep);
        }),
    ]
}
