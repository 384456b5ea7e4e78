//! Robots with rods: a rod that points down is turned about y and then about x; its end is on a ball.

use std::f64::consts::TAU;

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use testkit::fixture::Fixture;
use testkit::robot::Robot;
use urdd_format::urdf::JointType;

use super::made::{X, Y, closing, core_with_loops, hinge, moved, robot, turn};

const STRAIGHT: [f64; 3] = [0.0; 3];
/// The limits of a rod's two hinges, rad.
const SWING: [f64; 2] = [-2.8, 2.8];
const SIDE: [f64; 2] = [-1.2, 1.2];

/// Adds a rod: the links `NAME_cross` and `NAME`.
fn rod(robot: &mut Robot, name: &str, parent: &str, at: [f64; 3]) {
    let cross = format!("{name}_cross");
    hinge(robot, &cross, parent, (at, STRAIGHT), Y, Some(SWING));
    hinge(robot, name, &cross, (STRAIGHT, STRAIGHT), X, Some(SIDE));
}

/// The two angles of a rod that points along a unit vector of its parent's axes.
fn angles(along: &Vector3<f64>) -> [f64; 2] {
    [(-along.x).atan2(-along.z), along.y.asin()]
}

/// How far the motors and the platform's corners are from the middle, the lengths of arms and rods, and half of how far
/// the two rods of an arm are apart, m.
const BASE: f64 = 0.2;
const PLATFORM: f64 = 0.05;
const ARM: f64 = 0.2;
const ROD: f64 = 0.45;
const HALF: f64 = 0.04;

/// Three arms, each with two rods side by side, which keep the platform level.
pub fn delta() -> Fixture {
    let mut delta = robot("delta", "base");
    let about: [f64; 3] = [0.0, 1.0, 2.0].map(|arm| arm * TAU / 3.0);
    let corner = |arm: usize, side: f64| {
        Rotation3::from_axis_angle(&Vector3::z_axis(), about[arm])
            * Vector3::new(PLATFORM, side * HALF, 0.0)
    };
    let sides = [("left", 1.0), ("right", -1.0)];
    for (arm, about) in about.into_iter().enumerate() {
        let name = format!("arm_{arm}");
        let at = ([BASE * about.cos(), BASE * about.sin(), 0.0], [0.0, 0.0, about]);
        hinge(&mut delta, &name, "base", at, Y, Some([-0.2, 1.1]));
        for (side, sign) in sides {
            rod(&mut delta, &format!("{side}_rod_{arm}"), &name, [ARM, sign * HALF, 0.0]);
        }
    }
    let end = [0.0, 0.0, -ROD];
    moved(&mut delta, "platform", JointType::Spherical, "left_rod_0", (end, STRAIGHT), None);
    let mut loops = Vec::new();
    for arm in 0..3 {
        for (side, sign) in sides {
            if (arm, side) == (0, "left") {
                continue;
            }
            let name = format!("{side}_rod_{arm}");
            let to: [f64; 3] = (corner(arm, sign) - corner(0, 1.0)).into();
            let ends = [(&*name, end), ("platform", to)];
            loops.push(closing(&delta, &format!("ball_{side}_{arm}"), "Spherical", ends));
        }
    }
    let closed = |q: &[f64]| {
        let arms = [q[0], q[5], q[10]];
        // The middle of the platform is a rod away from each elbow, moved inward by the corner.
        let elbows = [0, 1, 2].map(|arm| {
            let out = BASE + ARM * arms[arm].cos() - PLATFORM;
            let [sin, cos] = [about[arm].sin(), about[arm].cos()];
            Vector3::new(out * cos, out * sin, -ARM * arms[arm].sin())
        });
        let middle = below(&elbows, ROD)?;
        let mut q = Vec::new();
        for (arm, angle) in arms.into_iter().enumerate() {
            let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), about[arm])
                * Rotation3::from_axis_angle(&Vector3::y_axis(), angle);
            let along = turned.inverse() * (middle - elbows[arm]) / ROD;
            let [swing, side] = angles(&along);
            q.extend([angle, swing, side, swing, side]);
        }
        let first = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), q[0] + q[1])
            * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), q[2]);
        q.extend(first.inverse().scaled_axis().iter());
        Some(q)
    };
    let mut start = vec![0.0; 18];
    (start[0], start[5], start[10]) = (0.3, 0.5, 0.4);
    core_with_loops(&delta, [loops, vec![]], &[0, 5, 10], closed, &start, 6)
}

