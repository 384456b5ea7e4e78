//! `connections_module` from the chain: SPEC 6.4.

use urdd_format::chain::ChainModule;
use urdd_format::connections::{ConnectionsModule, LinkPath};
use urdd_format::index::{JointIdx, LinkIdx};

/// Maximum number of links with which the path of every pair is written (SPEC 6.4.6).
pub const MOST_LINKS_WITH_PAIRS: usize = 300;

/// Maximum total number of links in the paths of all pairs.
pub const MOST_LINKS_IN_PAIRS: usize = 2_000_000;

/// Builds the module. Its size grows with links × depth and with links².
pub(super) fn connections_module(chain: &ChainModule) -> ConnectionsModule {
    let root_paths = root_paths(chain);
    let ancestors = lowest_common_ancestors(chain, &root_paths);
    let with_pairs = chain.links_in_chain.len() <= MOST_LINKS_WITH_PAIRS
        && links_in_pairs(chain) <= MOST_LINKS_IN_PAIRS;
    let pairs = with_pairs.then(|| {
        let paths = root_paths.iter().zip(&ancestors);
        paths
            .map(|(from, row)| {
                let to = root_paths.iter().zip(row);
                to.map(|(to, ancestor)| path(from, to, *ancestor)).collect()
            })
            .collect()
    });
    let descents = with_pairs.then(|| descents(&root_paths));
    ConnectionsModule {
        root_paths,
        lowest_common_ancestors: ancestors,
        link_to_link_paths: pairs,
        link_connection_paths: descents,
    }
}

fn root_paths(chain: &ChainModule) -> Vec<LinkPath> {
    let mut paths =
        vec![LinkPath { links: Vec::new(), joints: Vec::new() }; chain.links_in_chain.len()];
    for idx in chain.kinematic_hierarchy.iter().flatten() {
        let link = &chain.links_in_chain[idx.get()];
        let mut path = match (link.parent_link_idx, link.parent_joint_idx) {
            (Some(parent), Some(joint)) => {
                let mut path = paths[parent.get()].clone();
                path.joints.push(joint);
                path
            }
            _ => paths[idx.get()].clone(),
        };
        path.links.push(*idx);
        paths[idx.get()] = path;
    }
    paths
}

/// The total number of links in the paths of all pairs. Each path has its first link, and one more for each joint on
/// it. A joint with s links below it is on every path between one of these and one of the others.
fn links_in_pairs(chain: &ChainModule) -> usize {
    let all = chain.links_in_chain.len();
    let mut below = vec![1; all];
    let mut links = all * all;
    for idx in chain.kinematic_hierarchy.iter().flatten().rev() {
        if let Some(parent) = chain.links_in_chain[idx.get()].parent_link_idx {
            let own = below[idx.get()];
            below[parent.get()] += own;
            links += 2 * own * (all - own);
        }
    }
    links
}

/// Row i is filled from the root downwards: a link on the path to i is its own common ancestor with i; any other link
/// has that of its parent.
fn lowest_common_ancestors(chain: &ChainModule, root_paths: &[LinkPath]) -> Vec<Vec<LinkIdx>> {
    let rows = root_paths.iter().map(|path| {
        let mut row = vec![chain.root_idx; root_paths.len()];
        let mut on_path = vec![false; root_paths.len()];
        for link in &path.links {
            on_path[link.get()] = true;
        }
        for idx in chain.kinematic_hierarchy.iter().flatten() {
            let parent = chain.links_in_chain[idx.get()].parent_link_idx;
            row[idx.get()] = match parent {
                _ if on_path[idx.get()] => *idx,
                Some(parent) => row[parent.get()],
                None => *idx,
            };
        }
        row
    });
    rows.collect()
}

/// The path up from one link to the common ancestor and down to the other.
fn path(from: &LinkPath, to: &LinkPath, ancestor: LinkIdx) -> LinkPath {
    let depth = from.links.iter().position(|link| *link == ancestor).unwrap_or_default();
    let links_up = from.links[depth..].iter().rev();
    let joints_up = from.joints[depth..].iter().rev();
    let links: Vec<LinkIdx> = links_up.chain(&to.links[depth + 1..]).copied().collect();
    let joints: Vec<JointIdx> = joints_up.chain(&to.joints[depth..]).copied().collect();
    LinkPath { links, joints }
}

