//! `urdd configurations import`: an SRDF's group states become named configurations.

use urdd_robot::Robot;

use crate::program::urdd;
use testkit::robots::made_of;
use testkit::urdfs::{FOLLOWER, state};

#[test]
fn states_of_groups_are_configurations() {
    let (folder, path) = made_of(FOLLOWER);
    let folder = folder.path();
    let name = path.file_name().expect("a name").to_str().expect("a name");
    let srdf = format!(
        "<robot name=\"r\">{}{}{}{}</robot>",
        state("home", "x", &[("j", "0.5")]),
        state("home", "y", &[("k", " -0.5 "), ("m", "0.1")]),
        state("far", "x", &[("j", "2")]),
        state("empty", "x", &[("m", "0")]),
    );
    std::fs::write(folder.join("r.srdf"), &srdf).expect("written");
    let import = |more: &[&str]| {
        urdd(&[&["configurations", "import", "r.srdf", name], more].concat(), folder)
    };
    let (status, told, _) = import(&[]);
    assert_eq!(status, 0);
    assert_eq!(
        told,
        format!(
            "{name}: 1 configuration imported; 0 of the SRDF unchanged\n  \
             2 positions left out: of joints with no DOF of their own, or with several\n  \
             `far` left out: `j` is out of its bounds there\n"
        )
    );
    let robot = Robot::open(&path).expect("a robot");
    assert_eq!(robot.named_configuration("home"), Ok(&[0.5, -0.5][..]));
    assert!(import(&[]).1.contains("0 configurations imported; 1 of the SRDF unchanged"));

    // A person's configuration stays, unless --force.
    let (status, ..) = urdd(&["configurations", "set", name, "home", "j=0.25"], folder);
    assert_eq!(status, 0);
    let (status, _, said) = import(&[]);
    assert!(status == 2 && said.contains("another configuration `home`; --force"), "{said}");
    assert_eq!(
        Robot::open(&path).expect("a robot").named_configuration("home"),
        Ok(&[0.25, 0.0][..])
    );
    assert_eq!(import(&["--force"]).0, 0);
    assert_eq!(
        Robot::open(&path).expect("a robot").named_configuration("home"),
        Ok(&[0.5, -0.5][..])
    );
}

#[test]
fn what_is_wrong_in_states_is_named_and_the_rest_is_imported() {
    let (folder, path) = made_of(FOLLOWER);
    let folder = folder.path();
    let name = path.file_name().expect("a name").to_str().expect("a name");
    let wrong = state("away", "x", &[("jj", "0.5")]);
    let import = |states: &str| {
        let srdf = format!("<robot name=\"r\">\n{states}</robot>");
        std::fs::write(folder.join("r.srdf"), srdf).expect("written");
        urdd(&["configurations", "import", "r.srdf", name], folder)
    };
    let (status, told, _) = import(&format!("{wrong}\n{}", state("home", "x", &[("j", "0.5")])));
    assert_eq!(status, 0);
    let expected = "1 configuration imported; 0 of the SRDF unchanged\n  left out: line 2: there is no joint `jj`; did you mean `j`?\n";
    assert_eq!(told, format!("{name}: {expected}"));
    let (status, _, said) = import(&wrong);
    assert!(status == 2 && said.contains("nothing in it can be imported: line 2: "), "{said}");
}
