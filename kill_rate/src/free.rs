//! Changes that do not count: to fields that SPEC.md leaves free, to another valid value, or by less than ten times the
//! tolerance.

use serde_json::Value;

/// A field whose value SPEC.md leaves to the producer or to manual edits.
pub struct FreeField {
    /// The module, or `urdd.json`.
    pub module: &'static str,
    /// The field, with everything below it.
    pub field: &'static str,
    /// The clause that leaves it free.
    pub clause: &'static str,
}

/// Every free field. (Keys that begin with `x_`, and `$schema`, are always free: 3.1.2.)
pub const FREE_FIELDS: &[FreeField] = &[
    FreeField { module: "urdd.json", field: "/generator", clause: "2.2" },
    FreeField { module: "convex_decomposition_meshes_module", field: "/method", clause: "Annex A" },
    FreeField { module: "link_shapes_skips_module", field: "/edits/*/reason", clause: "Annex A" },
    // The producer's description of how the model was made.
    FreeField { module: "self_collision_model_module", field: "/clip_distance", clause: "8.8.12" },
    FreeField { module: "self_collision_model_module", field: "/training", clause: "8.8.12" },
    FreeField { module: "self_collision_model_module", field: "/calibration", clause: "8.8.12" },
    // Properties of the original parts, which this URDD does not contain.
    FreeField { module: "composition_module", field: "/parts/*/name", clause: "Annex A" },
    FreeField { module: "composition_module", field: "/parts/*/source", clause: "6.6.7" },
    FreeField { module: "composition_module", field: "/parts/*/composition", clause: "6.6.7" },
];

/// A change of a field to another value that SPEC.md allows.
pub struct Permitted {
    /// The module, or `urdd.json`.
    pub module: &'static str,
    /// The field.
    pub field: &'static str,
    /// The change.
    pub change: &'static str,
    /// The clause that allows it.
    pub clause: &'static str,
    permits: fn(&Value, &Value) -> bool,
}

