//! Spheres about links: each link's pieces cut into cells, and the smallest sphere about each cell.
//!
//! A link begins as one cell. The cell that wastes most, by the volume of its sphere beyond its own, is cut in two by a
//! plane, as long as spheres are left. Every convex part lies whole in the cells that it was cut into, so the spheres of
//! a link together hold all of its pieces, and with them the link.

mod cell;
pub(super) mod curobo;
pub(super) mod foam;

use rayon::prelude::*;

use super::error::ExportError;
use super::subject::Subject;
use crate::geometry::bounding_sphere::BoundingSphere;
use crate::robot::{ShapeKind, Solid};
use cell::Cell;

/// Most cuts for each sphere that is asked for: some cuts alone give no other sphere.
const CUTS: usize = 4;

/// How many spheres stand for links.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SphereBudget {
    /// At most so many for each link.
    PerLink(usize),
    /// At most so many for all links together, but at least one for each.
    Total(usize),
}

impl Default for SphereBudget {
    fn default() -> Self {
        SphereBudget::PerLink(8)
    }
}

/// The spheres of each link, in link order; none for one without pieces.
fn spheres(subject: &Subject) -> Result<Vec<Vec<BoundingSphere>>, ExportError> {
    let mut points: Vec<Vec<Vec<[f64; 3]>>> = subject.links.iter().map(|_| Vec::new()).collect();
    for shape in subject.robot.shapes(ShapeKind::Pieces)? {
        if let (Solid::Mesh(mesh), Some(of_link)) = (shape.solid, points.get_mut(shape.link)) {
            of_link.push(mesh.vertices);
        }
    }
    if points.iter().all(Vec::is_empty) {
        return Err(ExportError::NoShapes(ShapeKind::Pieces));
    }
    let cells = points.into_iter().map(|pieces| match pieces.is_empty() {
        true => Vec::new(),
        false => vec![Cell::new(&pieces)],
    });
    let mut cells: Vec<Vec<Cell>> = cells.collect();
    match subject.options.spheres {
        SphereBudget::PerLink(count) => {
            cells
                .par_iter_mut()
                .for_each(|cells| grow(cells, count, CUTS * count));
        }
        SphereBudget::Total(count) => share(&mut cells, count),
    }
    Ok(cells.iter().map(|cells| held(cells)).collect())
}

/// Cuts cells of all links until their spheres are so many: each time the link whose worst cell wastes most.
fn share(cells: &mut [Vec<Cell>], count: usize) {
    let worst = |cells: &[Cell]| cells.iter().map(Cell::waste).fold(0.0, f64::max);
    let mut wastes: Vec<f64> = cells.iter().map(|cells| worst(cells)).collect();
    let mut counts: Vec<usize> = cells.iter().map(|cells| held(cells).len()).collect();
    for _ in 0..CUTS * count {
        let first =
            (0..cells.len()).max_by(|a, b| wastes[*a].total_cmp(&wastes[*b]).then(b.cmp(a)));
        let Some(link) = first else {
            break;
        };
        if counts.iter().sum::<usize>() >= count || wastes[link] <= 0.0 {
            break;
        }
        wastes[link] = match cut(&mut cells[link]) {
            true => worst(&cells[link]),
            // Nothing of it can be cut.
            false => 0.0,
        };
        counts[link] = held(&cells[link]).len();
    }
}

/// Cuts cells until their spheres are so many.
fn grow(cells: &mut Vec<Cell>, count: usize, cuts: usize) {
    for _ in 0..cuts {
        if held(cells).len() >= count || !cut(cells) {
            break;
        }
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
