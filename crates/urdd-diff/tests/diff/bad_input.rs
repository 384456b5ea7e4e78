//! Huge, unrelated and hostile robots: a readable difference. `tests/program/diff` has those that are refused.

use std::time::Instant;

use super::{differences, open, places, quick};
use testkit::robots::our_robots;
use testkit::workshop::Workshop;
use urdd_diff::{Options, Side, compare, markdown, text};
use urdd_directory::account::{Account, Overdrawn};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::limits::ALLOWANCE;
use urdd_source::Settings;

#[cfg(unix)]
#[test]
fn a_robot_that_cannot_be_validated_has_a_note() {
    let shop = Workshop::new();
    let robot = shop.write("a\u{1b}.urdf", "<robot name='a'><link name='b'/></robot>");
    let side = Side::open(&robot, &Options::default()).unwrap();
    let notes =
        ["A", "B"].map(|word| format!("{word}: not validated: the path has a control character"));
    assert_eq!(compare(&side, &side, 0.0).unwrap().notes, notes);
}

#[test]
fn hostile_names_stay_text() {
    let shop = Workshop::new();
    let robot = |name: &str| {
        format!(
            "<robot name='r'><link name='a'/><link name='{name}'/><joint name='{name}' type='fixed'>\
             <parent link='a'/><child link='{name}'/></joint></robot>"
        )
    };
    let before = shop.write("before.urdf", &robot("b"));
    let bad = "x&#27;&#x9b;&#x202e;`&lt;img src=x&gt;&#10;::error::@user [a](http://b) | #1";
    // A URDF may not hold U+001B, but it may hold the others.
    let after = shop.write("after.urdf", &robot(&bad.replace("&#27;", "")));
    let report = differences(&before, &after);
    assert!(!report.same);
    for out in [text(&report), markdown(&report)] {
        assert!(!out.contains(['\u{1b}', '\u{9b}', '\u{202e}']), "{out}");
        assert!(out.lines().all(|line| !line.trim_start().starts_with("::")), "{out}");
    }
    for line in markdown(&report).lines().filter(|line| line.contains("@user")) {
        assert!(line.contains("``x"), "{line}");
    }
}

#[test]
fn unrelated_robots_are_a_short_list() {
    let robots = our_robots();
    for (_, a) in &robots {
        for (_, b) in &robots {
            let report = differences(a, b);
            assert_eq!(report.same, a == b);
            let lines = text(&report).lines().count();
            assert!(lines < 150, "{} {}: {lines} lines", a.display(), b.display());
        }
    }
}

/// A chain of links with two boxes each.
fn chain(links: usize, size: f64) -> String {
    let mut text = String::from("<robot name='chain'>");
    for link in 0..links {
        text += &format!(
            "<link name='l{link}'><visual><geometry><box size='1 1 {size}'/></geometry></visual>\
             <visual><geometry><mesh filename='none.stl'/></geometry></visual></link>"
        );
        if link > 0 {
            text += &format!(
                "<joint name='j{link}' type='continuous'><parent link='l{}'/><child link='l{link}'/></joint>",
                link - 1
            );
        }
    }
    text + "</robot>"
}

#[test]
fn large_robots_take_linear_time_and_markdown_is_cut() {
    let shop = Workshop::new();
    let before = open(&shop.write("before.urdf", &chain(10_000, 1.0)));
    let after = open(&shop.write("after.urdf", &chain(10_000, 2.0)));
    let begun = Instant::now();
    let report = compare(&before, &after, 0.0).unwrap();
    assert_eq!(places(&report).len(), 10_000);
    assert!(begun.elapsed().as_secs() < 20, "{:?}", begun.elapsed());
    assert_eq!(report.notes.len(), 2, "{:?}", report.notes);
    let markdown = markdown(&report);
    assert!(markdown.len() < 61_000, "{}", markdown.len());
    assert!(markdown.contains("left out here"));
    assert!(text(&report).lines().count() > 20_000);
}

#[test]
fn many_equal_elements_in_one_link_take_linear_time() {
    let shop = Workshop::new();
    let robot = |last: &str| {
        let element = "<visual><geometry><sphere radius='1'/></geometry></visual>";
        let elements = element.repeat(50_000);
        format!(
            "<robot name='r'><link name='a'>{elements}<visual><geometry><sphere radius='{last}'/></geometry></visual></link></robot>"
        )
    };
    let begun = Instant::now();
    let report =
        differences(&shop.write("a.urdf", &robot("2")), &shop.write("b.urdf", &robot("3")));
    assert_eq!(places(&report), ["links/a/visual[50000].radius"]);
    assert!(begun.elapsed().as_secs() < 45, "{:?}", begun.elapsed());
}

/// Each path in an element has the names above it: beyond what its text pays for, the text is compared.
#[test]
fn paths_of_long_tags_are_not_multiplied() {
    let shop = Workshop::new();
    let tag = "n".repeat(400_000);
    let elements = (0..1000).map(|k| format!("<c{k}/>")).collect::<String>();
    let attributes = (0..250).map(|k| format!(" a{k}='1'")).collect::<String>();
    let of_elements = |last: &str| format!("{elements}<{last}/>");
    let of_attributes = |last: &str| format!("<c{attributes} last='{last}'/>");
    let inside: [&dyn Fn(&str) -> String; 2] = [&of_elements, &of_attributes];
    for inside in inside {
        let robot = |last: &str| {
            let element = format!("<gazebo><{tag}>{}</{tag}></gazebo>", inside(last));
            format!(
                "<robot name='r'>{element}<link name='a'>{element}</link><link name='b'/>\
                 <joint name='j' type='fixed'><parent link='a'/><child link='b'/>{element}</joint>\
                 </robot>"
            )
        };
        let write = |last: &str| shop.write(&format!("{last}.urdf"), &robot(last));
        let (before, after) = (write("x"), write("y"));
        assert!(differences(&before, &before).same);
        let found = places(&differences(&before, &after));
        assert_eq!(found, ["links/a/gazebo", "joints/j/gazebo", "other/gazebo/text"]);
    }
}

#[test]
fn what_is_beside_robots_is_charged_to_the_account_of_the_run() {
    let shop = Workshop::new();
    let robot = shop.write("r.urdf", "<robot name='r'><link name='a'/></robot>");
    shop.write("r.srdf", "<robot name='r'><group name='g'><link name='a'/></group></robot>");
    shop.write("r.export.toml", "[[group]]\nname = \"g\"\n");
    let compared = |side: &Side| compare(side, side, 0.0).unwrap().notes;
    let open = |urdf: Settings| Side::open(&robot, &Options { urdf, ..quick() }).unwrap();
    let both = |why: &dyn ToString| -> Vec<String> {
        let note = |side, name| {
            format!("{side}: the {name} beside it is not compared: {}", why.to_string())
        };
        let names = ["SRDF", "`export.toml`"].into_iter();
        names.flat_map(|name| ["A", "B"].map(|side| note(side, name))).collect()
    };

    let account = Account::default();
    let side = open(Settings { account: Some(account.clone()), ..Settings::default() });
    assert_eq!(compared(&side), Vec::<String>::new());
    assert!(account.charge(usize::try_from(2 * ALLOWANCE).unwrap()).is_err());
    assert_eq!(compared(&side), both(&Overdrawn));

    let cancellation = Cancellation::default();
    let side = open(Settings { cancellation: cancellation.clone(), ..Settings::default() });
    cancellation.cancel();
    assert_eq!(compared(&side), both(&Cancelled));
}