/// The published table: the links below i down to j if j is a descendant of i.
fn descents(root_paths: &[LinkPath]) -> Vec<Vec<Option<Vec<LinkIdx>>>> {
    let row = |from: usize| {
        let to = root_paths.iter().enumerate();
        to.map(|(to, path)| {
            let own = LinkIdx(from as u32);
            let depth = path.links.iter().position(|link| *link == own)?;
            match to == from {
                true => Some(vec![own]),
                false => Some(path.links[depth + 1..].to_vec()),
            }
        })
        .collect()
    };
    (0..root_paths.len()).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::chain_module;
    use crate::urdf;

    /// Links in a line; the file lists them from the far end to the root.
    fn line(links: usize) -> ConnectionsModule {
        connections_module(&line_chain(links))
    }

    fn line_chain(links: usize) -> ChainModule {
        let mut xml = "<robot name=\"line\">".to_owned();
        for i in 0..links {
            xml += &format!("<link name=\"l{i}\"/>");
        }
        for i in 1..links {
            let above = i - 1;
            xml += &format!(
                "<joint name=\"j{i}\" type=\"fixed\"><parent link=\"l{i}\"/><child link=\"l{above}\"/></joint>"
            );
        }
        let reading = urdf::read(&(xml + "</robot>"), "line").unwrap();
        chain_module(&reading.robot, &reading.tree)
    }

    #[test]
    fn paths_along_a_line_are_ranges() {
        let count = 7;
        let module = line(count);
        let range = |from: usize, to: usize| -> Vec<LinkIdx> {
            let up = (from..=to).map(|link| LinkIdx(link as u32));
            let down = (to..=from).rev().map(|link| LinkIdx(link as u32));
            if from <= to { up.collect() } else { down.collect() }
        };
        let pairs = module.link_to_link_paths.unwrap();
        let descents = module.link_connection_paths.unwrap();
        for i in 0..count {
            // The root is the last link.
            assert_eq!(module.root_paths[i].links, range(count - 1, i));
            for j in 0..count {
                assert_eq!(module.lowest_common_ancestors[i][j], LinkIdx(i.max(j) as u32));
                assert_eq!(pairs[i][j].links, range(i, j));
                // Joint k is between links k and k + 1.
                let joints: Vec<u32> = pairs[i][j].joints.iter().map(|joint| joint.0).collect();
                let mut between: Vec<u32> = (i.min(j) as u32..i.max(j) as u32).collect();
                if i > j {
                    between.reverse();
                }
                assert_eq!(joints, between);
                let below = match i.cmp(&j) {
                    std::cmp::Ordering::Equal => Some(range(i, i)),
                    std::cmp::Ordering::Greater => Some(range(i - 1, j)),
                    std::cmp::Ordering::Less => None,
                };
                assert_eq!(descents[i][j], below);
            }
        }
    }

    /// Links that are all children of the first one.
    fn star(links: usize) -> ChainModule {
        let link = |i: usize| format!("<link name=\"l{i}\"/>");
        let joint = |i: usize| {
            format!(
                "<joint name=\"j{i}\" type=\"fixed\"><parent link=\"l0\"/><child link=\"l{i}\"/></joint>"
            )
        };
        let links_in_file: String = (0..links).map(link).collect();
        let joints: String = (1..links).map(joint).collect();
        let xml = format!("<robot name=\"star\">{links_in_file}{joints}</robot>");
        let reading = urdf::read(&xml, "star").unwrap();
        chain_module(&reading.robot, &reading.tree)
    }

    #[test]
    fn above_300_links_the_paths_of_pairs_are_left_out() {
        assert!(connections_module(&star(300)).link_to_link_paths.is_some());
        let large = connections_module(&star(301));
        assert!(large.link_to_link_paths.is_none() && large.link_connection_paths.is_none());
        assert_eq!(large.root_paths[300].links.len(), 2);
    }

    #[test]
    fn above_2_million_links_in_them_the_paths_of_pairs_are_left_out() {
        assert!(line(180).link_to_link_paths.is_some());
        let long = line(181);
        assert!(long.link_to_link_paths.is_none() && long.link_connection_paths.is_none());
        assert_eq!(long.root_paths[0].links.len(), 181);
    }

    #[test]
    fn the_links_in_paths_are_counted_without_the_paths() {
        // A line of n links: each path has 1 + |i - j| links.
        for n in [1_usize, 2, 9] {
            let module = line(n);
            let pairs = module.link_to_link_paths.unwrap();
            let written: usize = pairs.iter().flatten().map(|path| path.links.len()).sum();
            assert_eq!(written, n * n + (n * n * n - n) / 3);
            assert_eq!(links_in_pairs(&line_chain(n)), written);
        }
        // A star: 1 for a link to itself, 2 from or to the centre, otherwise 3.
        assert_eq!(links_in_pairs(&star(10)), 10 + 2 * 9 * 2 + 9 * 8 * 3);
    }
}
