//! The rules of `meshes::file_paths`.

use urdd_validate::rules::meshes::lists::slug;

#[test]
fn names_become_slugs() {
    assert_eq!(slug("base_link-2"), "base_link-2");
    assert_eq!(slug("arm/forearm äö.x"), "arm_forearm_x");
    assert_eq!(slug("_/_"), "___");
    assert_eq!(slug("//"), "_");
    assert_eq!(slug(""), "link");
    assert_eq!(slug(&"x".repeat(80)).len(), 64);
}
