use crate::program::urdd;
use testkit::robots::{made, made_of, our_robots};
use urdd_export::{CHOICES, Format};

#[test]
fn nothing_is_written_over_unless_asked() {
    let (folder, path) = made(&our_robots()[8].1);
    let folder = folder.path();
    let urdd_folder = path.to_str().expect("a path");
    let export = |more: &[&str]| {
        let mut arguments = vec!["export"];
        arguments.extend_from_slice(more);
        urdd(&arguments, folder)
    };
    // What is printed besides notes.
    let printed = |more: &[&str]| {
        let (status, out, said) = export(more);
        let other = said.lines().find(|line| !line.starts_with("urdd: note: ")).map(str::to_owned);
        (status, out, other)
    };
    assert_eq!(printed(&["urdf", urdd_folder, "-o", "arm.urdf"]), (0, String::new(), None));
    assert!(folder.join("arm.urdf").is_file());
    assert!(folder.join("arm_meshes").read_dir().expect("meshes").count() > 5);
    let before = std::fs::read(folder.join("arm.urdf")).expect("a file");
    let (status, _, said) = export(&["urdf", urdd_folder, "-o", "arm.urdf", "--shapes", "boxes"]);
    assert_eq!(status, 2);
    assert!(said.contains("already exists: --force"), "{said}");
    assert_eq!(std::fs::read(folder.join("arm.urdf")).expect("a file"), before);
    assert_eq!(
        export(&["urdf", urdd_folder, "-o", "arm.urdf", "--shapes", "boxes", "--force"]).0,
        0
    );
    assert_ne!(std::fs::read(folder.join("arm.urdf")).expect("a file"), before);

    // Its own output does not block a run, and a user's files beside it are kept.
    std::fs::write(folder.join("arm_meshes/notes.txt"), "mine").expect("written");
    let again = ["urdf", urdd_folder, "-o", "arm.urdf", "--shapes", "boxes"];
    assert_eq!(printed(&again), (0, String::new(), None));
    let mine = std::fs::read_to_string(folder.join("arm_meshes/notes.txt"));
    assert_eq!(mine.expect("a file"), "mine");

    // An existing mesh is not overwritten either, unless it is the same.
    std::fs::remove_file(folder.join("arm.urdf")).expect("removed");
    assert_eq!(export(&["urdf", urdd_folder, "-o", "arm.urdf"]).0, 0);
    std::fs::remove_file(folder.join("arm.urdf")).expect("removed");
    let meshes = folder.join("arm_meshes").read_dir().expect("meshes");
    let mut meshes = meshes.map(|mesh| mesh.expect("a mesh").path());
    let mesh = meshes.find(|mesh| !mesh.ends_with("notes.txt")).expect("a mesh");
    std::fs::write(&mesh, "mine").expect("written");
    let (status, _, said) = export(&["urdf", urdd_folder, "-o", "arm.urdf"]);
    assert_eq!(status, 2, "{said}");
    assert!(!folder.join("arm.urdf").exists());
    assert_eq!(std::fs::read(&mesh).expect("a file"), b"mine");
}

#[test]
fn an_srdf_is_brought_up_to_date() {
    let (folder, path) = made(&our_robots()[8].1);
    let folder = folder.path();
    let urdd_folder = path.to_str().expect("a path");
    let (status, printed, _) = urdd(&["export", "srdf", urdd_folder, "-o", "-"], folder);
    assert_eq!(status, 0);
    let mine = "<robot name=\"welding_arm\">\n  <!-- mine -->\n  <group name=\"arm\"/>\n</robot>\n";
    std::fs::write(folder.join("arm.srdf"), mine).expect("a file");
    let update =
        |name: &str| urdd(&["export", "srdf", urdd_folder, "-o", name, "--update"], folder);
    assert_eq!(update("arm.srdf").0, 0);
    let text = std::fs::read_to_string(folder.join("arm.srdf")).expect("a file");
    assert!(text.contains("<!-- mine -->\n  <group name=\"arm\"/>"), "{text}");
    let count = |text: &str| text.matches("<disable_collisions ").count();
    assert_eq!(count(&text), count(&printed));
    assert!(count(&text) > 3);

    std::fs::write(folder.join("other.srdf"), "<robot name=\"other\"/>").expect("a file");
    let (status, _, said) = update("other.srdf");
    assert_eq!(status, 2);
    assert!(said.contains("of robot `other`, not of `welding_arm`"), "{said}");
    let (status, _, said) = update("missing.srdf");
    assert_eq!(status, 2);
    assert!(said.contains("omit --update"), "{said}");
}

