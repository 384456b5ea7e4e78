//! Where a file of loops is looked for, and what loops and couplings cost.

use std::path::Path;
use std::sync::Arc;

use urdd_directory::account::{Account, Overdrawn};
use urdd_xml::Xml;

use crate::error::SourceError;
use crate::load::{Source, load};
use crate::loops::{Retyped, beside, retyped, urdf_plus};
use crate::{Files, Settings};

#[test]
fn a_file_of_loops_has_the_name_of_the_robot_without_its_endings() {
    let toml: Arc<[u8]> = Arc::from(&b"independent = [\"a\"]\n"[..]);
    let found = |robot: &str| {
        let files = Files::in_memory([("d/x.loops.toml".to_owned(), Arc::clone(&toml))]);
        let settings = Settings { files: files.expect("files"), ..Settings::default() };
        beside(Path::new(robot), &settings).expect("readable").is_some()
    };
    for robot in ["/d/x.urdf", "/d/x.URDF", "/d/x.xacro", "/d/x.urdf.xacro", "/d/x.xml"] {
        assert!(found(robot), "{robot}");
    }
    for robot in ["/d/y.urdf", "/x.urdf", "/d/x.y.urdf"] {
        assert!(!found(robot), "{robot}");
    }
}

/// A chain of joints of these names, and couplings from its first link to its last.
fn chain(joints: usize, name: &str, couplings: usize) -> String {
    let limit = "<limit effort='1' velocity='1' lower='-1' upper='1'/>";
    let joints: String = (1..=joints)
        .map(|k| {
            let ends = format!("<parent link='l{}'/><child link='l{k}'/>", k - 1);
            format!(
                "<link name='l{k}'/><joint name='{name}{k}' type='revolute'>{ends}{limit}</joint>\n"
            )
        })
        .collect();
    let last = joints.matches("<link").count();
    let ends = format!("<predecessor link='l0'/><successor link='l{last}'/><ratio value='1'/>");
    let couplings: String =
        (0..couplings).map(|k| format!("<coupling name='c{k}'>{ends}</coupling>\n")).collect();
    format!("<robot name='r'><link name='l0'/>\n{joints}{couplings}</robot>")
}

fn loaded(urdf: &str, yaml: Option<&str>) -> Result<Source, SourceError> {
    let files = [("r.urdf", Some(urdf)), ("r.yaml", yaml)].into_iter();
    let files =
        files.filter_map(|(name, text)| Some((name.to_owned(), Arc::from(text?.as_bytes()))));
    let files = Files::in_memory(files).expect("files");
    load(Path::new("/r.urdf"), &Settings { files, ..Settings::default() })
}

/// Each coupling has each joint, with its name.
#[test]
fn couplings_of_long_chains_are_charged() {
    let source = loaded(&chain(100, "j", 100), None).expect("little");
    let said = source.loops.expect("couplings");
    assert_eq!(
        (said.file.couplings.len(), said.file.couplings[99].get_ref().terms.len()),
        (100, 100)
    );
    for (joints, name, couplings) in [(1500, "j".to_owned(), 4000), (5, "j".repeat(300_000), 4000)]
    {
        let text = chain(joints, &name, couplings);
        let refused = loaded(&text, None).map(|_| ()).expect_err("too much");
        let SourceError::Import { file, line, fault, .. } = refused else { panic!("{refused}") };
        assert_eq!((&*file, fault), ("/r.urdf", Overdrawn.to_string()));
        // At a coupling, each of which has a line.
        assert!(line as usize > joints + 1, "{line}");
    }
}

/// What is made of a coupling is charged, and nothing else is: the names and coefficients of terms are shared.
#[test]
fn terms_of_couplings_share_names_and_coefficients() {
    let text = chain(50, "joint_with_a_name_", 2);
    let xml = Xml::new(&text);
    let root = xml.document().expect("XML").root_element();
    let (said, _) = urdf_plus(root, &Account::default()).expect("little").expect("couplings");
    let [one, other] = &said.file.couplings[..] else { panic!("two") };
    for ((a, of_a), (b, of_b)) in one.get_ref().terms.iter().zip(&other.get_ref().terms) {
        assert!(Arc::ptr_eq(a.get_ref(), b.get_ref()));
        assert_eq!((&**of_a, &**of_b), (&[-1.0][..], &[-1.0][..]));
    }
    let of_one: Vec<_> = one.get_ref().terms.values().collect();
    assert!(of_one.windows(2).all(|two| Arc::ptr_eq(two[0], two[1])));
}

