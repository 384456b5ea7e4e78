//! How serving ended.

/// How serving ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// The editor asked for it, as the protocol says.
    Orderly,
    /// The editor asked for it without announcing it.
    Exit,
    /// The editor closed the connection.
    Closed,
    /// The editor's process is gone.
    ParentGone,
}

impl Ended {
    /// Whether it ended as the protocol says: exit status 0, else 1.
    pub fn is_orderly(self) -> bool {
        self == Ended::Orderly
    }
}
