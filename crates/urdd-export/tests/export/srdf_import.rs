//! Import of SRDFs as edits.

use urdd_export::{SrdfError, import_srdf};
use urdd_robot::Robot;
use urdd_srdf::ReadError;

use testkit::robots::made_of;
use testkit::urdfs::line;

fn pair(a: u32, b: u32) -> String {
    format!("<disable_collisions link1=\"l{a}\" link2=\"l{b}\" reason=\"Never\"/>")
}

fn srdf(inner: &str) -> String {
    format!("<robot name=\"line\">\n{inner}\n</robot>")
}

#[test]
fn disable_default_is_all_pairs_of_a_link_but_those_enabled() {
    let (_folder, urdd) = made_of(&line());
    let robot = Robot::open(&urdd).expect("a robot");
    let text = srdf(
        "<disable_default_collisions link=\"l0\"/><enable_collisions link1=\"l4\" link2=\"l0\"/>",
    );
    let imported = import_srdf(&robot, &text, false).expect("edits");
    let pairs: Vec<_> =
        imported.edits.iter().map(|of| (of.link_a.as_str(), of.link_b.as_str(), of.skip)).collect();
    assert_eq!(pairs, [("l0", "l2", true), ("l0", "l3", true)]);
    assert_eq!((imported.already, imported.unlisted), (2, 3));
}

#[test]
fn what_is_no_srdf_of_the_robot_is_refused() {
    let (_folder, urdd) = made_of(&line());
    let robot = Robot::open(&urdd).expect("a robot");
    let fault = |text: &str| import_srdf(&robot, text, false).expect_err("a fault");
    assert!(matches!(
        fault("<robot name=\"other\"/>"),
        SrdfError::Read(ReadError::OtherRobot { .. })
    ));
    assert!(matches!(fault("no"), SrdfError::Read(ReadError::Xml { .. })));
}

/// MoveIt (srdfdom) says so in its log, and goes on with the next element.
#[test]
fn what_names_no_link_is_named_and_the_rest_is_imported() {
    let (_folder, urdd) = made_of(&line());
    let robot = Robot::open(&urdd).expect("a robot");
    let lines = [
        "<disable_collisions link1=\"l1\"/>".to_owned(),
        pair(0, 2),
        "<enable_collisions link1=\"l1\" link2=\"l11\"/>".to_owned(),
        "<disable_default_collisions link=\"\"/>".to_owned(),
        "<disable_collisions link1=\"l11\" link2=\"none\"/>".to_owned(),
        "<disable_collisions link1=\" l0 \" link2=\"l3\"/>".to_owned(),
    ];
    let imported = import_srdf(&robot, &srdf(&lines.join("\n")), false).expect("edits");
    assert_eq!((imported.added, imported.already), (2, 0));
    assert_eq!(
        imported.wrong,
        [
            "line 5: `<disable_default_collisions>` has no `link`",
            "line 4 and 1 more: there is no link `l11`; did you mean `l1`?",
            "line 2: `<disable_collisions>` has no `link2`",
            "line 6: there is no link `none`",
        ]
    );
}

/// Each name on a line of its own: their number, and the search for a near one, took quadratic time.
#[test]
fn very_many_unknown_names_take_a_moment() {
    let (_folder, urdd) = made_of(&line());
    let robot = Robot::open(&urdd).expect("a robot");
    let pairs: String = (0..200_000).map(|i| pair(i + 10, 4)).collect();
    let start = std::time::Instant::now();
    let imported = import_srdf(&robot, &srdf(&pairs), false).expect("edits");
    assert_eq!((imported.added, imported.wrong.len()), (0, 200_000));
    assert!(start.elapsed() < std::time::Duration::from_secs(20), "{:?}", start.elapsed());
}

/// The maximum number of pairs, on one line: counting lines and searching links and edits took quadratic time.
#[test]
fn very_many_pairs_on_one_line_take_a_moment() {
    let (folder, urdd) = made_of(&line());
    let pairs: String = (0..290_000).map(|i| pair(i % 4, 4)).collect();
    let text = format!("<robot name=\"line\">{pairs}</robot>");
    let start = std::time::Instant::now();
    let robot = Robot::open(&urdd).expect("a robot");
    let imported = import_srdf(&robot, &text, false).expect("edits");
    assert_eq!((imported.added, imported.already), (3, 1));
    let made =
        crate::made::export(&robot, urdd_export::Format::Srdf, &urdd_export::Choices::default());
    let merged = urdd_srdf::merge_srdf(&text, &made.expect("an SRDF").text).expect("merged");
    assert_eq!(merged.kept, 0);
    assert!(merged.text.len() < 2_000, "{}", merged.text.len());
    // This once took minutes.
    assert!(start.elapsed() < std::time::Duration::from_secs(30), "{:?}", start.elapsed());
    drop(folder);
}

#[test]
fn an_srdf_is_counted_before_it_is_parsed() {
    let (_folder, urdd) = made_of(&line());
    let robot = Robot::open(&urdd).expect("a robot");
    let deep = "<a>".repeat(1 << 20);
    let entities = "<!DOCTYPE robot [<!ENTITY a \"b\">]><robot name=\"line\"/>";
    for text in [srdf(&deep), entities.to_owned(), "\0".to_owned()] {
        let error = import_srdf(&robot, &text, false).expect_err("not read");
        assert!(matches!(error, SrdfError::Read(ReadError::Xml { .. })), "{error}");
        let merged = urdd_srdf::merge_srdf(&text, &srdf(""));
        assert!(matches!(merged, Err(ReadError::Xml { .. })));
    }
}
