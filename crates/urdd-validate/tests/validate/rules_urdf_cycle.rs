//! The rules of `urdf::tree`.

use urdd_validate::rules::urdf::tree::circles;

#[test]
fn finds_each_circle_once() {
    let none: Vec<Vec<usize>> = Vec::new();
    assert_eq!(circles(&[]), none);
    assert_eq!(circles(&[None, Some(0), Some(1), Some(0)]), none);
    assert_eq!(circles(&[Some(0)]), [[0]]);
    assert_eq!(
        circles(&[Some(2), None, Some(3), Some(2), Some(6), Some(4), Some(5), Some(9)]),
        [vec![2, 3], vec![4, 6, 5]]
    );
}
