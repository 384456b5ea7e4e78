//! The robot's reach (SPEC 5.6), computed from modules only.

use serde_json::Value;

/// Minimum reach, m (SPEC 5.6).
const LEAST: f64 = 1e-3;

/// The maximum, over all links, of the sum of joint origin lengths and joint travels along the path from the root.
pub(crate) fn reach(chain: Option<&Value>, urdf: Option<&Value>) -> f64 {
    let joints = list(chain, "/joints_in_chain");
    let far: Vec<f64> = joints
        .iter()
        .enumerate()
        .map(|(index, joint)| length(joint) + travel(joint, list(urdf, "/joints").get(index)))
        .collect();
    let parent_joint = |joint: usize| {
        let link = joints[joint].get("parent_link_idx")?.as_u64()?;
        joints
            .iter()
            .position(|other| other.get("child_link_idx").and_then(Value::as_u64) == Some(link))
    };
    let mut reach = LEAST;
    for joint in 0..joints.len() {
        let mut path = Some(joint);
        let mut sum = 0.0;
        // A path in a tree has at most as many joints as the tree.
        for _ in 0..joints.len() {
            let Some(joint) = path else { break };
            sum += far[joint];
            path = parent_joint(joint);
        }
        reach = reach.max(sum);
    }
    reach
}

fn list<'a>(document: Option<&'a Value>, pointer: &str) -> &'a [Value] {
    let list = document.and_then(|document| document.pointer(pointer)?.as_array());
    list.map_or(&[], Vec::as_slice)
}

fn length(joint: &Value) -> f64 {
    let position = list(Some(joint), "/origin/position");
    let squares = position.iter().filter_map(Value::as_f64).map(|x| x * x);
    squares.sum::<f64>().sqrt()
}

fn travel(joint: &Value, in_urdf: Option<&Value>) -> f64 {
    let limit = |key: &str| in_urdf?.pointer("/limit")?.get(key)?.as_f64();
    match joint.get("joint_type").and_then(Value::as_str) {
        Some("Prismatic") => match (limit("lower"), limit("upper")) {
            (None, None) => 1.0,
            (lower, upper) => lower.unwrap_or(0.0).abs().max(upper.unwrap_or(0.0).abs()),
        },
        Some("Planar" | "Floating") => 1.0,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn adds_offsets_and_travel_along_a_path() {
        let joint = |kind: &str, parent: u32, child: u32, position: [f64; 3]| {
            json!({"joint_type": kind, "parent_link_idx": parent, "child_link_idx": child,
                   "origin": {"position": position}})
        };
        let chain = json!({"joints_in_chain": [
            joint("Prismatic", 1, 2, [0.0, 0.0, 0.5]),
            joint("Revolute", 0, 1, [3.0, 4.0, 0.0]),
            joint("Floating", 0, 3, [0.0; 3]),
        ]});
        let urdf = json!({"joints": [{"limit": {"lower": -2.0, "upper": 1.0}}, {}, {}]});
        assert_eq!(reach(Some(&chain), Some(&urdf)), 7.5);
        assert_eq!(reach(None, None), LEAST);
    }
}
