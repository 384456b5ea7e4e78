//! Spheres that hold each link: its pieces cut into cells, and the smallest sphere about each cell.
//!
//! A link begins as one cell. The cell that wastes most, by the volume of its sphere beyond its own, is cut in two by a
//! plane, as long as spheres are left; of all steps on the way, the one whose spheres fill the least volume together
//! counts. Every convex piece is whole in the cells that it was cut into, so the spheres of a link together hold all of
//! its pieces.

mod cell;
mod filled;

use rayon::prelude::*;

use super::SphereBudget;
use cell::Cell;
use filled::filled;
use urdd_geometry::bounding_sphere::BoundingSphere;

/// Most cuts for each sphere that is asked for: some cuts alone give no other sphere.
const CUTS: usize = 4;

/// Spheres of a link where no number is asked for.
const AUTO: usize = 8;

/// The spheres of each link, in link order, from the vertices of its pieces; none for one without pieces.
pub(super) fn cover(
    links: &[Vec<Vec<[f64; 3]>>],
    budget: SphereBudget,
) -> Vec<Vec<BoundingSphere>> {
    let cells = links.iter().map(|pieces| match pieces.is_empty() {
        true => Vec::new(),
        false => vec![Cell::new(pieces)],
    });
    let mut links: Vec<Cover> = cells.map(Cover::new).collect();
    let per_link = match budget {
        SphereBudget::Auto => Some(AUTO),
        SphereBudget::PerLink(count) => Some(count),
        SphereBudget::Total(count) => {
            share(&mut links, count);
            None
        }
    };
    if let Some(count) = per_link {
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

/// Cuts cells of all links until their spheres are so many: each time the link whose worst cell wastes most.
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
        wastes[link] = match links[link].cut(most) {
            true => links[link].waste(),
            false => 0.0,
        };
    }
}

/// The cells of a link, and the best spheres so far.
struct Cover {
    cells: Vec<Cell>,
    /// Those that fill the least volume together.
    best: Vec<BoundingSphere>,
    volume: f64,
}

impl Cover {
    fn new(cells: Vec<Cell>) -> Self {
        let best = held(&cells);
        Cover {
            volume: filled(&best),
            best,
            cells,
        }
    }

    /// The volume that the worst sphere has beyond its cell, m³.
    fn waste(&self) -> f64 {
        self.cells.iter().map(Cell::waste).fold(0.0, f64::max)
    }

    /// Cuts the worst cell. Whether there is more to try with at most so many spheres.
    fn cut(&mut self, most: usize) -> bool {
        if !cut(&mut self.cells) {
            return false;
        }
        let spheres = held(&self.cells);
        if spheres.len() > most {
            return false;
        }
        let volume = filled(&spheres);
        // Some cuts make things worse before the next makes them better.
        if volume < self.volume {
            (self.best, self.volume) = (spheres, volume);
        }
        true
    }
}

/// The spheres of cells, without those that lie in another.
fn held(cells: &[Cell]) -> Vec<BoundingSphere> {
    let mut spheres: Vec<BoundingSphere> = Vec::new();
    let inside = |a: &BoundingSphere, b: &BoundingSphere| {
        let apart: f64 = (0..3)
            .map(|axis| (a.centre[axis] - b.centre[axis]).powi(2))
            .sum();
        apart.sqrt() + a.radius <= b.radius
    };
    for cell in cells {
        let sphere = cell.sphere();
        if !spheres.iter().any(|other| inside(&sphere, other)) {
            spheres.retain(|other| !inside(other, &sphere));
            spheres.push(sphere);
        }
    }
    spheres
}

/// Cuts the cell that wastes most and can be cut. Whether there was one.
fn cut(cells: &mut Vec<Cell>) -> bool {
    let mut order: Vec<usize> = (0..cells.len()).collect();
    order.sort_by(|a, b| cells[*b].waste().total_cmp(&cells[*a].waste()));
    for idx in order {
        if let Some([one, other]) = cells[idx].cut() {
            cells[idx] = one;
            cells.push(other);
            return true;
        }
    }
    false
}
