use std::collections::{BTreeMap, BTreeSet};

use crate::made::export;
use urdd_export::{Choices, Format, Note};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_robot::{Queries, Robot, ShapeKind};

use testkit::robots::{made, made_of, our_robots};
use testkit::urdfs::TOWER;

type Pair = (String, String);

fn pairs_in(text: &str, element: &str, keys: [&str; 2]) -> BTreeSet<Pair> {
    let document = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
    let found = document.descendants().filter(|n| n.has_tag_name(element));
    let name = |n: urdd_xml::Node, key: &str| n.attribute(key).expect("a link").to_owned();
    found.map(|n| (name(n, keys[0]), name(n, keys[1]))).collect()
}

/// The reasons of the shapes of each pair of links.
fn reasons(robot: &Robot, kind: ShapeKind) -> BTreeMap<Pair, BTreeSet<String>> {
    let skips = robot.skips(kind).expect("skips");
    let links = robot.link_names().expect("links");
    let mut reasons: BTreeMap<Pair, BTreeSet<String>> = BTreeMap::new();
    for (i, (a, _)) in skips.places().iter().enumerate() {
        for (j, (b, _)) in skips.places().iter().enumerate() {
            if a < b {
                let reason = format!("{:?}", skips.reason(i, j).expect("a reason"));
                let pair = (links[*a].clone(), links[*b].clone());
                reasons.entry(pair).or_default().insert(reason);
            }
        }
    }
    reasons
}

#[test]
fn the_pairs_of_every_format_are_those_of_the_modules() {
    let mut disabled = 0;
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        for kind in [ShapeKind::Pieces, ShapeKind::Hulls] {
            // Two links touch if two of their shapes do.
            let touches = ["Always", "Adjacent", "Default"];
            let expected: BTreeSet<Pair> = reasons(&robot, kind)
                .into_iter()
                .filter(|(_, reasons)| touches.iter().any(|reason| reasons.contains(*reason)))
                .map(|(pair, _)| pair)
                .collect();
            disabled += expected.len();
            let options = Choices { shapes: kind.into(), ..Choices::default() };
            let text = |format| export(&robot, format, &options).expect("an export").text;
            let srdf = pairs_in(&text(Format::Srdf), "disable_collisions", ["link1", "link2"]);
            assert_eq!(srdf, expected, "{name}");
            assert_eq!(mjcf_checked(&text(Format::Mjcf)), checked(&robot, kind), "{name}");
            assert_eq!(drake_pairs(&text(Format::Drake)), expected, "{name}");
        }
    }
    assert!(disabled > 50, "{disabled}");
}

type Shapes = BTreeSet<[(String, String); 2]>;

/// The pairs of shapes that MuJoCo checks, by its documentation: those of all bodies, except bodies without a joint
/// between them and excluded bodies, plus the explicitly named pairs.
fn mjcf_checked(text: &str) -> Shapes {
    let document = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
    let mut rigid = BTreeMap::new();
    let mut geoms = Vec::new();
    for body in
        document.descendants().filter(|n| ["body", "worldbody"].iter().any(|t| n.has_tag_name(*t)))
    {
        let name = body.attribute("name").unwrap_or("world").to_owned();
        let moves = body.children().any(|n| n.has_tag_name("joint"));
        let parent = body.parent().and_then(|parent| parent.attribute("name")).unwrap_or("world");
        let group = match moves || body.has_tag_name("worldbody") {
            true => name.clone(),
            false => String::clone(&rigid[parent]),
        };
        rigid.insert(name.clone(), group);
        let own = body.children().filter(|n| n.attribute("class") == Some("collision"));
        geoms.extend(
            own.map(|geom| (name.clone(), geom.attribute("name").expect("a name").to_owned())),
        );
    }
    let excluded = pairs_in(text, "exclude", ["body1", "body2"]);
    let mut checked = BTreeSet::new();
    for (k, (a, one)) in geoms.iter().enumerate() {
        for (b, other) in &geoms[k + 1..] {
            let is_out = |a: &String, b: &String| excluded.contains(&(a.clone(), b.clone()));
            if rigid[a] != rigid[b] && !is_out(a, b) && !is_out(b, a) {
                checked.insert(sorted(one, other));
            }
        }
    }
    for (one, other) in pairs_in(text, "pair", ["geom1", "geom2"]) {
        assert!(checked.insert(sorted(&one, &other)), "{one} {other} is checked anyway");
    }
    checked
}

fn sorted(one: &str, other: &str) -> [(String, String); 2] {
    let place = |geom: &str| {
        let (link, piece) = geom.rsplit_once('/').expect("a piece");
        (link.to_owned(), piece.to_owned())
    };
    let mut pair = [place(one), place(other)];
    pair.sort();
    pair
}

