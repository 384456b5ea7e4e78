//! SPH: spheres of links.

use crate::Case;

pub fn cases() -> Vec<Case> {
    Vec::new()
}

#[test]
fn base() {
    let mut fixture = testkit::spheres::fixture();
    println!("{}", serde_json::to_string(fixture.doc(testkit::spheres::SPHERES)).unwrap());
    fixture.seal();
    assert_eq!(crate::findings_in(&fixture), std::collections::BTreeMap::new());
}
