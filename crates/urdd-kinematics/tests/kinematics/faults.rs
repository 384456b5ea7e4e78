//! Modules from which kinematics cannot be computed: each fault is reported at its location.

use urdd_format::chain::ChainModule;
use urdd_format::dof::{DofModule, ResolvedMimic};
use urdd_format::index::{Count, DofIdx, LinkIdx};
use urdd_format::urdf::JointType::*;
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics};

use testkit::core_modules::{Joint, chain_of};

/// Four links in a row: revolute, planar, and a mimic joint.
fn robot() -> (ChainModule, DofModule) {
    chain_of(&[
        Joint::after(0, Revolute, [0.0, 0.0, 1.0]),
        Joint::after(1, Planar, [0.0, 0.0, 1.0]),
        Joint::after(2, Prismatic, [1.0, 0.0, 0.0]).follows(Some(0), 1.0, 0.0),
    ])
}

#[track_caller]
fn fault(change: impl FnOnce(&mut ChainModule, &mut DofModule), expected: &str) {
    let (mut chain, mut dof) = robot();
    assert!(ForwardKinematics::new(&chain, &dof).is_ok());
    change(&mut chain, &mut dof);
    let found = ForwardKinematics::new(&chain, &dof).unwrap_err().to_string();
    assert_eq!(found, expected);
}

#[test]
fn indices_out_of_range() {
    fault(
        |chain, _| chain.root_idx = LinkIdx(4),
        "chain_module/root_idx: link 4 is out of range: there are 4",
    );
    fault(
        |chain, _| chain.joints_in_chain[1].parent_link_idx = LinkIdx(u32::MAX),
        "chain_module/joints_in_chain/1/parent_link_idx: link 4294967295 is out of range: there are 4",
    );
    fault(
        |chain, _| chain.joints_in_chain[2].child_link_idx = LinkIdx(9),
        "chain_module/joints_in_chain/2/child_link_idx: link 9 is out of range: there are 4",
    );
    fault(
        |_, dof| dof.joint_idx_to_dof_idxs_mapping[1][2] = DofIdx(4),
        "dof_module/joint_idx_to_dof_idxs_mapping/1/2: DOF 4 is out of range: there are 4",
    );
    fault(
        |_, dof| dof.num_dofs = Count(0),
        "dof_module/joint_idx_to_dof_idxs_mapping/0/0: DOF 0 is out of range: there are 0",
    );
    fault(
        |_, dof| mimic(dof).dof_idx = Some(DofIdx(4)),
        "dof_module/joint_idx_to_mimic_mapping/2/dof_idx: DOF 4 is out of range: there are 4",
    );
}

fn mimic(dof: &mut DofModule) -> &mut ResolvedMimic {
    dof.joint_idx_to_mimic_mapping[2].as_mut().unwrap()
}

#[test]
fn a_chain_without_links() {
    let (mut chain, mut dof) = robot();
    chain.links_in_chain.clear();
    chain.joints_in_chain.clear();
    dof.joint_idx_to_dof_idxs_mapping.clear();
    dof.joint_idx_to_mimic_mapping.clear();
    let error = ForwardKinematics::new(&chain, &dof).unwrap_err().to_string();
    assert_eq!(error, "chain_module/root_idx: link 0 is out of range: there are 0");
}

#[test]
fn chains_that_are_no_tree() {
    // A cycle that does not contain the root.
    fault(
        |chain, _| chain.joints_in_chain[1].parent_link_idx = LinkIdx(3),
        "chain_module/links_in_chain/2: no path leads from the root to this link",
    );
    // A link that is its own parent.
    fault(
        |chain, _| chain.joints_in_chain[2].parent_link_idx = LinkIdx(3),
        "chain_module/links_in_chain/3: no path leads from the root to this link",
    );
    fault(
        |chain, _| chain.joints_in_chain[2].child_link_idx = LinkIdx(0),
        "chain_module/joints_in_chain/2/child_link_idx: this joint's child is the root link, 0",
    );
    fault(
        |chain, _| chain.joints_in_chain[2].child_link_idx = LinkIdx(1),
        "chain_module/joints_in_chain/2/child_link_idx: link 1 is already the child of joint 0",
    );
    fault(
        |chain, _| chain.links_in_chain.push(chain.links_in_chain[0].clone()),
        "chain_module/links_in_chain/4: no path leads from the root to this link",
    );
}

