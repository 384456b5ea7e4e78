//! Import of SRDFs as edits.

use std::path::Path;

use urdd_export::{SrdfError, import_srdf};
use urdd_robot::{Robot, ShapeKind};

use testkit::robots::made_of;

/// Five boxes in a line, far from each other: adjacent ones are skipped, no other pair is.
fn line() -> String {
    let mut text = String::from("<robot name=\"line\">");
    for i in 0..5 {
        text += &format!(
            "<link name=\"l{i}\"><visual><geometry><box size=\"0.1 0.1 0.1\"/></geometry></visual></link>"
        );
    }
    for i in 0..4 {
        text += &format!(
            "<joint name=\"j{i}\" type=\"revolute\"><parent link=\"l{i}\"/><child link=\"l{}\"/><origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/><limit lower=\"-0.1\" upper=\"0.1\" effort=\"1\" velocity=\"1\"/></joint>",
            i + 1
        );
    }
    text + "</robot>"
}

fn pair(a: u32, b: u32) -> String {
    format!("<disable_collisions link1=\"l{a}\" link2=\"l{b}\" reason=\"Never\"/>")
}

fn srdf(inner: &str) -> String {
    format!("<robot name=\"line\">\n{inner}\n</robot>")
}

/// The pairs of links that are skipped, by the last digits of their names.
fn skipped(urdd: &Path) -> Vec<(usize, usize)> {
    let robot = Robot::open(urdd).expect("a robot");
    let skips = robot.skips(ShapeKind::Pieces).expect("skips");
    let mut found = Vec::new();
    for i in 0..skips.len() {
        for j in i + 1..skips.len() {
            if skips.is_skipped(i, j) {
                found.push((skips.places()[i].0, skips.places()[j].0));
            }
        }
    }
    found
}

#[test]
fn pairs_become_edits_and_nothing_is_lost() {
    let (folder, urdd) = made_of(&line());
    let adjacent = [(0, 1), (1, 2), (2, 3), (3, 4)];
    assert_eq!(skipped(&urdd), adjacent);
    let run = |text: &str, more: &[&str]| {
        let file = folder.path().join("x.srdf");
        std::fs::write(&file, text).expect("a file");
        let import = ["skips", "import", "x.srdf", "robot"];
        crate::program::urdd(&[&import[..], more].concat(), folder.path())
    };
    let told = run(&srdf(&format!("{}{}{}", pair(0, 1), pair(4, 2), pair(0, 3))), &[]);
    assert_eq!(
        told,
        (
            0,
            "robot: 2 edits added; 1 pair of the SRDF unchanged\n  3 pairs skipped that the SRDF does not disable\n".to_owned(),
            String::new()
        )
    );
    assert_eq!(skipped(&urdd), [(0, 1), (0, 3), (1, 2), (2, 3), (2, 4), (3, 4)]);
    // Readers find correct hashes and matrices.
    let validated = urdd_validate::validate(&[&urdd], &Default::default()).expect("a URDD");
    let found: Vec<_> = validated.report.urdds[0]
        .findings
        .iter()
        .map(|of| &of.code)
        .filter(|code| !code.starts_with("SRC"))
        .collect();
    assert_eq!(found, [] as [&String; 0]);
    // Another SRDF that contradicts an earlier decision.
    let contrary = srdf("<enable_collisions link1=\"l3\" link2=\"l0\"/>");
    let (status, _, said) = run(&contrary, &[]);
    assert_eq!(status, 2);
    assert!(
        said.contains("has an edit of `l0` and `l3`") && said.contains("SRDF: Never"),
        "{said}"
    );
    assert_eq!(skipped(&urdd).len(), 6);
    assert_eq!(run(&contrary, &["--force"]).0, 0);
    assert_eq!(skipped(&urdd), [(0, 1), (1, 2), (2, 3), (2, 4), (3, 4)]);
    let edits =
        Robot::open(&urdd).expect("a robot").skips(ShapeKind::Hulls).expect("skips").edits().len();
    assert_eq!(edits, 3);
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
    assert!(matches!(fault("<robot name=\"other\"/>"), SrdfError::OtherRobot { .. }));
    assert!(matches!(fault("no"), SrdfError::Xml { .. }));
    let error = fault(&srdf("<disable_collisions link1=\"l1\"/>"));
    assert_eq!(error.to_string(), "line 2: `<disable_collisions>` has no `link2`");
    let error = fault(&srdf("<disable_collisions link1=\"l1\" link2=\"l11\"/>"));
    assert!(
        error.to_string().starts_with("line 2: ") && error.to_string().contains("`l11`"),
        "{error}"
    );
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
    let made = super::export(&robot, urdd_export::Format::Srdf, &urdd_export::Choices::default());
    let merged = urdd_export::merge_srdf(&text, &made.expect("an SRDF").text).expect("merged");
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
        assert!(matches!(error, SrdfError::Xml { .. }), "{error}");
        let merged = urdd_export::merge_srdf(&text, &srdf(""));
        assert!(matches!(merged, Err(SrdfError::Xml { .. })));
    }
}

/// Two concurrent imports: neither loses the changes of the other.
#[test]
fn an_import_waits_for_others_and_sees_what_they_wrote() {
    let (folder, urdd) = made_of(&line());
    let pairs = [(0, 2), (0, 3), (0, 4), (1, 3), (1, 4), (2, 4)];
    std::thread::scope(|scope| {
        for (number, (a, b)) in pairs.iter().enumerate() {
            let file = format!("{number}.srdf");
            std::fs::write(folder.path().join(&file), srdf(&pair(*a, *b))).expect("a file");
            let folder = folder.path();
            scope.spawn(move || {
                // If others keep writing, it reports that, and writes nothing.
                let import =
                    || crate::program::urdd(&["skips", "import", &file, "robot"], folder).0;
                assert!((0..20).any(|_| import() == 0));
            });
        }
    });
    assert_eq!(skipped(&urdd).len(), 10);
}
