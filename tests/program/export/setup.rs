use crate::program::urdd;
use testkit::robots::made_of;
use testkit::urdfs::mobile;

/// Every export reads the file beside the URDD; a person's file stays.
#[test]
fn the_file_beside_the_urdd_is_read_and_never_overwritten() {
    let (folder, path) = made_of(&mobile());
    let folder = folder.path();
    let name = path.file_name().expect("a name").to_str().expect("a name");
    let file = folder.join(format!("{name}.export.toml"));
    let (status, told, _) = urdd(&["export", "init", name], folder);
    assert!(status == 0 && told.contains("written; check"), "{told}");
    let mine = std::fs::read_to_string(&file).expect("a file");
    let mine = mine
        .replace("bandwidth = 10.0", "bandwidth = 5.0\njoint.j1 = { kp = 7.0, armature = 0.25 }");
    let mine = mine
        .replace("# friction = 0.8", "friction = 0.6")
        .replace("imus = []", "imus = [\"chassis\"]");
    std::fs::write(&file, &mine).expect("written");
    let (status, _, said) = urdd(&["export", "init", name], folder);
    assert!(status == 2 && said.contains("was left as it is"), "{said}");
    assert_eq!(std::fs::read_to_string(&file).expect("a file"), mine);

    let run = |more: &[&str]| {
        let export = ["export", "mjcf", name, "-o", "m.xml", "--force"];
        urdd(&[&export[..], more].concat(), folder)
    };
    let (status, _, said) = run(&["--actuators", "position", "--sensors"]);
    assert_eq!(status, 0, "{said}");
    let text = std::fs::read_to_string(folder.join("m.xml")).expect("a file");
    let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
    let find = |tag: &str, name: Option<&str>| {
        let mut nodes = document.descendants();
        nodes.find(|node| {
            node.has_tag_name(tag) && (name.is_none() || node.attribute("name") == name)
        })
    };
    let attribute = |tag, name, key: &str| find(tag, name).and_then(|node| node.attribute(key));
    assert_eq!(attribute("position", Some("j1"), "kp"), Some("7"));
    assert_eq!(attribute("joint", Some("j1"), "armature"), Some("0.25"));
    assert!(find("freejoint", None).is_some(), "the base floats");
    assert!(find("site", Some("palm_link")).is_some() && find("site", Some("chassis")).is_some());
    assert_eq!(attribute("gyro", None, "site"), Some("chassis"));
    assert!(text.contains("a bandwidth of 5 Hz") && text.contains("friction=\"0.6\""));

    // A wrong name in it stops every export, and says where.
    std::fs::write(&file, mine.replace("tools = [\"palm_link\"]", "tools = [\"pal_link\"]"))
        .expect("written");
    for format in ["mjcf", "urdf", "sdf"] {
        let (status, _, said) = urdd(&["export", format, name, "-o", "x", "--force"], folder);
        assert!(
            status == 2 && said.contains("there is no link `pal_link`; did you mean `palm_link`?"),
            "{said}"
        );
        assert!(said.contains(".export.toml:"), "{said}");
    }
    // Another file can be given instead; one that is too long is refused.
    std::fs::write(folder.join("other.toml"), &mine).expect("written");
    assert_eq!(run(&["--setup", "other.toml"]).0, 0);
    std::fs::write(folder.join("long.toml"), "#".repeat(17 << 20)).expect("written");
    let (status, _, said) = run(&["--setup", "long.toml"]);
    assert!(status == 2 && said.contains("long.toml: "), "{said}");
}
