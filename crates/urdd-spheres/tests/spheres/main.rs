//! Spheres of links, compared with closed forms.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod cover_cell;
mod cover_filled;
mod figures;
mod judge;
mod levels;
mod surface;
mod tree;

use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;

fn cuboid(low: [f64; 3], high: [f64; 3]) -> Mesh {
    let corner =
        |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { high[axis] } else { low[axis] });
    ConvexHull::new(&(0..8).map(corner).collect::<Vec<_>>()).expect("a hull").into_mesh()
}
