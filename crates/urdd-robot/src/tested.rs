//! Which shapes of a robot are tested against which parts of obstacles.

use super::placed_part::PlacedPart;
use super::proximity::Shape;

/// The pairs of the shapes of one link, or of an attached object, and one part of an obstacle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group {
    pub link: u32,
    pub part: u32,
    /// The first pair, how many there are, and how far it is from one to the next.
    first: usize,
    count: u32,
    step: u32,
}

impl Group {
    /// The places of its pairs.
    pub fn pairs(self) -> impl Iterator<Item = usize> {
        (0..self.count as usize).map(move |k| self.first + k * self.step as usize)
    }
}

/// The shapes and the parts that are tested against each other.
#[derive(Debug)]
pub(super) struct Tested {
    /// By shape, then by part.
    pub pairs: Vec<[u32; 2]>,
    /// The same pairs in groups.
    pub groups: Vec<Group>,
}

impl Tested {
    /// `ignored` has for each obstacle the bodies that may touch it.
    pub fn new(shapes: &[Shape], parts: &[PlacedPart], ignored: &[Vec<usize>]) -> Self {
        let mut pairs = Vec::with_capacity(shapes.len().saturating_mul(parts.len()));
        let (mut groups, mut begin) = (Vec::new(), 0);
        for own in shapes.chunk_by(|a, b| (a.link, a.owner) == (b.link, b.owner)) {
            let Shape { link, owner, .. } = own[0];
            let others = parts.iter().enumerate();
            let others = others.filter(|(_, part)| !ignored[part.obstacle].contains(&owner));
            let others: Vec<u32> = others.map(|(part, _)| part as u32).collect();
            let (begins, count) = (pairs.len(), own.len());
            groups.extend(others.iter().enumerate().map(|(place, part)| Group {
                link: link as u32,
                part: *part,
                first: begins + place,
                count: count as u32,
                step: others.len() as u32,
            }));
            for shape in begin..begin + count {
                pairs.extend(others.iter().map(|part| [shape as u32, *part]));
            }
            begin += count;
        }
        Tested { pairs, groups }
    }
}
