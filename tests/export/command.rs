use crate::program::urdd;
use crate::robots::{made, our_robots};

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
    assert_eq!(
        export(&["urdf", urdd_folder, "-o", "arm.urdf"]),
        (0, String::new(), String::new())
    );
    assert!(folder.join("arm.urdf").is_file());
    assert!(
        folder
            .join("arm_meshes")
            .read_dir()
            .expect("meshes")
            .count()
            > 5
    );
    let before = std::fs::read(folder.join("arm.urdf")).expect("a file");
    let (status, _, said) = export(&["urdf", urdd_folder, "-o", "arm.urdf", "--shapes", "boxes"]);
    assert_eq!(status, 2);
    assert!(said.contains("is there already: --force"), "{said}");
    assert_eq!(
        std::fs::read(folder.join("arm.urdf")).expect("a file"),
        before
    );
    assert_eq!(
        export(&[
            "urdf",
            urdd_folder,
            "-o",
            "arm.urdf",
            "--shapes",
            "boxes",
            "--force"
        ])
        .0,
        0
    );
    assert_ne!(
        std::fs::read(folder.join("arm.urdf")).expect("a file"),
        before
    );

    // A mesh in the way alone is not written over either, unless it is the same.
    std::fs::remove_file(folder.join("arm.urdf")).expect("removed");
    assert_eq!(export(&["urdf", urdd_folder, "-o", "arm.urdf"]).0, 0);
    std::fs::remove_file(folder.join("arm.urdf")).expect("removed");
    let mut meshes = folder.join("arm_meshes").read_dir().expect("meshes");
    let mesh = meshes.next().expect("a mesh").expect("a mesh").path();
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
    let update = |name: &str| {
        urdd(
            &["export", "srdf", urdd_folder, "-o", name, "--update"],
            folder,
        )
    };
    assert_eq!(update("arm.srdf").0, 0);
    let text = std::fs::read_to_string(folder.join("arm.srdf")).expect("a file");
    assert!(
        text.contains("<!-- mine -->\n  <group name=\"arm\"/>"),
        "{text}"
    );
    let count = |text: &str| text.matches("<disable_collisions ").count();
    assert_eq!(count(&text), count(&printed));
    assert!(count(&text) > 3);

    std::fs::write(folder.join("other.srdf"), "<robot name=\"other\"/>").expect("a file");
    let (status, _, said) = update("other.srdf");
    assert_eq!(status, 2);
    assert!(
        said.contains("of robot `other`, not of `welding_arm`"),
        "{said}"
    );
    let (status, _, said) = update("missing.srdf");
    assert_eq!(status, 2);
    assert!(said.contains("leave --update out"), "{said}");
}

#[test]
fn what_is_no_urdd_is_told_apart() {
    let (folder, path) = made(&our_robots()[8].1);
    let folder = folder.path();
    std::fs::write(folder.join("a.urdf"), "<robot/>").expect("a file");
    let (status, _, said) = urdd(&["export", "srdf", "a.urdf", "-o", "-"], folder);
    assert_eq!(status, 2);
    assert!(said.contains("urdd generate a.urdf"), "{said}");
    let (status, _, said) = urdd(
        &["export", "mjcf", path.to_str().expect("a path"), "-o", "-"],
        folder,
    );
    assert_eq!(status, 2);
    assert!(said.contains("give a file"), "{said}");
    std::fs::remove_dir_all(path.join("mesh_modules/convex_decomposition_meshes_module")).ok();
    let decomposition = walk(&path)
        .into_iter()
        .find(|p| p.ends_with("convex_decomposition_meshes_module"));
    if let Some(folder) = decomposition {
        std::fs::remove_dir_all(folder).expect("removed");
    }
    let (status, _, said) = urdd(
        &[
            "export",
            "curobo",
            path.to_str().expect("a path"),
            "-o",
            "-",
        ],
        folder,
    );
    assert_eq!(status, 2);
    assert!(
        said.contains("convex_decomposition_meshes_module is missing"),
        "{said}"
    );
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