#[test]
fn what_is_no_urdd_is_told_apart() {
    let (folder, path) = made(&our_robots()[8].1);
    let folder = folder.path();
    std::fs::write(folder.join("a.urdf"), "<robot/>").expect("a file");
    let (status, _, said) = urdd(&["export", "srdf", "a.urdf", "-o", "-"], folder);
    assert_eq!(status, 2);
    assert!(said.contains("urdd generate a.urdf"), "{said}");
    let (status, _, said) =
        urdd(&["export", "mjcf", path.to_str().expect("a path"), "-o", "-"], folder);
    assert_eq!(status, 2);
    assert!(said.contains("give a file"), "{said}");
    std::fs::remove_dir_all(path.join("mesh_modules/convex_decomposition_meshes_module")).ok();
    let decomposition =
        walk(&path).into_iter().find(|p| p.ends_with("convex_decomposition_meshes_module"));
    if let Some(folder) = decomposition {
        std::fs::remove_dir_all(folder).expect("removed");
    }
    let (status, _, said) =
        urdd(&["export", "curobo", path.to_str().expect("a path"), "-o", "-"], folder);
    assert_eq!(status, 2);
    assert!(said.contains("convex_decomposition_meshes_module is missing"), "{said}");
}

fn walk(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(walk(&path));
            found.push(path);
        }
    }
    found
}

