//! Spheres that cover each link: its pieces are cut into cells, each with its smallest enclosing sphere.
//!
//! A link begins as one cell. A plane cuts the cell with the most waste, the volume of its sphere beyond its own, in
//! two, as long as the budget allows. The result is the step whose spheres have the smallest volume of their union. The
//! cells of a convex piece together contain all of it, so the spheres of a link cover all its pieces.

#[doc(hidden)]
pub mod cell;
#[doc(hidden)]
pub mod filled;

use rayon::prelude::*;

use cell::Cell;
use filled::filled;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::vector::{norm, sub};

/// Maximum number of cuts per requested sphere: some cuts do not add a sphere.
const CUTS: usize = 4;

/// Spheres per link by default.
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
        let Some(link) = (0..links.len()).max_by(order) else {
            break;
        };
        if left == 0 || wastes[link] <= 0.0 {
            break;
        }
        let most = links[link].best.len() + left;
        wastes[link] = if links[link].cut(most) { links[link].waste() } else { 0.0 };
    }
}

/// The cells of a link, and the best spheres so far.
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
