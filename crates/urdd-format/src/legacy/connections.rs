//! `connections_module` 0.0.1: paths down the kinematic tree.

use crate::index::LinkIdx;
use crate::types::module;

module! {
    /// Paths from links down to their descendants.
    pub struct ConnectionsModule {
        /// Element (i, j), where link j is a descendant of link i: the links from i (left out) to j
        /// (included); where i is j: `[i]`; else null.
        pub link_connection_paths: Vec<Vec<Option<Vec<LinkIdx>>>>,
    }
}
