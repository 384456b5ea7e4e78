//! A fault in one mesh does not stop the validation of the others: rules on geometry skip the links and pieces in which
//! another rule found a fault, report that, and check all others.

use std::collections::BTreeSet;

use serde_json::{Value, json};
use testkit::fixture::Fixture;
use testkit::meshes::{Point, glb, obj, stl};
use testkit::robot::*;
use urdd_directory::root::Root;
use urdd_document::urdd::Urdd;
use urdd_findings::check::Examined;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::part::SkipReason;
use urdd_findings::part::{NotVerified, Part, Why};
use urdd_format::urdf::{Joint, JointType, Link};
use urdd_validate::code::Code;
use urdd_validate::code::Code::*;
use urdd_validate::rules;
use urdd_validate::settings::Settings;

const PLAIN: &str = "plain_meshes_module";
const HULLS: &str = "convex_hull_meshes_module";
const PIECES: &str = "convex_decomposition_meshes_module";
const APPROXIMATIONS: &str = "link_shapes_approximations_module";
const REACHES: &str = "link_shapes_max_distance_from_origin_module";
const STATISTICS: &str = "link_shapes_distance_statistics_module";

/// Half of each side of the box that every link shows, m; exact in binary32.
const HALF: [f64; 3] = [0.0625, 0.125, 0.25];

/// Four links, side by side, each a box; that of `moved` is 47 mm off its origin.
fn robot(moved: Option<usize>) -> Robot {
    let mut robot = Robot::new("four links");
    let size = HALF.map(|half| 2.0 * half);
    for at in 0..4 {
        let place = moved.filter(|moved| *moved == at);
        let place = place.map(|_| origin([0.046875, 0.0, 0.0], [0.0; 3]));
        robot.urdf.links.push(Link {
            visual: vec![visual(place.flatten(), cuboid(size))],
            ..link(&format!("link {at}"))
        });
    }
    for at in 1..4 {
        robot.urdf.joints.push(Joint {
            origin: origin([at as f64, 0.0, 0.0], [0.0; 3]),
            ..joint(&format!("joint {at}"), JointType::Fixed, "link 0", &format!("link {at}"))
        });
    }
    robot
}

/// The corners of a link's box, in the order of `testkit::meshes`; `scaled`, and with the last corner pushed in if
/// `dented`.
fn corners(scaled: f64, dented: bool) -> [Point; 8] {
    std::array::from_fn(|corner| {
        let inward = if dented && corner == 7 { 0.125 } else { 1.0 };
        std::array::from_fn(|axis| {
            let sign = if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
            sign * HALF[axis] * scaled * inward
        })
    })
}

/// Puts other corners into the three files that a module names at a pointer.
fn put(urdd: &mut Fixture, module: &str, pointer: &str, corners: &[Point; 8]) {
    let path = |format: &str| {
        let path = urdd.get(module, &format!("{pointer}/{format}"));
        path.as_str().expect("a path").to_owned()
    };
    let [a, b, c] = ["stl", "obj", "glb"].map(path);
    urdd.put_file(&a, stl(corners));
    urdd.put_file(&b, obj(corners, None));
    urdd.put_file(&c, glb(corners, None));
}

fn examine(mut urdd: Fixture) -> Examined {
    urdd.seal();
    let urdd = Urdd::of(Root::of(urdd.in_memory())).expect("a URDD");
    urdd_validate::examine(urdd, "robot", &Settings::default(), &rules::all())
}

fn check(examined: &Examined, code: Code) -> &Check {
    let found = examined.checks.iter().find(|check| check.rule.code == code);
    found.expect("a rule that ran")
}

/// The parts in which a rule found a fault.
fn at_fault(examined: &Examined, code: Code) -> Vec<Part> {
    let check = check(examined, code);
    assert_eq!(check.outcome, Outcome::Failed, "{code}");
    check.findings.iter().flat_map(|finding| finding.parts.clone()).collect()
}

/// The pointers at which a rule found a fault.
fn pointers(examined: &Examined, code: Code) -> Vec<String> {
    let check = check(examined, code);
    assert_eq!(check.outcome, Outcome::Failed, "{code}");
    let mut pointers = Vec::new();
    for finding in &check.findings {
        pointers.extend(finding.place.pointer.clone());
        pointers.extend(finding.more.iter().filter_map(|more| more.pointer.clone()));
    }
    pointers
}

/// The links with a mesh that was not verified.
fn links_left(examined: &Examined) -> BTreeSet<usize> {
    let links = examined.links_not_verified().into_iter();
    links.map(|link| link.link.get()).collect()
}

fn left_out(examined: &Examined, code: Code) -> BTreeSet<NotVerified> {
    check(examined, code).not_verified.iter().copied().collect()
}

#[test]
fn the_robot_is_sound() {
    for moved in [None, Some(2)] {
        let examined = examine(Fixture::full(&robot(moved)));
        let failed: Vec<Code> = examined
            .checks
            .iter()
            .filter(|check| check.outcome == Outcome::Failed)
            .map(|check| check.rule.code)
            .collect();
        assert_eq!(failed, []);
        assert!(examined.not_verified().is_empty());
        assert!(examined.links_not_verified().is_empty());
    }
}

