//! The rule `legacy::adjusted_mappings_wrong`.

use urdd_findings::finding::Findings;
use urdd_validate::rules::legacy::*;

fn pointers(to_base: &[usize], to_adjusted: &[Option<usize>], deleted: usize) -> Vec<String> {
    let mapping = Mapping {
        what: "link",
        to_base: to_base.to_vec(),
        to_adjusted: to_adjusted.to_vec(),
        kept: 2,
        deleted,
    };
    let mut findings = Findings::default();
    mapping.check("f", &mut findings);
    let pointers = findings.take().into_iter();
    pointers.filter_map(|finding| finding.place.pointer).collect()
}

#[test]
fn each_is_the_inverse_of_the_other() {
    let down = "/adjusted_link_idx_to_base_link_idx_mapping";
    let up = "/base_link_idx_to_adjusted_link_idx_mapping";
    let right = [Some(0), None, Some(1)];
    assert!(pointers(&[0, 2], &right, 1).is_empty());
    assert_eq!(pointers(&[0, 1], &right, 1), [format!("{down}/1")]);
    assert_eq!(pointers(&[0, 9], &right, 1), [format!("{down}/1")]);
    assert_eq!(pointers(&[0], &right, 1), [down]);
    assert_eq!(pointers(&[0, 2], &right, 2), [up]);
    let twice = [Some(0), Some(0), Some(1)];
    assert_eq!(pointers(&[0, 2], &twice, 1), [format!("{up}/1")]);
}
