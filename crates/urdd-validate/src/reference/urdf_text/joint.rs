//! Joints.

use super::reader::{Element, UrdfReader, numbers};
use super::reading::Fault;
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

impl UrdfReader {
    pub(super) fn joint(&mut self, joint: Element<'_>, at: &str) -> Option<v1::Joint> {
        let name = self.needed_text(joint, "name", at);
        let joint_type = self.joint_type(joint, at);
        let origin = self.origin(joint, at);
        let parent = self.joint_link(joint, "parent", at);
        let child = self.joint_link(joint, "child", at);
        // The rest is read first: all its faults are reported, also those of a joint without a name.
        Some(v1::Joint {
            origin,
            axis: self
                .only(joint, "axis", at)
                .map(|(axis, at)| v1::Axis { xyz: self.vector(axis, "xyz", &at) }),
            limit: self.only(joint, "limit", at).map(|limit| {
                numbers!(
                    self,
                    limit,
                    Limit { lower, upper, effort, velocity, acceleration, deceleration, jerk }
                )
            }),
            dynamics: self
                .only(joint, "dynamics", at)
                .map(|dynamics| numbers!(self, dynamics, Dynamics { damping, friction })),
            mimic: self.only(joint, "mimic", at).and_then(|(mimic, at)| self.mimic(mimic, &at)),
            safety_controller: self.only(joint, "safety_controller", at).map(|soft| {
                numbers!(
                    self,
                    soft,
                    SafetyController { soft_lower_limit, soft_upper_limit, k_position, k_velocity }
                )
            }),
            calibration: self
                .only(joint, "calibration", at)
                .map(|calibration| numbers!(self, calibration, Calibration { rising, falling })),
            unknown_elements: self.unknown(joint, JOINT_ELEMENTS, at),
            name: name?,
            joint_type: joint_type?,
            parent: parent?,
            child: child?,
        })
    }

    fn joint_type(&mut self, joint: Element<'_>, at: &str) -> Option<v1::JointType> {
        let word = self.needed_text(joint, "type", at)?;
        let mut types = v1::JointType::ALL.iter().copied();
        let found = types.find(|kind| kind.as_str().to_ascii_lowercase() == word);
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
        let Some((element, at)) = self.only(joint, name, at) else {
            let fault = Fault::MissingElement { element: name, parent: "joint" };
            let joint_name = xml::attribute(joint, "name").map(|name| name.value());
            self.problem(joint.range().start, fault, joint_name);
            return None;
        };
        Some(v1::LinkName { link: self.needed_text(element, "link", &at)? })
    }

    fn mimic(&mut self, mimic: Element<'_>, at: &str) -> Option<v1::Mimic> {
        let joint = self.needed_text(mimic, "joint", at);
        let multiplier = self.number(mimic, "multiplier", at);
        let offset = self.number(mimic, "offset", at);
        Some(v1::Mimic { joint: joint?, multiplier, offset })
    }
}
