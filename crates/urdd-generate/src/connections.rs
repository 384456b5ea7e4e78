//! `connections_module` from the chain: SPEC 6.4.

use urdd_format::chain::ChainModule;
use urdd_format::connections::{ConnectionsModule, LinkPath};
use urdd_format::index::{JointIdx, LinkIdx};

/// Maximum number of links with which the path of every pair is written (SPEC 6.4.6).
pub const MOST_LINKS_WITH_PAIRS: usize = 300;

/// Maximum total number of links in the paths of all pairs.
pub const MOST_LINKS_IN_PAIRS: usize = 2_000_000;

/// Builds the module. Its size grows with links × depth and with links².
pub fn connections_module(chain: &ChainModule) -> ConnectionsModule {
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
pub fn links_in_pairs(chain: &ChainModule) -> usize {
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
            if to == from { Some(vec![own]) } else { Some(path.links[depth + 1..].to_vec()) }
        })
        .collect()
    };
    (0..root_paths.len()).map(row).collect()
}
