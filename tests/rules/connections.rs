//! CON. In the toy, link 1 is the root. Joint 1 attaches link 2 to link 1, joint 2 link 3 to 2, joint 3 link 4 to 3,
//! and joint 11 link 5 to 1.

use serde_json::{Value, json};
use urdd_format::urdf::JointType;
use urdd_validate::code::Code::*;

use super::dof::star;
use crate::{Case, changed, invalid};
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
    let valid = |code, name, robot: fn() -> Robot| {
        changed(code, name, false, move || Fixture::core(&robot()), |_| {})
    };
    vec![
        invalid(CON001, "root-path-missing", |f| {
            f.remove(CONNECTIONS, "/root_paths/14");
        }),
        invalid(CON001, "short-row", |f| {
            f.remove(CONNECTIONS, "/lowest_common_ancestors/3/14");
        }),
        invalid(CON001, "row-missing", |f| {
            f.remove(CONNECTIONS, "/link_connection_paths/0");
        }),
        invalid(CON001, "long-row", |f| {
            f.set(CONNECTIONS, "/link_to_link_paths/2/-", json!({ "links": [], "joints": [] }));
        }),
        changed(CON001, "large-and-left-out", false, large, leave_out),
        invalid(CON002, "without-the-root", |f| {
            f.remove(CONNECTIONS, "/root_paths/3/links/0");
        }),
        invalid(CON002, "another-joint", |f| {
            f.set(CONNECTIONS, "/root_paths/3/joints/1", json!(3));
        }),
        invalid(CON002, "link-out-of-range", |f| {
            f.set(CONNECTIONS, "/root_paths/3/links/1", json!(99));
        }),
        valid(CON002, "link-alone", || star(&[])),
        invalid(CON003, "root-for-a-nearer-link", |f| {
            f.set(CONNECTIONS, "/lowest_common_ancestors/3/4", json!(1));
        }),
        invalid(CON003, "diagonal", |f| {
            f.set(CONNECTIONS, "/lowest_common_ancestors/3/3", json!(2));
        }),
        valid(CON003, "root-is-the-last-link", || {
            let mut robot = star(&[("a", JointType::Fixed), ("b", JointType::Fixed)]);
            robot.urdf.links.reverse();
            robot
        }),
        invalid(CON004, "by-way-of-the-root", |f| {
            let path = json!({ "links": [3, 2, 1, 2], "joints": [2, 1, 1] });
            f.set(CONNECTIONS, "/link_to_link_paths/3/2", path);
        }),
        invalid(CON004, "backwards", |f| {
            let path = f.get(CONNECTIONS, "/link_to_link_paths/5/3").clone();
            f.set(CONNECTIONS, "/link_to_link_paths/3/5", path);
        }),
        invalid(CON004, "joint-out-of-range", |f| {
            f.set(CONNECTIONS, "/link_to_link_paths/3/5/joints/0", json!(4_294_967_295_u32));
        }),
        valid(CON004, "link-alone", || star(&[])),
        invalid(CON005, "start-included", |f| {
            f.set(CONNECTIONS, "/link_connection_paths/1/3", json!([1, 2, 3]));
        }),
        invalid(CON005, "path-upwards", |f| {
            f.set(CONNECTIONS, "/link_connection_paths/3/1", json!([2, 1]));
        }),
        invalid(CON005, "path-missing", |f| {
            f.set(CONNECTIONS, "/link_connection_paths/1/3", Value::Null);
        }),
        invalid(CON005, "no-path-to-itself", |f| {
            f.set(CONNECTIONS, "/link_connection_paths/1/1", Value::Null);
        }),
        changed(CON005, "left-out", false, large, leave_out),
        invalid(CON006, "both-left-out", leave_out),
        invalid(CON006, "one-left-out", |f| {
            f.set(CONNECTIONS, "/link_connection_paths", Value::Null);
        }),
        changed(CON006, "300-links", true, || of_links(300), leave_out),
        changed(CON006, "301-links", false, large, leave_out),
        changed(CON006, "a-line-of-180-links", true, || Fixture::core(&line(180)), leave_out),
        // In a line of 180 links, the paths contain less than 2,000,000 links.
        changed(CON006, "a-line-of-181-links", false, || Fixture::core(&line(181)), leave_out),
    ]
}
