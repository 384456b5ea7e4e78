//! How large a robot may be.

use super::error::GenerateError;
use super::fault::{Fault, PlacedFault};
use super::source::Source;

/// Most links. The matrix of common ancestors grows with their square.
pub const MOST_LINKS: usize = 2_000;

/// Most elements besides links and joints; 2,000 links have some 10,000.
pub const MOST_ELEMENTS: usize = 100_000;

/// Refuses a robot of which the URDD would be too large for its readers.
///
/// # Errors
/// Where it has too many links, or too many elements.
pub(super) fn check(source: &Source) -> Result<(), GenerateError> {
    let robot = &source.reading.robot;
    let links = robot.links.len();
    let shapes = robot
        .links
        .iter()
        .map(|link| link.visual.len() + link.collision.len() + link.unknown_elements.len());
    let joints = robot.joints.iter();
    let of_joints = joints.map(|joint| joint.unknown_elements.len());
    let elements = shapes.chain(of_joints).sum::<usize>()
        + robot.materials.len()
        + robot.unknown_elements.len();
    let fault = if links > MOST_LINKS {
        Fault::TooManyLinks {
            found: links,
            limit: MOST_LINKS,
        }
    } else if elements > MOST_ELEMENTS {
        Fault::TooManyElements {
            found: elements,
            limit: MOST_ELEMENTS,
        }
    } else {
        return Ok(());
    };
    Err(GenerateError::Refused {
        file: source.shown.clone(),
        faults: vec![PlacedFault {
            line: 1,
            column: 1,
            fault,
        }],
    })
}
