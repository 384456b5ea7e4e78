use nalgebra::{Isometry3, Vector3};
use urdd_robot::{Robot, RobotError};

use testkit::robots::{made, made_of, our_robots};

/// A planar arm with two links of 0.5 m and 0.3 m, and a mimic finger.
const PLANAR: &str = r#"<robot name="planar">
  <link name="base"/><link name="upper"/><link name="fore"/><link name="tip"/><link name="finger"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.5 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="hand" type="fixed"><parent link="fore"/><child link="tip"/><origin xyz="0.3 0 0"/></joint>
  <joint name="finger" type="prismatic"><parent link="tip"/><child link="finger"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="elbow" multiplier="0.1" offset="0.02"/></joint>
</robot>"#;

#[test]
fn a_planar_arm_as_the_textbook_has_it() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    assert_eq!(robot.dof_names().unwrap(), ["shoulder", "elbow"]);
    assert_eq!(robot.dof_units().unwrap(), ["rad", "rad"]);
    let (a, b) = (0.4, -1.1);
    let tip = robot.link("tip").unwrap();
    let pose = robot.link_poses(&[a, b]).unwrap()[tip];
    let (x, y) =
        (0.5 * f64::cos(a) + 0.3 * f64::cos(a + b), 0.5 * f64::sin(a) + 0.3 * f64::sin(a + b));
    assert!((pose.translation.vector - Vector3::new(x, y, 0.0)).norm() < 1e-15);

    let jacobian = robot.jacobian(&[a, b], tip).unwrap();
    let (x2, y2) = (0.3 * f64::cos(a + b), 0.3 * f64::sin(a + b));
    let expected = [[-y, x, 0.0, 0.0, 0.0, 1.0], [-y2, x2, 0.0, 0.0, 0.0, 1.0]];
    for (column, expected) in jacobian.column_iter().zip(expected) {
        for (found, expected) in column.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{jacobian}");
        }
    }
    // The finger slides along the tip's x by a tenth of the elbow's angle, and turns with it.
    let finger = robot.link("finger").unwrap();
    let out = 0.1 * b + 0.02;
    let jacobian = robot.jacobian(&[a, b], finger).unwrap();
    let (c, s) = (f64::cos(a + b), f64::sin(a + b));
    let elbow = [-(0.3 + out) * s + 0.1 * c, (0.3 + out) * c + 0.1 * s];
    assert!((jacobian[(0, 1)] - elbow[0]).abs() < 1e-15);
    assert!((jacobian[(1, 1)] - elbow[1]).abs() < 1e-15);
}

/// The translation and rotation of a pose per unit of `h`, between `-h` and `h`.
fn difference(
    below: &Isometry3<f64>,
    above: &Isometry3<f64>,
    point: Vector3<f64>,
    h: f64,
) -> [f64; 6] {
    let at = |pose: &Isometry3<f64>| pose.translation.vector + pose.rotation * point;
    let linear = (at(above) - at(below)) / (2.0 * h);
    let angular = (above.rotation * below.rotation.inverse()).scaled_axis() / (2.0 * h);
    [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
}

#[test]
fn jacobians_are_the_differences_of_poses_on_every_kind_of_joint() {
    let h = 1e-5;
    let mut looked_at = 0;
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).unwrap();
        let space = robot.configurations().unwrap();
        for k in 0..4 {
            let q = space.random(k);
            for link in 0..robot.link_names().unwrap().len() {
                let point = [0.1, -0.2, 0.3];
                let jacobian = robot.jacobian_at(&q, link, point).unwrap();
                for dof in 0..q.len() {
                    let moved = |by: f64| {
                        let mut q = q.clone();
                        q[dof] += by;
                        robot.link_poses(&q).unwrap()[link]
                    };
                    let expected = difference(&moved(-h), &moved(h), point.into(), h);
                    for (row, expected) in expected.into_iter().enumerate() {
                        let found = jacobian[(row, dof)];
                        let off = (found - expected).abs();
                        assert!(
                            off < 1e-8 * (1.0 + expected.abs()),
                            "{name}, link {link}, DOF {dof}, row {row}: {found}, {expected}"
                        );
                        looked_at += 1;
                    }
                }
            }
        }
    }
    assert!(looked_at > 10_000, "{looked_at}");
}

#[test]
fn a_batch_is_each_of_its_configurations() {
    let (_folder, path) = made(&our_robots()[2].1);
    let robot = Robot::open(path).unwrap();
    let space = robot.configurations().unwrap();
    let all: Vec<Vec<f64>> = (0..201).map(|k| space.random(k)).collect();
    let batch = robot.link_poses_batch(&all.concat()).unwrap();
    let one_by_one: Vec<_> = all.iter().flat_map(|q| robot.link_poses(q).unwrap()).collect();
    assert_eq!(batch, one_by_one);
    assert_eq!(robot.link_poses_batch(&[]).unwrap(), []);
    let dofs = space.num_dofs();
    let found = dofs + 1;
    assert_eq!(robot.link_poses_batch(&vec![0.0; found]), Err(RobotError::Batch { found, dofs }));
    let mut broken = all.concat();
    broken[dofs * 150 + 1] = f64::NAN;
    let error = robot.link_poses_batch(&broken).unwrap_err();
    assert!(error.to_string().contains("value 1 of the configuration is NaN"), "{error}");
}

