//! Single changes of our robots' URDFs, made by a program: each is named at its place, and nothing else is.

use std::ops::Range;

use urdd_xml::{Document, Node};

use super::by_rules::{is_default, place};
use super::{few, open, places};
use testkit::robots::our_robots;
use testkit::workshop::Workshop;
use urdd_diff::{Side, compare};

/// The text with a range replaced.
fn replaced(text: &str, range: Range<usize>, by: &str) -> String {
    format!("{}{by}{}", &text[..range.start], &text[range.end..])
}

/// The places that a changed URDF differs in; `None` if it is refused.
fn changed(shop: &Workshop, before: &Side, text: &str) -> Option<Vec<String>> {
    let path = shop.write("changed.urdf", text);
    let after = Side::open(&path, &super::quick()).ok()?;
    Some(places(&compare(before, &after, 0.0).unwrap()))
}

/// Runs `check` for every robot of ours, with its text and document.
fn each_robot(mut check: impl FnMut(&Workshop, &Side, &str, &Document)) {
    let shop = Workshop::new();
    for (name, _) in our_robots() {
        let text = shop.text(&name);
        let before = open(&shop.path(&format!("{name}.urdf")));
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).unwrap();
        check(&shop, &before, &text, &document);
    }
}

fn elements<'a>(document: &'a Document<'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    document.descendants().filter(Node::is_element)
}

/// Elements of the same kind have the same tags around them, and are in a joint of the same type.
fn kind(node: Node) -> String {
    let around: Vec<Node> = node.ancestors().filter(Node::is_element).collect();
    let tags = around.iter().map(|node| {
        let joint_type = node.attribute("type").unwrap_or_default();
        format!("{}{joint_type}", node.tag_name().name())
    });
    tags.collect::<Vec<_>>().join("<")
}

/// The same, with the tags inside and whether they have values that are not the default.
fn kind_with_values(node: Node) -> String {
    let mut text = kind(node);
    for inside in node.descendants().filter(Node::is_element) {
        text.push('>');
        text.push_str(inside.tag_name().name());
        for attribute in inside.attributes() {
            let place = place(inside, attribute.name());
            let is_default = place.is_some_and(|it| is_default(&it.field, attribute.value()));
            text.push_str(if is_default { " default" } else { " other" });
        }
    }
    text
}

#[test]
fn each_number_is_named_at_its_place() {
    let mut count = 0;
    each_robot(|shop, before, text, document| {
        let mut numbers = Vec::new();
        for node in elements(document) {
            for attribute in node.attributes() {
                let words: Vec<&str> = attribute.value().split_whitespace().collect();
                let is_number = |word: &&str| word.parse::<f64>().is_ok();
                if words.is_empty() || !words.iter().all(is_number) {
                    continue;
                }
                if place(node, attribute.name()).is_none() {
                    continue;
                }
                for (index, word) in words.iter().enumerate() {
                    let is_zero = word.parse() == Ok(0.0);
                    let kind = format!("{} {} {index} {is_zero}", kind(node), attribute.name());
                    numbers.push((kind, (node, attribute, words.clone(), index)));
                }
            }
        }
        for (node, attribute, words, index) in few(numbers) {
            let place = place(node, attribute.name()).unwrap();
            let number: f64 = words[index].parse().unwrap();
            // So small that only an exact comparison finds it; an axis changes its direction.
            let step = if place.field == "axis" { 0.5 } else { f64::EPSILON };
            let number = if number == 0.0 { 1e-12 + step } else { number * (1.0 + step) };
            let mut words: Vec<String> = words.iter().map(|w| (*w).to_owned()).collect();
            words[index] = number.to_string();
            let is_scaled =
                place.field == "axis" && words.iter().filter(|w| w.parse() != Ok(0.0)).count() == 1;
            let text = replaced(text, attribute.range_value(), &words.join(" "));
            let found = changed(shop, before, &text).expect("a robot");
            let expected = if is_scaled { vec![] } else { vec![place.text()] };
            assert_eq!(found, expected, "{}", words.join(" "));
            count += 1;
        }
    });
    println!("{count} numbers");
    assert!(count > 250, "{count}");
}

