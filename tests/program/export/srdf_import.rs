//! `urdd skips import`: an SRDF's pairs become edits.

use std::path::Path;

use urdd_robot::{Robot, ShapeKind};

use testkit::robots::made_of;
use testkit::urdfs::line;

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
fn lines_that_cannot_be_read_are_named_and_the_others_are_imported() {
    let (folder, urdd) = made_of(&line());
    let import = |text: &str| {
        std::fs::write(folder.path().join("x.srdf"), text).expect("a file");
        crate::program::urdd(&["skips", "import", "x.srdf", "robot"], folder.path())
    };
    let bad =
        "<disable_collisions link1=\"l1\"/>\n<disable_collisions link1=\"l1\" link2=\"arm\"/>";
    let (status, told, _) = import(&srdf(&format!("{bad}{}", pair(0, 2))));
    assert_eq!(status, 0);
    let left_out = "robot: 1 edit added; 0 pairs of the SRDF unchanged\n  left out: line 2: `<disable_collisions>` has no \
        `link2`\n  left out: line 3: there is no link `arm`\n";
    assert!(told.starts_with(left_out), "{told}");
    assert_eq!(skipped(&urdd), [(0, 1), (0, 2), (1, 2), (2, 3), (3, 4)]);
    let (status, _, said) = import(&srdf(bad));
    assert_eq!(status, 2);
    assert!(said.contains("`link2`; line 3: there is no link `arm`"), "{said}");
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

#[cfg(unix)]
#[test]
fn an_srdf_that_is_xacro_is_expanded() {
    let (folder, urdd) = made_of(&line());
    let programs = crate::lint::xacro::hand("hand");
    let text = "<robot name=\"line\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n\
        <xacro:macro name=\"pair\" params=\"prefix\">\
        <disable_collisions link1=\"${prefix}4\" link2=\"l2\" reason=\"Never\"/></xacro:macro>\n\
        <xacro:pair prefix=\"l\"/></robot>";
    std::fs::write(folder.path().join("x.srdf.xacro"), text).expect("a file");
    std::fs::write(folder.path().join("x.srdf"), srdf("")).expect("a file");
    let run = |arguments: &[&str]| {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_urdd"))
            .args(["skips", "import"])
            .args(arguments)
            .current_dir(folder.path())
            .env("PATH", programs.path().join("bin"))
            .output()
            .expect("the program");
        let [out, err] =
            [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        out + &err
    };
    let told = run(&["x.srdf.xacro", "robot", "a:=1"]);
    assert!(told.starts_with("robot: 1 edit added; 0 pairs"), "{told}");
    assert!(skipped(&urdd).contains(&(2, 4)));
    let told = run(&["x.srdf", "robot", "a:=1"]);
    assert!(told.contains("x.srdf: not a xacro file"), "{told}");
}
