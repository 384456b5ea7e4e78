//! Limits of joints of which one is not said.

use super::features::{self, Tally};
use super::model::JointKind;
use super::place::Place;

/// How far the other limit is from one that stands alone, rad and m.
const FAR: [f64; 2] = [4.0 * std::f64::consts::PI, 10.0];

/// The limits of a joint, where infinite ones are none; `None` without any.
pub fn limits(
    [lower, upper]: [f64; 2],
    kind: JointKind,
    (joint, place): (&str, Place),
    tally: &mut Tally,
) -> Option<[f64; 2]> {
    let far = FAR[usize::from(kind == JointKind::Slide)];
    let (range, missing) = match (lower.is_finite(), upper.is_finite()) {
        (true, true) => return Some([lower, upper]),
        (false, false) => return None,
        (true, false) => ([lower, far.max(lower + far)], "upper"),
        (false, true) => ([(-far).min(upper - far), upper], "lower"),
    };
    tally.count(features::ONE_SIDED);
    let text = format!("joint `{joint}` has no {missing} limit: it is written with {range:?}");
    tally.remark(place, text);
    Some(range)
}

/// Says that a joint closes a chain, in which its limits are left out.
pub fn say_closed(
    ranges: impl IntoIterator<Item = [f64; 2]>,
    (joint, place): (&str, Place),
    tally: &mut Tally,
) {
    tally.count(features::CLOSED);
    if ranges.into_iter().flatten().any(f64::is_finite) {
        let text = format!(
            "the limits of joint `{joint}` are left out: it closes a chain, and moves as the others let it"
        );
        tally.remark(place, text);
    }
}
