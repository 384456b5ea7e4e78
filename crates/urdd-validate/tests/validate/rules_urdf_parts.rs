//! Which rule compares which values of `urdf_module` with the carried URDF.

use urdd_validate::rules::urdf::compared::{Part, element_part};

#[test]
fn each_value_belongs_to_one_part() {
    for pointer in ["/links", "/joints", "/links/3/name", "/version", "/joints/1/mimic/offset"] {
        assert_eq!(Part::of(pointer), Part::Joints, "{pointer}");
    }
    for pointer in ["/materials", "/materials/0/name", "/links/3/visual/0/material"] {
        assert_eq!(Part::of(pointer), Part::Materials, "{pointer}");
    }
    for pointer in [
        "/name",
        "/links/3/visual/0/name",
        "/links/3/visual/0/origin/xyz/0",
        "/joints/1/dynamics",
        "",
    ] {
        assert_eq!(Part::of(pointer), Part::Rest, "{pointer}");
    }
}

#[test]
fn an_origin_is_one_place() {
    for pointer in ["/links/3/collision/0/origin", "/links/3/collision/0/origin/xyz/2"] {
        assert_eq!(element_part(pointer), Some("/links/3/collision/0/origin"));
    }
    for pointer in ["/links/3/inertial/origin/xyz", "/joints/3/origin", "/links", ""] {
        assert_eq!(element_part(pointer), None, "{pointer}");
    }
}