/// The pairs of shapes that the URDD checks, of links that move relative to each other.
fn checked(robot: &Robot, kind: ShapeKind) -> Shapes {
    let skips = robot.skips(kind).expect("skips");
    let description = robot.description().expect("a description");
    let names = robot.link_names().expect("links");
    let mut rigid: BTreeMap<&str, &str> =
        names.iter().map(|name| (name.as_str(), name.as_str())).collect();
    for _ in &description.joints {
        for joint in &description.joints {
            if joint.joint_type == urdd_format::urdf::JointType::Fixed {
                rigid.insert(&joint.child.link, rigid[joint.parent.link.as_str()]);
            }
        }
    }
    let mut found = BTreeSet::new();
    for (i, (a, p)) in skips.places().iter().enumerate() {
        for (j, (b, q)) in skips.places().iter().enumerate().skip(i + 1) {
            let [a, b] = [a, b].map(|link| names[*link].as_str());
            if a != b && rigid[a] != rigid[b] && !skips.is_skipped(i, j) {
                found.insert(sorted(&format!("{a}/{p}"), &format!("{b}/{q}")));
            }
        }
    }
    found
}

#[test]
fn a_mixed_pair_is_named_with_what_is_lost_or_found_for_nothing() {
    let (_folder, path) = made_of(TOWER);
    let robot = Robot::open(&path).expect("a robot");
    let skips = robot.skips(ShapeKind::Pieces).expect("skips");
    let (mut all, mut expected) = (0, 0);
    for i in 0..skips.len() {
        for j in i + 1..skips.len() {
            if skips.places()[i].0 != skips.places()[j].0 {
                all += 1;
                expected += usize::from(!skips.is_skipped(i, j));
            }
        }
    }
    assert!(0 < expected && expected < all, "{expected} of {all}");
    // The lost pairs, from the distances of all pairs.
    let proximity = robot.proximity(ShapeKind::Pieces).expect("shapes");
    let configurations = robot.configurations().expect("bounds");
    let touches = |k: &u64| {
        let distances = proximity.closest_points(&configurations.random(*k)).expect("distances");
        distances.iter().any(|pair| pair.distance == 0.0)
    };
    let lost = (0..1000).filter(touches).count();
    assert!(lost > 20, "{lost}");
    for keep_pairs in [false, true] {
        let options = Choices { keep_pairs, ..Choices::default() };
        for format in [Format::Srdf, Format::Drake] {
            let made = export(&robot, format, &options).expect("an export");
            let notes: Vec<&Note> =
                made.notes.iter().filter(|note| matches!(note, Note::Mixed { .. })).collect();
            let [Note::Mixed { links, disabled, checked, skipped: of, contacts: Some(contacts) }] =
                notes[..]
            else {
                panic!("{notes:?}");
            };
            assert_eq!(links, &["base".to_owned(), "arm".to_owned()]);
            assert_eq!((*disabled, *checked, *of), (!keep_pairs, expected, all - expected));
            // The arm's foot is inside the base.
            assert_eq!((contacts.checked, contacts.skipped, contacts.samples), (lost, 1000, 1000));
            let text = notes[0].to_string();
            let count = if keep_pairs { 1000 } else { lost };
            assert!(text.contains(&format!("{count} of 1000 sampled configurations")), "{text}");
            assert!(made.text.contains(&text), "the file says so too");
            let disables = match format {
                Format::Srdf => pairs_in(&made.text, "disable_collisions", ["link1", "link2"]),
                _ => drake_pairs(&made.text),
            };
            assert_eq!(disables.contains(&("base".into(), "arm".into())), !keep_pairs);
        }
        // The MJCF contains pieces, whatever shapes are requested.
        let made = export(&robot, Format::Mjcf, &options).expect("an export");
        assert!(made.notes.iter().all(|note| !matches!(note, Note::Mixed { .. })));
        assert_eq!(mjcf_checked(&made.text), checked(&robot, ShapeKind::Pieces));
        assert_eq!(pairs_in(&made.text, "pair", ["geom1", "geom2"]).len(), expected);
    }
}

