use super::prelude::*;
use crate::vocabulary::Names;

declare_lint! {
    /// A `<gazebo reference>` names neither a link nor a joint.
    ///
    /// Gazebo leaves out its friction, sensors and plugins without a word.
    ///
    /// Write the name of a link or joint.
    LNT044 "gazebo-reference-unknown", Warning, WrongMotion, since "1.1.0" => gazebo_reference_unknown;

    /// A `<ros2_control>` names a joint that the robot does not have.
    ///
    /// `ros2_control_node` ends with `Joint 'X' not found in URDF`, and gz_ros2_control crashed.
    ///
    /// Write the name of a joint, or remove this one.
    LNT043 "ros2-control-unknown-joint", Error, WrongMotion, since "1.1.0" => ros2_control_unknown_joint;

    /// A `<transmission>` names a joint that the robot does not have.
    ///
    /// ros_control says `Could not find joint`, and the controller does not start.
    ///
    /// Write the name of a joint, or remove the transmission.
    LNT042 "transmission-unknown-joint", Error, WrongMotion, since "1.1.0" => transmission_unknown_joint;

    /// A visual names a material that is not defined.
    ///
    /// Programs refuse the robot, or draw the link in a colour of their own. ROS reads links in the order of the file, so a
    /// definition in a later link does not count.
    ///
    /// Define the material directly in `<robot>`, or write its colour here.
    LNT041 "material-not-defined", Warning, Appearance, since "1.1.0" => material_not_defined
}

fn gazebo_reference_unknown(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let known = Names::new(urdf.names(&urdf.links).chain(urdf.names(&urdf.joints)));
    for node in named(urdf.root, "gazebo") {
        let reference = node.attribute("reference").filter(|name| !name.is_empty());
        let Some(reference) = reference.filter(|name| !known.has(name)) else { continue };
        let hint = known.hint(reference);
        let message = format!(
            "neither a link nor a joint is called `{reference}`{hint}; write a name that is there"
        );
        urdf.at_attribute(node, "reference", message).report(findings);
    }
    Some(())
}

fn ros2_control_unknown_joint(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let joints = named(urdf.root, "ros2_control").flat_map(|control| named(control, "joint"));
    joints.for_each(|joint| urdf.names_a_joint(joint, findings));
    Some(())
}

fn transmission_unknown_joint(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let inside = named(urdf.root, "transmission").flat_map(|node| node.descendants());
    let joints = inside.filter(|node| node.tag_name().name() == "joint");
    joints.for_each(|joint| urdf.names_a_joint(joint, findings));
    Some(())
}

fn material_not_defined(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let global = named(urdf.root, "material");
    let mut defined: BTreeSet<&str> = global.filter_map(|node| node.attribute("name")).collect();
    let mut told = BTreeSet::new();
    for link in &urdf.links {
        let visuals = link.children().filter(|node| node.tag_name().name() == "visual");
        for material in visuals.filter_map(|visual| child(visual, "material")) {
            let Some(name) = material.attribute("name").filter(|name| !name.is_empty()) else {
                continue;
            };
            if child(material, "color").is_some() || child(material, "texture").is_some() {
                defined.insert(name);
            } else if !defined.contains(name) && told.insert(name) {
                let message = format!(
                    "material `{}` is not defined in `<robot>`, nor in a link before this one; define it \
                     in `<robot>`",
                    urdd_format::escape::line(name)
                );
                urdf.at_attribute(material, "name", message).report(findings);
            }
        }
    }
    Some(())
}
