//! Names that occur more than once.

use urdd_validate::rules::urdf::tree::repeated;

#[test]
fn case_makes_another_name() {
    let names = ["a", "A", "", "a", "", "a"];
    let found: Vec<_> = repeated(names.into_iter()).collect();
    assert_eq!(found, [(3, 0, "a"), (4, 2, ""), (5, 0, "a")]);
}
