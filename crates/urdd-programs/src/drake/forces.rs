//! Springs, bushings and constraints that are Drake's own. What they need is refused if it is missing.

use super::{DrakeReader, Links};
use crate::prelude::*;

/// What an element has to name.
#[derive(Clone, Copy)]
enum End {
    Body(&'static str),
    Frame(&'static str),
}

/// What a value must be.
#[derive(Clone, Copy)]
enum Value {
    Any,
    NotNegative,
    Positive,
}

use End::{Body, Frame};
use Value::{Any, NotNegative, Positive};

/// An element, the elements in it that name its ends, and those that have numbers, and how many.
struct Force {
    name: &'static str,
    ends: &'static [End],
    numbers: &'static [(&'static str, usize, Value)],
}

const TENDON: &str = "drake:tendon_constraint";
const BALL: &str = "drake:ball_constraint";

const FORCES: [Force; 4] = [
    Force {
        name: "drake:linear_bushing_rpy",
        ends: &[Frame("drake:bushing_frameA"), Frame("drake:bushing_frameC")],
        numbers: &[
            ("drake:bushing_torque_stiffness", 3, NotNegative),
            ("drake:bushing_torque_damping", 3, NotNegative),
            ("drake:bushing_force_stiffness", 3, NotNegative),
            ("drake:bushing_force_damping", 3, NotNegative),
        ],
    },
    Force {
        name: "drake:linear_spring_damper",
        ends: &[
            Body("drake:linear_spring_damper_body_A"),
            Body("drake:linear_spring_damper_body_B"),
        ],
        numbers: &[
            ("drake:linear_spring_damper_p_AP", 3, Any),
            ("drake:linear_spring_damper_p_BQ", 3, Any),
            ("drake:linear_spring_damper_free_length", 1, Positive),
            ("drake:linear_spring_damper_stiffness", 1, NotNegative),
            ("drake:linear_spring_damper_damping", 1, NotNegative),
        ],
    },
    Force {
        name: BALL,
        ends: &[Body("drake:ball_constraint_body_A"), Body("drake:ball_constraint_body_B")],
        numbers: &[("drake:ball_constraint_p_AP", 3, Any), ("drake:ball_constraint_p_BQ", 3, Any)],
    },
    Force {
        name: TENDON,
        ends: &[],
        numbers: &[
            ("drake:tendon_constraint_offset", 1, Any),
            ("drake:tendon_constraint_lower_limit", 1, Any),
            ("drake:tendon_constraint_upper_limit", 1, Any),
            ("drake:tendon_constraint_stiffness", 1, Any),
            ("drake:tendon_constraint_damping", 1, Any),
        ],
    },
];

impl DrakeReader<'_> {
    /// `frames` has the links, too.
    pub(super) fn forces(
        &mut self,
        robot: Node<'_>,
        links: &Links<'_>,
        frames: &HashSet<String>,
        is_joint: &dyn Fn(&str) -> bool,
    ) -> Reading<()> {
        for force in FORCES {
            for node in robot.named(force.name) {
                self.force(node, &force, links, frames)?;
                if force.name == TENDON {
                    self.tendon(node, is_joint)?;
                }
            }
        }
        Ok(())
    }

    fn force(
        &mut self,
        node: Node<'_>,
        force: &Force,
        links: &Links<'_>,
        frames: &HashSet<String>,
    ) -> Reading<()> {
        let mut before = None;
        for end in force.ends {
            let (Body(element) | Frame(element)) = *end;
            let of = self.effects.needed_element(node, element)?;
            let of = self.effects.needed(of, "name")?;
            let (kind, is_there) = match end {
                Body(_) => ("link", links.contains_key(&*of.value)),
                Frame(_) => ("link or frame", frames.contains(&*of.value)),
            };
            if !is_there {
                return self.effects.refuse(of, Fault::unknown(kind, &of.value));
            }
            if force.name == BALL && before == Some(&of.value) {
                return self.effects.refuse(of, Fault::Other("a ball has one link on both sides"));
            }
            before = Some(&of.value);
        }
        for &(element, count, value) in force.numbers {
            let of = self.effects.needed_element(node, element)?;
            let written = self.effects.needed(of, "value")?;
            let numbers = self.numbers(written, count, &force.name.into())?;
            match value {
                NotNegative if numbers.iter().any(|number| *number < 0.0) => {
                    return self.negative(written);
                }
                Positive if numbers.iter().any(|number| *number <= 0.0) => {
                    return self.effects.refuse(written, Fault::range(written, "must be above 0"));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The joints of a tendon, each with a factor.
    fn tendon(&mut self, node: Node<'_>, is_joint: &dyn Fn(&str) -> bool) -> Reading<()> {
        const JOINT: &str = "drake:tendon_constraint_joint";
        self.effects.needed_element(node, JOINT)?;
        for joint in node.named(JOINT) {
            let name = self.effects.needed(joint, "name")?;
            if !is_joint(&name.value) {
                return self.effects.refuse(name, Fault::unknown("joint", &name.value));
            }
            let factor = self.effects.needed(joint, "a")?;
            self.numbers(factor, 1, &TENDON.into())?;
        }
        Ok(())
    }
}
