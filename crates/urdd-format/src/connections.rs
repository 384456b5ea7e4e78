//! `connections_module`: the path between any two links.

use super::annotations::lengths;
use super::index::{JointIdx, LinkIdx};
use super::object::{module, object};

module! {
    /// Paths through the kinematic tree. The path from link i to link j climbs from i to their lowest
    /// common ancestor and goes down to j, so two slices of `root_paths` give it.
    pub struct ConnectionsModule {
        /// For each link, the path to it from the root.
        #[schemars(transform = lengths("links"))]
        pub root_paths: Vec<LinkPath>,
        /// Element (i, j) is the lowest link that lies above (or is) both i and j.
        #[schemars(transform = lengths("links, links"))]
        pub lowest_common_ancestors: Vec<Vec<LinkIdx>>,
        /// Element (i, j) is the path from link i to link j. May be null above 300 links, and where
        /// the paths hold more than 2,000,000 links together.
        #[schemars(transform = lengths("links, links"))]
        pub link_to_link_paths: Option<Vec<Vec<LinkPath>>>,
        /// Element (i, j), where j is a descendant of i: the links from i (exclusive) to j (inclusive);
        /// where i is j: `[i]`; else null. The whole may be null where `link_to_link_paths` may.
        #[schemars(transform = lengths("links, links"))]
        pub link_connection_paths: Option<Vec<Vec<Option<Vec<LinkIdx>>>>>,
    }
}

object! {
    /// A path through the kinematic tree.
    pub struct LinkPath {
        /// The links along the path, both ends included.
        pub links: Vec<LinkIdx>,
        /// The joints between them: one fewer than `links`.
        pub joints: Vec<JointIdx>,
    }
}
