//! The smallest rectangle about points of a plane.
//!
//! One of its sides lies along an edge of their convex hull (H. Freeman, R. Shapira, Determining the
//! Minimum-Area Encasing Rectangle for an Arbitrary Closed Curve, Communications of the ACM 18,
//! 1975); all edges are tried in one turn (G. Toussaint, Solving Geometric Problems with the
//! Rotating Calipers, MELECON 1983).

type Point2 = [f64; 2];

/// A rectangle.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    pub area: f64,
    /// The sum of two sides at a corner.
    pub half_perimeter: f64,
    /// The unit direction of a side.
    pub side: Point2,
}

fn cross(u: Point2, v: Point2) -> f64 {
    u[0] * v[1] - u[1] * v[0]
}

fn dot(u: Point2, v: Point2) -> f64 {
    u[0] * v[0] + u[1] * v[1]
}

fn minus(u: Point2, v: Point2) -> Point2 {
    [u[0] - v[0], u[1] - v[1]]
}

/// The smallest rectangle about a convex polygon, counterclockwise, or a closed line that is one but
/// for rounding and for repeated points. `None` if it has no area.
pub fn smallest_rectangle(polygon: &mut Vec<Point2>) -> Option<Rectangle> {
    straighten(polygon);
    let n = polygon.len();
    if n < 3 {
        return None;
    }
    // Edges and corners alike, one round and the first again.
    polygon.push(polygon[0]);
    let edge = |i: usize| minus(polygon[i + 1], polygon[i]);
    // The corner farthest in a direction, found by walking on from where the last edge had it.
    let walk = |from: &mut usize, towards: Point2| {
        for _ in 0..n {
            if dot(edge(*from), towards) <= 0.0 {
                break;
            }
            *from = if *from + 1 == n { 0 } else { *from + 1 };
        }
    };
    let (mut ahead, mut across, mut behind) = (0, 0, 0);
    let mut best = (f64::INFINITY, 0.0, [0.0; 2]);
    for i in 0..n {
        let along = edge(i);
        let normal = [-along[1], along[0]];
        walk(&mut ahead, along);
        if i == 0 {
            across = ahead;
        }
        walk(&mut across, normal);
        if i == 0 {
            behind = across;
        }
        walk(&mut behind, [-along[0], -along[1]]);
        let length = dot(minus(polygon[ahead], polygon[behind]), along);
        let height = dot(minus(polygon[across], polygon[i]), normal);
        // Both hold the length of the edge as a factor.
        let area = length * height / dot(along, along);
        if area < best.0 {
            best = (area, length + height, along);
        }
    }
    let (area, half_perimeter, along) = best;
    let length = dot(along, along).sqrt();
    (length > 0.0).then(|| Rectangle {
        area,
        half_perimeter: half_perimeter / length,
        side: along.map(|x| x / length),
    })
}

/// Removes what turns right or not at all from a closed line that is nearly a convex polygon.
fn straighten(polygon: &mut Vec<Point2>) {
    let by_value = |p: &Point2, q: &Point2| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]));
    let Some((first, _)) = polygon
        .iter()
        .enumerate()
        .min_by(|(_, p), (_, q)| by_value(p, q))
    else {
        return;
    };
    polygon.rotate_left(first);
    let start = polygon[0];
    let mut kept = 1;
    for i in 1..=polygon.len() {
        // The lowest corner stays, and closes the line.
        let p = polygon.get(i).copied().unwrap_or(start);
        while kept >= 2 {
            let (u, v) = (polygon[kept - 2], polygon[kept - 1]);
            if cross(minus(v, u), minus(p, v)) > 0.0 {
                break;
            }
            kept -= 1;
        }
        if i < polygon.len() && p != polygon[kept - 1] {
            polygon[kept] = p;
            kept += 1;
        }
    }
    polygon.truncate(kept);
}

/// The convex hull of points, counterclockwise, in place: Andrew's monotone chain. In doubles, which
/// changes its area by no more than rounding does.
pub fn outline(points: &mut Vec<Point2>) {
    points.sort_unstable_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    let mut polygon: Vec<Point2> = Vec::with_capacity(points.len() + 1);
    for backwards in [false, true] {
        let fixed = polygon.len();
        for k in 0..points.len() {
            let p = points[if backwards { points.len() - 1 - k } else { k }];
            while polygon.len() >= fixed + 2 {
                let (u, v) = (polygon[polygon.len() - 2], polygon[polygon.len() - 1]);
                if cross(minus(v, u), minus(p, v)) > 0.0 {
                    break;
                }
                polygon.pop();
            }
            polygon.push(p);
        }
        polygon.pop();
    }
    *points = polygon;
}
