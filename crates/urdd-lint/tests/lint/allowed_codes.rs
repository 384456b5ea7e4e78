//! Comments in a URDF that allow findings: `<!-- urdd: allow LNT001, LNT003 the cable is not drawn -->`.

use urdd_lint::allow::*;

#[test]
fn codes_stand_before_the_reason() {
    assert_eq!(codes_of(" urdd: allow LNT001 SRC, really "), Some(vec!["LNT001"]));
    assert_eq!(codes_of("urdd:allow LNT001 , SRC: see #3, #4"), Some(vec!["LNT001", "SRC"]));
    assert_eq!(codes_of(" urdd: allow "), None);
    assert_eq!(codes_of(" urdd: allowance "), None);
    assert_eq!(codes_of(" a comment about urdd: allow LNT001 "), None);
}
