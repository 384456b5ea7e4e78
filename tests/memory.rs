//! Memory use by input size: the multiples that docs/security.md states, enforced by a system limit.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]
#![cfg(target_os = "linux")]

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Bytes that the program and its threads use without an input.
const OWN: usize = 64 << 20;

/// Runs the program with its data limited to this many bytes.
fn urdd(limit: usize, arguments: &[&str], folder: &Path) -> Output {
    let kibibytes = limit / 1024;
    Command::new("sh")
        .args(["-c", &format!("ulimit -d {kibibytes} && exec \"$@\""), "sh"])
        .arg(env!("CARGO_BIN_EXE_urdd"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// Asserts that a run exits with this status when its memory is limited to this multiple of the input.
fn assert_within(multiple: usize, size: usize, status: i32, arguments: &[&str], folder: &Path) {
    let output = urdd(OWN + multiple * size, arguments, folder);
    assert_eq!(output.status.code(), Some(status), "{arguments:?}, {size} bytes: {output:?}");
}

#[test]
fn documents_take_a_stated_multiple_of_memory() {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("r.urdf"), "<robot name=\"r\"><link name=\"a\"/></robot>")
        .unwrap();
    let made = ["generate", "--modules", "core", "-o", "r", "r.urdf"];
    assert_within(0, 0, 0, &made, folder.path());
    let nested = "[".repeat(80) + &"]".repeat(80);
    let list = |element: &str| {
        format!("[{}0]", format!("{element},").repeat(2_000_000 / (element.len() + 1)))
    };
    for (multiple, file, text) in [
        (200, "module.json", list(&nested)),
        (200, "module.json", list("{\"\":0}")),
        (200, "module.json", list("[]")),
        (40, "module.json", list("0.25")),
        (200, "module.yaml", list("[]")),
        (200, "module.yaml", list("a")),
        (10, "module.yaml", "- 0.25\n".repeat(300_000)),
    ] {
        let path = folder.path().join("r/urdf_module").join(file);
        let before = fs::read(&path).unwrap();
        fs::write(&path, &text).unwrap();
        assert_within(multiple, text.len(), 1, &["validate", "r"], folder.path());
        assert_within(multiple, text.len(), 0, &["info", "r"], folder.path());
        fs::write(&path, before).unwrap();
    }
}

#[test]
fn a_urdf_takes_a_stated_multiple_of_memory() {
    let folder = testkit::temporary::folder();
    for element in ["<a/>", "<a b=\"c\" d=\"e\"/>", "<!--x-->", "<?a?>"] {
        let many = element.repeat(1_600_000 / element.len());
        let text = format!("<robot name=\"r\"><link name=\"a\"/>{many}</robot>");
        fs::write(folder.path().join("r.urdf"), &text).unwrap();
        assert_within(100, text.len(), 0, &["validate", "r.urdf"], folder.path());
    }
}

#[test]
fn lint_takes_a_stated_multiple_of_memory() {
    let folder = testkit::temporary::folder();
    let long = "x".repeat(40_000);
    let text = |link: &str, inside: &str| {
        format!("<robot name=\"r\"><link name=\"{link}\">{inside}</link></robot>")
    };
    let sphere = "<visual><geometry><sphere radius=\"1\"/></geometry></visual>";
    for text in [
        text(&long, &"<visual/>".repeat(4_000)),
        text(&long, &"<vsual/>".repeat(4_000)),
        text("l", &"<visual/>".repeat(40_000)),
        text("l", &sphere.repeat(4_000)),
        text("l", &"<vsual/>".repeat(90_000)),
        format!("<robot name=\"r\"><link name=\"l\"/>{}</robot>", "<lnk/>".repeat(120_000)),
    ] {
        fs::write(folder.path().join("r.urdf"), &text).unwrap();
        let limit = OWN + 100 * text.len() + (128 << 20);
        let output = urdd(limit, &["lint", "r.urdf", "--format", "json"], folder.path());
        assert_eq!(output.status.code(), Some(0), "{} bytes: {:?}", text.len(), output.stderr);
    }
}

/// What a robot's package says of itself is read beside it.
#[test]
fn a_package_takes_a_stated_multiple_of_memory() {
    let folder = testkit::temporary::folder();
    let mesh =
        "<visual><geometry><mesh filename=\"package://p/meshes/s.stl\"/></geometry></visual>";
    let urdf = format!("<robot name=\"r\"><link name=\"l\">{mesh}</link></robot>");
    let manifest = "<package><name>p</name></package>";
    let (names, place) = ("a ".repeat(30_000), "x".repeat(60_000));
    let python = format!(
        "name = 'p'\nlong = '{}'\nsetup(data_files=[('share/p/'{}, [{}])])",
        "x".repeat(255),
        " + long".repeat(120),
        "'a',".repeat(600)
    );
    let depends =
        format!("<package><name>p</name>{}</package>", "<depend>q</depend>".repeat(40_000));
    for (file, text) in [
        (
            "CMakeLists.txt",
            format!("project(p)\ninstall(FILES {names} DESTINATION share/p/{place})"),
        ),
        ("setup.py", python),
        ("package.xml", depends),
        ("package.xml", format!("<package><name>{}</name></package>", "p".repeat(900_000))),
    ] {
        fs::write(folder.path().join("package.xml"), manifest).unwrap();
        fs::write(folder.path().join("r.urdf"), &urdf).unwrap();
        fs::write(folder.path().join(file), &text).unwrap();
        let limit = OWN + 100 * (urdf.len() + text.len()) + (64 << 20);
        let made = ["generate", "r.urdf", "-o", "r", "--force", "--modules", "original_meshes"];
        for arguments in [["lint", "r.urdf"].as_slice(), &made] {
            let output = urdd(limit, arguments, folder.path());
            let ended = output.status.code().is_some_and(|status| status < 2);
            assert!(ended, "{file}, {arguments:?}: {output:?}");
        }
        fs::remove_file(folder.path().join(file)).unwrap();
    }
}

#[test]
fn a_mesh_takes_a_stated_multiple_of_memory() {
    let folder = testkit::temporary::folder();
    let urdf = "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"m.obj\"/></geometry></visual></link></robot>";
    fs::write(folder.path().join("r.urdf"), urdf).unwrap();
    // A field of waves, of 200 x 200 squares.
    let side = 200;
    let mut field = String::new();
    for at in 0..side * side {
        let (x, y) = (f64::from(at / side), f64::from(at % side));
        writeln!(field, "v {x} {y} {:.6}", (x * 0.7).sin() + (y * 0.9).cos()).unwrap();
    }
    for at in 1..side * (side - 1) {
        writeln!(field, "f {at} {} {}", at + side, at + 1).unwrap();
    }
    // A polygon that repeats one face: a triangle in four bytes.
    let corners = "1 2 3 ".repeat(60_000);
    let fan = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf {corners}\n");
    for (text, triangles) in [(field, 0), (fan, 180_000)] {
        fs::write(folder.path().join("m.obj"), &text).unwrap();
        let limit = OWN + 200 * text.len() + 600 * triangles;
        for arguments in [["generate", "-o", "out", "r.urdf"].as_slice(), &["validate", "out"]] {
            let output = urdd(limit, arguments, folder.path());
            assert_eq!(output.status.code(), Some(0), "{arguments:?}: {output:?}");
        }
        fs::remove_dir_all(folder.path().join("out")).unwrap();
    }
}

/// An archive's names are stored once, however many folders they name. An archive is in memory once.
#[test]
fn many_levels_take_no_memory() {
    use std::io::Write as _;
    use zip::write::{SimpleFileOptions, ZipWriter};
    let folder = testkit::temporary::folder();
    let file = folder.path().join("a.zip");
    let pack = |entries: &[(String, usize)]| {
        let stored =
            SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
        let mut zip = ZipWriter::new(fs::File::create(&file).unwrap());
        zip.start_file("urdd.json", stored).unwrap();
        zip.write_all(b"{}").unwrap();
        for (name, size) in entries {
            zip.start_file(name.as_str(), stored).unwrap();
            zip.write_all(&vec![b'x'; *size]).unwrap();
        }
        zip.finish().unwrap();
        usize::try_from(fs::metadata(&file).unwrap().len()).unwrap()
    };
    // One name of 32,000 levels in 551 kB: refused.
    let size = pack(&[(["a"; 32_000].join("/"), 420_000)]);
    assert_within(2, size, 2, &["info", "a.zip"], folder.path());
    // Many names at the limit: they are read, and are nothing of a URDD.
    let deep = |k: usize| (format!("{k:04}/{}", ["a"; 2040].join("/")), 1);
    let size = pack(&(0..2_000).map(deep).collect::<Vec<_>>());
    assert_within(3, size, 2, &["info", "a.zip"], folder.path());
    let size = pack(&[("notes".to_owned(), 200 << 20)]);
    assert_within(1, size, 2, &["info", "a.zip"], folder.path());
}
