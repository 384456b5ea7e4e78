//! Fitted spheres, read back from the output and judged by sphere distances computed here. Poses come from
//! `urdd_robot`, exact contacts from its pieces; each has its own tests against other implementations.

use std::collections::BTreeSet;

use crate::made::export;
use nalgebra::Isometry3;
use urdd_export::{Choices, Export, Format, Note};
use urdd_format::rate::interval;
use urdd_robot::{Queries, Robot, ShapeKind};

use testkit::robots::{made, made_of, our_robots};

/// What a planner reads from the file.
struct Model {
    links: Vec<String>,
    /// The spheres of each link: centres and radii.
    spheres: Vec<Vec<([f64; 3], f64)>>,
    ignored: BTreeSet<[usize; 2]>,
    /// The amount added to the radii of a link.
    buffers: Vec<f64>,
}

fn read(text: &str, robot: &Robot) -> Model {
    let document: serde_yaml::Value = serde_yaml::from_str(text).expect("YAML");
    let links = robot.link_names().expect("links").to_vec();
    let number = |value: &serde_yaml::Value| value.as_f64().expect("a number");
    let of_link = |name: &String| -> Vec<([f64; 3], f64)> {
        let list = document["collision_spheres"][name.as_str()].as_sequence();
        let sphere = |sphere: &serde_yaml::Value| {
            let centre = [0, 1, 2].map(|k| number(&sphere["center"][k]));
            (centre, number(&sphere["radius"]))
        };
        list.map_or_else(Vec::new, |list| list.iter().map(sphere).collect())
    };
    let index = |name: &serde_yaml::Value| {
        let name = name.as_str().expect("a name");
        links.iter().position(|link| link == name).expect("a link")
    };
    let mut ignored = BTreeSet::new();
    for (a, others) in document["self_collision_ignore"].as_mapping().expect("a mapping") {
        for b in others.as_sequence().expect("a list") {
            let (a, b) = (index(a), index(b));
            ignored.insert([a.min(b), a.max(b)]);
        }
    }
    let wide = number(&document["collision_sphere_buffer"]);
    let buffer = |name: &String| wide + number(&document["self_collision_buffer"][name.as_str()]);
    let spheres: Vec<_> = links.iter().map(of_link).collect();
    let named = document["collision_link_names"].as_sequence().expect("a list");
    let named: BTreeSet<usize> = named.iter().map(index).collect();
    let held = |link: &usize| !spheres[*link].is_empty();
    assert_eq!(named, (0..links.len()).filter(held).collect());
    Model {
        buffers: links
            .iter()
            .enumerate()
            .map(|(link, name)| if held(&link) { buffer(name) } else { 0.0 })
            .collect(),
        spheres,
        links,
        ignored,
    }
}

impl Model {
    /// In plain numbers: 26,000 configurations are judged, and this is compiled without optimisation.
    fn touches(&self, poses: &[Isometry3<f64>]) -> bool {
        let placed = |link: usize| {
            let rotation = poses[link].rotation.to_rotation_matrix().into_inner();
            let rows = [0, 1, 2].map(|k| {
                let [x, y, z] = [0, 1, 2].map(|column| rotation[(k, column)]);
                [x, y, z, poses[link].translation.vector[k]]
            });
            let mut placed = Vec::new();
            for ([x, y, z], radius) in &self.spheres[link] {
                let [a, b, c] = &rows;
                placed.push([
                    a[0] * x + a[1] * y + a[2] * z + a[3],
                    b[0] * x + b[1] * y + b[2] * z + b[3],
                    c[0] * x + c[1] * y + c[2] * z + c[3],
                    radius + self.buffers[link],
                ]);
            }
            placed
        };
        let placed: Vec<_> = (0..self.links.len()).map(placed).collect();
        for a in 0..placed.len() {
            for b in a + 1..placed.len() {
                if self.ignored.contains(&[a, b]) {
                    continue;
                }
                for p in &placed[a] {
                    for q in &placed[b] {
                        let [x, y, z] = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
                        let reach = p[3] + q[3];
                        if x * x + y * y + z * z <= reach * reach {
                            return true;
                        }
                    }
                }
            }
        }
        false
    }

    /// Collisions missed, collisions, false contacts, free configurations.
    fn counts(&self, robot: &Robot, configurations: &[Vec<f64>]) -> [usize; 4] {
        let flat: Vec<f64> = configurations.concat();
        let proximity = robot.proximity(ShapeKind::Pieces).expect("pieces");
        let exact = proximity.in_collision_batch(&flat).expect("answers");
        let mut counts = [0; 4];
        for (q, collides) in configurations.iter().zip(exact) {
            let touches = self.touches(&robot.link_poses(q).expect("poses"));
            counts[if collides { 1 } else { 3 }] += 1;
            counts[if collides { 0 } else { 2 }] += usize::from(touches != collides);
        }
        counts
    }
}

