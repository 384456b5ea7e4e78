//! A file that cannot be taken is called what it is, by each command, and never "not well-formed XML".

use std::fs;

use crate::program::urdd;

#[test]
fn a_file_that_cannot_be_taken_is_called_what_it_is() {
    let stl = [&[0; 80][..], &1_u32.to_le_bytes(), &[0; 50]].concat();
    let files: [(&[u8], &str); 9] = [
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n", "git lfs pull"),
        (b"", "an empty file"),
        (b" \n", "an empty file"),
        (b"PK\x03\x04\x14\0\0\0\0\0", "zip archive"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "a PNG image"),
        (b"solid x\nfacet normal 0 0 1\nendsolid x\n", "a mesh in STL"),
        (&stl, "a mesh in STL"),
        (b"ISO-10303-21;\nHEADER;\n", "a CAD model in STEP"),
        (b"<!DOCTYPE html>\n<html><body>404</body>", "a web page"),
    ];
    let commands: [&[&str]; 10] = [
        &["lint", "FILE"],
        &["validate", "FILE"],
        &["import", "FILE", "-o", "imported"],
        &["generate", "FILE", "-o", "made"],
        &["view", "FILE", "--export", "page.html"],
        &["picture", "FILE", "-o", "new.png"],
        &["diff", "FILE", "FILE"],
        &["info", "FILE"],
        &["export", "srdf", "FILE", "-o", "new.srdf"],
        &["check-collisions", "FILE"],
    ];
    let mut failed = Vec::new();
    for (bytes, wanted) in files {
        for name in ["arm.urdf", "arm.xml", "arm.sdf", "arm.usd", "arm.stl"] {
            let folder = tempfile::tempdir().expect("a folder");
            fs::write(folder.path().join(name), bytes).expect("written");
            for command in commands {
                let arguments: Vec<&str> =
                    command.iter().map(|&word| if word == "FILE" { name } else { word }).collect();
                let (status, out, err) = urdd(&arguments, folder.path());
                let said = out + &err;
                assert_ne!(status, 0, "{arguments:?}: {said}");
                // A USD may be a zip archive.
                if (wanted, name) == ("zip archive", "arm.usd") {
                    continue;
                }
                if !said.contains(wanted) || said.contains("well-formed") {
                    failed.push(format!("{wanted}: {arguments:?}: {said}"));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{} fail:\n{}", failed.len(), failed.join("\n"));
}
