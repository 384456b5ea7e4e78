//! CON: large robots.

use serde_json::Value;
use urdd_format::urdf::JointType;
use urdd_validate::code::Code::*;

use super::dof::star;
use crate::{Case, changed, valid};
use testkit::fixture::Fixture;
use testkit::robot::{Robot, joint, link, solid_box};

const CONNECTIONS: &str = "connections_module";

/// A base with so many links attached that explicit paths may be omitted.
fn large() -> Fixture {
    of_links(301)
}

fn of_links(links: usize) -> Fixture {
    let names: Vec<String> = (1..links).map(|i| format!("j{}", i - 1)).collect();
    let joints: Vec<(&str, JointType)> =
        names.iter().map(|name| (name.as_str(), JointType::Fixed)).collect();
    Fixture::core(&star(&joints))
}

/// Links in a line, each on the one before.
fn line(links: usize) -> Robot {
    let mut robot = Robot::new("line");
    for i in 0..links {
        let mut one = link(&format!("l{i}"));
        one.inertial = Some(solid_box(1.0, [0.1; 3]));
        robot.urdf.links.push(one);
        if let Some(above) = i.checked_sub(1) {
            let (above, below) = (format!("l{above}"), format!("l{i}"));
            let fixed = joint(&format!("j{i}"), JointType::Fixed, &above, &below);
            robot.urdf.joints.push(fixed);
        }
    }
    robot
}

fn leave_out(fixture: &mut Fixture) {
    fixture.set(CONNECTIONS, "/link_to_link_paths", Value::Null);
    fixture.set(CONNECTIONS, "/link_connection_paths", Value::Null);
}

pub fn cases() -> Vec<Case> {
    vec![
        changed(CON001, "large-and-left-out", false, large, leave_out),
        valid(CON003, "root-is-the-last-link", || {
            let mut robot = star(&[("a", JointType::Fixed), ("b", JointType::Fixed)]);
            robot.urdf.links.reverse();
            robot
        }),
        changed(CON006, "300-links", true, || of_links(300), leave_out),
        changed(CON006, "a-line-of-180-links", true, || Fixture::core(&line(180)), leave_out),
        // In a line of 180 links, the paths contain less than 2,000,000 links.
        changed(CON006, "a-line-of-181-links", false, || Fixture::core(&line(181)), leave_out),
    ]
}