fn configurations(robot: &Robot, first: u64, count: u64) -> Vec<Vec<f64>> {
    let all = robot.configurations().expect("bounds");
    (first..first + count).map(|k| all.random(k)).collect()
}

fn rates([missed, colliding, wrong, free]: [usize; 4]) -> [f64; 2] {
    [missed as f64 / colliding as f64, wrong as f64 / free as f64]
}

/// The two counts that the file states, each `hits of all`.
fn stated(text: &str) -> [usize; 4] {
    let count = |what: &str| -> [usize; 2] {
        let line = text.lines().find(|line| line.contains(what)).expect("a rate");
        let words: Vec<&str> = line.split(what).nth(1).expect("numbers").split(' ').collect();
        [words[1], words[3]].map(|word| word.parse().expect("a number"))
    };
    let ([missed, colliding], [wrong, free]) =
        (count("missed collisions:"), count("false contacts:"));
    [missed, colliding, wrong, free]
}

#[test]
fn fitted_spheres_answer_as_the_pieces_do() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(path).expect("a robot");
    let made = export(&robot, Format::Curobo, &Choices::default()).expect("an export");
    assert!(made.notes.iter().all(|note| matches!(note, Note::Links { .. })), "{:?}", made.notes);
    let mut model = read(&made.text, &robot);
    let number: usize = model.spheres.iter().map(Vec::len).sum();
    assert!(number <= 96, "{number}");
    let zero = robot.configurations().expect("bounds").zero();
    assert!(!model.touches(&robot.link_poses(&zero).expect("poses")));
    assert!(made.text.contains("Default configuration: free."));
    // The file's own figures, counted again in the same configurations.
    let counts = model.counts(&robot, &configurations(&robot, 3_000_000, 10_000));
    assert_eq!(counts, stated(&made.text));
    // In other configurations, within statistical error.
    let others = configurations(&robot, 50_000_000, 5_000);
    let counts = model.counts(&robot, &others);
    assert!(interval(counts[0], counts[1])[0] <= 0.01, "{counts:?}");
    assert!(interval(counts[2], counts[3])[0] <= 0.05, "{counts:?}");
    assert!(counts[1] > 500 && counts[3] > 500, "{counts:?}");
    // Larger spheres report false contacts, smaller ones miss contacts, and neighbours that are not ignored always
    // touch.
    for (factor, rate, above) in [(1.3, 1, 0.05), (0.7, 0, 0.01)] {
        let spheres = model.spheres.clone();
        for (_, radius) in model.spheres.iter_mut().flatten() {
            *radius *= factor;
        }
        let counts = model.counts(&robot, &others[..1000]);
        assert!(rates(counts)[rate] > 2.0 * above, "{factor}: {counts:?}");
        model.spheres = spheres;
    }
    model.ignored.clear();
    assert_eq!(rates(model.counts(&robot, &others[..1000]))[1], 1.0);
}

/// Both files contain the same spheres and pairs; Foam has its own keys for each link.
#[test]
fn foams_file_says_the_same_in_its_own_form() {
    let (_folder, path) = made(&our_robots()[0].1);
    let robot = Robot::open(path).expect("a robot");
    let options = Choices { samples: 300, spheres: Some(4), ..Choices::default() };
    let text = |format| export(&robot, format, &options).expect("an export").text;
    let model = read(&text(Format::Curobo), &robot);
    let foam: serde_json::Value = serde_json::from_str(&text(Format::Foam)).expect("JSON");
    for (link, spheres) in model.links.iter().zip(&model.spheres) {
        assert!(spheres.len() <= 4);
        let of_link = &foam["links"][link];
        assert_eq!(of_link.is_null(), spheres.is_empty(), "{link}");
        for (k, (centre, radius)) in spheres.iter().enumerate() {
            let sphere = &of_link["spheres"][k];
            assert_eq!(sphere["radius"].as_f64(), Some(*radius));
            assert_eq!([0, 1, 2].map(|axis| sphere["origin"][axis].as_f64()), centre.map(Some));
        }
        if !spheres.is_empty() {
            let [best, mean, worst] = ["best", "mean", "worst"].map(|key| of_link[key].as_f64());
            assert!(best.is_some() && best <= mean && mean <= worst, "{of_link}");
        }
    }
    let pairs = foam["ignored_pairs"].as_array().expect("a list");
    assert_eq!(pairs.len(), model.ignored.len());
    for pair in pairs {
        let ends = [0, 1].map(|k| model.links.iter().position(|link| pair[k] == link.as_str()));
        let [Some(a), Some(b)] = ends else {
            panic!("{pair}");
        };
        assert!(model.ignored.contains(&[a.min(b), a.max(b)]));
    }
    let rates = &foam["measured"]["rates"];
    let number = |key: &str| rates[key].as_u64().expect("a count");
    assert_eq!(number("colliding") + number("free"), 300);
}

