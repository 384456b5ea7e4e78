//! `connections_module`: the path between any two links.

use super::index::{JointIdx, LinkIdx};
use super::types::module;

module! {
    /// Paths through the kinematic tree. The path from link i to link j climbs from i to their lowest
    /// common ancestor and goes down to j, so two slices of `root_paths` give it.
    pub struct ConnectionsModule {
        /// For each link, the path to it from the root.
        pub root_paths: Vec<LinkPath> where { length: "links" },
        /// Element (i, j) is the lowest link that lies above (or is) both i and j.
        pub lowest_common_ancestors: Vec<Vec<LinkIdx>> where { square: "links" },
        /// Element (i, j) is the path from link i to link j. May be null above 300 links, and where
        /// the paths hold more than 2,000,000 links together.
        pub link_to_link_paths: Option<Vec<Vec<LinkPath>>> where { square: "links" },
        /// Element (i, j), where j is a descendant of i: the links from i (exclusive) to j (inclusive);
        /// where i is j: `[i]`; else null. The whole may be null where `link_to_link_paths` may.
        pub link_connection_paths: Option<Vec<Vec<Option<Vec<LinkIdx>>>>> where { square: "links" },
    }

    /// A path through the kinematic tree.
    pub struct LinkPath {
        /// The links along the path, both ends included.
        pub links: Vec<LinkIdx>,
        /// The joints between them: one fewer than `links`.
        pub joints: Vec<JointIdx>,
    }
}
