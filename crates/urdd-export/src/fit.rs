//! Primitives in the place of convex meshes, where that costs little.

use std::fmt;
use std::str::FromStr;

use rayon::prelude::*;
use thiserror::Error;
use urdd_geometry::enclosing::Enclosing;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::primitives::Primitive;

use crate::{Note, Shape, ShapeCounts, Solid};

/// What a primitive in the place of a convex mesh may cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Its volume, over that of the mesh.
    pub(super) volume: f64,
    /// How far it stands off the mesh, at most, m.
    pub(super) standoff: f64,
}

impl Default for Fit {
    fn default() -> Self {
        Fit { volume: 1.2, standoff: 0.005 }
    }
}

/// Words that are no [`Fit`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "a fit is a volume of 1 or more over that of the mesh and a distance in metres, such as 1.2 and 0.005"
)]
pub struct NoFit;

impl Fit {
    /// A primitive may have this multiple of the volume of the mesh, and stand off it by so many metres.
    ///
    /// # Errors
    /// If the multiple is less than 1, the distance negative, or one of them not finite.
    pub fn new(volume: f64, standoff: f64) -> Result<Self, NoFit> {
        let is_usable =
            volume.is_finite() && standoff.is_finite() && volume >= 1.0 && standoff >= 0.0;
        is_usable.then_some(Fit { volume, standoff }).ok_or(NoFit)
    }

    /// The tightest primitive around a mesh, if one is within these costs.
    fn around(&self, shape: &Shape, has_capsules: bool) -> Option<Solid> {
        let Solid::Convex(mesh) = &shape.solid else { return None };
        let hull = ConvexHull::new(&mesh.vertices).ok().filter(|hull| !hull.is_flat())?;
        let most = self.volume * hull.mesh().signed_volume();
        let is_capsule = |of: &Enclosing| matches!(of.primitive, Primitive::Capsule { .. });
        let mut all: Vec<(f64, Enclosing)> = Enclosing::around(&hull)
            .into_iter()
            .filter(|of| has_capsules || !is_capsule(of))
            .map(|of| (of.primitive.volume(), of))
            .filter(|(volume, _)| *volume <= most)
            .collect();
        all.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let is_near = |of: &Enclosing| of.standoff(&hull).is_some_and(|away| away <= self.standoff);
        let (_, found) = all.into_iter().find(|(_, of)| is_near(of))?;
        Some(Solid::Primitive(found.pose, found.primitive))
    }
}

/// `VOLUME,STANDOFF`.
impl FromStr for Fit {
    type Err = NoFit;

    fn from_str(word: &str) -> Result<Self, NoFit> {
        let (volume, standoff) = word.split_once(',').ok_or(NoFit)?;
        let number = |word: &str| word.trim().parse().map_err(|_| NoFit);
        Fit::new(number(volume)?, number(standoff)?)
    }
}

/// As it stands in a sentence.
impl fmt::Display for Fit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Fit { volume, standoff } = self;
        write!(f, "at most {volume} times its volume, and at most {standoff} m off it")
    }
}

/// Puts primitives in the place of convex meshes: how many, and a note.
pub(super) fn fit(by_link: &mut [Vec<Shape>], fit: Fit, has_capsules: bool) -> (usize, Note) {
    let is_mesh = |shape: &&mut Shape| matches!(shape.solid, Solid::Convex(_));
    let meshes: Vec<&mut Shape> = by_link.iter_mut().flatten().filter(is_mesh).collect();
    let of = meshes.len();
    let fitted = meshes.into_par_iter().filter_map(|shape| {
        shape.solid = fit.around(shape, has_capsules)?;
        Some(shape.solid.clone())
    });
    let fitted: Vec<Solid> = fitted.collect();
    let counts = ShapeCounts::of(fitted.iter());
    (fitted.len(), Note::Fitted { counts, of, costs: fit.to_string() })
}
