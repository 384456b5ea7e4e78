//! The friction of collision shapes, if all have the same.

use super::super::features::{self, Tally};
use super::tag::Tag;

/// What was met so far.
#[derive(Debug, Default)]
pub struct Friction {
    first: Option<Option<f64>>,
    is_mixed: bool,
    /// How many shapes say one.
    given: usize,
}

/// Where the coefficient is.
const PATHS: [&[&str]; 2] =
    [&["surface", "friction", "ode", "mu"], &["surface", "friction", "bullet", "friction"]];

impl Friction {
    /// Looks at a collision shape.
    pub fn meet(&mut self, collision: Tag, tally: &mut Tally) {
        let found = PATHS.iter().find_map(|path| collision.descendant(path));
        let found = found.and_then(|tag| tag.text().parse::<f64>().ok());
        let found = found.filter(|value| value.is_finite() && *value >= 0.0);
        self.is_mixed |= *self.first.get_or_insert(found) != found;
        if let Some(surface) = collision.child("surface") {
            let others = surface.node.descendants().filter(|node| {
                node.is_element() && !node.children().any(|child| child.is_element())
            });
            if others.count() > usize::from(found.is_some()) {
                tally.count(features::CONTACTS);
            }
        }
        self.given += usize::from(found.is_some());
    }

    /// The coefficient that all have. Counts those that differ.
    pub fn common(&self, tally: &mut Tally) -> Option<f64> {
        let feature = if self.is_mixed { features::FRICTIONS } else { features::FRICTION };
        (0..self.given).for_each(|_| tally.count(feature));
        self.first.flatten().filter(|_| !self.is_mixed)
    }
}
