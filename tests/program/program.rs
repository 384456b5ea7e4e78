//! `urdd` as a program.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Runs it in a folder.
pub fn output(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(arguments)
        .env("TMPDIR", testkit::temporary::place())
        .current_dir(folder)
        .output()
        .expect("the program")
}

/// Runs it in a folder: its status, and its standard output and standard error.
pub fn urdd(arguments: &[&str], folder: &Path) -> (i32, String, String) {
    let output = output(arguments, folder);
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("a status"), text(output.stdout), text(output.stderr))
}

/// As [`urdd`], with bytes on its standard input.
pub fn urdd_with_input(arguments: &[&str], folder: &Path, input: &[u8]) -> (i32, String, String) {
    let mut process = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(arguments)
        .env("TMPDIR", testkit::temporary::place())
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program");
    process.stdin.take().expect("its input").write_all(input).expect("read by the program");
    let output = process.wait_with_output().expect("its end");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("a status"), text(output.stdout), text(output.stderr))
}
