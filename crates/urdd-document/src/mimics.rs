//! Mimic joints, resolved through chains of mimics (SPEC 5.10).

use super::robot::Robot;

/// A resolved mimic joint: `multiplier * position of driver + offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolved {
    /// The joint at the end of the chain: fixed, or with its own DOFs.
    pub driver: usize,
    /// Factor.
    pub multiplier: f64,
    /// Offset.
    pub offset: f64,
}

/// The mimic joints of a robot.
#[derive(Debug, Clone)]
pub struct Mimics {
    /// Resolved mimic of each joint; `None` for joints that are not mimic joints.
    pub by_joint: Vec<Option<Resolved>>,
}

impl Mimics {
    /// Resolves every mimic. `None` if one names an unknown joint, or they form a cycle.
    pub fn resolve(robot: &Robot) -> Option<Mimics> {
        let joints = robot.joints.len();
        let mut by_joint: Vec<Option<Resolved>> = vec![None; joints];
        let mut done = vec![false; joints];
        for start in 0..joints {
            let mut chain = Vec::new();
            let mut joint = start;
            while !done[joint] {
                let Some(mimic) = robot.joints[joint].active_mimic() else {
                    done[joint] = true;
                    break;
                };
                chain.push(joint);
                if chain.len() > joints {
                    return None;
                }
                joint = robot.joint(&mimic.joint)?;
            }
            // From the end of the chain backwards: each joint follows the one just resolved.
            for &follower in chain.iter().rev() {
                let mimic = robot.joints[follower].active_mimic()?;
                let next = robot.joint(&mimic.joint)?;
                by_joint[follower] = Some(match by_joint[next] {
                    None => Resolved {
                        driver: next,
                        multiplier: mimic.multiplier,
                        offset: mimic.offset,
                    },
                    Some(resolved) => Resolved {
                        driver: resolved.driver,
                        multiplier: mimic.multiplier * resolved.multiplier,
                        offset: mimic.multiplier * resolved.offset + mimic.offset,
                    },
                });
                done[follower] = true;
            }
        }
        Some(Mimics { by_joint })
    }
}
