use urdd_format::readable::number as shown;

use super::prelude::*;

declare_lint! {
    /// The effort or velocity of a joint's limit is negative, or one of them is 0; or a joint slides at 20 m/s or more.
    ///
    /// Programs refuse a negative one, on joints that follow another one too. With effort 0, Gazebo, ros2_control and whoever asks PyBullet for the limit apply no force. With velocity 0, MoveIt's time
    /// parameterization fails. MuJoCo takes 0 as "no limit".
    ///
    /// A prismatic joint of 20 m/s or more has its velocity in millimetres a second, or too large; 100, 500, 999 and such stand for
    /// "unlimited".
    ///
    /// Write what the motor can do, in N or N m, and in m/s or rad/s. Where both are 0, SRC009 says so.
    LNT013 "absurd-velocity-or-effort", Warning, WrongMotion, since "1.1.0" => absurd_velocity_or_effort;

    /// A `<limit>` has no effort or no velocity, or a revolute or prismatic joint has no `<limit>`.
    ///
    /// A `<limit>` needs both on joints of any type, and a joint that follows another needs a `<limit>`: ROS says `Could not
    /// parse limit element`, or `did not specify limits`. yourdfpy and others load the robot, so that nobody sees it.
    ///
    /// Write what is missing: what the motor can do, in N or N m, and in m/s or rad/s.
    LNT017 "limit-incomplete", Error, Format, since "1.1.0" => limit_incomplete;

    /// The limits of a revolute joint look like degrees.
    ///
    /// URDF's angles are radians, and every program takes them as such: with `upper="90"` the joint turns 14 times around
    /// before it stops. Planners and random sampling then use poses that the robot cannot take.
    ///
    /// So are velocities: with `velocity="180"` a planner takes 29 turns a second for possible. One from 75 rad/s is reported, but
    /// not 100, 500, 999 and such, which stand for "unlimited".
    ///
    /// Divide by 57.2958 (180/π). A joint without limits is `continuous`.
    LNT010 "limits-look-like-degrees", Warning, WrongMotion, since "1.1.0" => limits_look_like_degrees;

    /// The limits of a joint leave out 0.
    ///
    /// Most programs begin with every joint at 0, which this joint cannot take. MuJoCo pushes it into its range from the
    /// first step: without any load it was at 1.2 rad/s after 0.4 s. MoveIt refuses 0 as a start, and RViz shows a pose
    /// that the robot does not have.
    ///
    /// Give programs a start within the limits, such as a `<group_state>` of the SRDF, a keyframe of MuJoCo, or
    /// `initial_value` of ros2_control. A joint that is still being designed can have its 0 within the limits.
    LNT011 "zero-outside-limits", Info, WrongMotion, since "1.1.0" => zero_outside_limits;

    /// A continuous joint has a lower or an upper limit.
    ///
    /// URDF has none for continuous joints, and programs disagree about them: a steering joint turns without end in one program
    /// and stops in another.
    ///
    /// - Drake keeps to each limit that is there, also to a single one. It holds a joint with equal limits, and refuses the robot if
    ///   the lower limit is above the upper one.
    /// - PyBullet 3.2.7 cuts targets of positions to them, so that a joint with limits 0 and 0 stays at 0. A missing `lower` is 0 there,
    ///   a missing `upper` -1; limits that are crossed then do nothing.
    /// - MuJoCo up to 3.3 limits the joint if `lower` is below `upper`. MuJoCo 4, Pinocchio, MoveIt and SDFormat, so Gazebo, ignore them.
    ///
    /// Make the joint `revolute` if it has stops. Otherwise remove `lower` and `upper`.
    LNT014 "continuous-with-limits", Warning, WrongMotion, since "1.1.0" => continuous_with_limits
}

fn absurd_velocity_or_effort(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (joint, limit) in urdf.limits_of(&ONE_DOF) {
        let bound = |name| number(limit, name).unwrap_or(0.0);
        let is_free = joint.attribute("type") == Some("continuous");
        // PyBullet takes a lower limit above the upper one as "free", and SRC tells others.
        let is_still = !is_free && bound("lower") >= bound("upper");
        let may_be_0 = is_still || child(joint, "mimic").is_some();
        for (name, other) in [("velocity", "effort"), ("effort", "velocity")] {
            let other = number(limit, other);
            let wrong = match number(limit, name) {
                Some(value) if value < 0.0 => "is negative",
                Some(0.0) if !may_be_0 && other.is_some_and(|other| other != 0.0) => {
                    "is 0: programs that keep to it do not move the joint"
                }
                _ => continue,
            };
            let message = format!("`{name}` {wrong}; write what the motor can do");
            urdf.at_attribute(limit, name, message).report(findings);
        }
        let velocity = number(limit, "velocity").filter(|one| is_too_fast(*one, FAST_SLIDE));
        if let (Some("prismatic"), Some(velocity)) = (joint.attribute("type"), velocity) {
            let message = format!(
                "`velocity` is {velocity} m/s; if it is in millimetres a second, write velocity=\"{}\"",
                shown(velocity / 1000.0, 5)
            );
            urdf.at_attribute(limit, "velocity", message).report(findings);
        }
    }
    Some(())
}

fn limit_incomplete(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for joint in &urdf.joints {
        let Some(limit) = child(*joint, "limit") else {
            if matches!(joint.attribute("type"), Some("revolute" | "prismatic")) {
                let message = "the joint has no `<limit>`; write it, with effort and velocity";
                urdf.at(*joint, message).report(findings);
            }
            continue;
        };
        let mut missing = vec!["effort", "velocity"];
        missing.retain(|name| !limit.has_attribute(*name));
        if !missing.is_empty() {
            let what = if missing.len() == 1 { "it" } else { "both" };
            let message = format!("`<limit>` has no {}; write {what}", missing.join(" and no "));
            urdf.at(limit, message).report(findings);
        }
    }
    Some(())
}

