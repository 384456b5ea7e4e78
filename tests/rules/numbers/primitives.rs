//! Numbers about the tessellation of cylinders: capsules and spheres are judged by the same.

use std::f64::consts::TAU;

use serde_json::json;
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_validate::code::Code::*;

use super::geometry::geometry_alone;
use super::{Number, most, number, sides};
use crate::mesh_files::{ALL, lone_box, put, rewrite};
use crate::meshes::{HULLS, PIECES, PLAIN, boxy, robot_of};
use crate::{Case, changed};
use testkit::fixture::Fixture;
use testkit::robot::link;

const RADIUS: f64 = 0.05;
const LENGTH: f64 = 0.3;

/// A prism in a cylinder, with corners at these angles.
fn prism(angles: &[f64]) -> Mesh {
    let corner = |angle: f64, z: f64| {
        [RADIUS * angle.cos(), RADIUS * angle.sin(), z].map(|x| f64::from(x as f32))
    };
    let ends = [-LENGTH / 2.0, LENGTH / 2.0];
    let corners = angles.iter().flat_map(|angle| ends.map(|z| corner(*angle, z)));
    let corners: Vec<[f64; 3]> = corners.collect();
    ConvexHull::new(&corners).expect("a prism").into_mesh()
}

fn even(count: usize) -> Vec<f64> {
    (0..count).map(|i| TAU * i as f64 / count as f64).collect()
}

/// A link that shows a cylinder, as this prism, and a link without a shape. Class Geometry.
fn cylinder(angles: &[f64]) -> Fixture {
    let mut f = Fixture::full(&robot_of(vec![link("a"), boxy("b")]));
    geometry_alone(&mut f);
    f.urdf_replace(
        "<box size=\"0.1 0.2 0.3\"/>",
        &format!("<cylinder radius=\"{RADIUS}\" length=\"{LENGTH}\"/>"),
    );
    f.set(
        "urdf_module",
        "/links/1/visual/0/geometry",
        json!({"Cylinder": {"radius": RADIUS, "length": LENGTH}}),
    );
    let mesh = prism(angles);
    for module in [PLAIN, HULLS, PIECES] {
        for format in ALL {
            put(&mut f, module, 1, format, &mesh);
        }
    }
    f
}

/// The middle of one side is inside by this part of the radius, those of the others by less.
fn one_wide_side(f: &mut Fixture, sag: f64) {
    let half = (1.0 - sag).acos();
    let rest = TAU - 2.0 * half;
    let others = (0..=31).map(|i| half + rest * f64::from(i) / 31.0);
    *f = cylinder(&others.collect::<Vec<f64>>());
}

fn change_plain(f: &mut Fixture, angles: &[f64], change: impl Fn(&mut Mesh)) {
    *f = cylinder(angles);
    let mut mesh = prism(angles);
    change(&mut mesh);
    for format in ALL {
        put(f, PLAIN, 1, format, &mesh);
    }
}

