use std::collections::{BTreeMap, BTreeSet};

use roxmltree::Document;
use urdd::export::{Format, Options, export};
use urdd::format::link_shapes_simple_skips::SkipReason;
use urdd::format::link_shapes_skips::SkippedReason;
use urdd::robot::{Robot, ShapeKind};

use crate::robots::{made, our_robots};

type Pair = (String, String);

fn pairs_in(text: &str, element: &str, keys: [&str; 2]) -> BTreeSet<Pair> {
    let document = Document::parse(text).expect("well-formed");
    let found = document.descendants().filter(|n| n.has_tag_name(element));
    let name = |n: roxmltree::Node, key: &str| n.attribute(key).expect("a link").to_owned();
    found
        .map(|n| (name(n, keys[0]), name(n, keys[1])))
        .collect()
}

/// For each pair of links the reasons of their shapes.
fn reasons(robot: &Robot, kind: ShapeKind) -> BTreeMap<Pair, BTreeSet<String>> {
    let skips = robot.skips(kind).expect("skips");
    let links = robot.links().expect("links");
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
            // Two links touch where two of their shapes do.
            let touches = ["Always", "Adjacent", "Default"];
            let expected: BTreeSet<Pair> = reasons(&robot, kind)
                .into_iter()
                .filter(|(_, reasons)| touches.iter().any(|reason| reasons.contains(*reason)))
                .map(|(pair, _)| pair)
                .collect();
            disabled += expected.len();
            let options = Options {
                shapes: kind,
                ..Options::default()
            };
            let text = |format| export(&robot, format, &options).expect("an export").text;
            let srdf = pairs_in(
                &text(Format::Srdf),
                "disable_collisions",
                ["link1", "link2"],
            );
            assert_eq!(srdf, expected, "{name}");
            let mjcf = pairs_in(&text(Format::Mjcf), "exclude", ["body1", "body2"]);
            assert_eq!(mjcf, expected, "{name}");
            assert_eq!(drake_pairs(&text(Format::Drake)), expected, "{name}");
            assert_eq!(curobo_pairs(&text(Format::Curobo)), expected, "{name}");
        }
    }
    assert!(disabled > 50, "{disabled}");
}

/// By Drake's documentation: members of a group do not collide with those of a group that it ignores.
fn drake_pairs(text: &str) -> BTreeSet<Pair> {
    let document = Document::parse(text).expect("well-formed");
    let groups: Vec<_> = document
        .descendants()
        .filter(|n| n.tag_name().name() == "collision_filter_group")
        .collect();
    let children =
        |group: &roxmltree::Node, kind: &'static str, key: &'static str| -> Vec<String> {
            let found = group.children().filter(|n| n.tag_name().name() == kind);
            found
                .map(|n| n.attribute(key).expect("a name").to_owned())
                .collect()
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

fn curobo_pairs(text: &str) -> BTreeSet<Pair> {
    let document: serde_yaml::Value = serde_yaml::from_str(text).expect("YAML");
    let ignored = document["self_collision_ignore"]
        .as_mapping()
        .expect("a mapping");
    let mut pairs = BTreeSet::new();
    for (a, others) in ignored {
        for b in others.as_sequence().expect("a list") {
            let name = |value: &serde_yaml::Value| value.as_str().expect("a name").to_owned();
            pairs.insert((name(a), name(b)));
        }
    }
    pairs
}

#[test]
fn reasons_of_choice_decide_and_edits_stand_above_them() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(&path).expect("a robot");
    let of = |robot: &Robot, reasons: Option<Vec<SkippedReason>>| {
        let options = Options {
            reasons,
            ..Options::default()
        };
        let text = export(robot, Format::Srdf, &options)
            .expect("an export")
            .text;
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

    // A person skips the first pair of these, and checks one that is adjacent.
    let skipped = never.iter().next().expect("a pair").clone();
    let adjacent = by_reason
        .iter()
        .find(|(_, reasons)| reasons.contains("Adjacent"));
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
    assert_eq!(
        of(&robot, Some(Vec::new())),
        BTreeSet::from([skipped.clone()])
    );
    let text = export(&robot, Format::Srdf, &Options::default())
        .expect("an export")
        .text;
    let user = text
        .lines()
        .find(|line| line.contains("\"User\""))
        .expect("by a person");
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
    let options = Options {
        shapes: ShapeKind::Hulls,
        reasons: Some(all),
        ..Options::default()
    };
    let text = export(&robot, Format::Srdf, &options)
        .expect("an export")
        .text;
    let document = Document::parse(&text).expect("well-formed");
    let links = robot.links().expect("links");
    let mut seen = 0;
    for pair in document
        .descendants()
        .filter(|n| n.has_tag_name("disable_collisions"))
    {
        let place = |key: &str| {
            let link = links
                .iter()
                .position(|link| Some(link.as_str()) == pair.attribute(key));
            let place = skips
                .places()
                .iter()
                .position(|(place, _)| Some(*place) == link);
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
