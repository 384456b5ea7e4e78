//! Large obstacles that a covering sphere touches by a nanometre: 32 bits alone would call some of them free.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use urdd_robot::spheres::{CoveringAnswer, LinkSpheres, Sphere, SphereChecker, SphereLevel};
use urdd_robot::{Obstacle, Robot, World};

use super::planning::SLIDE;
use super::spheres::Numbers;
use testkit::robots::made_of;

/// The radius of the sphere, whose centre is the origin, m. 32 bits hold it.
const RADIUS: f64 = 0.125;
/// The sizes of obstacles, m.
const HALF: f64 = 17.3;
const ROUND: f64 = 5.7;
const LONG: f64 = 21.1;

/// Each kind of obstacle, turned, that is `apart` from the origin.
fn obstacles(numbers: &mut Numbers, apart: f64) -> Vec<Obstacle> {
    let rotation = numbers.pose(1.0).rotation;
    // What is nearest to the origin is at -x of the obstacle, by y and z off its centre.
    let at = |reach: f64, y: f64, z: f64| {
        let shift = rotation * Vector3::new(reach + apart, y, z);
        Isometry3::from_parts(Translation3::from(shift), rotation)
    };
    let [y, z] = [numbers.within(HALF), numbers.within(LONG)];
    let half = [HALF, HALF, LONG];
    let corners =
        (0..8).map(|k| [0, 1, 2].map(|j| if k >> j & 1 == 0 { -half[j] } else { half[j] }));
    let corners: Vec<[f64; 3]> = corners.collect();
    let cloud: Vec<[f64; 3]> = (0..100).map(|k| [0.3 * f64::from(k), 0.0, 0.0]).collect();
    let mut around = || {
        let spin = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), numbers.within(3.0));
        let shift = spin * Vector3::new(ROUND + apart, 0.0, 0.0) + Vector3::new(0.0, 0.0, z);
        Isometry3::from_parts(Translation3::from(rotation * shift), rotation)
    };
    let [capsule, cylinder] = [around(), around()];
    let centre = (rotation * Vector3::new(HALF + apart, 0.0, 0.0)).into();
    [
        Obstacle::cuboid("box", at(HALF, y, z), half),
        Obstacle::sphere("ball", centre, HALF),
        Obstacle::capsule("capsule", capsule, ROUND, LONG),
        Obstacle::cylinder("cylinder", cylinder, ROUND, LONG),
        Obstacle::hull("hull", at(HALF, y, z), &corners),
        Obstacle::points("cloud", at(0.25, 0.0, 0.0), &cloud, 0.25),
        // One cell, whose middle is at half of its height below.
        Obstacle::height_field("field", at(HALF, y, 0.0), &[LONG], 1, [2.0 * HALF; 2], 2.0 * LONG),
    ]
    .map(|made| made.expect("an obstacle"))
    .to_vec()
}

#[test]
fn rounding_frees_no_contact_with_a_large_obstacle() {
    let (_folder, path) = made_of(SLIDE);
    let robot = Robot::open(path).expect("a robot");
    let sphere = Sphere { centre: [0.0; 3], radius: RADIUS };
    let level = SphereLevel {
        links: vec![LinkSpheres { link_idx: 0, spheres: vec![sphere] }],
        covers: true,
    };
    let checker = SphereChecker::covering(&robot, &[level], &[]).expect("spheres");
    let mut numbers = Numbers(23);
    for _ in 0..300 {
        for (apart, answer) in
            [(RADIUS - 1e-9, CoveringAnswer::Maybe), (RADIUS + 1e-3, CoveringAnswer::Free)]
        {
            for obstacle in obstacles(&mut numbers, apart) {
                let name = obstacle.name().to_owned();
                let around = checker.around(&World::new([obstacle])).expect("an obstacle");
                assert_eq!(around.in_collision(&[0.0]).expect("an answer"), answer, "{name}");
            }
        }
    }
}
