//! MSH017 to MSH023: hulls and pieces.

use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_validate::code::Code::*;

use super::{ALL, grow_piece, lone_box, rewrite, up};
use crate::meshes::{HULLS, PIECES, boxy, robot_of};
use crate::{Case, changed, invalid, near_miss};
use testkit::fixture::Fixture;
use testkit::robot::*;

pub fn cases() -> Vec<Case> {
    vec![
        invalid(MSH017, "open", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                mesh.triangles.pop();
            });
        }),
        // One triangle has a corner of its own, at the next binary32.
        invalid(MSH017, "edges-that-only-nearly-meet", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                let near = mesh.vertices[mesh.triangles[0][0] as usize].map(up);
                mesh.triangles[0][0] = mesh.vertices.len() as u32;
                mesh.vertices.push(near);
            });
        }),
        invalid(MSH017, "inward", |f| rewrite(f, HULLS, ALL, Mesh::flip)),
        changed(
            MSH017,
            "flat",
            false,
            || {
                let mut flat = link("flat");
                flat.visual.push(visual(None, cuboid([0.3, 0.2, 0.0])));
                Fixture::full(&robot_of(vec![flat, boxy("b")]))
            },
            |_| {},
        ),
        invalid(MSH018, "corner-cut-off", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                let seven = &mesh.vertices[..7];
                *mesh = ConvexHull::new(seven).expect("a hull").into_mesh();
            });
        }),
        near_miss(MSH018, "rounded-otherwise", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                mesh.vertices[0] = mesh.vertices[0].map(up);
            });
        }),
        invalid(MSH019, "vertex-that-is-not-the-meshs", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                let mut points = mesh.vertices.clone();
                points.push([0.0, 0.0, 0.0625]);
                *mesh = ConvexHull::new(&points).expect("a hull").into_mesh();
            });
        }),
        near_miss(MSH019, "rounded-otherwise", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                mesh.vertices[7] = mesh.vertices[7].map(up);
            });
        }),
        invalid(MSH020, "open", |f| {
            rewrite(f, PIECES, ALL, |mesh| {
                mesh.triangles.remove(0);
            });
        }),
        near_miss(MSH020, "another-order", |f| {
            rewrite(f, PIECES, ALL, |mesh| mesh.triangles.reverse());
        }),
        invalid(MSH021, "larger-than-the-link", |f| {
            rewrite(f, PIECES, ALL, |mesh| {
                for vertex in &mut mesh.vertices {
                    *vertex = vertex.map(|x| f64::from((x * 1.1) as f32));
                }
            });
        }),
        changed(MSH023, "barely-larger-than-the-link", true, lone_box, |f| {
            grow_piece(f, 1.01);
        }),
        changed(MSH023, "larger-by-rounding-of-voxels", false, lone_box, |f| {
            // 15 micrometres of a hull that is 0.37 m across.
            grow_piece(f, 1.0001);
        }),
        near_miss(MSH021, "rounded-otherwise", |f| {
            rewrite(f, PIECES, ALL, |mesh| {
                mesh.vertices[7] = mesh.vertices[7].map(up);
            });
        }),
        invalid(MSH022, "part-of-the-link", |f| {
            rewrite(f, PIECES, ALL, |mesh| {
                for vertex in &mut mesh.vertices {
                    vertex[0] = vertex[0].min(0.1);
                }
            });
        }),
    ]
}