#[test]
fn a_batch_of_jacobians_is_each_of_them_to_the_bit() {
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).unwrap();
        let space = robot.configurations().unwrap();
        let all: Vec<Vec<f64>> = (0..70).map(|k| space.random(k)).collect();
        for link in 0..robot.link_names().unwrap().len() {
            let batch = robot.jacobian_batch(&all.concat(), link).unwrap();
            let each = all.iter().map(|q| robot.jacobian(q, link).unwrap());
            let each: Vec<f64> = each.flat_map(|j| j.as_slice().to_vec()).collect();
            assert_eq!(batch, each, "{name}, {link}");
        }
    }
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    assert_eq!(robot.jacobian_batch(&[], 1).unwrap(), [0.0; 0]);
    let (what, index, count) = ("link", 5, 5);
    let missing = RobotError::OutOfRange { what, index, count };
    assert_eq!(robot.jacobian_batch(&[0.0; 4], 5), Err(missing));
    let (found, dofs) = (3, 2);
    assert_eq!(robot.jacobian_batch(&[0.0; 3], 1), Err(RobotError::Batch { found, dofs }));
    let broken = [0.0, 0.0, 0.0, f64::NAN];
    assert!(matches!(robot.jacobian_batch(&broken, 1), Err(RobotError::Configuration(_))));
}

#[test]
fn configurations_are_within_bounds_where_they_are_said_to_be() {
    let (_folder, path) = made_of(PLANAR);
    let robot = Robot::open(path).unwrap();
    let space = robot.configurations().unwrap();
    assert_eq!(space.bounds(), [[-3.0, 3.0], [-2.0, 2.0]]);
    assert_eq!((space.zero(), space.middle()), (vec![0.0; 2], vec![0.0; 2]));
    assert_eq!((space.lower(), space.upper()), (vec![-3.0, -2.0], vec![3.0, 2.0]));
    let mut beyond = [9.0, -0.5];
    assert!(!space.is_within_bounds(&beyond));
    // It still has a pose.
    assert!(robot.link_poses(&beyond).is_ok());
    space.clamp(&mut beyond);
    assert_eq!(beyond, [3.0, -0.5]);
    assert!((0..100).all(|k| space.is_within_bounds(&space.random(k))));
    assert_ne!(space.random(1), space.random(2));
}

/// What planners need beside poses, of a robot whose numbers are in the text.
#[test]
fn limits_masses_and_the_dofs_between_links() {
    let text = r#"<robot name="r"><link name="base"><inertial><origin xyz="0 0 1"/><mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
    <link name="left"/><link name="right"><inertial><origin xyz="0.5 0 0"/><mass value="6"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><link name="tip"/><link name="still"/>
    <joint name="a" type="revolute"><parent link="base"/><child link="left"/><axis xyz="0 0 1"/>
      <limit lower="-1" upper="1" effort="7" velocity="3"/></joint>
    <joint name="b" type="continuous"><parent link="base"/><child link="right"/><axis xyz="0 0 1"/></joint>
    <joint name="c" type="prismatic"><parent link="right"/><child link="tip"/><axis xyz="1 0 0"/>
      <limit lower="0" upper="1" effort="5" velocity="2"/><mimic joint="a"/></joint>
    <joint name="d" type="fixed"><parent link="tip"/><child link="still"/><origin xyz="0 2 0"/></joint></robot>"#;
    let (_folder, path) = made_of(text);
    let robot = Robot::open(path).unwrap();
    assert_eq!(robot.dof_names().unwrap(), ["a", "b"]);
    assert_eq!(robot.velocity_limits().unwrap(), [3.0, f64::INFINITY]);
    assert_eq!(robot.effort_limits().unwrap(), [7.0, f64::INFINITY]);
    let masses = robot.link_masses().unwrap();
    assert_eq!(masses.iter().map(|link| link.mass).sum::<f64>(), 8.0);
    assert_eq!(masses[robot.link("right").unwrap()].centre, [0.5, 0.0, 0.0]);
    // (2 (0, 0, 1) + 6 (0, 0.5, 0)) / 8, with the right link turned by a quarter.
    let quarter = std::f64::consts::FRAC_PI_2;
    let centre = robot.centre_of_mass(&[0.3, quarter]).unwrap().unwrap();
    let off = Vector3::from(centre) - Vector3::new(0.0, 0.375, 0.25);
    assert!(off.norm() < 1e-15, "{centre:?}");

    let link = |name: &str| robot.link(name).unwrap();
    let between = |a: &str, b: &str| robot.dofs_between(link(a), link(b)).unwrap();
    assert_eq!(between("base", "left"), [0]);
    assert_eq!(between("left", "right"), [0, 1]);
    // The slide follows `a`.
    assert_eq!(between("right", "still"), [0]);
    assert_eq!(between("still", "base"), [0, 1]);
    assert!(between("tip", "still").is_empty() && between("tip", "tip").is_empty());
    assert!(matches!(robot.dofs_between(0, 9), Err(RobotError::OutOfRange { index: 9, .. })));

    // The right link and the tip turn together.
    let pose = robot.relative_pose(&[0.3, 1.2], link("still"), link("right")).unwrap();
    let off = pose.translation.vector - Vector3::new(0.3, 2.0, 0.0);
    assert!(off.norm() < 1e-15 && pose.rotation.angle() < 1e-15, "{pose}");
    assert!(robot.relative_pose(&[0.0; 2], 9, 0).is_err());
}
