//! Planar robots: two circles meet in two points, of which the one to the left of the line between their centres is taken.

use serde_json::Value;
use testkit::fixture::Fixture;
use testkit::robot::{Robot, limit};
use urdd_format::urdf::JointType;

use super::made::{X, Z, closing, core_with_loops, coupling, hinge, moved, robot, turn};

const FLAT: [f64; 3] = [0.0; 3];

/// Where two circles meet, to the left of the way from the first centre to the second.
fn meeting([a, b]: [[f64; 2]; 2], [of_a, of_b]: [f64; 2]) -> Option<[f64; 2]> {
    let way = [b[0] - a[0], b[1] - a[1]];
    let apart = way[0].hypot(way[1]);
    let along = (apart * apart + of_a * of_a - of_b * of_b) / (2.0 * apart);
    let aside = (of_a * of_a - along * along).sqrt();
    let [x, y] = way.map(|part| part / apart);
    let met = [a[0] + along * x - aside * y, a[1] + along * y + aside * x];
    met[0].is_finite().then_some(met)
}

/// The direction from one point to another.
fn direction(from: [f64; 2], to: [f64; 2]) -> f64 {
    (to[1] - from[1]).atan2(to[0] - from[0])
}

fn beyond(from: [f64; 2], angle: f64, length: f64) -> [f64; 2] {
    [from[0] + length * angle.cos(), from[1] + length * angle.sin()]
}

const GROUND: f64 = 0.2;
const FIVE_CRANK: f64 = 0.15;
const FIVE_COUPLER: f64 = 0.2;

/// Two driven cranks, and two couplers that meet in a pin. Not every pair of angles can be closed.
pub fn five_bar() -> Fixture {
    let mut five = robot("five_bar", "base");
    let cranks = Some([0.3, 2.8]);
    hinge(&mut five, "crank_a", "base", (FLAT, FLAT), Z, cranks);
    hinge(&mut five, "coupler_a", "crank_a", ([FIVE_CRANK, 0.0, 0.0], FLAT), Z, None);
    hinge(&mut five, "crank_b", "base", ([GROUND, 0.0, 0.0], FLAT), Z, cranks);
    hinge(&mut five, "coupler_b", "crank_b", ([FIVE_CRANK, 0.0, 0.0], FLAT), Z, None);
    let closed = |q: &[f64]| {
        let (a, b) = (q[0], q[2]);
        let ends = [beyond([0.0; 2], a, FIVE_CRANK), beyond([GROUND, 0.0], b, FIVE_CRANK)];
        // From b to a, the left side is above.
        let tip = meeting([ends[1], ends[0]], [FIVE_COUPLER; 2])
            .or_else(|| meeting(ends, [FIVE_COUPLER; 2]))?;
        let of = |end: usize, crank: f64| turn(direction(ends[end], tip) - crank);
        Some(vec![a, of(0, a), b, of(1, b)])
    };
    let tip = [FIVE_COUPLER, 0.0, 0.0];
    let pin = closing(&five, "pin", "Revolute", [("coupler_a", tip), ("coupler_b", tip)]);
    let start = [2.0, 0.0, 1.0, 0.0];
    core_with_loops(&five, [vec![pin], vec![]], &[0, 2], closed, &start, 12)
}

/// Where a finger's driver and follower are held, m; the lengths of both; and where the follower holds the finger.
const DRIVER_AT: [f64; 2] = [0.0, 0.02];
const FOLLOWER_AT: [f64; 2] = [-0.01, 0.045];
const DRIVER: f64 = 0.05;
const FOLLOWER: f64 = 0.055;
const HELD_AT: [f64; 2] = [-0.008, 0.022];

/// Two fingers, each on a driver and a follower, whose drivers turn each other: one DOF is free.
pub fn gripper() -> Fixture {
    let mut gripper = robot("two_loops", "palm");
    let mut loops = Vec::new();
    for (side, mirrored) in [("left", 1.0), ("right", -1.0)] {
        let at = |[x, y]: [f64; 2]| [x, mirrored * y, 0.0];
        let named = |of: &str| format!("{side}_{of}");
        let (driver, finger, follower) = (named("driver"), named("finger"), named("follower"));
        let limits = Some(if mirrored > 0.0 { [-0.6, 0.9] } else { [-0.9, 0.6] });
        hinge(&mut gripper, &driver, "palm", (at(DRIVER_AT), FLAT), Z, limits);
        hinge(&mut gripper, &finger, &driver, ([DRIVER, 0.0, 0.0], FLAT), Z, Some([-2.0, 2.0]));
        hinge(&mut gripper, &follower, "palm", (at(FOLLOWER_AT), FLAT), Z, Some([-2.5, 2.5]));
        let ends = [(&*finger, at(HELD_AT)), (&*follower, [FOLLOWER, 0.0, 0.0])];
        loops.push(closing(&gripper, &named("pin"), "Revolute", ends));
    }
    let gear = coupling("gear", 0.0, &[(0, 1.0), (3, 1.0)]);
    let closed = |q: &[f64]| {
        let end = beyond(DRIVER_AT, q[0], DRIVER);
        let arm = HELD_AT[0].hypot(HELD_AT[1]);
        let held = meeting([FOLLOWER_AT, end], [FOLLOWER, arm])?;
        let finger = turn(direction(end, held) - direction([0.0; 2], HELD_AT) - q[0]);
        let follower = direction(FOLLOWER_AT, held);
        Some(vec![q[0], finger, follower, -q[0], -finger, -follower])
    };
    let start = [0.2, 0.0, 0.0, 0.0, 0.0, 0.0];
    core_with_loops(&gripper, [loops, vec![gear]], &[0], closed, &start, 6)
}

/// A sun, a ring and a carrier, of which the third follows; a pinion that the carrier turns, and its rack. No loop.
pub fn wheels() -> Fixture {
    let mut wheels: Robot = robot("wheels", "case");
    let at = |x: f64| ([x, 0.0, 0.0], FLAT);
    hinge(&mut wheels, "sun", "case", at(0.0), Z, None);
    hinge(&mut wheels, "ring", "case", at(0.0), Z, Some([-1.0, 1.0]));
    hinge(&mut wheels, "carrier", "case", at(0.0), Z, None);
    hinge(&mut wheels, "pinion", "case", at(0.2), Z, Some([-1.0, 1.0]));
    moved(&mut wheels, "rack", JointType::Prismatic, "case", at(0.3), Some(X));
    wheels.joint_mut("rack_joint").limit = limit(-0.02, 0.02);
    let couplings: Vec<Value> = vec![
        coupling("planets", 0.0, &[(0, 1.0), (1, 3.0), (2, -4.0)]),
        coupling("pinion_on_carrier", 0.1, &[(2, 1.0), (3, 2.0)]),
        coupling("rack_on_pinion", 0.0, &[(3, 0.02), (4, -1.0)]),
    ];
    let closed = |q: &[f64]| {
        let carrier = (q[0] + 3.0 * q[1]) / 4.0;
        let pinion = -(carrier + 0.1) / 2.0;
        Some(vec![q[0], q[1], carrier, pinion, 0.02 * pinion])
    };
    core_with_loops(&wheels, [vec![], couplings], &[0, 1], closed, &[0.5, -0.25], 6)
}