/// Every allowed change.
pub const PERMITTED: &[Permitted] = &[
    Permitted {
        module: "urdd.json",
        field: "/conformance_class",
        change: "to a lower class: more than is claimed may be there",
        clause: "12.1",
        permits: |from, to| {
            let rank =
                |class: &Value| ["Core", "Geometry", "Shapes"].iter().position(|c| class == c);
            rank(to).is_some() && rank(to) < rank(from)
        },
    },
    Permitted {
        module: "urdd.json",
        field: "/urdd_version",
        change: "to a newer minor or patch version",
        clause: "4.2",
        permits: |from, to| {
            let version = |value: &Value| semver::Version::parse(value.as_str()?).ok();
            match (version(from), version(to)) {
                (Some(from), Some(to)) => to.major == from.major && to > from,
                _ => false,
            }
        },
    },
    Permitted {
        module: "urdd.json",
        field: "/modules/*/depends_on",
        change: "of the order: it names modules in any",
        clause: "2.10",
        permits: |from, to| match (from.as_array(), to.as_array()) {
            (Some(from), Some(to)) => {
                from.len() == to.len() && from.iter().all(|name| to.contains(name))
            }
            _ => false,
        },
    },
    Permitted {
        module: "kinematics_samples_module",
        field: "/samples",
        change: "fewer sampled ones: how many there are is not said",
        clause: "9.2",
        permits: |from, to| match (from.as_array(), to.as_array()) {
            (Some(from), Some(to)) => to.len() >= 4 && from.starts_with(to),
            _ => false,
        },
    },
    Permitted {
        module: "composition_module",
        field: "/parts/*/id",
        change: "to another id: the recipe is not here",
        clause: "6.6.2",
        permits: |_, to| {
            let id = to.as_str();
            id.is_some_and(|id| !id.is_empty() && !id.contains('/'))
        },
    },
    Permitted {
        module: "composition_module",
        field: "/parts/*/dropped_links",
        change: DROPPED,
        clause: "6.6.3",
        permits: |_, to| are_names(to),
    },
    Permitted {
        module: "composition_module",
        field: "/parts/*/dropped_links/*",
        change: DROPPED,
        clause: "6.6.3",
        permits: |_, to| to.is_string(),
    },
    Permitted {
        module: "composition_module",
        field: "/parts/*/dropped_joints",
        change: DROPPED,
        clause: "6.6.3",
        permits: |_, to| are_names(to),
    },
    Permitted {
        module: "composition_module",
        field: "/parts/*/dropped_joints/*",
        change: DROPPED,
        clause: "6.6.3",
        permits: |_, to| to.is_string(),
    },
    Permitted {
        module: "composition_module",
        field: "/parts/*/frozen_joints",
        change: "fewer: the others may have been fixed in the part",
        clause: "6.6.6",
        permits: |from, to| match (from.as_array(), to.as_array()) {
            (Some(from), Some(to)) => {
                let mut from = from.iter();
                to.iter().all(|joint| from.any(|of| of == joint))
            }
            _ => false,
        },
    },
    Permitted {
        module: "composition_module",
        field: "/parts/*/frozen_joints/*/position",
        change: "to 1, 3 or 6 other values: where it was is not here",
        clause: "6.6.6",
        permits: |_, to| {
            let values = to.as_array();
            values
                .is_some_and(|to| [1, 3, 6].contains(&to.len()) && to.iter().all(Value::is_number))
        },
    },
    Permitted {
        module: "composition_module",
        field: "/parts/*/frozen_joints/*/position/*",
        change: "to another value: where it was is not here",
        clause: "6.6.6",
        permits: |_, to| to.is_number(),
    },
    Permitted {
        module: "named_configurations_module",
        field: "/configurations",
        change: "fewer, or in another order: a person decides which there are",
        clause: "6.7.1",
        permits: |from, to| match (from.as_array(), to.as_array()) {
            (Some(from), Some(to)) => {
                let is_first = |(place, one): (usize, &Value)| {
                    from.contains(one) && !to[..place].contains(one)
                };
                to.iter().enumerate().all(is_first)
            }
            _ => false,
        },
    },
    Permitted {
        module: "named_configurations_module",
        field: "/configurations/*/name",
        change: "to another name: a person decides",
        clause: "6.7.2",
        permits: |_, to| to.as_str().is_some_and(|name| !name.is_empty()),
    },
];

const DROPPED: &str = "to other names, each once: the part's links and joints are not here";

fn are_names(list: &Value) -> bool {
    let Some(names) = list.as_array() else {
        return false;
    };
    let is_first = |(place, name): (usize, &Value)| !names[..place].contains(name);
    names.iter().all(Value::is_string) && names.iter().enumerate().all(is_first)
}

/// Whether SPEC.md allows this change of a field.
pub(crate) fn is_permitted(module: &str, field: &str, from: &Value, to: &Value) -> bool {
    PERMITTED.iter().any(|permitted| {
        permitted.module == module && permitted.field == field && (permitted.permits)(from, to)
    })
}

/// The difference that a clause allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// For a copied number: 1e-9 of the larger absolute value, at least 1e-12.
    Copied,
    /// Proportion of the robot's reach.
    OfReach(f64),
    /// Proportion of the largest shape's size.
    OfShapes(f64),
    /// Proportion of twice the reach plus twice the largest shape's size, the maximum distance between two points.
    OfSpan(f64),
    /// Absolute, in the number's own unit.
    Absolute(f64),
}

/// The tolerance of the numbers of a field.
pub struct FieldTolerance {
    /// The module.
    pub module: &'static str,
    /// The field, with everything below it.
    pub field: &'static str,
    /// The tolerance.
    pub tolerance: Tolerance,
    /// The clause that specifies it.
    pub clause: &'static str,
}

