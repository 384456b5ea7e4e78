//! Spheres that cover each link: its pieces are cut into cells, each with its smallest enclosing sphere.
//!
//! A link begins as one cell. A plane cuts the cell with the most waste, the volume of its sphere beyond its own, in
//! two, as long as the budget allows. The result is the step whose spheres have the smallest volume of their union. The
//! cells of a convex piece together contain all of it, so the spheres of a link cover all its pieces.

use std::sync::OnceLock;

use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::vector::{dot, norm, sub};

/// Maximum number of cuts per requested sphere: some cuts do not add a sphere.
const CUTS: usize = 4;

const AUTO: usize = 8;

/// At most so many spheres of each link, or of all, in link order, from the vertices of its pieces; none for a link without
/// pieces.
pub fn cover(
    links: &[Vec<Vec<[f64; 3]>>],
    per_link: Option<usize>,
    total: Option<usize>,
) -> Vec<Vec<BoundingSphere>> {
    let cells = links
        .iter()
        .map(|pieces| if pieces.is_empty() { Vec::new() } else { vec![Cell::new(pieces)] });
    let mut links: Vec<Cover> = cells.map(Cover::new).collect();
    if let Some(count) = total {
        share(&mut links, count);
    } else {
        let count = per_link.unwrap_or(AUTO);
        links.par_iter_mut().for_each(|link| {
            for _ in 0..CUTS.saturating_mul(count) {
                if !link.cut(count) {
                    break;
                }
            }
        });
    }
    links.into_iter().map(|link| link.best).collect()
}

/// Cuts cells of all links until there are `count` spheres: each time in the link whose worst cell has the most waste.
fn share(links: &mut [Cover], count: usize) {
    let mut wastes: Vec<f64> = links.iter().map(Cover::waste).collect();
    for _ in 0..CUTS * count {
        let left = count.saturating_sub(links.iter().map(|link| link.best.len()).sum());
        let order = |a: &usize, b: &usize| wastes[*a].total_cmp(&wastes[*b]).then(b.cmp(a));
        let Some(link) = (0..links.len()).max_by(order) else { break };
        if left == 0 || wastes[link] <= 0.0 {
            break;
        }
        let most = links[link].best.len() + left;
        wastes[link] = if links[link].cut(most) { links[link].waste() } else { 0.0 };
    }
}

struct Cover {
    cells: Vec<Cell>,
    /// The spheres whose union has the smallest volume.
    best: Vec<BoundingSphere>,
    volume: f64,
}

impl Cover {
    fn new(cells: Vec<Cell>) -> Self {
        let best = held(&cells);
        Cover { volume: filled(&best), best, cells }
    }

    /// The waste of the worst cell, m³.
    fn waste(&self) -> f64 {
        self.cells.iter().map(Cell::waste).fold(0.0, f64::max)
    }

    /// Cuts the worst cell. Returns whether to continue, with at most `most` spheres.
    fn cut(&mut self, most: usize) -> bool {
        if cut(&mut self.cells).is_none() {
            return false;
        }
        let spheres = held(&self.cells);
        if spheres.len() > most {
            return false;
        }
        let volume = filled(&spheres);
        // Some cuts increase the volume before the next one reduces it.
        if volume < self.volume {
            (self.best, self.volume) = (spheres, volume);
        }
        true
    }
}

/// The spheres of cells, without those that are inside another.
fn held(cells: &[Cell]) -> Vec<BoundingSphere> {
    let mut spheres: Vec<BoundingSphere> = Vec::new();
    let inside = |a: &BoundingSphere, b: &BoundingSphere| {
        norm(sub(a.centre, b.centre)) + a.radius <= b.radius
    };
    for cell in cells {
        let sphere = cell.sphere;
        if !spheres.iter().any(|other| inside(&sphere, other)) {
            spheres.retain(|other| !inside(other, &sphere));
            spheres.push(sphere);
        }
    }
    spheres
}

/// Cuts the cell with the most waste that can be cut. One half takes its place, the other is the last. Returns its index;
/// `None` if none can be cut.
pub fn cut(cells: &mut Vec<Cell>) -> Option<usize> {
    let mut order: Vec<usize> = (0..cells.len()).collect();
    order.sort_by(|a, b| cells[*b].waste().total_cmp(&cells[*a].waste()));
    for idx in order {
        if let Some([one, other]) = cells[idx].cut() {
            cells[idx] = one;
            cells.push(other);
            return Some(idx);
        }
    }
    None
}

