//! Union-find: elements that are joined in pairs, as groups.

/// Groups of the elements `0..count`. The first element represents its group, so that the result does not depend on the
/// order of joining.
pub struct Groups(Vec<u32>);

impl Groups {
    /// Each element is a group of its own.
    pub fn new(count: usize) -> Self {
        Groups((0..count as u32).collect())
    }

    /// The first element of the group of an element.
    pub fn first(&mut self, mut at: usize) -> usize {
        while self.0[at] as usize != at {
            let up = self.0[self.0[at] as usize];
            self.0[at] = up;
            at = up as usize;
        }
        at
    }

    /// Makes the groups of two elements one.
    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b)] = a.min(b) as u32;
    }
}