/// Two plates with a gap far smaller than spheres can follow: the file and a note name the pair.
#[test]
fn pairs_that_spheres_cannot_tell_apart_are_named() {
    let plate = |name: &str| {
        format!(
            "<link name=\"{name}\"><visual><geometry><box size=\"1 1 0.01\"/></geometry></visual></link>"
        )
    };
    // An invisible arm between the two, so that they are not neighbours. Contact begins at z = 0.01.
    let urdf = format!(
        "<robot name=\"plates\">{}<link name=\"between\"/>{}\
         <joint name=\"fixed\" type=\"fixed\"><parent link=\"lower\"/><child link=\"between\"/></joint>\
         <joint name=\"lift\" type=\"prismatic\"><parent link=\"between\"/><child link=\"upper\"/>\
         <origin xyz=\"0 0 0.011\"/><axis xyz=\"0 0 1\"/>\
         <limit lower=\"-0.002\" upper=\"0.002\" effort=\"1\" velocity=\"1\"/></joint></robot>",
        plate("lower"),
        plate("upper")
    );
    let (_folder, path) = made_of(&urdf);
    let robot = Robot::open(path).expect("a robot");
    let options = Choices { total_spheres: Some(4), samples: 400, ..Choices::default() };
    let cover = Choices { cover: true, ..options.clone() };
    let Export { text, notes, .. } = export(&robot, Format::Curobo, &cover).expect("an export");
    assert!(text.contains("`lower` and `upper` (0 missed, "), "{text}");
    assert!(text.contains("in contact, though the exact shapes are free"), "{text}");
    let about =
        |note: &Note| matches!(note, Note::Spheres(of) if of.contains("`lower` and `upper`"));
    assert!(notes.iter().any(about), "{notes:?}");
    let [missed, colliding, wrong, free] = stated(&text);
    // A quarter of the way is contact.
    assert!(missed == 0 && wrong == free && (60..140).contains(&colliding), "{text}");
}

#[test]
fn a_robot_without_shapes_has_no_spheres() {
    let (_folder, path) = made_of(
        "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>",
    );
    let robot = Robot::open(path).expect("a robot");
    for cover in [false, true] {
        let options = Choices { cover, ..Choices::default() };
        let Export { text, notes, .. } =
            export(&robot, Format::Curobo, &options).expect("an export");
        assert_eq!(notes, [Note::NoShapes(ShapeKind::Pieces.into())]);
        let document: serde_yaml::Value = serde_yaml::from_str(&text).expect("YAML");
        assert!(document["collision_link_names"].as_sequence().is_some_and(Vec::is_empty));
        assert!(document["collision_spheres"].as_mapping().is_some_and(|links| links.is_empty()));
        let Export { text, notes, .. } = export(&robot, Format::Foam, &options).expect("an export");
        assert_eq!(notes, [Note::NoShapes(ShapeKind::Pieces.into())]);
        let document: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert!(document["links"].as_object().is_some_and(|links| links.is_empty()));
    }
}

/// Names that YAML would take for something else, or that would end a string, a line or a comment.
#[test]
fn hostile_names_stay_names() {
    let names = [
        "null",
        "~",
        "yes",
        "1e3",
        "a: b",
        "# c",
        "- d",
        "'q'",
        "\"q\"",
        "{x}",
        "[y]",
        "*z",
        "&z",
        "!t",
        "%p",
        "a\nb",
        "---",
        "\u{85}",
        "\u{2028}",
        "back\\slash",
        "\u{202e}",
    ];
    let escaped = |name: &str| {
        let each = name.chars().map(|c| format!("&#{};", u32::from(c)));
        each.collect::<String>()
    };
    let mut urdf = String::from("<robot name=\"a&#10;collision_spheres: 1\">");
    for name in names {
        urdf += &format!(
            "<link name=\"{}\"><visual><geometry><box size=\"0.1 0.1 0.1\"/></geometry></visual></link>",
            escaped(name)
        );
    }
    for (k, name) in names.iter().enumerate().skip(1) {
        urdf += &format!(
            "<joint name=\"j{k}\" type=\"fixed\"><parent link=\"{}\"/><child link=\"{}\"/><origin xyz=\"{} 0 0\"/></joint>",
            escaped(names[0]),
            escaped(name),
            k as f64
        );
    }
    urdf += "</robot>";
    let (_folder, path) = made_of(&urdf);
    let robot = Robot::open(path).expect("a robot");
    let options = Choices { samples: 100, spheres: Some(1), ..Choices::default() };
    let text = export(&robot, Format::Curobo, &options).expect("an export").text;
    let model = read(&text, &robot);
    assert!(model.spheres.iter().all(|spheres| spheres.len() == 1));
    let foam = export(&robot, Format::Foam, &options).expect("an export").text;
    let foam: serde_json::Value = serde_json::from_str(&foam).expect("JSON");
    let links = foam["links"].as_object().expect("links");
    let found: BTreeSet<&str> = links.keys().map(String::as_str).collect();
    assert_eq!(found, BTreeSet::from(names));
}