/// Sides are left out while more than this part of the true area is left.
fn part_of_area(f: &mut Fixture, part: f64) {
    let whole = TAU * RADIUS * (RADIUS + LENGTH);
    change_plain(f, &even(128), |mesh| {
        let area = |mesh: &Mesh, triangle: &[u32; 3]| {
            let [a, b, c] = mesh.corners(*triangle);
            let [u, v] = [b, c].map(|p| [0, 1, 2].map(|i| p[i] - a[i]));
            let cross = [0, 1, 2]
                .map(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
            cross.iter().map(|x| x * x).sum::<f64>().sqrt() / 2.0
        };
        let mut left: f64 = mesh.triangles.iter().map(|t| area(mesh, t)).sum();
        let old = std::mem::take(&mut mesh.triangles);
        for triangle in old {
            let heights = mesh.corners(triangle).map(|corner| corner[2]);
            let own = area(mesh, &triangle);
            let side = heights != [heights[0]; 3];
            if side && left - own >= part * whole {
                left -= own;
            } else {
                mesh.triangles.push(triangle);
            }
        }
    });
}

/// The top of the lone box, of 0.1 by 0.2 by 0.3 m, ends where this part of the whole area is left.
fn part_of_box(f: &mut Fixture, part: f64) {
    geometry_alone(f);
    let [x, y, z] = [0.1, 0.2, 0.3];
    let gap = (1.0 - part) * 2.0 * (x * y + y * z + z * x) / x;
    rewrite(f, PLAIN, ALL, |mesh| {
        let end = f64::from((y / 2.0 - gap) as f32);
        let mut moved = [0; 8];
        for (corner, [px, py, pz]) in mesh.vertices.clone().into_iter().enumerate() {
            moved[corner] = corner as u32;
            if py > 0.0 && pz > 0.0 {
                moved[corner] = mesh.vertices.len() as u32;
                mesh.vertices.push([px, end, pz]);
            }
        }
        let heights: Vec<f64> = mesh.vertices.iter().map(|vertex| vertex[2]).collect();
        for triangle in &mut mesh.triangles {
            if triangle.iter().all(|corner| heights[*corner as usize] > 0.0) {
                *triangle = triangle.map(|corner| moved[corner as usize]);
            }
        }
    });
}

fn thirty_two() -> Fixture {
    cylinder(&even(32))
}

pub fn numbers() -> Vec<Number> {
    vec![
        number(
            "sag",
            "7.8",
            "by at most 2 % of the radius",
            ("2 %", 0.02),
            vec![most(MSH015, thirty_two, one_wide_side, 0.02)],
        ),
        number(
            "area",
            "7.8",
            "at least 95 % of its area",
            ("95 %", 0.95),
            vec![
                sides(MSH015, thirty_two, part_of_area, 0.95, [0.9455, 0.9505]),
                sides(MSH015, lone_box, part_of_box, 0.95, [0.9455, 0.9505]),
            ],
        ),
    ]
}

/// A link that shows a cylinder of 1 mm, so far along x, as this prism.
fn small_cylinder(x: f64, mesh: &Mesh) -> Fixture {
    let mut f = thirty_two();
    let size = json!({"Cylinder": {"radius": SMALL, "length": 2.0 * SMALL}});
    f.set("urdf_module", "/links/1/visual/0/geometry", size);
    f.urdf_replace(
        &format!("<cylinder radius=\"{RADIUS}\" length=\"{LENGTH}\"/>"),
        &format!("<cylinder radius=\"{SMALL}\" length=\"{}\"/>", 2.0 * SMALL),
    );
    if x != 0.0 {
        let origin = json!({"xyz": [x, 0.0, 0.0], "rpy": null, "quat_xyzw": null});
        f.set("urdf_module", "/links/1/visual/0/origin", origin);
        let placed = format!("<origin xyz=\"{x} 0 0\"/>\n<geometry>\n<cylinder");
        f.urdf_replace("<geometry>\n<cylinder", &placed);
    }
    let hull = ConvexHull::new(&mesh.vertices).expect("a prism").into_mesh();
    for format in ALL {
        put(&mut f, PLAIN, 1, format, mesh);
        put(&mut f, HULLS, 1, format, &hull);
        put(&mut f, PIECES, 1, format, &hull);
    }
    f
}

const SMALL: f64 = 1e-3;

/// A prism around the axis at `x`, from `low` to `high`.
fn small_prism(sides: usize, x: f64, [low, high]: [f64; 2]) -> Mesh {
    let corner = |angle: &f64, z: f64| {
        [x + SMALL * angle.cos(), SMALL * angle.sin(), z].map(|x| f64::from(x as f32))
    };
    let angles = even(sides);
    let corners: Vec<[f64; 3]> =
        angles.iter().flat_map(|angle| [low, high].map(|z| corner(angle, z))).collect();
    ConvexHull::new(&corners).expect("a prism").into_mesh()
}

/// Cases beside the numbers: a cylinder that faces inward, and what the tolerance of corners adds.
pub fn cases() -> Vec<Case> {
    vec![
        changed(MSH015, "cylinder-that-faces-inward", true, thirty_two, |f| {
            change_plain(f, &even(32), Mesh::flip);
        }),
        changed(MSH015, "cylinder-of-thirty-two-sides", false, thirty_two, |_| {}),
        // 10 m away, corners are known to 9.5e-6 m: sides that are inside by 2.5 % of the radius, and an end by as much.
        changed(
            MSH015,
            "small-cylinder-far-away",
            false,
            || small_cylinder(10.0, &small_prism(14, 10.0, [-SMALL, SMALL - 2.5e-5])),
            |_| {},
        ),
        // Here to 1e-7 m.
        changed(MSH015, "small-cylinder-with-a-corner-off", true, thirty_two, |f| {
            let mut mesh = small_prism(32, 0.0, [-SMALL, SMALL]);
            let far = mesh.vertices.iter_mut().max_by(|a, b| a[0].total_cmp(&b[0]));
            far.expect("a corner")[0] += 1.5e-7;
            *f = small_cylinder(0.0, &mesh);
        }),
    ]
}
