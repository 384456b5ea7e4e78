//! Names the shared library after the ABI number, so that a program finds the one that it was linked with.

use std::env::var;
use std::fs::read_to_string;

fn main() {
    println!("cargo:rerun-if-changed=src/lib.rs");
    let is_linux = var("CARGO_CFG_TARGET_OS").is_ok_and(|name| name == "linux");
    let text = read_to_string("src/lib.rs").unwrap_or_default();
    let number = |line: &str| {
        let rest = line.strip_prefix("pub const URDD_ABI_VERSION: u32 = ")?;
        rest.strip_suffix(';').map(str::to_owned)
    };
    if let (true, Some(abi)) = (is_linux, text.lines().find_map(number)) {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,liburdd.so.{abi}");
    }
}
