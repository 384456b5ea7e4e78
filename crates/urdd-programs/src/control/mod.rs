//! ros2_control: the parser of `hardware_interface`, and what its resource manager does with the hardware that the parser
//! gives. gz_ros2_control has a manager of its own. A fault anywhere in `<ros2_control>` ends it: no controller starts.
//!
//! The readers follow the sources of ros2_control 2.54.0 (Humble) and 4.46.0 (Jazzy; the parsers of 5.16.0 and 6.8.0 read
//! the same), and of gz_ros2_control 1.2.7.

mod gazebo;
mod joints;
mod manager;
mod parser;

use crate::prelude::*;
use parser::{Hardware, NAME, Release, controls, parse};

/// ROS jazzy, kilted, lyrical and rolling.
pub const FOUR: About = About {
    id: "ros2_control4",
    name: "ros2_control jazzy",
    family: "ros2_control",
    version: "4.46.0",
    settings: &["ros2_control", "jazzy", "kilted", "lyrical", "rolling", "ros"],
    is_asked: true,
    is_for: Some(has_control),
    names: Names::Exact,
    never: &[],
    read: |file, effects| {
        let hardware = read(file, Release::Four, effects)?;
        manager::load(&hardware, Release::Four, effects)
    },
};

/// ROS humble.
pub const TWO: About = About {
    id: "ros2_control2",
    name: "ros2_control humble",
    version: "2.54.0",
    settings: &["ros2_control", "humble"],
    read: |file, effects| {
        let hardware = read(file, Release::Two, effects)?;
        manager::load(&hardware, Release::Two, effects)
    },
    ..FOUR
};

/// Gazebo Harmonic with ROS jazzy.
pub const GAZEBO: About = About {
    id: "gz_ros2_control",
    name: "gz_ros2_control jazzy",
    version: "1.2.7",
    settings: &["gz_ros2_control"],
    is_for: Some(gazebo::is_for),
    read: |file, effects| {
        let hardware = read(file, Release::Four, effects)?;
        gazebo::load(file, &hardware, effects)
    },
    ..FOUR
};

fn has_control(file: &File<'_>) -> bool {
    controls(file).next().is_some()
}

/// What `parse_control_resources_from_urdf` gives.
fn read<'t>(
    file: &'t File<'_>,
    release: Release,
    effects: &mut Effects,
) -> Reading<Vec<Hardware<'t>>> {
    const NESTED: Fault = Fault::Control(
        "`<ros2_control>` is not directly in `<robot>`",
        "move it there: out of `<gazebo>`, if it is in one",
    );
    let tree = effects.parsed(file.document.within(tinyxml::MAX_DEPTH))?;
    let robot = effects.robot(tree)?;
    let mut strays =
        controls(file).filter(|one| robot.named(NAME).all(|own| own.index != one.index));
    if robot.child(NAME).is_none() {
        return match strays.next() {
            Some(stray) => effects.refuse(stray, NESTED),
            None => effects.refuse(robot, Fault::MissingElement(NAME)),
        };
    }
    let hardware = parse(robot, release, effects)?;
    if release == Release::Four {
        joints::check(tree, &hardware, effects)?;
    }
    for stray in strays {
        let part = Part::of("hardware", stray.value("name").unwrap_or_default());
        effects.drop(stray, part, NESTED);
    }
    Ok(hardware)
}