/// By Drake's documentation: members of a group do not collide with those of a group that it ignores.
fn drake_pairs(text: &str) -> BTreeSet<Pair> {
    let document = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
    let groups: Vec<_> = document
        .descendants()
        .filter(|n| n.tag_name().name() == "collision_filter_group")
        .collect();
    let children = |group: &urdd_xml::Node, kind: &'static str, key: &'static str| -> Vec<String> {
        let found = group.children().filter(|n| n.tag_name().name() == kind);
        found.map(|n| n.attribute(key).expect("a name").to_owned()).collect()
    };
    let members: BTreeMap<String, Vec<String>> = groups
        .iter()
        .map(|group| {
            let name = group.attribute("name").expect("a name").to_owned();
            (name, children(group, "member", "link"))
        })
        .collect();
    let mut pairs = BTreeSet::new();
    for group in &groups {
        for ignored in children(group, "ignored_collision_filter_group", "name") {
            for a in children(group, "member", "link") {
                for b in &members[&ignored] {
                    pairs.insert((a.clone(), b.clone()));
                }
            }
        }
    }
    pairs
}

#[test]
fn reasons_of_choice_decide_and_edits_stand_above_them() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(&path).expect("a robot");
    let of = |robot: &Robot, reasons: Option<Vec<SkippedReason>>| {
        let options = Choices { reasons, ..Choices::default() };
        let text = export(robot, Format::Srdf, &options).expect("an export").text;
        pairs_in(&text, "disable_collisions", ["link1", "link2"])
    };
    let by_reason = reasons(&robot, ShapeKind::Pieces);
    let never: BTreeSet<Pair> = by_reason
        .iter()
        .filter(|(_, reasons)| reasons.len() == 1 && reasons.contains("Never"))
        .map(|(pair, _)| pair.clone())
        .collect();
    assert!(!never.is_empty());
    assert_eq!(of(&robot, Some(vec![SkippedReason::Never])), never);
    assert_eq!(of(&robot, Some(Vec::new())), BTreeSet::new());

    // A user skips the first pair of these, and checks one that is adjacent.
    let skipped = never.iter().next().expect("a pair").clone();
    let adjacent = by_reason.iter().find(|(_, reasons)| reasons.contains("Adjacent"));
    let checked = adjacent.expect("a pair").0.clone();
    let module = path.join("link_shapes_modules/link_shapes_skips_module/module.json");
    let mut document: serde_json::Value =
        serde_json::from_slice(&std::fs::read(&module).expect("a module")).expect("JSON");
    document["edits"] = serde_json::json!([
        {"link_a": skipped.1, "link_b": skipped.0, "skip": true, "reason": "far"},
        {"link_a": checked.0, "link_b": checked.1, "skip": false, "reason": "cable"},
    ]);
    std::fs::write(&module, document.to_string()).expect("written");
    let robot = Robot::open(&path).expect("a robot");
    let usual = of(&robot, None);
    assert!(usual.contains(&skipped) && !usual.contains(&checked));
    assert_eq!(of(&robot, Some(Vec::new())), BTreeSet::from([skipped.clone()]));
    let text = export(&robot, Format::Srdf, &Choices::default()).expect("an export").text;
    let user = text.lines().find(|line| line.contains("\"User\"")).expect("by a person");
    assert!(user.contains(&skipped.0) && user.contains(&skipped.1));
}

#[test]
fn reasons_are_named_as_moveit_names_them() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(&path).expect("a robot");
    let skips = robot.skips(ShapeKind::Hulls).expect("skips");
    let description = robot.description().expect("a description");
    let all = vec![
        SkippedReason::Always,
        SkippedReason::Adjacent,
        SkippedReason::Default,
        SkippedReason::Never,
    ];
    let options =
        Choices { shapes: ShapeKind::Hulls.into(), reasons: Some(all), ..Choices::default() };
    let text = export(&robot, Format::Srdf, &options).expect("an export").text;
    let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
    let links = robot.link_names().expect("links");
    let mut seen = 0;
    for pair in document.descendants().filter(|n| n.has_tag_name("disable_collisions")) {
        let place = |key: &str| {
            let link = links.iter().position(|link| Some(link.as_str()) == pair.attribute(key));
            let place = skips.places().iter().position(|(place, _)| Some(*place) == link);
            place.expect("a link with a hull")
        };
        let reason = skips.reason(place("link1"), place("link2"));
        let ends = ["link1", "link2"].map(|key| pair.attribute(key).expect("a link").to_owned());
        let connected = description.joints.iter().any(|joint| {
            let joined = [&joint.parent.link, &joint.child.link];
            ends.iter().all(|end| joined.contains(&end))
        });
        let expected = match reason {
            Some(SkipReason::Always) if connected => "Adjacent",
            Some(SkipReason::Always) => "Always",
            Some(SkipReason::Adjacent) => "Adjacent",
            Some(SkipReason::Default) => "Default",
            Some(SkipReason::Never) => "Never",
            other => panic!("{other:?}"),
        };
        assert_eq!(pair.attribute("reason"), Some(expected));
        seen += 1;
    }
    assert!(seen > 5, "{seen}");
    assert!(text.contains("1000 sampled configurations"), "{text}");
}