/// Sample points per sphere. For a link's spheres together, the estimate is accurate to a few percent.
const POINTS: usize = 1000;

/// Evenly distributed points in the unit ball, the same on every machine.
fn ball() -> &'static [[f64; 3]] {
    static BALL: OnceLock<Vec<[f64; 3]>> = OnceLock::new();
    BALL.get_or_init(|| {
        // The additive sequence with steps from the root of x^4 = x + 1 fills a cube evenly.
        let root = 1.220_744_084_605_759_5_f64;
        let steps = [1.0 / root, 1.0 / (root * root), 1.0 / (root * root * root)];
        let point = |n: u32| steps.map(|step| (2.0 * (0.5 + step * f64::from(n))) % 2.0 - 1.0);
        let inside = |p: &[f64; 3]| dot(*p, *p) <= 1.0;
        (0..).map(point).filter(inside).take(POINTS).collect()
    })
}

/// Estimates the volume of the union of spheres, m³: counts the points of each sphere that are in no earlier sphere.
pub fn filled(spheres: &[BoundingSphere]) -> f64 {
    let own = spheres.iter().enumerate().map(|(idx, sphere)| {
        let near: Vec<&BoundingSphere> = (spheres[..idx].iter())
            .filter(|other| {
                let reach = other.radius + sphere.radius;
                apart(&other.centre, &sphere.centre) < reach * reach
            })
            .collect();
        let is_new = |point: &&[f64; 3]| {
            let at = [0, 1, 2].map(|k| sphere.centre[k] + sphere.radius * point[k]);
            near.iter().all(|other| apart(&other.centre, &at) > other.radius * other.radius)
        };
        let new = ball().iter().filter(is_new).count();
        volume(sphere) * new as f64 / POINTS as f64
    });
    own.sum()
}

/// The square of a distance, m².
fn apart(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let between = sub(*a, *b);
    dot(between, between)
}

#[derive(Debug, Clone)]
struct Chunk {
    points: Vec<Vector3<f64>>,
    /// Pairs of `points`; empty if the points are collinear, so that nothing can be cut.
    edges: Vec<[usize; 2]>,
    volume: f64,
}

/// A cell of a link.
#[derive(Debug, Clone)]
pub struct Cell {
    chunks: Vec<Chunk>,
    /// Its smallest enclosing sphere.
    pub sphere: BoundingSphere,
    volume: f64,
}

/// Positions of cuts along a direction, as fractions of the extent.
const PLACES: [f64; 5] = [0.3, 0.4, 0.5, 0.6, 0.7];

impl Chunk {
    fn new(points: Vec<Vector3<f64>>) -> Self {
        let list: Vec<[f64; 3]> = points.iter().map(|p| [p.x, p.y, p.z]).collect();
        let Ok(hull) = ConvexHull::new(&list) else {
            return Chunk { points, edges: Vec::new(), volume: 0.0 };
        };
        let mesh = hull.into_mesh();
        let mut edges: Vec<[usize; 2]> = Vec::new();
        for [a, b, c] in &mesh.triangles {
            for (a, b) in [(a, b), (b, c), (c, a)] {
                edges.push([*a.min(b) as usize, *a.max(b) as usize]);
            }
        }
        edges.sort_unstable();
        edges.dedup();
        let volume = mesh.signed_volume().max(0.0);
        let points = mesh.vertices.into_iter().map(Vector3::from).collect();
        Chunk { points, edges, volume }
    }

    /// The parts below and above a plane; both include the points on it.
    fn cut(&self, normal: &Vector3<f64>, offset: f64) -> [Option<Chunk>; 2] {
        let mut sides = [Vec::new(), Vec::new()];
        self.sides(normal, offset, &mut sides);
        sides.map(|points| match points {
            points if points.is_empty() => None,
            points if points == self.points => Some(self.clone()),
            points => Some(Chunk::new(points)),
        })
    }