/// The lower of the two points that are as far from three points.
fn below([a, b, c]: &[Vector3<f64>; 3], far: f64) -> Option<Vector3<f64>> {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(&ac);
    // The middle of the circle through the three points.
    let middle = (ac.norm_squared() * normal.cross(&ab) - ab.norm_squared() * normal.cross(&ac))
        / (2.0 * normal.norm_squared());
    let aside = (far * far - middle.norm_squared()).sqrt() * normal.normalize();
    let down = if aside.z < 0.0 { aside } else { -aside };
    let found = a + middle + down;
    found.x.is_finite().then_some(found)
}

/// The ankle is this far below the shank's frame, the motors this far; the motors and the foot's pins behind the ankle and
/// to the sides, m.
const ANKLE: f64 = 0.4;
const MOTOR: f64 = 0.1;
const BEHIND: f64 = 0.06;
const ASIDE: f64 = 0.05;

/// A leg whose foot is moved by two motors in the shank, through cranks and rods; and a knee, which no loop depends on.
pub fn ankle() -> Fixture {
    let mut leg = robot("leg", "thigh");
    hinge(&mut leg, "shank", "thigh", ([0.0, 0.0, -0.4], STRAIGHT), Y, Some([0.0, 2.0]));
    hinge(&mut leg, "cross", "shank", ([0.0, 0.0, -ANKLE], STRAIGHT), Y, Some([-0.5, 0.5]));
    hinge(&mut leg, "foot", "cross", (STRAIGHT, STRAIGHT), X, Some([-0.3, 0.3]));
    let mut loops = Vec::new();
    let sides = [("left", ASIDE), ("right", -ASIDE)];
    for (side, y) in sides {
        let (crank, bar) = (format!("{side}_crank"), format!("{side}_rod"));
        hinge(&mut leg, &crank, "shank", ([0.0, y, -MOTOR], STRAIGHT), Y, Some([-1.5, 1.5]));
        rod(&mut leg, &bar, &crank, [-BEHIND, 0.0, 0.0]);
        let ends = [(&*bar, [0.0, 0.0, MOTOR - ANKLE]), ("foot", [-BEHIND, y, 0.0])];
        loops.push(closing(&leg, &format!("{side}_ball"), "Spherical", ends));
    }
    let closed = |q: &[f64]| {
        let foot = Rotation3::from_axis_angle(&Vector3::y_axis(), q[1])
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q[2]);
        let mut closed = q[..3].to_vec();
        let long = ANKLE - MOTOR;
        for (_, y) in sides {
            // From the motor to the foot's pin. The crank's end is at (-cos, 0, sin) times its length.
            let pin = foot * Vector3::new(-BEHIND, y, 0.0) - Vector3::new(0.0, y, long);
            let sum = (pin.norm_squared() + BEHIND * BEHIND - long * long) / (2.0 * BEHIND);
            let (a, b) = (-pin.x, pin.z);
            let crank = turn(b.atan2(a) + (sum / a.hypot(b)).acos());
            let turned = Rotation3::from_axis_angle(&Vector3::y_axis(), crank);
            let end = turned * Vector3::new(-BEHIND, 0.0, 0.0);
            closed.push(crank);
            closed.extend(angles(&(turned.inverse() * (pin - end) / long)));
        }
        closed.iter().all(|value| value.is_finite()).then_some(closed)
    };
    let start = [0.5, 0.1, -0.05];
    core_with_loops(&leg, [loops, vec![]], &[0, 1, 2], closed, &start, 6)
}