/// Sizes of the larger bound that are degrees. No revolute joint of 1,758 URDFs has one.
const FROM: f64 = 25.0;
const TO: f64 = 720.0;
/// Bounds on both sides that mean "unlimited".
const UNLIMITED: [f64; 3] = [50.0, 100.0, 500.0];

/// Velocities that are degrees or millimetres per second. Those of 1,181 URDFs are below, or stand for "unlimited".
const FAST_TURN: f64 = 75.0;
const FAST_SLIDE: f64 = 20.0;
const FASTEST: f64 = 7200.0;

/// Whether a velocity is above what motors do, and does not stand for "unlimited", as 100, 500 and 999 do.
fn is_too_fast(velocity: f64, from: f64) -> bool {
    let digits = velocity.to_string();
    let is_round = ["1", "5"].contains(&digits.trim_end_matches('0')) && velocity % 100.0 == 0.0;
    let is_nines = digits.len() > 2 && digits.bytes().all(|digit| digit == b'9');
    (from..=FASTEST).contains(&velocity) && !is_round && !is_nines
}

fn limits_look_like_degrees(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (_, limit) in urdf.limits_of(&["revolute"]) {
        let ends = number(limit, "lower").zip(number(limit, "upper"));
        let ends = ends.filter(|(lower, upper)| {
            let size = lower.abs().max(upper.abs());
            let is_unlimited = *lower == -*upper && UNLIMITED.contains(&size);
            (FROM..=TO).contains(&size) && !is_unlimited
        });
        let velocity = number(limit, "velocity").filter(|one| is_too_fast(*one, FAST_TURN));
        let radians =
            |name: &str, value: f64| format!("{name}=\"{}\"", shown(value.to_radians(), 5));
        let turn = velocity.map(|velocity| radians("velocity", velocity));
        let finding = match (ends, turn) {
            (Some((lower, upper)), turn) => {
                let mut written = vec![radians("lower", lower), radians("upper", upper)];
                written.extend(turn);
                let message = format!(
                    "the limits look like degrees, and are taken as radians; write {}",
                    written.join(" ")
                );
                urdf.at(limit, message).actual(format!("{lower} to {upper}"))
            }
            (None, Some(turn)) => {
                let message = format!(
                    "the velocity looks like degrees a second, and is taken as radians; write {turn}"
                );
                let actual = velocity.unwrap_or_default();
                urdf.at_attribute(limit, "velocity", message).actual(format!("{actual} rad/s"))
            }
            (None, None) => continue,
        };
        finding.report(findings);
    }
    Some(())
}

/// A rounded 0 is within the limits, rad or m.
const MARGIN: f64 = 1e-6;

fn zero_outside_limits(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (joint, limit) in urdf.limits_of(&["revolute", "prismatic"]) {
        let bound = |name| number(limit, name).unwrap_or(0.0);
        let (lower, upper) = (bound("lower"), bound("upper"));
        // SRC001 finds crossed limits.
        let is_within = lower > upper || (lower <= MARGIN && upper >= -MARGIN);
        if is_within || child(joint, "mimic").is_some() {
            continue;
        }
        let message = format!(
            "0 is outside of the limits {lower} to {upper}, and most programs start there; give them another \
            start"
        );
        urdf.at(limit, message).report(findings);
    }
    Some(())
}

/// What PyBullet takes for limits that are not there.
const PYBULLET: (f64, f64) = (0.0, -1.0);

fn continuous_with_limits(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (_, limit) in urdf.limits_of(&["continuous"]) {
        // A limit that is no number is URD011's.
        let [lower, upper] = ["lower", "upper"].map(|one| number(limit, one));
        let is_read = lower.is_some() == limit.has_attribute("lower")
            && upper.is_some() == limit.has_attribute("upper");
        if let Some(message) = message(lower, upper).filter(|_| is_read) {
            let first = if lower.is_some() { "lower" } else { "upper" };
            urdf.at_attribute(limit, first, message).report(findings);
        }
    }
    Some(())
}

fn message(lower: Option<f64>, upper: Option<f64>) -> Option<String> {
    let (from, to) = (lower.unwrap_or(PYBULLET.0), upper.unwrap_or(PYBULLET.1));
    let of_one = |which: &str, limit: f64| {
        let in_pybullet = match from <= to {
            true => format!("PyBullet cuts targets to {from} to {to}"),
            false => "PyBullet ignores it".to_owned(),
        };
        format!(
            "a continuous joint has only {which} limit, {limit}: Drake keeps to it, {in_pybullet}, most programs ignore it; \
            make it `revolute`, or remove the limit"
        )
    };
    Some(match (lower, upper) {
        (None, None) => return None,
        (Some(lower), None) => of_one("a lower", lower),
        (None, Some(upper)) => of_one("an upper", upper),
        (Some(lower), Some(upper)) if lower < upper => format!(
            "a continuous joint has the limits {lower} to {upper}, which Drake and PyBullet keep to and most programs ignore; \
            make it `revolute`, or remove them"
        ),
        (Some(lower), Some(upper)) if lower > upper => format!(
            "the lower limit of a continuous joint, {lower}, is above its upper one, {upper}: Drake refuses the robot, and most \
            programs ignore both; remove them"
        ),
        (Some(lower), Some(_)) => format!(
            "both limits of a continuous joint are {lower}: Drake and PyBullet hold it there, and in most programs it turns \
            without end; remove them, or make it `fixed`"
        ),
    })
}
