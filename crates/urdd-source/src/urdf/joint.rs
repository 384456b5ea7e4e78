//! Joints.

use super::numbers::element_of_numbers;
use super::reader::{JointPlace, UrdfReader};
use super::xml::Element;
use crate::fault::Fault;
use crate::note::NoteKind;
use urdd_format::short::Short;
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
    /// Reads a joint and adds it to the robot.
    pub(super) fn joint(&mut self, joint: Element<'_>) {
        let at = joint.range().start;
        let mut place = JointPlace { joint: at, ..JointPlace::default() };
        let name = self.needed(joint, "joint", "name");
        let shown = name.as_deref().unwrap_or("?");
        let joint_type = self.joint_type(joint, shown);
        let parent = self.end(joint, shown, "parent", &mut place.parent);
        let child = self.end(joint, shown, "child", &mut place.child);
        let origin = self.origin(joint);
        let axis = self.only(joint, "axis").map(|axis| {
            place.axis = axis.range().start;
            v1::Axis { xyz: self.vector(axis, "xyz") }
        });
        let limit = element_of_numbers!(
            self,
            joint,
            "limit",
            Limit { lower, upper, effort, velocity, acceleration, deceleration, jerk }
        );
        let dynamics = element_of_numbers!(self, joint, "dynamics", Dynamics { damping, friction });
        let mimic = self.only(joint, "mimic").and_then(|mimic| {
            place.mimic = mimic.range();
            self.mimic(mimic, shown)
        });
        let safety_controller = element_of_numbers!(
            self,
            joint,
            "safety_controller",
            SafetyController { soft_lower_limit, soft_upper_limit, k_position, k_velocity }
        );
        let calibration =
            element_of_numbers!(self, joint, "calibration", Calibration { rising, falling });
        let unknown_elements = self.unknown(joint, JOINT_ELEMENTS);
        let (Some(name), Some(joint_type), Some(parent), Some(child)) =
            (name, joint_type, parent, child)
        else {
            return;
        };
        self.joint_places.push(place);
        self.reading.robot.joints.push(v1::Joint {
            name,
            joint_type,
            origin,
            parent,
            child,
            axis,
            limit,
            dynamics,
            mimic,
            safety_controller,
            calibration,
            unknown_elements,
        });
    }

    fn joint_type(&mut self, joint: Element<'_>, name: &str) -> Option<v1::JointType> {
        let word = self.needed(joint, "joint", "type")?;
        let plain = word.trim().to_ascii_lowercase();
        let mut kinds = v1::JointType::ALL.iter().copied();
        let found = kinds.find(|kind| kind.as_str().to_ascii_lowercase() == plain);
        let attribute = self.attribute(joint, "type")?;
        match found {
            None => {
                let fault = Fault::UnknownJointType { joint: name.into(), found: Short::of(&word) };
                self.fault(attribute.range().start, fault);
            }
            Some(_) if plain != word => {
                let problem =
                    format!("the joint type `{}` is not spelled as in URDF", Short::of(&word));
                let assumed = format!("read as `{plain}`");
                self.remark(NoteKind::JointType, attribute.range().start, problem, assumed);
                self.edit(attribute.range_value(), plain);
            }
            Some(_) => {}
        }
        found
    }

    /// The parent or child link.
    fn end(
        &mut self,
        joint: Element<'_>,
        shown: &str,
        end: &'static str,
        place: &mut usize,
    ) -> Option<v1::LinkName> {
        let Some(element) = self.only(joint, end) else {
            let fault = Fault::MissingElement { joint: shown.into(), element: end };
            self.fault(joint.range().start, fault);
            return None;
        };
        *place = element.range().start;
        let link = self.needed(element, end, "link")?;
        Some(v1::LinkName { link })
    }

    fn mimic(&mut self, mimic: Element<'_>, shown: &str) -> Option<v1::Mimic> {
        let Some(joint) = self.text(mimic, "joint") else {
            let problem = format!("the mimic of joint `{shown}` names no joint");
            self.remark(NoteKind::Mimic, mimic.range().start, problem, "the mimic is left out");
            self.edit(mimic.range(), "");
            return None;
        };
        Some(v1::Mimic {
            joint,
            multiplier: self.number(mimic, "multiplier"),
            offset: self.number(mimic, "offset"),
        })
    }
}
