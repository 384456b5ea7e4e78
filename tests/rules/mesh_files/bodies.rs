//! MSH017 to MSH023: hulls and pieces.

use serde_json::json;
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_validate::code::Code::*;

use super::{ALL, grow_piece, lone_box, rewrite, up};
use crate::meshes::{HULLS, PIECES, PLAIN, boxy, robot_of};
use crate::numbers::geometry::geometry_alone;
use crate::{Case, changed, invalid, near_miss};
use testkit::fixture::Fixture;
use testkit::robot::*;

/// Splits an edge of a triangle at a vertex of its own. The other side of the edge stays, and a triangle without height may
/// be between the two.
fn split_edge(mesh: &mut Mesh, filled: bool) {
    let [a, b, c] = mesh.triangles.remove(0);
    let [from, to, _] = mesh.corners([a, b, c]);
    let middle = [0, 1, 2].map(|i| up((from[i] + to[i]) / 2.0));
    let m = mesh.vertices.len() as u32;
    mesh.vertices.push(middle);
    mesh.triangles.extend([[a, m, c], [m, b, c]]);
    if filled {
        mesh.triangles.push([a, b, m]);
    }
}

/// A box, and a link that shows a rectangle. Class Geometry.
fn flat() -> Fixture {
    let mut flat = link("flat");
    flat.visual.push(visual(None, cuboid([0.3, 0.2, 0.0])));
    let mut f = Fixture::full(&robot_of(vec![boxy("a"), flat]));
    geometry_alone(&mut f);
    f
}

pub fn cases() -> Vec<Case> {
    let mut cases = hulls_and_pieces();
    cases.extend(thin());
    cases
}

/// What has no height: triangles, boxes and pieces.
fn thin() -> Vec<Case> {
    vec![
        near_miss(MSH017, "triangle-without-height-between-edges", |f| {
            rewrite(f, PLAIN, ALL, |mesh| split_edge(mesh, true));
            rewrite(f, HULLS, ALL, |mesh| split_edge(mesh, true));
        }),
        invalid(MSH017, "triangle-without-height-left-out", |f| {
            rewrite(f, PLAIN, ALL, |mesh| split_edge(mesh, true));
            rewrite(f, HULLS, ALL, |mesh| split_edge(mesh, false));
        }),
        changed(MSH015, "flat-box-of-one-side", true, flat, |f| {
            rewrite(f, PLAIN, ALL, |mesh| {
                let all = std::mem::take(&mut mesh.triangles);
                let faces_up = |triangle: &[u32; 3]| {
                    let [a, b, c] = mesh.corners(*triangle);
                    (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
                };
                let kept: Vec<[u32; 3]> = all.into_iter().filter(faces_up).collect();
                let corners = kept.iter().flat_map(|triangle| mesh.corners(*triangle)).collect();
                let count = u32::try_from(kept.len()).expect("few");
                let triangles = (0..count).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
                *mesh = Mesh { vertices: corners, triangles };
            });
        }),
        // A point in its plane is inside of a flat piece, wherever in it.
        changed(MSH022, "flat-piece-of-half-the-size", false, flat, |f| {
            f.set(PIECES, "/method/surface_tolerance", json!(0.0));
            rewrite(f, PIECES, ALL, |mesh| {
                for [x, ..] in &mut mesh.vertices {
                    *x /= 2.0;
                }
            });
        }),
        // By 1 / 20,000 of the hull's diagonal, which is no more than MSH023 lets pass.
        changed(MSH022, "flat-piece-beside-the-plane", true, flat, |f| {
            f.set(PIECES, "/method/surface_tolerance", json!(0.0));
            rewrite(f, PIECES, ALL, |mesh| {
                for [.., z] in &mut mesh.vertices {
                    *z = f64::from(1.8e-5_f32);
                }
            });
        }),
    ]
}

fn hulls_and_pieces() -> Vec<Case> {
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
        invalid(MSH021, "larger-on-one-side", |f| {
            rewrite(f, PIECES, ALL, |mesh| {
                for vertex in &mut mesh.vertices {
                    vertex[0] = f64::from((vertex[0].max(1.1 * vertex[0])) as f32);
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