/// A joint that is named 20,000 times, whose child has a name of 200 kB, was 4 GB of text.
#[test]
fn a_joint_is_retyped_once() {
    let child = "x".repeat(200_000);
    let urdf = format!(
        "<robot name='r'><link name='a'/><link name='{child}'/><joint name='j' type='revolute'><parent link='a'/><child link='{child}'/><limit effort='1' velocity='1' lower='-1' upper='1'/></joint></robot>"
    );
    let yaml = |kinds: &[&str]| {
        let names = vec!["j"; kinds.len()].join(", ");
        let kinds = kinds.join(", ");
        format!("closed_loop: []\ntype: []\njoint_name: [{names}]\njoint_type: [{kinds}]\n")
    };
    let source = loaded(&urdf, Some(&yaml(&["UJOINT_ZY"; 20_000]))).expect("one universal joint");
    assert!(source.carried.len() < urdf.len() + 1000, "{}", source.carried.len());
    assert_eq!(source.reading.robot.joints.len(), 2);
    // Which of two it is to be is not said.
    let refused = loaded(&urdf, Some(&yaml(&["FIXED", "FIXED", "SPHERICAL"])));
    let said = refused.map(|_| ()).expect_err("two kinds").to_string();
    assert!(said.starts_with("/r.yaml:3:20: the joint `j` is named twice"), "{said}");
}

#[test]
fn joints_are_retyped_in_one_pass_in_the_order_of_the_file() {
    let joints: String = (0..3)
        .map(|k| format!("<joint name='j{k}' type='revolute'><child link='l'/></joint>"))
        .collect();
    let text = format!("<robot>{joints}</robot>");
    let all = ["z", "j2", "y", "j0"].map(|name| (name.to_owned(), Retyped::Fixed));
    let (text, missing) = retyped(&Xml::new(&text), &all);
    assert_eq!(text.matches("type='fixed'").count(), 2);
    assert_eq!(missing, ["z", "y"]);
}

/// The places of words are those of the file, not of the first words that are alike.
#[test]
fn faults_of_extended_urdf_have_their_own_places() {
    let urdf = "<robot name='r'><link name='a'/></robot>";
    for (yaml, place) in [
        (
            "type: [6d,\n  6d, 5d]\nclosed_loop: [[a, b], [a, b], [a, b]]\n",
            "/r.yaml:2:7: `5d` in `type`",
        ),
        (
            "closed_loop: []\ntype: []\njoint_name: [a, FIXE]\njoint_type: [FIXED, FIXE]\n",
            "/r.yaml:4:21: ",
        ),
        (
            "closed_loop: []\nname_mot: [6d]\ntype: [6d]\n",
            "/r.yaml:3:1: `closed_loop` and `type` need",
        ),
    ] {
        let said = loaded(urdf, Some(yaml)).map(|_| ()).expect_err("faulty").to_string();
        assert!(said.starts_with(place), "{said}");
    }
}

/// Importers write files of up to 16 MiB.
#[test]
fn a_file_of_loops_has_at_most_16_mib() {
    let read = |bytes: usize| {
        let begin = "independent = [\"a\"]\n#";
        let toml = format!("{begin}{}", "x".repeat(bytes - begin.len()));
        let files = Files::in_memory([("x.loops.toml".to_owned(), Arc::from(toml.as_bytes()))]);
        let settings = Settings { files: files.expect("files"), ..Settings::default() };
        beside(Path::new("/x.urdf"), &settings).map(|said| said.is_some())
    };
    const MOST: usize = 16 << 20;
    assert_eq!(read(MOST).map_err(|error| error.to_string()), Ok(true));
    let refused = read(MOST + 1).map_err(|error| error.to_string()).expect_err("too long");
    assert!(refused.starts_with("/x.loops.toml") && refused.contains("16 MiB"), "{refused}");
}
