//! Results that follow from files alone. A rule may run up to four times on a URDD, by both descriptions of its robot.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Mutex, PoisonError};

use super::solids::polytope::{Dents, NotConvex};
use urdd_findings::code::Code;

/// Results by key, each computed once.
pub struct Memo<K, V>(Mutex<HashMap<K, V>>);

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Memo(Mutex::default())
    }
}

impl<K: Eq + Hash, V: Copy> Memo<K, V> {
    /// The result of a key, computed if it is not known.
    pub fn get(&self, key: K, compute: impl FnOnce() -> V) -> V {
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // Unlocked before it is computed.
        let found = known().get(&key).copied();
        found.unwrap_or_else(|| {
            let value = compute();
            known().insert(key, value);
            value
        })
    }
}

/// The place that is farthest from where it should be.
#[derive(Clone, Copy)]
pub struct Farthest {
    /// Coordinates in the frame of the link, m.
    pub place: [f64; 3],
    /// Its distance, m.
    pub distance: f64,
    /// The distance up to which it is not reported, m.
    pub tolerance: f64,
}

impl Farthest {
    /// The first of the farthest of some places, given with their distances.
    pub fn of(places: impl Iterator<Item = ([f64; 3], f64)>, tolerance: f64) -> Option<Farthest> {
        let (place, distance) = places.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
        Some(Farthest { place, distance, tolerance })
    }

    /// Whether it is reported.
    pub fn is_off(&self) -> bool {
        self.distance > self.tolerance
    }
}

/// Why a mesh is not convex, and its dents, where they were measured.
type Concavity = (NotConvex, Option<Dents>);

/// The results of comparisons of mesh files, boxes and spheres with each other. Meshes are by their content: see
/// [`Solids::content`](super::solids::Solids::content).
#[derive(Default)]
pub struct Memos {
    /// For a rule and the meshes that it compares: the place farthest off.
    pub farthest: Memo<(Code, Vec<usize>), Option<Farthest>>,
    pub convexity: Memo<usize, Option<Concavity>>,
    /// The size of a box or sphere over that of the smallest one around a mesh. The numbers are those of its size.
    pub ratios: Memo<(usize, [u64; 4]), Option<f64>>,
}
