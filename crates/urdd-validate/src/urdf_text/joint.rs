//! Joints.

use super::problem::Fault;
use super::reader::{Element, Reader};
use super::xml;
use urdd_format::urdf as v1;

const JOINT_ELEMENTS: &[&str] = &[
    "origin",
    "parent",
    "child",
    "axis",
    "limit",
    "dynamics",
    "mimic",
    "safety_controller",
    "calibration",
];

impl Reader {
    pub(super) fn joint(&mut self, joint: Element<'_>, at: &str) -> Option<v1::Joint> {
        let name = self.needed_text(joint, "name", at);
        let joint_type = self.joint_type(joint, at);
        let origin = self.origin(joint, at);
        let parent = self.joint_link(joint, "parent", at);
        let child = self.joint_link(joint, "child", at);
        let axis = self
            .only(joint, "axis", at)
            .map(|(axis, at)| v1::Axis { xyz: self.vector(axis, "xyz", &at) });
        let limit = self.only(joint, "limit", at).map(|(limit, at)| v1::Limit {
            lower: self.number(limit, "lower", &at),
            upper: self.number(limit, "upper", &at),
            effort: self.number(limit, "effort", &at),
            velocity: self.number(limit, "velocity", &at),
            acceleration: self.number(limit, "acceleration", &at),
            deceleration: self.number(limit, "deceleration", &at),
            jerk: self.number(limit, "jerk", &at),
        });
        let dynamics = self.only(joint, "dynamics", at).map(|(dynamics, at)| v1::Dynamics {
            damping: self.number(dynamics, "damping", &at),
            friction: self.number(dynamics, "friction", &at),
        });
        let mimic = self.only(joint, "mimic", at).and_then(|(mimic, at)| self.mimic(mimic, &at));
        let safety_controller =
            self.only(joint, "safety_controller", at).map(|(soft, at)| v1::SafetyController {
                soft_lower_limit: self.number(soft, "soft_lower_limit", &at),
                soft_upper_limit: self.number(soft, "soft_upper_limit", &at),
                k_position: self.number(soft, "k_position", &at),
                k_velocity: self.number(soft, "k_velocity", &at),
            });
        let calibration =
            self.only(joint, "calibration", at).map(|(calibration, at)| v1::Calibration {
                rising: self.number(calibration, "rising", &at),
                falling: self.number(calibration, "falling", &at),
            });
        let unknown_elements = self.unknown(joint, JOINT_ELEMENTS, at);
        Some(v1::Joint {
            name: name?,
            joint_type: joint_type?,
            origin,
            parent: parent?,
            child: child?,
            axis,
            limit,
            dynamics,
            mimic,
            safety_controller,
            calibration,
            unknown_elements,
        })
    }

    fn joint_type(&mut self, joint: Element<'_>, at: &str) -> Option<v1::JointType> {
        let word = self.needed_text(joint, "type", at)?;
        let found = v1::JointType::ALL
            .iter()
            .copied()
            .find(|kind| kind.as_str().to_ascii_lowercase() == word);
        let attribute = xml::attribute(joint, "type")?.range().start;
        self.place(&format!("{at}/joint_type"), attribute);
        if found.is_none() {
            self.problem(attribute, Fault::UnknownJointType, Some(&word));
        }
        found
    }

    fn joint_link(
        &mut self,
        joint: Element<'_>,
        name: &'static str,
        at: &str,
    ) -> Option<v1::LinkName> {
        match self.only(joint, name, at) {
            Some((element, at)) => {
                let link = self.needed_text(element, "link", &at)?;
                Some(v1::LinkName { link })
            }
            None => {
                let fault = Fault::MissingElement { element: name, parent: "joint" };
                self.problem(
                    joint.range().start,
                    fault,
                    xml::attribute(joint, "name").map(|name| name.value()),
                );
                None
            }
        }
    }

    fn mimic(&mut self, mimic: Element<'_>, at: &str) -> Option<v1::Mimic> {
        let joint = self.needed_text(mimic, "joint", at);
        let multiplier = self.number(mimic, "multiplier", at);
        let offset = self.number(mimic, "offset", at);
        Some(v1::Mimic { joint: joint?, multiplier, offset })
    }
}
