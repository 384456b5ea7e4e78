//! Cargo does not see new files in the folder that `src/conformance/data.rs` embeds.

fn main() {
    println!("cargo:rerun-if-changed=conformance");
}
