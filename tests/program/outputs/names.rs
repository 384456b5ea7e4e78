//! Names of robots that no file can have everywhere.

use std::fs;

use super::mjcf;
use crate::program::urdd;

#[test]
fn robots_of_any_name_get_files_of_plain_names() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    let long = "x".repeat(300);
    for (name, file) in [
        ("nul", "_nul".to_owned()),
        ("COM1.v2", "_COM1.v2".to_owned()),
        ("com\u{b9}", "_com\u{b9}".to_owned()),
        ("a&lt;b&gt;?*|", "a_b____".to_owned()),
        (long.as_str(), "x".repeat(228)),
        (&"\u{e9}".repeat(200), "\u{e9}".repeat(114)),
    ] {
        let source = mjcf(1).replace("model=\"r\"", &format!("model=\"{name}\""));
        fs::write(folder.join("r.xml"), source).unwrap();
        let (status, out, said) = urdd(&["import", "r.xml", "-o", "out"], folder);
        assert_eq!(status, 0, "{name}: {said}");
        assert!(out.starts_with(&format!("out/{file}.urdf: ")), "{out}");
        assert!(said.contains(&format!("its files are named after `{file}`")), "{said}");
        for ending in ["urdf", "srdf", "export.toml"] {
            assert!(folder.join(format!("out/{file}.{ending}")).is_file(), "{file}.{ending}");
        }
        let urdf = fs::read_to_string(folder.join(format!("out/{file}.urdf"))).unwrap();
        assert!(urdf.contains(&format!("<robot name=\"{name}\"")), "{urdf}");
        // The next command finds it.
        let made = ["generate", "r.xml", "-o", "urdd", "--force"];
        let (status, _, said) = urdd(&made, folder);
        assert_eq!(status, 0, "{said}");
        assert!(folder.join(format!("urdd/{file}.urdf")).is_file());
        let (status, out, _) = urdd(&["validate", "urdd"], folder);
        assert!(status == 0 && out.contains("0 findings"), "{out}");
        let (status, _, said) = urdd(&["export", "moveit", "urdd", "-o", "moveit"], folder);
        assert_eq!(status, 0, "{said}");
        for made in ["out", "urdd", "moveit"] {
            for (path, _) in super::files(&folder.join(made)) {
                let names = path.split('/').map(str::to_lowercase);
                for name in names {
                    let stem = name.split('.').next().unwrap().to_owned();
                    assert!(name.len() <= 255 && !["nul", "com1"].contains(&&*stem), "{path}");
                }
            }
            fs::remove_dir_all(folder.join(made)).unwrap();
        }
        let _ = fs::remove_file(folder.join("urdd.export.toml"));
    }
}

/// What is refused after an import has its place in the original, or none.
#[test]
fn no_place_is_in_a_file_that_nobody_has() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    let geoms = "<geom size=\"1\"/>".repeat(6);
    let text = format!(
        "<mujoco model=\"r\"><worldbody><body name=\"root\"><geom size=\"1\"/>\n\
         <replicate count=\"20000\" offset=\"1 0 0\">{geoms}</replicate></body></worldbody></mujoco>"
    );
    fs::write(folder.join("large.xml"), text).unwrap();
    let commands: [&[&str]; 3] = [
        &["import", "large.xml", "-o", "out"],
        &["generate", "large.xml", "-o", "made"],
        &["diff", "large.xml", "large.xml"],
    ];
    for arguments in commands {
        let (status, _, said) = urdd(arguments, folder);
        assert_ne!(status, 0, "{said}");
        assert!(said.contains("large.xml:") && !said.contains(".urdf:"), "{said}");
    }
}
