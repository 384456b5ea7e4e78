//! The rules of `dof::mappings`.

use urdd_validate::rules::dof::*;

fn inverse(joint_of_dof: &[usize], dofs_of_joint: &[&[usize]]) -> bool {
    are_inverse(joint_of_dof, dofs_of_joint.iter().map(|list| list.iter().copied()))
}

#[test]
fn inverse_means_in_both_directions() {
    assert!(inverse(&[1, 1, 0], &[&[2], &[0, 1], &[]]));
    assert!(inverse(&[], &[&[], &[]]));
    assert!(!inverse(&[1, 1, 0], &[&[2], &[0], &[]]));
    assert!(!inverse(&[1, 1, 0], &[&[2], &[0, 0], &[]]));
    assert!(!inverse(&[1, 1, 0], &[&[2], &[0, 9], &[]]));
    assert!(!inverse(&[1, 1, 2], &[&[2], &[0, 1], &[]]));
    assert!(!inverse(&[1, 1, 7], &[&[], &[0, 1], &[]]));
}