/// Every field with a tolerance other than that of copied numbers (5.6).
pub const FIELD_TOLERANCES: &[FieldTolerance] = &[
    FieldTolerance {
        module: "chain_module",
        field: "/joints_in_chain/*/origin/position",
        tolerance: Tolerance::OfReach(1e-9),
        clause: "5.6",
    },
    FieldTolerance {
        module: "chain_module",
        field: "/joints_in_chain/*/origin/quaternion_wxyz",
        tolerance: Tolerance::Absolute(1e-9),
        clause: "5.6, 6.3.4",
    },
    FieldTolerance {
        module: "chain_module",
        field: "/joints_in_chain/*/axis",
        tolerance: Tolerance::Absolute(1e-9),
        clause: "6.3.4",
    },
    FieldTolerance {
        module: "kinematics_samples_module",
        field: "/samples/*/link_poses/*/position",
        tolerance: Tolerance::OfReach(1e-9),
        clause: "5.6",
    },
    FieldTolerance {
        module: "kinematics_samples_module",
        field: "/samples/*/link_poses/*/quaternion_wxyz",
        tolerance: Tolerance::Absolute(1e-9),
        clause: "5.6",
    },
    FieldTolerance {
        module: "kinematics_samples_module",
        field: "/samples/*/configuration",
        tolerance: Tolerance::Absolute(4e-9),
        clause: "5.6, of the bounds' size",
    },
    FieldTolerance {
        module: "named_configurations_module",
        field: "/configurations/*/configuration",
        tolerance: Tolerance::Absolute(4e-9),
        clause: "5.6, of the bounds' size",
    },
    FieldTolerance {
        module: "link_shapes_approximations_module",
        field: "",
        tolerance: Tolerance::OfShapes(1e-6),
        clause: "8.2",
    },
    FieldTolerance {
        module: "link_shapes_max_distance_from_origin_module",
        field: "/full_convex_hulls_maximum_distances",
        tolerance: Tolerance::OfShapes(1e-6),
        clause: "8.3",
    },
    FieldTolerance {
        module: "link_shapes_max_distance_from_origin_module",
        field: "/decomposition_convex_hulls_maximum_distances",
        tolerance: Tolerance::OfShapes(1e-6),
        clause: "8.3",
    },
    FieldTolerance {
        module: "link_shapes_distance_statistics_module",
        field: "",
        tolerance: Tolerance::OfSpan(1e-5),
        clause: "8.5",
    },
    FieldTolerance {
        module: "self_collision_model_module",
        field: "/evaluation",
        tolerance: Tolerance::Absolute(5.0),
        clause: "8.8.9",
    },
];

/// Smallest change that counts, in tolerances.
const LEAST_TOLERANCES: f64 = 10.0;

/// Whether a field is free.
pub(crate) fn is_free(module: &str, field: &str) -> bool {
    FREE_FIELDS.iter().any(|free| free.module == module && is_within(field, free.field))
}

fn is_within(field: &str, of: &str) -> bool {
    field.strip_prefix(of).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

/// The location of a number, which determines its tolerance.
#[derive(Clone, Copy)]
pub(crate) struct Ground<'a> {
    /// The module, or `urdd.json`.
    pub module: &'a str,
    /// The field.
    pub field: &'a str,
    /// The robot's reach, m.
    pub reach: f64,
    /// The largest shape's size, m.
    pub shapes: f64,
}

