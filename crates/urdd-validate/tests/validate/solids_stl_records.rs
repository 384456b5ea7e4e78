//! The content of binary STL besides corners: a normal for each triangle, and two unused bytes.

use urdd_geometry::primitives::sphere;
use urdd_geometry::read::Part;
use urdd_geometry::write::stl;
use urdd_validate::solids::file::*;

#[test]
fn normals_are_those_of_the_corners_or_zero() {
    let sound = stl(&[Part::from(sphere(0.3))]).expect("a mesh");
    assert_eq!(stl_fault(&sound), None);
    let mut zero = sound.clone();
    zero[STL_HEADER..STL_HEADER + 12].fill(0);
    assert_eq!(stl_fault(&zero), None);
    let mut turned = sound.clone();
    turned[STL_HEADER + 3 * STL_RECORD + 3] ^= 0x80;
    assert!(stl_fault(&turned).is_some_and(|told| told.contains("triangle 3")));
    let mut spare = sound;
    spare[STL_HEADER + 49] = 1;
    assert!(stl_fault(&spare).is_some());
}
