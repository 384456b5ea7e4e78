use fearless_simd::Level;

use super::super::shape::ConvexShape;

/// General directions, and directions with equal, zero and opposite coordinates, which are on the borders of cells.
fn directions() -> Vec<[f64; 3]> {
    let mut list: Vec<[f64; 3]> = (0..4000)
        .map(|i| {
            let x = f64::from(i);
            [(1.3 * x).sin(), (2.1 * x).cos(), (0.7 * x).sin()]
        })
        .collect();
    for x in [-1.0, -0.5, -0.0, 0.0, 0.5, 1.0] {
        for y in [-1.0, -0.25, -0.0, 0.0, 0.5, 1.0] {
            list.extend([-1.0, -0.5, -0.0, 0.0, 0.5, 1.0].map(|z| [x, y, z]));
        }
    }
    list.retain(|d| d.iter().any(|x| *x != 0.0));
    list
}

fn most(points: &[[f64; 3]], d: [f64; 3]) -> f64 {
    points.iter().map(|p| p[0] * d[0] + p[1] * d[1] + p[2] * d[2]).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn the_table_finds_the_farthest_vertex() {
    for n in [1, 2, 3, 5, 8, 30, 300, 3000] {
        // On a stretched sphere around the origin, with some groups of close vertices.
        let points: Vec<[f64; 3]> = (0..n)
            .flat_map(|i| {
                let x = f64::from(i);
                let z = (0.77 * x).sin();
                let (r, near) = ((1.0 - z * z).sqrt(), 1e-3 * (5.1 * x).cos());
                let p = [r * (x + near).cos(), 2.0 * r * (x + near).sin(), 0.3 * z];
                [p, p.map(|x| -x)]
            })
            .collect();
        let shape = ConvexShape::of_points(&points).expect("a shape");
        for d in directions() {
            let p = shape.farthest(Level::new(), d.into()).into();
            let (found, most) = (most(&[p], d), most(&points, d));
            assert!((found - most).abs() < 1e-14, "{n} points, direction {d:?}: {found} {most}");
        }
    }
}
