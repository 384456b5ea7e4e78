//! How many spheres there may be.

/// Number of spheres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SphereBudget {
    /// Twelve per link with shapes on average, at most 150 in total. For covering spheres: at most eight per link.
    #[default]
    Auto,
    /// Maximum number per link.
    PerLink(usize),
    /// Maximum number for all links together, but at least one per link.
    Total(usize),
}
