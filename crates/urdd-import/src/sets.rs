//! Which bodies joints connect.

/// Sets of bodies, each known by one of them.
pub struct Sets(Vec<usize>);

impl Sets {
    /// Each of so many bodies by itself.
    pub fn new(count: usize) -> Self {
        Sets((0..count).collect())
    }

    /// The set of a body.
    pub fn of(&mut self, mut body: usize) -> usize {
        while self.0[body] != body {
            self.0[body] = self.0[self.0[body]];
            body = self.0[body];
        }
        body
    }

    /// Makes one of two sets; false if they are one.
    pub fn join(&mut self, left: usize, right: usize) -> bool {
        let (left, right) = (self.of(left), self.of(right));
        self.0[left.max(right)] = left.min(right);
        left != right
    }
}
