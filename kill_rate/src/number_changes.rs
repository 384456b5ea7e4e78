//! Mutations of a number.

use serde_json::{Value, json};

use super::dice::Dice;
use super::field::Field;
use super::free::Ground;

/// Relative step sizes.
const RELATIVE_STEPS: [(&str, f64); 4] = [
    ("a step of 1e-7 of it", 1e-7),
    ("a step of 1e-6 of it", 1e-6),
    ("a step of 1e-3 of it", 1e-3),
    ("a step of 0.1 of it", 0.1),
];

/// Absolute step sizes, in the number's own unit.
const ABSOLUTE_STEPS: [(&str, f64); 3] =
    [("a step of 1e-6", 1e-6), ("a step of 1e-3", 1e-3), ("a step of 1", 1.0)];

/// Mutations of a non-integer number.
pub(crate) fn numbers(ground: &Ground, x: f64, dice: &mut Dice) -> Vec<(&'static str, Value)> {
    let mut to = vec![
        ("the other sign", -x),
        ("twice", 2.0 * x),
        ("zero", 0.0),
        ("huge", 1e12_f64.copysign(x)),
        // Slightly more than the smallest change that counts.
        ("eleven tolerances", x + dice.sign() * 11.5 * ground.tolerance(x, x)),
        ("a millionth of the reach", x + dice.sign() * 1e-6 * ground.reach),
    ];
    for (kind, step) in RELATIVE_STEPS {
        to.push((kind, x * (1.0 + dice.sign() * step)));
    }
    for (kind, step) in ABSOLUTE_STEPS {
        to.push((kind, x + dice.sign() * step));
    }
    // Adding 0.0 turns negative zero into zero.
    to.into_iter().map(|(kind, x)| (kind, json!(x + 0.0))).collect()
}

/// Mutations of an integer.
pub(crate) fn integers(
    field: &Field,
    value: &Value,
    dice: &mut Dice,
) -> Vec<(&'static str, Value)> {
    let Some(x) = value.as_f64() else {
        return Vec::new();
    };
    let mut to = vec![
        ("one more", whole(x + 1.0)),
        ("half more", json!(x + 0.5)),
        ("zero", json!(0)),
        ("huge", json!(u32::MAX)),
    ];
    to.push(("one less", whole(x - 1.0)));
    if let Some((_, other)) = field.another(value, dice, Value::is_number) {
        to.push(("another place's integer", other.clone()));
    }
    to
}

#[allow(clippy::cast_possible_truncation)]
fn whole(x: f64) -> Value {
    json!(x as i64)
}
