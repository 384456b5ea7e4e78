//! Bounding boxes and bounding spheres compared with their hulls and pieces.

use std::f64::consts::FRAC_PI_4;

use urdd_document::shapes::Volume;
use urdd_geometry::Mesh;
use urdd_validate::views::enclosure::*;

/// A square of half diagonal 1 in the plane z = 0, and a point above it.
fn pyramid() -> Mesh {
    let vertices =
        vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 2.0]];
    Mesh { vertices, ..Mesh::default() }
}

fn turned_box(half_extents: [f64; 3]) -> Fit {
    let volume = Volume::Box { half_extents, offset: [0.0, 0.0, 1.0], rpy: [0.0, 0.0, FRAC_PI_4] };
    Fit::new(&volume, &pyramid())
}

#[test]
fn a_box_about_a_pyramid() {
    // Rotated by an eighth of a turn, the square is sqrt(2) wide.
    let half = 0.5_f64.sqrt();
    let tight = turned_box([half, half, 1.0]);
    assert!(tight.outside.1 < 1e-15 && tight.off.1 < 1e-15, "{tight:?}");

    let low = turned_box([half, half, 0.75]);
    assert!((low.outside.1 - 0.25).abs() < 1e-15, "{low:?}");

    let wide = turned_box([half, half + 0.5, 1.25]);
    assert!(matches!(wide.off, (Side::Of(1, _), off) if (off - 0.5).abs() < 1e-15), "{wide:?}");
    assert_eq!(wide.outside.1, 0.0);
}

#[test]
fn a_vertex_past_an_edge_is_as_far_out_as_the_edge_is_away() {
    // In the axes of the rotated box, (1, 0, 0) is at (half, -half).
    let half = 0.5_f64.sqrt();
    let narrow = turned_box([half - 0.03, half - 0.04, 1.0]);
    assert!((narrow.outside.1 - 0.05).abs() < 1e-15, "{narrow:?}");
}

#[test]
fn a_sphere_about_a_pyramid() {
    let about = |radius| {
        let offset = [0.0, 0.0, 0.75];
        Fit::new(&Volume::Sphere { radius, offset }, &pyramid())
    };
    // The square's corners and the tip are 1.25 away.
    assert_eq!(about(1.25).outside.1, 0.0);
    assert_eq!(about(1.25).off.1, 0.0);
    assert_eq!(about(1.5).off, (Side::Round, 0.25));
    assert_eq!(about(1.0).outside, (0, 0.25));
}
