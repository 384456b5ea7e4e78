//! Numbers of clauses 2 to 6 and 9 to 13, but for the limits of files.

use std::f64::consts::PI;

use serde_json::json;
use urdd_format::urdf::{Axis, JointType};
use urdd_validate::code::Code::*;

use super::{Number, Sides, least, most, number, sides, there};
use crate::chain::turned;
use crate::dof::star;
use testkit::fixture::{Fixture, URDF, toy_robot};
use testkit::robot::{Robot, limit};

const CHAIN: &str = "chain_module";
const SAMPLES: &str = "kinematics_samples_module";

/// The toy, with a joint or a link changed.
fn toy_with(change: impl Fn(&mut Robot)) -> Fixture {
    let mut robot = toy_robot();
    change(&mut robot);
    Fixture::core(&robot)
}

/// A planar joint whose axis is this far from -z.
fn planar(sine: f64) -> Fixture {
    let mut robot = star(&[("j", JointType::Planar)]);
    robot.joint_mut("j").axis = Some(Axis { xyz: Some([sine, 0.0, -1.0]) });
    Fixture::core(&robot)
}

/// Another URDD in place of this one.
fn becomes(f: &mut Fixture, other: Fixture) {
    *f = other;
}

/// An axis of this length. The modules are those of an axis of 1.
fn axis_of(f: &mut Fixture, length: f64) {
    let of = |length: f64| {
        let mut robot = star(&[("j", JointType::Revolute)]);
        robot.joint_mut("j").axis = Some(Axis { xyz: Some([0.0, 0.0, length]) });
        Fixture::core(&robot)
    };
    let (mut other, urdf) = (of(1.0), of(length));
    *other.doc_mut("urdf_module") = urdf.doc("urdf_module").clone();
    other.put_file(URDF, urdf.file(URDF));
    becomes(f, other);
}

fn toy_core() -> Fixture {
    Fixture::core(&toy_robot())
}

fn moments(f: &mut Fixture, [ixx, iyy, izz]: [f64; 3]) {
    let inertial = crate::source::of(1.0, [ixx, iyy, izz]);
    let other = toy_with(|robot| robot.link_mut("arm").inertial = inertial.clone());
    becomes(f, other);
}

fn star_of_one() -> Fixture {
    Fixture::core(&star(&[("j", JointType::Revolute)]))
}

/// A pose that is turned about x by half a turn less this, with the negative of its quaternion.
fn negative_quaternion(f: &mut Fixture, w: f64) {
    let mut other = turned([PI - 2.0 * w, 0.0, 0.0]);
    let pointer = "/samples/0/link_poses/1/quaternion_wxyz";
    let negative: Vec<f64> = other
        .get(SAMPLES, pointer)
        .as_array()
        .expect("a list")
        .iter()
        .map(|x| -x.as_f64().expect("a number"))
        .collect();
    other.set(SAMPLES, pointer, json!(negative));
    becomes(f, other);
}

