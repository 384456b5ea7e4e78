//! URDDs in zip archives (SPEC 2.14).

use urdd_conformance::archive::Packed;
use urdd_validate::code::Code::*;

use crate::{Case, invalid, near_miss};
use testkit::fixture::ROOT;

fn packed(packed: Packed, case: Case) -> Case {
    Case { packed: Some(packed), ..case }
}

pub fn cases() -> Vec<Case> {
    vec![
        packed(Packed::AtRoot, near_miss(DIR001, "packed", |_| {})),
        packed(Packed::InFolder, near_miss(DIR001, "packed-in-a-folder", |_| {})),
        // The folders of modules say where it is.
        packed(
            Packed::InFolder,
            invalid(DIR001, "packed-without-urdd-json", |f| {
                f.remove_file(ROOT);
            }),
        ),
        packed(
            Packed::AtRoot,
            invalid(DIR014, "packed-with-another-hash", |f| {
                f.put_file("dof_module/notes.txt", *b"hello\n");
                f.list("dof_module/notes.txt");
                f.seal();
                f.keep_hashes();
                f.put_file("dof_module/notes.txt", *b"Hello\n");
            }),
        ),
    ]
}
