use super::prelude::*;

declare_lint! {
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
    LNT014 "continuous-with-limits", Warning, WrongMotion, since "1.1.0"
}

/// What PyBullet takes for limits that are not there.
const PYBULLET: (f64, f64) = (0.0, -1.0);

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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