pub fn numbers() -> Vec<Number> {
    vec![
        number(
            "binary64",
            "3.1.1",
            "`1e999` are errors",
            ("1e999", f64::INFINITY),
            vec![there("JSN005/just-beyond-binary64", "JSN005/largest")],
        ),
        number(
            "json-depth",
            "3.1.1",
            "deeper than 100 objects",
            ("100", 100.0),
            vec![there("JSN006/one-hundred-and-one", "JSN006/one-hundred")],
        ),
        number(
            "yaml-depth",
            "3.2.2",
            "no nesting deeper than 100",
            ("100", 100.0),
            vec![there("YML008/one-hundred-and-one", "YML008/one-hundred")],
        ),
        number(
            "yaml-key",
            "3.2.2",
            "within 1,024 characters",
            ("1,024", 1024.0),
            vec![there("YML001/key-of-more-than-1024-characters", "YML001/key-of-1024-characters")],
        ),
        number(
            "major-version",
            "4.1",
            "Its major number MUST be 1",
            ("1", 1.0),
            vec![there("DIR025/two", "DIR025/one")],
        ),
        number(
            "planar-axis",
            "5.9",
            "sqrt(nx^2 + ny^2) < 1e-10",
            ("1e-10", 1e-10),
            // Poses as if the axis were -z.
            vec![least_of_planar()],
        ),
        number(
            "least-axis",
            "6.1.6",
            "at least 2^-1022",
            ("2^-1022", f64::MIN_POSITIVE),
            vec![
                // The square root: 1.4917e-154.
                sides(
                    URD010,
                    star_of_one,
                    axis_of,
                    1.491_668_146_240_041e-154,
                    [1.485e-154, 1.499e-154],
                ),
                // Finite: the largest has a square just below 2^1024.
                sides(
                    URD010,
                    star_of_one,
                    axis_of,
                    1.340_780_792_994_259_7e154,
                    [1.35e154, 1.33e154],
                ),
            ],
        ),
        number(
            "mimic-limit",
            "6.1.7",
            "to 1e-6 of the larger absolute value of its two limits",
            ("1e-6", 1e-6),
            // The tip goes from -0.3 to 0.1; the larger limit is 1.
            vec![most(
                SRC002,
                toy_core,
                |f, by| {
                    becomes(
                        f,
                        toy_with(|robot| robot.joint_mut("tip").limit = limit(-0.3 + by, 1.0)),
                    )
                },
                1e-6,
            )],
        ),
        number(
            "definite",
            "6.1.7",
            "more than 1e-9 of the largest",
            ("1e-9", 1e-9),
            vec![least(SRC004, toy_core, |f, by| moments(f, [1.0, 1.0, by]), 1e-9)],
        ),
        number(
            "triangle",
            "6.1.7",
            "to 1e-6 of itself",
            ("1e-6", 1e-6),
            vec![most(SRC005, toy_core, |f, by| moments(f, [0.01, 0.02, 0.03 / (1.0 - by)]), 1e-6)],
        ),
        number(
            "unit-quaternion",
            "6.3.4",
            "of a norm within 1e-9 of 1",
            ("1e-9", 1e-9),
            vec![
                most(CHN010, || turned([0.0; 3]), |f, by| longer(f, 1.0 + by), 1e-9),
                most(CHN010, || turned([0.0; 3]), |f, by| longer(f, 1.0 - by), 1e-9),
            ],
        ),
        number(
            "links",
            "6.4.6",
            "at most 300 links",
            ("300", 300.0),
            vec![there("CON006/300-links", "CON006/301-links")],
        ),
        number(
            "links-in-paths",
            "6.4.6",
            "at most 2,000,000 links together",
            ("2,000,000", 2_000_000.0),
            vec![there("CON006/a-line-of-180-links", "CON006/a-line-of-181-links")],
        ),
        number(
            "values-of-a-frozen-joint",
            "6.6.6",
            "1, 3 or 6. [CMP006]",
            ("3", 3.0),
            vec![there("CMP006/frozen-with-two-values", "CMP006/frozen-elsewhere")],
        ),
        number(
            "unit-quaternion-of-a-pose",
            "9.2",
            "of a norm within 1e-9 of 1",
            ("1e-9", 1e-9),
            vec![most(
                KIN003,
                Fixture::toy,
                |f, by| {
                    f.set(
                        SAMPLES,
                        "/samples/2/link_poses/1/quaternion_wxyz",
                        json!([1.0 + by, 0, 0, 0]),
                    );
                },
                1e-9,
            )],
        ),
        number(
            "negative-w",
            "9.2",
            "w not below -1e-9",
            ("1e-9", 1e-9),
            vec![most(KIN003, star_of_one, negative_quaternion, 1e-9)],
        ),
        number(
            "legacy-widening",
            "10.3",
            "it has upper + 1e-7",
            ("1e-7", 1e-7),
            vec![there("BND003/legacy-locked-far-off", "LEG006/locked-and-equal")],
        ),
        number(
            "legacy-configurations",
            "10.5",
            "the first 96 sampled configurations",
            ("96", 96.0),
            vec![Sides::Elsewhere("a validator may look at fewer: 13.5")],
        ),
        number(
            "archive-name",
            "2.14",
            "at most 4,096 bytes, and 1,020 between two slashes",
            ("4,096", 4096.0),
            vec![
                there("unreadable/beyond-archive-name", "unreadable/within-archive-name"),
                there(
                    "unreadable/beyond-archive-part-of-a-name",
                    "unreadable/within-archive-part-of-a-name",
                ),
            ],
        ),
        number(
            "validators-documents",
            "13.1",
            "at most 512 MiB and directories of at most 100,000 files",
            ("100,000", 100_000.0),
            vec![Sides::Elsewhere(
                "limits of this project's validator, and no rule's: docs/security.md",
            )],
        ),
        number(
            "validators-archives",
            "13.1",
            "come to 4 GiB, and to no more than 64 MiB plus 250 times",
            ("64 MiB", 67_108_864.0),
            vec![there("unreadable/beyond-archive-sizes", "unreadable/within-archive-sizes")],
        ),
        number(
            "triangles-of-a-robot",
            "13.3",
            "A file of more than 20 million triangles, instances counted, is not a mesh (7.5). The generator of this project makes URDDs of at most 3 million triangles a link and 10 million a robot and refuses others, since a URDF of some bytes names a mesh, or a sphere, as often as it likes. Up to 4096 materials of a mesh are told apart; faces of any other have none. Polygons that are not convex are cut by ears up to 10,000 corners each and 500 million",
            ("10,000", 10_000.0),
            vec![Sides::Elsewhere(
                "limits of this project's programs, and no rule's: docs/security.md",
            )],
        ),
        number(
            "work-of-a-model",
            "13.4",
            "costs a validator 100,000 configurations",
            ("100,000", 100_000.0),
            vec![Sides::Elsewhere("a cost, and no limit; 8.8.9 and 8.8.12 have the counts")],
        ),
    ]
}

fn longer(f: &mut Fixture, length: f64) {
    f.set(CHAIN, "/joints_in_chain/0/origin/quaternion_wxyz", json!([length, 0, 0, 0]));
}

/// The poses of an axis that counts as -z, beside an axis of this distance from it.
fn least_of_planar() -> Sides {
    sides(
        KIN003,
        star_of_one,
        |f, sine| {
            let mut other = planar(sine);
            let as_z = planar(0.0);
            *other.doc_mut(SAMPLES) = as_z.doc(SAMPLES).clone();
            becomes(f, other);
        },
        1e-10,
        [1.005e-10, 0.995e-10],
    )
}
