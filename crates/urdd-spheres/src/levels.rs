//! Levels of spheres of a link that cover all of its pieces, each inside the one before.
//!
//! The pieces are cut into cells, as [`cover`](crate::cover) does. A cell's smallest sphere is a sphere of the finest level.
//! Cells that came from one cell of a coarser level have one sphere there: the smallest around theirs, so that it holds
//! them all.

use super::cover::cell::Cell;
use super::cover::cut;
use super::frame::{add, norm, scaled, sub};
use super::model::Sphere;
use urdd_geometry::Mesh;

/// The most spheres of a link in the levels that cover, from coarse to fine.
pub const COUNTS: [usize; 3] = [1, 4, 16];

/// Steps of the search for the smallest sphere around spheres.
const STEPS: u32 = 400;

/// Radii are larger by this part, so that rounding leaves no vertex outside and no sphere out of its outer one.
const LARGER: f64 = 1.0 + 1e-10;

/// Spheres of one level, each with the index of its outer sphere in the level before; 0 in the first.
pub type Level = Vec<(Sphere, usize)>;

/// The levels of a link from coarse to fine, from its pieces; each is empty without a piece. The first holds `more` too.
pub fn covering(pieces: &[Mesh], more: &[Sphere]) -> [Level; COUNTS.len()] {
    let mut levels: [Level; COUNTS.len()] = Default::default();
    if pieces.is_empty() {
        return levels;
    }
    let vertices: Vec<_> = pieces.iter().map(|mesh| mesh.vertices.clone()).collect();
    let mut cells = vec![Cell::new(&vertices)];
    // The cell that each was cut from, and how many there are in each level.
    let mut cut_from = vec![0];
    let counts = COUNTS.map(|count| {
        while cells.len() < count {
            let Some(cell) = cut(&mut cells) else { break };
            cut_from.push(cell);
        }
        cells.len()
    });
    let mut inner: Vec<Sphere> = cells.iter().map(|cell| larger(cell.sphere)).collect();
    for level in (0..COUNTS.len()).rev() {
        levels[level] = inner.iter().map(|sphere| (*sphere, 0)).collect();
        let Some(count) = level.checked_sub(1).map(|outer| counts[outer]) else { break };
        let mut held = vec![Vec::new(); count];
        for (number, (sphere, outer)) in levels[level].iter_mut().enumerate() {
            *outer = number;
            while *outer >= count {
                *outer = cut_from[*outer];
            }
            held[*outer].push(*sphere);
        }
        if level == 1 {
            held.iter_mut().for_each(|held| held.extend(more));
        }
        inner = held.iter().map(|held| around(held)).collect();
    }
    levels
}

fn larger(sphere: Sphere) -> Sphere {
    Sphere { centre: sphere.centre, radius: (sphere.radius * LARGER).max(f64::MIN_POSITIVE) }
}

/// A sphere around spheres, close to the smallest: the centre moves toward the farthest one by smaller and smaller steps
/// (Bădoiu and Clarkson, Smaller Core-Sets for Balls, 2003).
pub fn around(spheres: &[Sphere]) -> Sphere {
    let Some(first) = spheres.first() else {
        return Sphere { centre: [0.0; 3], radius: f64::MIN_POSITIVE };
    };
    let reach = |centre, sphere: &Sphere| norm(sub(sphere.centre, centre)) + sphere.radius;
    let farthest = |centre| {
        let each = spheres.iter().map(|sphere| (reach(centre, sphere), sphere));
        each.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, first))
    };
    let mut centre = first.centre;
    let mut best = (farthest(centre).0, centre);
    for step in 1..=STEPS {
        let (_, sphere) = farthest(centre);
        let between = sub(sphere.centre, centre);
        let length = norm(between);
        // The farthest point of that sphere.
        let far = if length > 0.0 {
            add(between, scaled(between, sphere.radius / length))
        } else {
            [sphere.radius, 0.0, 0.0]
        };
        centre = add(centre, scaled(far, 1.0 / f64::from(step + 1)));
        let radius = farthest(centre).0;
        if radius < best.0 {
            best = (radius, centre);
        }
    }
    larger(Sphere { centre: best.1, radius: best.0 })
}
