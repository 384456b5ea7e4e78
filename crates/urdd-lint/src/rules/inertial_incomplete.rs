use super::prelude::*;

declare_lint! {
    /// An `<inertial>` has no mass, no inertia, or not all numbers of it.
    ///
    /// MuJoCo refuses the file, and PyBullet does where `<mass>` or `<inertia>` is missing. urdfdom, so ROS and Pinocchio,
    /// goes on without the inertial: without a mass the link weighs nothing.
    ///
    /// Write `<mass value>` and all of ixx, ixy, ixz, iyy, iyz, izz. A link without mass has no `<inertial>` at all.
    LNT008 "inertial-incomplete", Error, WrongMotion, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for link in &urdf.links {
        let Some(inertial) = child(*link, "inertial") else {
            continue;
        };
        let mut missing = Vec::new();
        match child(inertial, "mass") {
            None => missing.push("`<mass>`"),
            Some(mass) if !mass.has_attribute("value") => missing.push("`value` of the mass"),
            Some(_) => {}
        }
        match child(inertial, "inertia") {
            None => missing.push("`<inertia>`"),
            Some(inertia) => {
                let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
                missing.extend(names.into_iter().filter(|name| !inertia.has_attribute(*name)));
            }
        }
        if !missing.is_empty() {
            let message = format!("`<inertial>` has no {}; write it", missing.join(", no "));
            urdf.at(inertial, message).report(findings);
        }
    }
    Some(())
}
