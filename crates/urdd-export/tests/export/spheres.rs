use std::collections::BTreeMap;

use crate::made::export;
use nalgebra::Vector3;
use urdd_export::{Choices, Format};
use urdd_robot::{Robot, ShapeKind, Solid};

use testkit::robots::{made, our_robots};

type Spheres = BTreeMap<String, Vec<(Vector3<f64>, f64)>>;

/// Covering spheres, measured in few configurations.
fn covering(spheres: Option<usize>, total_spheres: Option<usize>) -> Choices {
    Choices { spheres, total_spheres, cover: true, samples: 100, ..Choices::default() }
}

fn foam(robot: &Robot, options: Choices) -> Spheres {
    let text = export(robot, Format::Foam, &options).expect("an export").text;
    let document: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let links = document["links"].as_object().expect("links");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let sphere = |value: &serde_json::Value| {
        let centre: Vec<f64> = value["origin"].as_array().expect("3").iter().map(number).collect();
        (Vector3::from_vec(centre), number(&value["radius"]))
    };
    let of_link = |link: &serde_json::Value| {
        link["spheres"].as_array().expect("a list").iter().map(sphere).collect()
    };
    links.iter().map(|(name, link)| (name.clone(), of_link(link))).collect()
}

fn curobo(robot: &Robot, options: &Choices) -> Spheres {
    let text = export(robot, Format::Curobo, options).expect("an export").text;
    spheres_of(&text)
}

/// The spheres in cuRobo's form.
fn spheres_of(text: &str) -> Spheres {
    let document: serde_yaml::Value = serde_yaml::from_str(text).expect("YAML");
    let number = |value: &serde_yaml::Value| value.as_f64().expect("a number");
    let sphere = |value: &serde_yaml::Value| {
        let centre: Vec<f64> =
            value["center"].as_sequence().expect("3").iter().map(number).collect();
        (Vector3::from_vec(centre), number(&value["radius"]))
    };
    let links = document["collision_spheres"].as_mapping().expect("links");
    let of_link = |(name, list): (&serde_yaml::Value, &serde_yaml::Value)| {
        let list = list.as_sequence().expect("a list");
        (name.as_str().expect("a name").to_owned(), list.iter().map(sphere).collect())
    };
    links.iter().map(of_link).collect()
}

/// The volume that spheres fill, by counting points of a grid, and the largest radius.
fn filled(spheres: &[(Vector3<f64>, f64)]) -> (f64, f64) {
    let low = |axis: usize| spheres.iter().map(|(c, r)| c[axis] - r).fold(f64::MAX, f64::min);
    let high = |axis: usize| spheres.iter().map(|(c, r)| c[axis] + r).fold(f64::MIN, f64::max);
    let step = (0..3).map(|axis| high(axis) - low(axis)).fold(0.0, f64::max) / 60.0;
    let count = |axis: usize| ((high(axis) - low(axis)) / step).ceil() as usize;
    let of_numbers: Vec<[f64; 4]> = spheres.iter().map(|(c, r)| [c.x, c.y, c.z, *r]).collect();
    // In plain numbers: there are a million points, and this is compiled without optimisation.
    let lows = [0, 1, 2].map(low);
    let counts = [0, 1, 2].map(count);
    let mut inside = 0;
    for i in 0..counts[0] {
        let x = lows[0] + (i as f64 + 0.5) * step;
        for j in 0..counts[1] {
            let y = lows[1] + (j as f64 + 0.5) * step;
            for k in 0..counts[2] {
                let z = lows[2] + (k as f64 + 0.5) * step;
                for [a, b, c, radius] in &of_numbers {
                    let [a, b, c] = [x - a, y - b, z - c];
                    if a * a + b * b + c * c <= radius * radius {
                        inside += 1;
                        break;
                    }
                }
            }
        }
    }
    let radius = spheres.iter().map(|(_, radius)| *radius).fold(0.0, f64::max);
    (f64::from(u32::try_from(inside).expect("a count")) * step.powi(3), radius)
}

/// Points inside the pieces, at the corners and between them.
#[test]
fn covering_spheres_of_a_link_hold_its_pieces() {
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        let options = covering(None, None);
        let spheres = foam(&robot, options.clone());
        assert_eq!(spheres, curobo(&robot, &options), "{name}");
        let links = robot.link_names().expect("links");
        let mut next = 1u64;
        let mut dice = || {
            // Numerical Recipes' congruential sequence.
            next = next
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (next >> 11) as f64 / (1u64 << 53) as f64
        };
        for shape in robot.shapes(ShapeKind::Pieces).expect("pieces") {
            let Solid::Mesh(mesh) = &shape.solid else {
                panic!("a mesh");
            };
            let of_link = &spheres[&links[shape.link]];
            assert!(!of_link.is_empty() && of_link.len() <= 8, "{name}");
            let corners: Vec<Vector3<f64>> =
                mesh.vertices.iter().map(|p| Vector3::from(*p)).collect();
            let mixed = (0..500).map(|_| {
                let weights: Vec<f64> = corners.iter().map(|_| -dice().max(1e-300).ln()).collect();
                let sum: f64 = weights.iter().sum();
                corners
                    .iter()
                    .zip(weights)
                    .map(|(corner, w)| corner * (w / sum))
                    .sum::<Vector3<f64>>()
            });
            for point in corners.iter().copied().chain(mixed) {
                let held =
                    of_link.iter().any(|(centre, radius)| (point - centre).norm() <= radius + 1e-9);
                assert!(held, "{name}: {point} of {} is in no sphere", links[shape.link]);
            }
        }
    }
}

#[test]
fn more_covering_spheres_waste_less_and_keep_to_their_number() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(path).expect("a robot");
    let mut last: BTreeMap<String, (f64, f64)> = BTreeMap::new();
    let mut sums = Vec::new();
    for count in [1, 4, 16, 64] {
        let spheres = foam(&robot, covering(Some(count), None));
        assert!(spheres.values().all(|of_link| (1..=count).contains(&of_link.len())));
        let now: BTreeMap<String, (f64, f64)> =
            spheres.iter().map(|(link, of_link)| (link.clone(), filled(of_link))).collect();
        for (link, (volume, radius)) in &last {
            let (new_volume, new_radius) = now[link];
            assert!(new_radius <= *radius, "{link}: {new_radius} with {count}, {radius} before");
            assert!(
                new_volume < 1.02 * volume,
                "{link}: {new_volume} with {count}, {volume} before"
            );
        }
        sums.push(now.values().map(|(volume, _)| volume).sum::<f64>());
        last = now;
    }
    assert!(sums[3] < 0.5 * sums[0], "{sums:?}");
    // A link's only sphere is the smallest around its pieces: no larger than that around its hull, and not smaller.
    let one = foam(&robot, covering(Some(1), None));
    let links = robot.link_names().expect("links");
    for shape in robot.shapes(ShapeKind::Spheres).expect("spheres") {
        let Solid::Sphere { radius, .. } = shape.solid else {
            panic!("a sphere");
        };
        let got = one[&links[shape.link]][0].1;
        assert!((got / radius - 1.0).abs() < 0.02, "{got} for {radius}");
    }
    let total = foam(&robot, covering(None, Some(40)));
    let count = total.values().map(Vec::len).sum::<usize>();
    assert!((30..=40).contains(&count), "{count}");
    let few = foam(&robot, covering(None, Some(1)));
    assert!(few.values().all(|of_link| of_link.len() == 1));
}