impl Ground<'_> {
    /// The tolerance between two numbers.
    pub(crate) fn tolerance(&self, from: f64, to: f64) -> f64 {
        let listed = FIELD_TOLERANCES
            .iter()
            .find(|listed| listed.module == self.module && is_within(self.field, listed.field));
        let larger = from.abs().max(to.abs());
        match listed.map_or(Tolerance::Copied, |listed| listed.tolerance) {
            Tolerance::Copied => (1e-9 * larger).max(1e-12),
            Tolerance::OfReach(part) => part * self.reach,
            Tolerance::OfShapes(part) => part * self.shapes,
            Tolerance::OfSpan(part) => part * 2.0 * (self.reach + self.shapes),
            Tolerance::Absolute(tolerance) => tolerance,
        }
    }

    /// Whether the difference of two numbers is large enough to count.
    pub(crate) fn counts(&self, from: f64, to: f64) -> bool {
        (from - to).abs() >= LEAST_TOLERANCES * self.tolerance(from, to)
    }

    /// Whether the difference of two values is large enough to count.
    pub(crate) fn differs(&self, from: &Value, to: &Value) -> bool {
        match (from, to) {
            (Value::Number(a), Value::Number(b)) => match (a.as_f64(), b.as_f64()) {
                (Some(a), Some(b)) => a != b && self.counts(a, b),
                _ => a != b,
            },
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
                let field = format!("{}/*", self.field);
                let inner = Ground { field: &field, ..*self };
                a.iter().zip(b).any(|(a, b)| inner.differs(a, b))
            }
            (Value::Object(a), Value::Object(b)) if a.len() == b.len() => {
                a.iter().any(|(key, value)| match b.get(key) {
                    None => true,
                    Some(other) => {
                        let field = format!("{}/{key}", self.field);
                        let inner = Ground { field: &field, ..*self };
                        inner.differs(value, other)
                    }
                })
            }
            _ => from != to,
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn small_steps_do_not_count() {
        let ground = Ground {
            module: "chain_module",
            field: "/joints_in_chain/*/origin/position",
            reach: 2.0,
            shapes: 1.0,
        };
        assert!(!ground.differs(&json!([1.0, 0.0]), &json!([1.0, 1.9e-8])));
        assert!(ground.differs(&json!([1.0, 0.0]), &json!([1.0, 2.1e-8])));
        let copied = Ground { module: "bounds_module", field: "/bounds", reach: 2.0, shapes: 1.0 };
        assert!(copied.differs(&json!([[1.0]]), &json!([[1.0 + 2e-8]])));
        assert!(!copied.differs(&json!([[1.0]]), &json!([[1.0 + 5e-9]])));
        assert!(!copied.differs(&json!({"a": 1}), &json!({"a": 1.0})));
        assert!(copied.differs(&json!({"a": 1}), &json!({"b": 1})));
    }

    #[test]
    fn what_is_right_too_is_no_change() {
        let permitted = |field, from, to| is_permitted("urdd.json", field, &from, &to);
        let class = "/conformance_class";
        assert!(permitted(class, json!("Shapes"), json!("Core")));
        assert!(!permitted(class, json!("Core"), json!("Shapes")));
        assert!(!permitted(class, json!("Shapes"), json!("Cor")));
        let version = "/urdd_version";
        assert!(permitted(version, json!("1.0.0"), json!("1.1.0")));
        assert!(!permitted(version, json!("1.0.0"), json!("2.0.0")));
        let order = "/modules/*/depends_on";
        assert!(permitted(order, json!(["a", "b"]), json!(["b", "a"])));
        assert!(!permitted(order, json!(["a", "b"]), json!(["a", "a"])));
        let samples = |from, to| is_permitted("kinematics_samples_module", "/samples", &from, &to);
        assert!(samples(json!([0, 1, 2, 3, 4]), json!([0, 1, 2, 3])));
        assert!(!samples(json!([0, 1, 2, 3, 4]), json!([1, 2, 3, 4])));
        assert!(!samples(json!([0, 1, 2, 3]), json!([0, 1, 2])));
    }

    #[test]
    fn what_is_below_a_free_field_is_free() {
        assert!(is_free("urdd.json", "/generator/name"));
        assert!(!is_free("urdd.json", "/generators"));
        assert!(!is_free("link_shapes_skips_module", "/edits/*/skip"));
    }
}