    /// Adds the points below and above a plane to their sides, and the points where edges cross it to both.
    fn sides(&self, normal: &Vector3<f64>, offset: f64, sides: &mut [Vec<Vector3<f64>>; 2]) {
        let heights: Vec<f64> = self.points.iter().map(|p| normal.dot(p) - offset).collect();
        let below = heights.iter().any(|height| *height < 0.0);
        let above = heights.iter().any(|height| *height > 0.0);
        if self.edges.is_empty() && below && above {
            // Collinear, without an edge to cut: whole on both sides, so that no point is lost.
            sides.iter_mut().for_each(|side| side.extend(&self.points));
            return;
        }
        for (point, height) in self.points.iter().zip(&heights) {
            if *height <= 0.0 && (below || !above) {
                sides[0].push(*point);
            }
            if *height >= 0.0 && above {
                sides[1].push(*point);
            }
        }
        for &[a, b] in &self.edges {
            if heights[a] * heights[b] < 0.0 {
                let part = heights[a] / (heights[a] - heights[b]);
                let crossing = self.points[a] + (self.points[b] - self.points[a]) * part;
                sides[0].push(crossing);
                sides[1].push(crossing);
            }
        }
    }
}

impl Cell {
    /// A cell of all pieces of a link, each given by its vertices.
    pub fn new(pieces: &[Vec<[f64; 3]>]) -> Self {
        let chunk = |piece: &Vec<[f64; 3]>| Chunk::new(piece.iter().map(|p| (*p).into()).collect());
        Cell::of(pieces.iter().map(chunk).collect())
    }

    fn of(chunks: Vec<Chunk>) -> Self {
        let points: Vec<[f64; 3]> =
            chunks.iter().flat_map(|chunk| chunk.points.iter().map(|p| [p.x, p.y, p.z])).collect();
        Cell {
            sphere: BoundingSphere::of_points(&points),
            volume: chunks.iter().map(|chunk| chunk.volume).sum(),
            chunks,
        }
    }

    /// The volume of the sphere beyond the cell's own, m³. Overlaps of pieces count twice in the cell's volume.
    pub fn waste(&self) -> f64 {
        (volume(&self.sphere) - self.volume).max(0.0)
    }

    /// Cuts the cell in two, with the smallest total volume of spheres over all cuts. That can exceed the volume
    /// before: for a cube, eight spheres are better than one, but two are not; a disc needs four.
    pub fn cut(&self) -> Option<[Cell; 2]> {
        let directions = self.directions();
        let mut best: Option<(f64, Vector3<f64>, f64)> = None;
        for direction in directions {
            let heights = self.chunks.iter().flat_map(|chunk| &chunk.points);
            let heights = heights.map(|point| direction.dot(point));
            let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), height| {
                (low.min(height), high.max(height))
            });
            for place in PLACES {
                let offset = low + place * (high - low);
                let mut sides = [Vec::new(), Vec::new()];
                for chunk in &self.chunks {
                    chunk.sides(&direction, offset, &mut sides);
                }
                if sides.iter().any(Vec::is_empty) {
                    continue;
                }
                // Computes hulls only for the best cut.
                let about = sides.map(|points| {
                    let points: Vec<[f64; 3]> = points.into_iter().map(Into::into).collect();
                    volume(&BoundingSphere::of_points(&points))
                });
                let total: f64 = about.iter().sum();
                if best.as_ref().is_none_or(|(least, ..)| total < *least) {
                    best = Some((total, direction, offset));
                }
            }
        }
        let (_, direction, offset) = best?;
        self.cut_at(&direction, offset)
    }

    fn cut_at(&self, normal: &Vector3<f64>, offset: f64) -> Option<[Cell; 2]> {
        let (mut below, mut above) = (Vec::new(), Vec::new());
        for chunk in &self.chunks {
            let [one, other] = chunk.cut(normal, offset);
            below.extend(one);
            above.extend(other);
        }
        let is_cut = !below.is_empty() && !above.is_empty();
        is_cut.then(|| [Cell::of(below), Cell::of(above)])
    }

    /// The principal axes of the points, and the axes of the link.
    fn directions(&self) -> Vec<Vector3<f64>> {
        let points: Vec<&Vector3<f64>> =
            self.chunks.iter().flat_map(|chunk| &chunk.points).collect();
        let mean = points.iter().copied().sum::<Vector3<f64>>() / points.len().max(1) as f64;
        let spread = points.iter().fold(Matrix3::zeros(), |sum, point| {
            let from = **point - mean;
            sum + from * from.transpose()
        });
        let own = spread.symmetric_eigen().eigenvectors;
        let mut directions: Vec<Vector3<f64>> =
            own.column_iter().map(|column| column.into_owned()).collect();
        directions.extend([Vector3::x(), Vector3::y(), Vector3::z()]);
        directions.retain(|direction| direction.iter().all(|x| x.is_finite()));
        directions
    }
}

/// The volume of a sphere, m³.
pub fn volume(sphere: &BoundingSphere) -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * sphere.radius.powi(3)
}
