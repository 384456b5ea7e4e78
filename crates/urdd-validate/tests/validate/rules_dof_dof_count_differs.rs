//! The rules of `dof::counts`.

use urdd_validate::rules::dof::*;

#[test]
fn the_odd_one_is_named() {
    assert_eq!(odd_one(&[("a", 2), ("b", 2), ("c", 2)]), None);
    assert_eq!(odd_one(&[("a", 2), ("b", 2), ("c", 3)]), Some(("c", 3, 2)));
    assert_eq!(odd_one(&[("a", 3), ("b", 2), ("c", 2)]), Some(("a", 3, 2)));
    assert_eq!(odd_one(&[("a", 1), ("b", 2), ("c", 3)]), Some(("a", 1, 2)));
    assert_eq!(odd_one(&[("a", 1), ("b", 2)]), Some(("a", 1, 2)));
}
