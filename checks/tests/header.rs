//! The C header is what cbindgen writes from `crates/urdd-c` today. `URDD_UPDATE=1` writes it.

use std::path::Path;

#[test]
fn the_header_is_current() {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/urdd-c"));
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml")).unwrap();
    // It follows the modules of lib.rs.
    let builder = cbindgen::Builder::new().with_config(config).with_src(folder.join("src/lib.rs"));
    let mut written = Vec::new();
    builder.generate().unwrap().write(&mut written);
    let text = String::from_utf8(written).unwrap();
    let header = folder.join("include/urdd.h");
    if std::env::var_os("URDD_UPDATE").is_some() {
        std::fs::create_dir_all(header.parent().unwrap()).unwrap();
        std::fs::write(&header, &text).unwrap();
    }
    let known = std::fs::read_to_string(&header).unwrap_or_default();
    assert!(known == text, "{} is not current: run again with URDD_UPDATE=1", header.display());
}
