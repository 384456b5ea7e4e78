//! Which shapes of a robot are tested against which parts of obstacles.

use std::sync::Arc;

use super::placed_part::PlacedPart;
use super::proximity::Shape;

/// The pairs of the shapes of one link, or of an attached object, and one part of an obstacle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group {
    pub link: usize,
    pub part: usize,
    /// The first pair, how many there are, and how far it is from one to the next.
    first: usize,
    count: usize,
    step: usize,
}

impl Group {
    /// The places of its pairs.
    pub fn pairs(self) -> impl Iterator<Item = usize> {
        (0..self.count).map(move |k| self.first + k * self.step)
    }
}

/// The shapes and the parts that are tested against each other, by shape, then by part; and the same pairs in groups.
/// `ignored` has for each obstacle the bodies that may touch it.
pub(super) fn tested(
    shapes: &[Shape],
    parts: &[PlacedPart],
    ignored: &[Vec<usize>],
) -> (Arc<[[u32; 2]]>, Arc<[Group]>) {
    let (mut pairs, mut groups) = (Vec::new(), Vec::new());
    let mut begin = 0;
    for own in shapes.chunk_by(|a, b| (a.link, a.owner) == (b.link, b.owner)) {
        let Shape { link, owner, .. } = own[0];
        let others = parts.iter().enumerate();
        let others = others.filter(|(_, part)| !ignored[part.obstacle].contains(&owner));
        let others: Vec<usize> = others.map(|(part, _)| part).collect();
        let (first, count, step) = (pairs.len(), own.len(), others.len());
        let group = |(place, part): (usize, &usize)| Group {
            link,
            part: *part,
            first: first + place,
            count,
            step,
        };
        groups.extend(others.iter().enumerate().map(group));
        pairs.reserve(count * step);
        for shape in begin..begin + count {
            pairs.extend(others.iter().map(|part| [shape as u32, *part as u32]));
        }
        begin += count;
    }
    (pairs.into(), groups.into())
}
