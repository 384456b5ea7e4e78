//! CHN: `chain_module`.
//!
//! Every table is compared with the tree that follows from `urdf_module`, and none with another, so
//! that one wrong value gives one finding.

mod chain_joint_wrong;
mod chain_link_wrong;
mod children_wrong;
mod hierarchy_wrong;
mod joint_axis_wrong;
mod joint_origin_differs;
mod joint_type_differs;
mod parent_wrong;
mod quaternion_not_canonical;
mod root_wrong;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &chain_link_wrong::RULE,
    &chain_joint_wrong::RULE,
    &parent_wrong::RULE,
    &children_wrong::RULE,
    &hierarchy_wrong::RULE,
    &root_wrong::RULE,
    &joint_type_differs::RULE,
    &joint_origin_differs::RULE,
    &joint_axis_wrong::RULE,
    &quaternion_not_canonical::RULE,
];

/// An index that may be absent, as a report has it.
fn or_null(index: Option<usize>) -> String {
    index.map_or_else(|| "null".to_owned(), |index| index.to_string())
}

/// A list of indices, as a report has it: cut where it is long.
fn list(indices: &[usize]) -> String {
    const LONGEST: usize = 12;
    let shown: Vec<String> = indices.iter().take(LONGEST).map(usize::to_string).collect();
    match indices.len() {
        0..=LONGEST => format!("[{}]", shown.join(", ")),
        all => format!("[{}, … {all} in all]", shown.join(", ")),
    }
}
