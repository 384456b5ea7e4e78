//! CON: `connections_module`.
//!
//! Every table is compared with the tree that follows from `urdf_module`, in time proportional to
//! what is written in it: the table of lowest common ancestors is made row by row, and paths are
//! walked without being made.

mod common_ancestor_wrong;
mod connection_table_size;
mod descendant_path_wrong;
mod explicit_paths_missing;
mod link_to_link_path_wrong;
mod root_path_wrong;
mod walk;

use crate::finding::{Finding, Findings, KEPT_PLACES};
use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &connection_table_size::RULE,
    &root_path_wrong::RULE,
    &common_ancestor_wrong::RULE,
    &link_to_link_path_wrong::RULE,
    &descendant_path_wrong::RULE,
    &explicit_paths_missing::RULE,
];

/// Wrong elements of a table of millions: the first few are kept, the others counted without being
/// put into words.
#[derive(Default)]
struct Tally {
    kept: Vec<Finding>,
    more: usize,
}

impl Tally {
    fn wrong(&mut self, finding: impl FnOnce() -> Finding) {
        match self.kept.len() < KEPT_PLACES {
            true => self.kept.push(finding()),
            false => self.more += 1,
        }
    }

    fn report(mut self, findings: &mut Findings) {
        if let Some(last) = self.kept.last_mut() {
            last.count += self.more;
        }
        for finding in self.kept {
            findings.report(finding);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tally_counts_all_and_keeps_few() {
        let mut tally = Tally::default();
        for i in 0..2 * KEPT_PLACES {
            tally.wrong(|| Finding::at("f", format!("/t/{i}"), "wrong"));
        }
        let mut findings = Findings::default();
        tally.report(&mut findings);
        let findings = findings.take();
        assert_eq!(findings.len(), 1);
        assert_eq!(findings[0].count, 2 * KEPT_PLACES);
        assert_eq!(findings[0].more.len(), KEPT_PLACES - 1);
    }
}
