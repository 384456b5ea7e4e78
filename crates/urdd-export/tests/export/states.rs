//! Import of an SRDF's group states as named configurations.

use urdd_export::{SrdfError, import_states};
use urdd_robot::Robot;

use testkit::robots::made_of;
use testkit::urdfs::{FOLLOWER, state};

#[test]
fn what_is_wrong_is_named_with_its_line_and_the_rest_is_imported() {
    let (_folder, path) = made_of(FOLLOWER);
    let robot = Robot::open(path).expect("a robot");
    let cases = [
        (state("s", "g", &[("jj", "0")]), "there is no joint `jj`; did you mean `j`?"),
        (state("s", "g", &[("j", "x")]), "`x` is not a position, rad or m"),
        (state("s", "g", &[("j", "NaN")]), "`NaN` is not a position, rad or m"),
        (state("s", "g", &[("j", "0 1")]), "`0 1` is not a position, rad or m"),
        (state("s", "g", &[("j", "")]), "`<joint>` has no `value`"),
        (state("", "g", &[("j", "0")]), "`<group_state>` has no `name`"),
        (
            state("s", "g", &[("j", "0"), ("j", "1")]),
            "another state `s` sets the joint `j` to another position",
        ),
    ];
    for (inner, expected) in cases {
        let good = state("good", "g", &[("k", "0.25")]);
        let text = format!("<robot name=\"r\">\n{inner}\n{good}</robot>");
        let imported = import_states(&robot, &text, false).expect("states");
        assert_eq!(imported.wrong, [format!("line 2: {expected}")], "{inner}");
        let last = imported.configurations.last().expect("a configuration");
        assert_eq!((last.name.as_str(), last.positions[0].position), ("good", 0.25));
    }
    let other = import_states(&robot, "<robot name=\"q\"/>", false).expect_err("another robot");
    assert!(matches!(other, SrdfError::Read(urdd_srdf::ReadError::OtherRobot { .. })), "{other}");
}

/// An SRDF of 16 MB holds a quarter of a million states.
#[test]
fn very_many_states_take_a_moment() {
    let (_folder, path) = made_of(FOLLOWER);
    let robot = Robot::open(path).expect("a robot");
    let mut text = String::from("<robot name=\"r\">");
    for k in 0..100_000 {
        text += &state(&format!("s{k}"), "g", &[("j", "0.5")]);
    }
    text += "</robot>";
    let started = std::time::Instant::now();
    let imported = import_states(&robot, &text, false).expect("states");
    assert_eq!(imported.changed, 100_000);
    assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
}
