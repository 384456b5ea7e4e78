//! Compares the documents of two producers for one robot.

use std::collections::BTreeSet;

use serde_json::Value;

/// The first difference between two documents, with its JSON Pointer. Poses agree within 1e-9; quaternions up to the
/// sign, which depends on rounding at half a turn. Other numbers agree within 1e-12 of their size (plus 1e-14 for
/// cancelling sums).
pub fn difference(ours: &Value, theirs: &Value, at: &str) -> Option<String> {
    match (ours, theirs) {
        (Value::Object(a), Value::Object(b)) => {
            let keys: [BTreeSet<&String>; 2] = [a.keys().collect(), b.keys().collect()];
            if keys[0] != keys[1] {
                return Some(format!("{at}: keys {:?} or {:?}", keys[0], keys[1]));
            }
            a.iter().find_map(|(key, value)| difference(value, &b[key], &format!("{at}/{key}")))
        }
        (Value::Array(a), Value::Array(b)) if at.ends_with("/quaternion_wxyz") => {
            let gap = |sign: f64| {
                let pairs = a.iter().zip(b);
                let gaps = pairs.map(|(a, b)| (number(a) - sign * number(b)).abs());
                gaps.fold(0.0, f64::max)
            };
            let agree = a.len() == 4 && b.len() == 4 && gap(1.0).min(gap(-1.0)) <= 1e-9;
            (!agree).then(|| format!("{at}: {ours} or {theirs}"))
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            let mut pairs = a.iter().zip(b).enumerate();
            pairs.find_map(|(i, (a, b))| difference(a, b, &format!("{at}/{i}")))
        }
        (Value::Number(_), Value::Number(_)) => {
            let (a, b) = (number(ours), number(theirs));
            let in_pose = at.contains("/link_poses/") || at.contains("/origin/position/");
            let size = a.abs().max(b.abs());
            let tolerance = if in_pose { 1e-9 * size.max(1.0) } else { 1e-12 * size + 1e-14 };
            let agree = (a - b).abs() <= tolerance;
            (!agree || ours.is_f64() != theirs.is_f64())
                .then(|| format!("{at}: {ours} or {theirs}"))
        }
        _ => (ours != theirs).then(|| format!("{at}: {ours} or {theirs}")),
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}
