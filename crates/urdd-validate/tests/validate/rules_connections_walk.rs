//! Walks the kinematic tree: computes common ancestors row by row, and checks paths without building them.

use urdd_document::tree::Tree;
use urdd_format::connections::LinkPath;
use urdd_format::index::{JointIdx, LinkIdx};
use urdd_validate::rules::connections::*;

/// 3 is the root; 3-2-0 by joints 1 and 0; 2-1 by joint 2; 3-4 by joint 3.
fn tree() -> Tree {
    Tree {
        root: 3,
        parent_joint: vec![Some(0), Some(2), Some(1), None, Some(3)],
        parent_link: vec![Some(2), Some(2), Some(3), None, Some(3)],
        child_joints: vec![vec![], vec![], vec![0, 2], vec![1, 3], vec![]],
        joint_links: vec![(2, 0), (3, 2), (2, 1), (3, 4)],
        depth: vec![2, 2, 1, 0, 1],
        order: vec![3, 2, 4, 0, 1],
    }
}

fn path(links: &[u32], joints: &[u32]) -> LinkPath {
    LinkPath {
        links: links.iter().copied().map(LinkIdx).collect(),
        joints: joints.iter().copied().map(JointIdx).collect(),
    }
}

#[test]
fn paths_and_counts_in_words() {
    assert_eq!(count(1, "links"), "1 link");
    assert_eq!(count(0, "joints"), "0 joints");
    assert_eq!(show_path(&[1]), "[1]");
    assert_eq!(show_path(&[]), "[]");
    assert_eq!(show_path(&[0, 1]), "[0, 1]");
    let long: Vec<usize> = (3..20).collect();
    assert_eq!(show_path(&long), "[3, 4, ..., 19] (17 links)");
}

#[test]
fn ancestors_of_every_pair() {
    let tree = tree();
    let mut ancestors = Ancestors::new(&tree);
    assert_eq!(ancestors.row(0), [0, 2, 2, 3, 3]);
    assert_eq!(ancestors.row(1), [2, 1, 2, 3, 3]);
    assert_eq!(ancestors.row(2), [2, 2, 2, 3, 3]);
    assert_eq!(ancestors.row(3), [3, 3, 3, 3, 3]);
    assert_eq!(ancestors.row(4), [3, 3, 3, 3, 4]);
}

#[test]
fn a_path_is_followed_up_and_down() {
    let tree = tree();
    let at = |ends, links: &[u32], joints: &[u32]| {
        path_fault(&tree, ends, &path(links, joints)).map(|(place, ..)| place)
    };
    let far = [0, 3, 4];
    assert_eq!(at(far, &[0, 2, 3, 4], &[0, 1, 3]), None);
    assert_eq!(at([4, 3, 0], &[4, 3, 2, 0], &[3, 1, 0]), None);
    assert_eq!(at([1, 1, 1], &[1], &[]), None);
    assert_eq!(at([1, 1, 1], &[0], &[]).as_deref(), Some("/links/0"));
    assert_eq!(at(far, &[0, 2, 3], &[0, 1, 3]).as_deref(), Some("/links"));
    assert_eq!(at(far, &[0, 2, 3, 4], &[0, 1]).as_deref(), Some("/joints"));
    for place in 0..4 {
        let mut links = [0, 2, 3, 4];
        links[place] = 1;
        let found = at(far, &links, &[0, 1, 3]);
        assert_eq!(found, Some(format!("/links/{place}")));
    }
    for place in 0..3 {
        let mut joints = [0, 1, 3];
        joints[place] = 2;
        let found = at(far, &[0, 2, 3, 4], &joints);
        assert_eq!(found, Some(format!("/joints/{place}")));
    }
}
