//! Where the arrays of a call are, so that one that is written overlaps no other.

use std::cell::RefCell;

/// Where an array of the caller's is.
#[derive(Clone, Copy)]
pub(crate) struct Span {
    pub what: &'static str,
    pub address: usize,
    pub bytes: usize,
    pub is_written: bool,
}

thread_local! {
    /// The arrays of the call that this thread is in.
    static ARRAYS: RefCell<Vec<Span>> = const { RefCell::new(Vec::new()) };
}

/// Begins a call.
pub(crate) fn begin() {
    let _ = ARRAYS.try_with(|arrays| arrays.borrow_mut().clear());
}

impl Span {
    /// The first array of this call that it clashes with. It counts among them from now on.
    pub fn first_clash(self) -> Option<Span> {
        // A thread that ends has no list any more.
        let clash = ARRAYS.try_with(|arrays| {
            let mut arrays = arrays.borrow_mut();
            let other = arrays.iter().find(|other| other.clashes(&self)).copied();
            arrays.push(self);
            other
        });
        clash.ok().flatten()
    }

    /// Whether one of two arguments would be written over the other.
    fn clashes(&self, other: &Span) -> bool {
        (self.is_written || other.is_written)
            && self.what != other.what
            && self.bytes > 0
            && other.bytes > 0
            && self.address < other.address.saturating_add(other.bytes)
            && other.address < self.address.saturating_add(self.bytes)
    }
}
