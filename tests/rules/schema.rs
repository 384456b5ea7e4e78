use serde_json::json;
use urdd_validate::code::Code::*;

use crate::json::{edit_text, replaced};
use crate::{Case, in_folder, invalid, legacy, near_miss};
use testkit::fixture::ROOT;

pub fn cases() -> Vec<Case> {
    vec![
        invalid(SCH001, "key-missing", |f| {
            f.remove("kinematics_samples_module", "/samples/0/kind");
        }),
        invalid(SCH001, "unknown-key", |f| {
            f.set("dof_module", "/nums_dofs", json!(1));
        }),
        invalid(SCH001, "wrong-type", |f| f.set("dof_module", "/num_dofs", json!("1"))),
        invalid(SCH001, "fraction", |f| f.set("dof_module", "/num_dofs", json!(1.5))),
        invalid(SCH001, "negative-index", |f| {
            f.set("chain_module", "/root_idx", json!(-1));
        }),
        invalid(SCH001, "root-metadata", |f| {
            f.set(ROOT, "/modules/0/files/0/sha256", json!("abc"));
            f.keep_hashes();
        }),
        in_folder(SCH001, "legacy", true, |root| {
            legacy::write_legacy(root);
            let document = json!({"num_dofs": 1});
            legacy::write_module(root, "dof_module", Some("0.0.2"), &document);
        }),
        near_miss(SCH001, "keys-of-ones-own", |f| {
            f.set("dof_module", "/x_acme", json!({"anything": [1, null]}));
            f.set("dof_module", "/dofs/0/x_acme", json!(1));
            f.set("dof_module", "/$schema", json!("dof_module.schema.json"));
            f.set(ROOT, "/x_acme", json!(true));
        }),
        near_miss(SCH001, "integer-with-a-fraction-of-zero", |f| {
            let number = f.get("dof_module", "/num_dofs").as_f64().expect("a number");
            f.set("dof_module", "/num_dofs", json!(number));
        }),
        near_miss(SCH001, "integer-with-an-exponent", |f| {
            edit_text(f, "chain_module/module.json", |bytes| {
                replaced(bytes, "\"root_idx\": 1", "\"root_idx\": 1e0")
            });
        }),
    ]
}