#[test]
fn each_attribute_that_is_removed_is_named_or_was_the_default() {
    let (mut named, mut default, mut refused) = (0, 0, 0);
    each_robot(|shop, before, text, document| {
        let attributes = elements(document).flat_map(|node| {
            let attributes = node.attributes();
            attributes.filter_map(move |attribute| {
                let place = place(node, attribute.name())?;
                let is_default = is_default(&place.field, attribute.value());
                let kind = format!("{} {} {is_default}", kind(node), attribute.name());
                Some((kind, (node, attribute, place)))
            })
        });
        for (node, attribute, place) in few(attributes) {
            let name = attribute.name();
            let range = attribute.range();
            let Some(found) = changed(shop, before, &replaced(text, range, "")) else {
                refused += 1;
                continue;
            };
            let other = match name {
                // One of the two that is absent is 0, where the other is there.
                "lower" => node.attribute("upper"),
                "upper" => node.attribute("lower"),
                _ => Some(""),
            };
            if is_default(&place.field, attribute.value()) && other.is_some() {
                assert_eq!(found, Vec::<String>::new(), "{}", place.text());
                default += 1;
                continue;
            }
            // The shape itself is gone with an attribute that it needs.
            let element = place.field.split('.').next().unwrap();
            let prefix = format!("{}/{}/{element}", place.list, place.part);
            // A joint that follows no more has a DOF of its own, and later ones move.
            let is_dof = |place: &String| element == "mimic" && place.starts_with("dofs/");
            let is_named = |place: &String| place.starts_with(&prefix) || is_dof(place);
            assert!(!found.is_empty(), "{} is not named", place.text());
            assert!(found.iter().all(is_named), "{}: {found:?}", place.text());
            named += 1;
        }
    });
    println!("{named} named, {default} defaults, {refused} refused");
    assert!(named > 100 && default > 30 && refused > 50);
}

#[test]
fn each_element_that_is_removed_is_named_or_had_defaults_alone() {
    let (mut named, mut default, mut refused) = (0, 0, 0);
    each_robot(|shop, before, text, document| {
        let elements = elements(document).filter(|node| !node.has_tag_name("robot"));
        for node in few(elements.map(|node| (kind_with_values(node), node))) {
            let Some(found) = changed(shop, before, &replaced(text, node.range(), "")) else {
                refused += 1;
                continue;
            };
            let inside = node.descendants().filter(Node::is_element);
            let attributes = inside.flat_map(|node| {
                let place = move |name| place(node, name);
                let attributes = node.attributes();
                attributes.filter_map(move |a| Some((place(a.name())?, a.value().to_owned())))
            });
            let all: Vec<_> = attributes.collect();
            let parts = ["link", "joint", "material"];
            let is_part = parts.iter().any(|tag| node.has_tag_name(*tag))
                && node.parent_element().is_some_and(|of| of.has_tag_name("robot"));
            let only_defaults = all.iter().all(|(place, value)| is_default(&place.field, value));
            // The axis of a fixed joint has no place.
            let has_meaning = !all.is_empty() || node.has_tag_name("axis");
            if !is_part && has_meaning && only_defaults && !node.has_tag_name("visual") {
                assert_eq!(found, Vec::<String>::new(), "{}", &text[node.range()]);
                default += 1;
                continue;
            }
            let part = node.ancestors().filter(Node::is_element);
            let part =
                part.filter(|of| of.parent_element().is_some_and(|of| of.has_tag_name("robot")));
            let part = part.last().unwrap();
            let name = part.attribute("name").unwrap_or_default();
            let list = match part.tag_name().name() {
                "link" => "links",
                "joint" => "joints",
                "material" => "materials",
                _ => "other",
            };
            let prefix = format!("{list}/{name}/");
            // A joint that follows no more has a DOF of its own, and later ones move.
            let is_dof = |place: &String| node.has_tag_name("mimic") && place.starts_with("dofs/");
            let is_at_place = |place: &String| {
                place.starts_with(&prefix)
                    || is_dof(place)
                    || (list == "other" && place.starts_with("other/"))
            };
            assert!(!found.is_empty(), "not named: {}", &text[node.range()]);
            assert!(found.iter().all(is_at_place), "{}: {found:?}", &text[node.range()]);
            named += 1;
        }
    });
    println!("{named} named, {default} defaults, {refused} refused");
    assert!(named > 100 && default > 10 && refused > 30);
}