#[test]
fn the_misplaced_one_of_two_links_that_share_a_file_is_named() {
    let mut urdd = Fixture::full(&robot(Some(2)));
    let shared = urdd.get(PLAIN, "/link_meshes/1/files").clone();
    urdd.set(PLAIN, "/link_meshes/2/files", shared);
    // And a box of a link that shares nothing.
    urdd.set(APPROXIMATIONS, "/full_obbs/3/half_extents", json!([0.0625, 0.125, 0.1]));
    let examined = examine(urdd);
    assert_eq!(
        at_fault(&examined, MSH005).iter().map(|part| part.link()).collect::<BTreeSet<_>>(),
        BTreeSet::from([1, 2])
    );
    assert_eq!(at_fault(&examined, MSH015), [Part::Plain(2)]);
    assert_eq!(pointers(&examined, SHP017), ["/full_obbs/3"]);
    // Hulls and pieces cannot be compared with a mesh that is elsewhere.
    let not_held = NotVerified { part: Part::Hull(2), why: Why::Failed(MSH015) };
    assert_eq!(left_out(&examined, MSH018), BTreeSet::from([not_held]));
    assert!(left_out(&examined, SHP017).is_empty());
    assert_eq!(links_left(&examined), BTreeSet::from([1, 2]));
}

#[test]
fn a_folded_piece_leaves_the_other_pieces_judged() {
    let mut urdd = Fixture::full(&robot(None));
    put(&mut urdd, PIECES, "/link_pieces/2/0", &corners(1.0, true));
    put(&mut urdd, PIECES, "/link_pieces/1/0", &corners(0.5, false));
    urdd.set(APPROXIMATIONS, "/decomposition_obbs/3/0/half_extents", json!([0.0625, 0.125, 0.1]));
    let examined = examine(urdd);
    // Links of even numbers have two pieces, the others one.
    let piece = |link, piece| Part::Piece { link, piece };
    assert_eq!(at_fault(&examined, MSH020), [piece(2, 0)]);
    assert_eq!(at_fault(&examined, MSH022), [piece(1, 0)]);
    assert_eq!(pointers(&examined, SHP017), ["/decomposition_obbs/3/0"]);
    let left = |part, code| NotVerified { part, why: Why::Failed(code) };
    // Whether a link's pieces cover it depends on all of them; a box depends on one.
    let folded = [piece(2, 0), piece(2, 1)].map(|part| left(part, MSH020));
    assert_eq!(left_out(&examined, MSH022), BTreeSet::from(folded));
    let unsound = BTreeSet::from([left(piece(2, 0), MSH020), left(piece(1, 0), MSH022)]);
    assert_eq!(left_out(&examined, SHP017), unsound);
    assert_eq!(links_left(&examined), BTreeSet::from([1, 2]));
}

#[test]
fn an_unsound_hull_leaves_the_distances_of_others_judged() {
    let mut urdd = Fixture::full(&robot(None));
    put(&mut urdd, HULLS, "/link_hulls/1", &corners(1.0, true));
    urdd.set(REACHES, "/full_convex_hulls_maximum_distances/3", json!(0.2));
    for key in ["mean_distances", "min_distances", "max_distances"] {
        // Links 2 and 3, and 0 and 1; boxes side by side, 0.875 m apart.
        for (i, j) in [(2, 3), (3, 2), (0, 1), (1, 0)] {
            let pointer = format!("/full_convex_hulls/{key}/{i}/{j}");
            let distance = urdd.get(STATISTICS, &pointer).as_f64().expect("a number");
            assert!((distance - 0.875).abs() < 1e-6, "{distance}");
            urdd.set(STATISTICS, &pointer, json!(0.75));
        }
    }
    let examined = examine(urdd);
    assert_eq!(at_fault(&examined, MSH017), [Part::Hull(1)]);
    assert_eq!(pointers(&examined, SHP021), ["/full_convex_hulls_maximum_distances/3"]);
    assert_eq!(pointers(&examined, SHP024), ["/full_convex_hulls/mean_distances/2/3"]);
    let left = BTreeSet::from([NotVerified { part: Part::Hull(1), why: Why::Failed(MSH017) }]);
    for code in [MSH018, MSH019, SHP017, SHP021, SHP024] {
        assert_eq!(left_out(&examined, code), left, "{code}");
    }
}

#[test]
fn where_no_part_is_sound_the_rule_is_skipped_for_that() {
    let mut urdd = Fixture::full(&robot(None));
    for link in 0..4 {
        put(&mut urdd, HULLS, &format!("/link_hulls/{link}"), &corners(1.0, true));
    }
    let examined = examine(urdd);
    assert_eq!(check(&examined, MSH018).outcome, Outcome::Skipped(SkipReason::Failed(MSH017)));
    assert_eq!(links_left(&examined), BTreeSet::from([0, 1, 2, 3]));
}

#[test]
fn a_mesh_that_cannot_be_read_is_not_verified() {
    let mut urdd = Fixture::full(&robot(None));
    let path: Value = urdd.get(PLAIN, "/link_meshes/2/files/obj").clone();
    urdd.put_file(path.as_str().expect("a path"), *b"v 0 0\n");
    let examined = examine(urdd);
    let unread = NotVerified { part: Part::Plain(2), why: Why::Unreadable };
    assert_eq!(left_out(&examined, MSH015), BTreeSet::from([unread]));
    assert_eq!(links_left(&examined), BTreeSet::from([2]));
}
