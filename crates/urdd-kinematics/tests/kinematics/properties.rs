//! Properties of every robot and every configuration.

use std::f64::consts::TAU;

use nalgebra::{Matrix4, Point3, Vector3};
use proptest::prelude::*;
use proptest::sample::Index;
use urdd_format::dof::ResolvedMimic;
use urdd_format::index::DofIdx;
use urdd_format::urdf::JointType;
use urdd_kinematics::rotation::rotation_distance;
use urdd_kinematics::{ForwardKinematics, Load};

use crate::naive_kinematics::link_pose;
use testkit::core_modules::{Joint, core_modules, dof_count, first_dofs};

fn axis() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![
        4 => prop::array::uniform3(-1.0..1.0_f64)
            .prop_filter("a direction", |v| v.iter().any(|x| x.abs() > 1e-3)),
        1 => Just([0.0, 0.0, 1.0]),
        1 => Just([0.0, 0.0, -1.0]),
        1 => (-1e-6..1e-6_f64, -1e-6..1e-6_f64).prop_map(|(x, y)| [x, y, -1.0]),
    ]
}

type Draft = (JointType, [f64; 3], [f64; 3], [f64; 3], Index, Option<(Option<Index>, f64, f64)>);

fn draft() -> impl Strategy<Value = Draft> {
    (
        prop::sample::select(JointType::ALL),
        prop::array::uniform3(-1.0..1.0_f64),
        prop::array::uniform3(-4.0..4.0_f64),
        axis(),
        any::<Index>(),
        prop::option::weighted(
            0.2,
            (prop::option::weighted(0.8, any::<Index>()), -2.0..2.0_f64, -1.0..1.0_f64),
        ),
    )
}

/// A tree of up to eight joints of any type, links and joints listed in any order, and values for
/// its DOFs.
fn robot() -> impl Strategy<Value = (Vec<Joint>, Vec<f64>)> {
    prop::collection::vec(draft(), 0..8).prop_flat_map(|drafts| {
        let links = Just((0..=drafts.len()).collect::<Vec<_>>()).prop_shuffle();
        let values = prop::collection::vec(-4.0..4.0_f64, 6 * drafts.len());
        (Just(drafts).prop_shuffle(), links, values)
            .prop_map(|(drafts, links, values)| assemble(&drafts, &links, values))
    })
}

fn assemble(drafts: &[Draft], links: &[usize], mut values: Vec<f64>) -> (Vec<Joint>, Vec<f64>) {
    let mut joints: Vec<Joint> = Vec::new();
    for (i, (joint_type, xyz, rpy, axis, parent, mimic)) in drafts.iter().enumerate() {
        let one_number = matches!(
            joint_type,
            JointType::Revolute | JointType::Continuous | JointType::Prismatic
        );
        joints.push(Joint {
            name: format!("joint_{i}"),
            joint_type: *joint_type,
            // Any link that is already in the tree.
            parent: links[parent.index(i + 1)],
            child: links[i + 1],
            xyz: *xyz,
            rpy: *rpy,
            axis: *axis,
            mimic: mimic.filter(|_| one_number).map(|(_, multiplier, offset)| ResolvedMimic {
                dof_idx: None,
                multiplier,
                offset,
            }),
        });
    }
    // Not in the order of the tree.
    joints.rotate_left(drafts.len() / 2);
    let num_dofs: u32 = joints.iter().map(dof_count).sum();
    for (joint, draft) in joints.iter_mut().zip(drafts) {
        if let (Some(mimic), Some((Some(driver), ..)), 1..) = (&mut joint.mimic, &draft.5, num_dofs)
        {
            mimic.dof_idx = Some(DofIdx(driver.index(num_dofs as usize) as u32));
        }
    }
    values.truncate(num_dofs as usize);
    (joints, values)
}

fn kinematics(joints: &[Joint]) -> ForwardKinematics {
    let links: Vec<String> = (0..=joints.len()).map(|i| format!("link_{i}")).collect();
    let (chain, dof) = core_modules(&links, joints);
    ForwardKinematics::new(&chain, &dof).unwrap()
}

