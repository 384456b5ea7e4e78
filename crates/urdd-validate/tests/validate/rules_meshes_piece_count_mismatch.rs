//! The rules of `meshes::lists`.

use urdd_validate::rules::meshes::lists::most_common;

#[test]
fn the_number_that_comes_most_often_and_first() {
    assert_eq!(most_common([3, 2, 2].into_iter()), 2);
    assert_eq!(most_common([3, 2, 2, 3].into_iter()), 3);
    assert_eq!(most_common([7].into_iter()), 7);
    assert_eq!(most_common(std::iter::empty()), 0);
}