#[test]
fn each_name_that_is_changed_is_one_part_gone_and_one_new() {
    let mut count = 0;
    each_robot(|shop, before, text, document| {
        let robot = document.root_element();
        let parts = robot.children().filter(Node::is_element);
        for part in few(parts.map(|part| (kind(part), part))) {
            let list = match part.tag_name().name() {
                "link" => "links",
                "joint" => "joints",
                "material" => "materials",
                _ => continue,
            };
            let name = part.attribute("name").unwrap();
            // In all places that mean this part.
            let means =
                |node: &Node, attribute: &str| match (list, node.tag_name().name(), attribute) {
                    (_, _, "name") => {
                        *node == part || (list == "materials" && node.has_tag_name("material"))
                    }
                    ("links", "parent" | "child", "link") => true,
                    ("joints", "mimic", "joint") => true,
                    _ => false,
                };
            let mut ranges: Vec<(Range<usize>, Node)> = Vec::new();
            for node in elements(document) {
                let found =
                    node.attributes().filter(|a| a.value() == name && means(&node, a.name()));
                ranges.extend(found.map(|attribute| (attribute.range_value(), node)));
            }
            let mut changed_text = text.to_owned();
            for (range, _) in ranges.iter().rev() {
                changed_text = replaced(&changed_text, range.clone(), "renamed part");
            }
            let mut found = changed(shop, before, &changed_text).expect("a robot");
            let mut expected =
                vec![format!("{list}/{name}/removed"), format!("{list}/renamed part/added")];
            for (_, node) in ranges.iter().filter(|(_, node)| *node != part) {
                let attribute = match list {
                    "links" => "link",
                    "joints" => "joint",
                    _ => "name",
                };
                expected.extend(place(*node, attribute).map(|place| place.text()));
            }
            // The DOFs of a joint have its name.
            found.retain(|place| {
                let of_joint = [name, "renamed part"].iter().any(|name| {
                    let whole = format!("dofs/{name}/");
                    list == "joints" && place.starts_with(&whole)
                });
                !of_joint
            });
            found.sort();
            expected.sort();
            assert_eq!(found, expected, "{list} {name}");
            count += 1;
        }
    });
    println!("{count} names");
    assert!(count > 25, "{count}");
}

#[test]
fn what_urdf_does_not_define_is_named_at_its_place() {
    let shop = Workshop::new();
    let text = shop.text("gripper");
    let before = open(&shop.path("gripper.urdf"));
    for (from, to, expected) in [
        ("<joint name=", "<joint dont_collapse=\"true\" name=", "dont_collapse"),
        ("<limit ", "<limit stiffness=\"3\" ", "limit.stiffness"),
        ("<geometry>", "<geometry tag=\"x\">", "geometry.tag"),
        ("<robot ", "<robot maker=\"me\" ", "maker"),
    ] {
        assert!(text.contains(from), "{from}");
        let found = changed(&shop, &before, &text.replacen(from, to, 1)).expect("a robot");
        assert!(matches!(&found[..], [place] if place.ends_with(expected)), "{found:?}");
    }
}