proptest! {
    #[test]
    fn agrees_with_products_of_matrices((joints, q) in robot()) {
        let poses = kinematics(&joints).link_poses(&q).unwrap();
        for (link, pose) in poses.iter().enumerate() {
            let difference: Matrix4<f64> = pose.to_homogeneous() - link_pose(&joints, &q, link);
            prop_assert!(difference.amax() < 1e-13, "link {}: {}", link, difference);
        }
    }

    #[test]
    fn poses_are_rigid((joints, q) in robot()) {
        for pose in kinematics(&joints).link_poses(&q).unwrap() {
            prop_assert!((pose.rotation.coords.norm() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_full_turn_changes_nothing((joints, q) in robot()) {
        // For a joint that turns about its axis and drives no other.
        let kinematics = kinematics(&joints);
        let before = kinematics.link_poses(&q).unwrap();
        for (joint, first) in joints.iter().zip(first_dofs(&joints)) {
            let dof = match joint.joint_type {
                JointType::Revolute | JointType::Continuous if joint.mimic.is_none() => first,
                JointType::Planar => first + 2,
                _ => continue,
            };
            let drives = |mimic: &ResolvedMimic| mimic.dof_idx == Some(DofIdx(dof));
            if joints.iter().any(|other| other.mimic.as_ref().is_some_and(drives)) {
                continue;
            }
            let mut turned = q.clone();
            turned[dof as usize] += TAU;
            for (a, b) in before.iter().zip(kinematics.link_poses(&turned).unwrap()) {
                prop_assert!(rotation_distance(&a.rotation, &b.rotation) < 1e-13);
                prop_assert!((a.translation.vector - b.translation.vector).norm() < 1e-12);
            }
        }
    }

    #[test]
    fn gravity_torques_are_the_slope_of_the_energy(
        (joints, q) in robot(),
        bodies in prop::collection::vec((0.0..5.0_f64, prop::array::uniform3(-1.0..1.0_f64)), 9),
        gravity in prop::array::uniform3(-10.0..10.0_f64),
    ) {
        let kinematics = kinematics(&joints);
        let gravity = Vector3::from(gravity);
        let energy = |q: &[f64]| -> f64 {
            let of = |(link, (mass, centre)): (usize, &(f64, [f64; 3]))| {
                let at = link_pose(&joints, q, link).transform_point(&Point3::from(*centre));
                -mass * gravity.dot(&at.coords)
            };
            bodies.iter().take(joints.len() + 1).enumerate().map(of).sum()
        };
        let poses = kinematics.link_poses(&q).unwrap();
        let loads = bodies.iter().zip(&poses);
        let loads = loads.map(|((mass, centre), pose)| Load::new(*mass, (*centre).into(), pose));
        let (mut loads, mut found) = (loads.collect::<Vec<_>>(), vec![f64::NAN; q.len()]);
        kinematics.gravity_torques_into(&q, &poses, &gravity, &mut loads, &mut found);
        for dof in 0..q.len() {
            let at = |by: f64| {
                let mut moved = q.clone();
                moved[dof] += by;
                energy(&moved)
            };
            // Differences of the fourth order.
            let h = 1e-3;
            let slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
            prop_assert!((found[dof] - slope).abs() < 1e-6, "{}: {} {}", dof, found[dof], slope);
        }
    }

    #[test]
    fn a_joint_moves_what_hangs_on_it_and_nothing_else(
        (joints, q) in robot(),
        which in any::<Index>(),
        by in 0.1..0.5_f64,
    ) {
        prop_assume!(!q.is_empty());
        let kinematics = kinematics(&joints);
        let dof = which.index(q.len());
        let mut moved = q.clone();
        moved[dof] += by;
        let before = kinematics.link_poses(&q).unwrap();
        let after = kinematics.link_poses(&moved).unwrap();
        for link in 0..before.len() {
            if !depends(&joints, link, dof as u32) {
                prop_assert_eq!(before[link], after[link]);
            }
        }
    }
}

fn depends(joints: &[Joint], link: usize, dof: u32) -> bool {
    let firsts = first_dofs(joints);
    joints.iter().zip(firsts).any(|(joint, first)| {
        let own = match &joint.mimic {
            Some(mimic) => mimic.dof_idx == Some(DofIdx(dof)),
            None => (first..first + dof_count(joint)).contains(&dof),
        };
        joint.child == link && (own || depends(joints, joint.parent, dof))
    })
}