/// A full disk, simulated by a limit on file size.
#[test]
#[cfg(target_os = "linux")]
fn an_export_that_cannot_be_written_leaves_nothing() {
    let (folder, path) = made(&our_robots()[8].1);
    let folder = folder.path();
    let out = folder.join("out");
    std::fs::create_dir(&out).expect("a folder");
    let export = |output: &str, blocks: &str| {
        let script = "trap '' XFSZ; ulimit -f $1; exec \"$2\" export mjcf \"$3\" -o \"$4\" --force";
        let output = std::process::Command::new("sh")
            .args(["-c", script, "sh", blocks, env!("CARGO_BIN_EXE_urdd")])
            .args([path.as_os_str(), out.join(output).as_os_str()])
            .output()
            .expect("the program");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let entries = || out.read_dir().expect("a folder").count();
    for output in ["arm.xml", "new/below/arm.xml"] {
        let (status, said) = export(output, "1");
        assert_eq!(status, Some(2), "{said}");
        assert!(said.contains("cannot be written"), "{said}");
        assert_eq!(entries(), 0, "{said}");
    }
    // Neither the file nor the meshes of an existing export change.
    assert_eq!(export("arm.xml", "unlimited").0, Some(0));
    let files = || {
        let meshes = out.join("arm_meshes").read_dir().expect("meshes");
        let meshes = meshes.map(|mesh| mesh.expect("a mesh").path());
        let mut files: Vec<_> = meshes.chain([out.join("arm.xml")]).collect();
        files.sort();
        let read = |file| (std::fs::read(&file).expect("a file"), file);
        files.into_iter().map(read).collect::<Vec<_>>()
    };
    std::fs::write(out.join("arm.xml"), "mine").expect("written");
    let before = files();
    assert_eq!(export("arm.xml", "1").0, Some(2));
    assert!(files() == before);
}

#[test]
#[cfg(unix)]
fn update_reads_regular_files_up_to_a_limit() {
    let (folder, path) = made(&our_robots()[8].1);
    let folder = folder.path();
    let path = path.to_str().expect("a path");
    let pipe = std::process::Command::new("mkfifo").arg(folder.join("pipe")).status();
    assert!(pipe.expect("mkfifo").success());
    std::os::unix::fs::symlink("/dev/zero", folder.join("zero")).expect("a link");
    let long = std::fs::File::create(folder.join("long")).expect("a file");
    long.set_len((16 << 20) + 1).expect("a file");
    for file in ["pipe", "zero", "long", "not-there"] {
        let (status, _, said) = urdd(&["export", "srdf", path, "--update", "-o", file], folder);
        assert_eq!(status, 2, "{file}: {said}");
        assert!(said.contains(&format!("{file}: cannot be read")), "{said}");
    }
    let long = std::fs::metadata(folder.join("long")).expect("a file");
    assert_eq!(long.len(), (16 << 20) + 1);
}

#[test]
fn update_keeps_what_a_person_wrote_and_says_so() {
    let (folder, path) = made(&our_robots()[8].1);
    let folder = folder.path();
    let path = path.to_str().expect("a path");
    let name = our_robots().swap_remove(8).0;
    let old = format!(
        "<?xml version=\"1.0\"?>\r\n<robot name=\"{name}\">\r\n  <disable_collisions link1=\"x\" link2=\"y\" reason=\"Never\"/>\r\n  <disable_collisions link1=\"mine\" link2=\"y\" reason=\"User\"/>\r\n  <disable_collisions link1=\"mine\" link2=\"z\" reason=\"they are welded\"/>\r\n</robot>\r\n"
    );
    let file = folder.join("arm.srdf");
    std::fs::write(&file, old).expect("a file");
    let mut last = String::new();
    for run in 0..2 {
        let update = ["export", "srdf", path, "--update", "-o", "arm.srdf"];
        let (status, _, said) = urdd(&update, folder);
        assert_eq!(status, 0, "{said}");
        assert!(said.contains("kept 2 pairs of links that a person disabled"), "{said}");
        let text = std::fs::read_to_string(&file).expect("a file");
        assert_eq!(text.matches("\"mine\"").count(), 2);
        assert!(!text.contains("link1=\"x\"") && text.contains("reason=\"Adjacent\""));
        assert!(!text.replace("\r\n", "").contains('\n'), "{text:?}");
        assert!(run == 0 || text == last);
        last = text;
    }
    // A new file and an updated one are the same.
    assert_eq!(urdd(&["export", "srdf", path, "-o", "new.srdf"], folder).0, 0);
    let new = std::fs::read(folder.join("new.srdf")).expect("a file");
    let (status, _, said) = urdd(&["export", "srdf", path, "--update", "-o", "new.srdf"], folder);
    assert_eq!(status, 0, "{said}");
    assert_eq!(std::fs::read(folder.join("new.srdf")).expect("a file"), new);
}

/// A report names what is lost, and takes the place of no other file.
#[test]
fn a_report_is_written_beside_and_replaces_no_file() {
    let (folder, path) = made_of(
        r#"<robot name="r"><link name="arm"><visual><geometry><box size="0.3 0.1 0.1"/></geometry>
<material name="t"><texture filename="t.png"/></material></visual></link></robot>"#,
    );
    let name = path.file_name().expect("a name").to_str().expect("a name");
    let folder = folder.path();
    let (status, _, said) =
        urdd(&["export", "mjcf", name, "-o", "m.xml", "--report", "m.json"], folder);
    assert!(status == 0 && said.contains("textures that the URDF itself names (1)"), "{said}");
    // A file of a person's is no report.
    std::fs::write(folder.join("mine.json"), "mine").expect("written");
    let again = ["export", "mjcf", name, "-o", "n.xml", "--report", "mine.json"];
    let (status, _, said) = urdd(&again, folder);
    assert!(status == 2 && said.contains("mine.json already exists"), "{said}");
    assert_eq!(std::fs::read_to_string(folder.join("mine.json")).expect("a file"), "mine");
    assert!(!folder.join("n.xml").exists());
    let report = std::fs::read_to_string(folder.join("m.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    assert_eq!((&report["robot"], &report["format"]), (&"r".into(), &"MJCF".into()));
}

/// The command line knows the same formats.
#[test]
fn every_format_of_the_command_line_is_tried() {
    let folder = testkit::temporary::folder();
    let (_, help, _) = urdd(&["export", "--help"], folder.path());
    let listed = help.split("Possible values:").nth(1).expect("formats");
    let listed = listed.lines().take_while(|line| !line.trim_start().starts_with("<"));
    let count = listed.filter(|line| line.trim_start().starts_with("- ")).count();
    // `init` is no format.
    assert_eq!(count, Format::ALL.len() + 1, "{help}");
}

/// The command line has the options of the table: all but the one that follows from `-o`.
#[test]
fn the_options_of_the_table_are_on_the_command_line() {
    let (_, help, _) = urdd(&["export", "--help"], std::path::Path::new("."));
    for choice in CHOICES.iter().filter(|choice| choice.name != "mesh_folder") {
        let name = if choice.name == "robot_file" { "config" } else { choice.name };
        let option = format!("--{}", name.replace('_', "-"));
        assert!(help.split([' ', '[', '\n']).any(|word| word == option), "{option}");
    }
}
