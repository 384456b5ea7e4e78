//! Packs the conformance suite into the archive that a release build carries.

#[path = "src/suite/archive.rs"]
mod archive;

fn main() {
    suite();
    println!("cargo:rerun-if-changed=build.rs");
}

/// A debug build gets an empty archive, and reads the folder when it runs.
fn suite() {
    use std::path::PathBuf;

    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    let folder = PathBuf::from(variable("CARGO_MANIFEST_DIR")).join("conformance");
    let release = variable("PROFILE") == "release";
    let bytes = match release {
        true => archive::read_folder(&folder).and_then(|files| archive::pack(&files)),
        false => Ok(Vec::new()),
    };
    let target = PathBuf::from(variable("OUT_DIR")).join("suite.tar.gz");
    #[allow(clippy::disallowed_methods)]
    let written = bytes.and_then(|bytes| std::fs::write(target, bytes));
    if let Err(error) = written {
        println!("cargo:error=the conformance suite cannot be packed: {error}");
    }
    // No path here: two clones may share a target directory, and so what this script says.
    println!("cargo:rustc-check-cfg=cfg(suite_in_repository)");
    match release {
        true => println!("cargo:rerun-if-changed=conformance"),
        false => println!("cargo:rustc-cfg=suite_in_repository"),
    }
    println!("cargo:rerun-if-changed=src/suite/archive.rs");
}
