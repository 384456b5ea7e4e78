//! Pairs of convex shapes that are swept by spheres: shapes of robots, obstacles, attached objects.

use arrayvec::ArrayVec;

use urdd_geometry::convex::across::{self, AT_ONCE, PlacedPair};
use urdd_geometry::convex::{Level, Penetration, Witness, penetration};
use urdd_geometry::vector::{norm, sub};

/// Two placed shapes.
#[derive(Clone, Copy)]
pub struct SweptPair<'a> {
    pub cores: PlacedPair<'a>,
    /// The shapes are all points that are at most this far from their cores, m.
    pub radii: [f64; 2],
}

/// The distances of some pairs, at most [`AT_ONCE`], m, and their closest points in the frame of the first shape.
pub(crate) fn witnesses(
    level: Level,
    pairs: &[SweptPair],
) -> ArrayVec<(f64, [[f64; 3]; 2]), AT_ONCE> {
    let cores: ArrayVec<PlacedPair, AT_ONCE> = pairs.iter().map(|pair| pair.cores).collect();
    let found = across::some_witnesses(level, &cores);
    let each = found.iter().zip(pairs);
    each.map(|(witness, pair)| rounded(witness, pair.radii)).collect()
}

/// How far two shapes overlap, in the frame of the first; `None` if they are apart.
pub(crate) fn penetration_of(level: Level, pair: &SweptPair) -> Option<Penetration> {
    let [a, b] = pair.radii;
    let (depth, direction, [p, q]) = match penetration(&pair.cores) {
        Some(found) => (found.depth + a + b, found.direction, found.points),
        None if a + b == 0.0 => return None,
        None => {
            // The cores are apart.
            let [Witness { points, .. }] = across::witnesses(level, &[pair.cores])[..] else {
                return None;
            };
            let between = sub(points[1], points[0]);
            let length = norm(between);
            if !(length > 0.0 && length <= a + b) {
                return None;
            }
            (a + b - length, between.map(|x| x / length), points)
        }
    };
    let along = |point: [f64; 3], by: f64| [0, 1, 2].map(|k| point[k] + by * direction[k]);
    Some(Penetration { depth, direction, points: [along(p, a), along(q, -b)] })
}

/// The distance and closest points of two shapes enlarged by radii.
fn rounded(witness: &Witness, [a, b]: [f64; 2]) -> (f64, [[f64; 3]; 2]) {
    let [p, q] = witness.points;
    let between = sub(q, p);
    let length = norm(between);
    let distance = (witness.distance - (a + b)).max(0.0);
    if length == 0.0 {
        return (distance, [p, q]);
    }
    // Positions along the line from p to q. If the bodies overlap, the middle of their common segment.
    let along = match distance > 0.0 {
        true => [a, length - b],
        false => [0.5 * ((length - b).max(0.0) + a.min(length)); 2],
    };
    let points = along.map(|t| [0, 1, 2].map(|k| p[k] + between[k] * (t / length)));
    (distance, points)
}

/// Pairs that may touch, which wait for others: as many as possible are computed at once.
pub(crate) struct Waiting<'a> {
    level: Level,
    /// Without radii: whether they touch is known sooner than their distance.
    flat: ArrayVec<PlacedPair<'a>, AT_ONCE>,
    swept: ArrayVec<PlacedPair<'a>, AT_ONCE>,
    /// The sums of the radii of `swept`.
    radii: ArrayVec<f64, AT_ONCE>,
}

impl<'a> Waiting<'a> {
    pub fn new(level: Level) -> Self {
        Waiting { level, flat: ArrayVec::new(), swept: ArrayVec::new(), radii: ArrayVec::new() }
    }

    /// Adds a pair, whose radii have this sum. True if one of those that waited touches.
    pub fn touches_with(&mut self, cores: PlacedPair<'a>, radii: f64) -> bool {
        let is_full = if radii == 0.0 {
            self.flat.push(cores);
            self.flat.is_full()
        } else {
            self.swept.push(cores);
            self.radii.push(radii);
            self.swept.is_full()
        };
        is_full && self.any_touches()
    }

    /// Whether one of those that wait touches. None waits any longer.
    pub fn any_touches(&mut self) -> bool {
        let mut values = [f64::INFINITY; AT_ONCE];
        across::distances(self.level, &self.swept, &mut values[..self.swept.len()]);
        let mut swept = values.iter().zip(&self.radii);
        let touches = swept.any(|(value, radii)| value <= radii)
            || across::any_touches(self.level, &self.flat);
        self.swept.clear();
        self.radii.clear();
        self.flat.clear();
        touches
    }
}
