//! The rules of `connections::tables`.

use urdd_document::tree::Tree;
use urdd_validate::rules::connections::*;

/// The tree of links in which `parent` gives the parent of each link except the first.
fn tree(links: usize, parent: impl Fn(usize) -> usize) -> Tree {
    let mut depth = vec![0; links];
    for link in 1..links {
        depth[link] = depth[parent(link)] + 1;
    }
    Tree {
        root: 0,
        parent_joint: (0..links).map(|link| link.checked_sub(1)).collect(),
        parent_link: (0..links).map(|i| (i > 0).then(|| parent(i))).collect(),
        child_joints: Vec::new(),
        joint_links: (1..links).map(|link| (parent(link), link)).collect(),
        depth,
        order: (0..links).collect(),
    }
}

#[test]
fn paths_of_a_line_and_a_star() {
    let line = |links: usize| links_in_paths(&tree(links, |link| link - 1));
    // The sum of 1 + |i - j|.
    assert_eq!(line(1), 1);
    assert_eq!(line(3), 3 + 4 * 2 + 2 * 3);
    assert_eq!(line(180), 1_976_340);
    assert_eq!(line(181), 2_009_281);
    let star = links_in_paths(&tree(300, |_| 0));
    assert_eq!(star, 300 + 2 * 299 * 2 + 299 * 298 * 3);
}
