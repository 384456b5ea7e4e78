//! The quaternions of joint origins (SPEC 6.1.9), straight from the XML: urdf-rs turns them into
//! roll, pitch and yaw, and near a pitch of a quarter turn takes it for one: 0.004 rad are lost.

use std::collections::HashMap;

use nalgebra::{Quaternion, UnitQuaternion};
use roxmltree::{Document, Node, ParsingOptions};

use crate::document::pose::has_quaternions;

/// For joints whose rotation is a quaternion: the rotation, by name. Empty where the URDF is of a
/// version before 1.1.
pub fn of_joints(urdf: &str) -> HashMap<String, UnitQuaternion<f64>> {
    let options = ParsingOptions {
        allow_dtd: true,
        ..ParsingOptions::default()
    };
    let Ok(document) = Document::parse_with_options(urdf, options) else {
        return HashMap::new();
    };
    let robot = document.root_element();
    if !has_quaternions(robot.attribute("version")) {
        return HashMap::new();
    }
    let joints = children(robot, "joint");
    joints
        .filter_map(|joint| {
            let origin = children(joint, "origin").next()?;
            let numbers = origin.attribute("quat_xyzw")?.split_ascii_whitespace();
            let numbers: Result<Vec<f64>, _> = numbers.map(str::parse).collect();
            let [x, y, z, w] = numbers.ok()?.try_into().ok()?;
            // Without a length it is no rotation, and so none at all. Divided by the largest number
            // first, so that the squares of tiny or huge ones are neither lost nor infinite.
            let largest = [w, x, y, z]
                .into_iter()
                .fold(0.0_f64, |most, n| most.max(n.abs()));
            let unit = UnitQuaternion::try_new(Quaternion::new(w, x, y, z) / largest, 0.0)?;
            Some((joint.attribute("name")?.to_owned(), unit))
        })
        .collect()
}

fn children<'a, 'input>(
    node: Node<'a, 'input>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'input>> {
    node.children()
        .filter(move |child| child.has_tag_name(name))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_1_SQRT_2;

    use nalgebra::Vector3;

    use crate::validate::reference::{MimicDofs, Reference};

    /// The columns of the rotation of a fixed joint with this origin: where x, y and z go.
    fn axes(version: &str, origin: &str) -> [Vector3<f64>; 3] {
        let urdf = format!(
            "<robot name='r' {version}><link name='a'/><link name='b'/><joint name='j' type='fixed'>\
             <origin {origin}/><parent link='a'/><child link='b'/></joint></robot>"
        );
        let reference = Reference::read(&urdf, MimicDofs::Follow).expect("a robot");
        let poses = reference.link_poses(&[]).expect("no DOFs");
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| poses[1].rotation * axis)
    }

    #[test]
    fn a_quaternion_is_x_y_z_w_and_exact() {
        let turned = |version, origin, expected: [[f64; 3]; 3]| {
            for (found, expected) in axes(version, origin).iter().zip(expected) {
                let apart = (found - Vector3::from(expected)).norm();
                assert!(
                    apart < 1e-15,
                    "{version} {origin}: {found} is no {expected:?}"
                );
            }
        };
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let minus = |v: [f64; 3]| v.map(|c| -c);
        // A quarter turn about x, of any length and sign.
        turned("version='1.1'", "quat_xyzw='3 0 0 3'", [x, z, minus(y)]);
        turned("version='1.2'", "quat_xyzw='-1 0 0 -1'", [x, z, minus(y)]);
        turned(
            "version='1.1'",
            "quat_xyzw='2e-200 0 0 2e-200'",
            [x, z, minus(y)],
        );
        // A third of a turn about (1, 1, 1): x to y to z to x.
        turned("version='1.1'", "quat_xyzw='.5 .5 .5 .5'", [y, z, x]);
        // Before 1.1 it has no meaning.
        turned("", "quat_xyzw='3 0 0 3'", [x, y, z]);
        turned(
            "version='1.0'",
            "quat_xyzw='1 0 0 1' rpy='0 0 0'",
            [x, y, z],
        );
        turned("version='1.1'", "quat_xyzw='0 0 0 0'", [x, y, z]);
    }

    #[test]
    fn a_pitch_of_nearly_a_quarter_turn_keeps_its_digits() {
        // 0.001 rad short of a quarter turn about y: z goes to (cos 0.001, 0, sin 0.001).
        let half = std::f64::consts::FRAC_PI_4 - 0.0005;
        let origin = format!("quat_xyzw='0 {} 0 {}'", half.sin(), half.cos());
        let [_, _, z] = axes("version='1.1'", &origin);
        let expected = Vector3::new(0.001_f64.cos(), 0.0, 0.001_f64.sin());
        assert!((z - expected).norm() < 1e-15, "{z}");
        assert!(half.sin() < FRAC_1_SQRT_2);
    }
}