#[test]
fn lists_that_do_not_go_with_the_chain() {
    fault(
        |_, dof| dof.joint_idx_to_dof_idxs_mapping.truncate(2),
        "dof_module/joint_idx_to_dof_idxs_mapping: 2 entries, expected 3: one for each joint of chain_module",
    );
    fault(
        |_, dof| dof.joint_idx_to_mimic_mapping.push(None),
        "dof_module/joint_idx_to_mimic_mapping: 4 entries, expected 3: one for each joint of chain_module",
    );
    fault(
        |_, dof| dof.joint_idx_to_dof_idxs_mapping[1].truncate(2),
        "dof_module/joint_idx_to_dof_idxs_mapping/1: 2 DOFs, expected 3 of a Planar joint",
    );
    fault(
        |_, dof| dof.joint_idx_to_dof_idxs_mapping[2].push(DofIdx(0)),
        "dof_module/joint_idx_to_dof_idxs_mapping/2: 1 DOF, expected 0 of a mimic joint",
    );
}

#[test]
fn joints_whose_motion_is_not_defined() {
    fault(
        |chain, _| chain.joints_in_chain[0].axis = None,
        "chain_module/joints_in_chain/0/axis: a Revolute joint needs an axis",
    );
    fault(
        |chain, _| chain.joints_in_chain[1].axis = Some([0.0, 3.0, 4.0]),
        "chain_module/joints_in_chain/1/axis: not a unit vector: its length is 5",
    );
    fault(
        |chain, _| chain.joints_in_chain[1].axis = Some([0.0, f64::NAN, 1.0]),
        "chain_module/joints_in_chain/1/axis: not a unit vector: its length is NaN",
    );
    fault(
        |chain, _| chain.joints_in_chain[0].origin.quaternion_wxyz = [0.0; 4],
        "chain_module/joints_in_chain/0/origin: not a unit quaternion: its length is 0",
    );
    fault(
        |chain, _| chain.joints_in_chain[0].origin.position[2] = f64::INFINITY,
        "chain_module/joints_in_chain/0/origin: the position has a component that is not a finite number",
    );
    fault(
        |_, dof| mimic(dof).offset = f64::NAN,
        "dof_module/joint_idx_to_mimic_mapping/2/offset: NaN is not a finite number",
    );
    fault(
        |chain, _| chain.joints_in_chain[2].joint_type = Spherical,
        "dof_module/joint_idx_to_mimic_mapping/2: a Spherical joint cannot be a mimic joint: its position is not one number",
    );
}

#[test]
fn a_hair_off_a_unit_vector_is_scaled_and_no_more() {
    let (mut chain, dof) = robot();
    chain.joints_in_chain[0].origin.quaternion_wxyz = [0.8660254, 0.5, 0.0, 0.0];
    let kinematics = ForwardKinematics::new(&chain, &dof).unwrap();
    let norm = kinematics.link_poses(&[0.1, 0.2, 0.3, 0.4]).unwrap()[3].rotation.coords.norm();
    assert!((norm - 1.0).abs() < 1e-15);
    chain.joints_in_chain[0].origin.quaternion_wxyz = [0.866, 0.5, 0.0, 0.0];
    assert!(ForwardKinematics::new(&chain, &dof).is_err());
}

#[test]
fn bounds_that_make_no_configuration() {
    let (chain, mut dof) = robot();
    let error = |dof: &DofModule, bounds: &[[f64; 2]]| {
        let space = ConfigurationSpace::new(dof, &chain, bounds);
        space.unwrap_err().to_string()
    };
    assert_eq!(
        error(&dof, &[[0.0, 1.0]; 5]),
        "bounds_module/bounds: 5 entries, expected 4: one for each DOF of dof_module"
    );
    assert_eq!(
        error(&dof, &[[0.0, 1.0], [0.0, 1.0], [0.0, f64::INFINITY], [0.0, 1.0]]),
        "bounds_module/bounds/2/1: inf is not a finite number"
    );
    dof.joint_idx_to_mimic_mapping.clear();
    assert_eq!(
        error(&dof, &[[0.0, 1.0]; 4]),
        "dof_module/joint_idx_to_mimic_mapping: 0 entries, expected 3: one for each joint of chain_module"
    );
}
