//! Positions of the links of a robot.
//!
//! `cargo run --example forward_kinematics -- URDD` prints the values that it takes: one for each DOF, rad or m. With
//! them, it prints the position of every link in the frame of the root link.

#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::error::Error;

use urdd_robot::Robot;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("usage: forward_kinematics URDD [VALUE...]")?;
    let q: Vec<f64> = arguments.map(|value| value.parse()).collect::<Result<_, _>>()?;
    let robot = Robot::open(path)?;
    let links = robot.link_names()?;
    if q.is_empty() && !robot.dof_names()?.is_empty() {
        let dofs = robot.dof_names()?.iter().zip(robot.dof_units()?);
        let dofs: Vec<String> = dofs.map(|(name, unit)| format!("{name} [{unit}]")).collect();
        println!("{} links; values: {}", links.len(), dofs.join(" "));
        return Ok(());
    }
    for (link, pose) in links.iter().zip(robot.link_poses(&q)?) {
        let [x, y, z] = pose.translation.vector.into();
        println!("{link:24} {x:8.4} {y:8.4} {z:8.4} m");
    }
    Ok(())
}
