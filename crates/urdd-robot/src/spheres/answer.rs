//! What an answer by spheres is worth.

/// What the spheres of a robot say of its shapes, as a type: [`Covering`] or [`Approximating`].
pub trait Coverage: sealed::Sealed + Send + Sync {
    /// What is said of a configuration.
    type Answer: Copy + Send + Sync + Default + PartialEq + std::fmt::Debug;
    /// Whether radii grow by what is rounded.
    #[doc(hidden)]
    const IS_CERTAIN: bool;
    /// The answer where no spheres touch, or where some do.
    #[doc(hidden)]
    fn answer(touches: bool) -> Self::Answer;
}

/// Every shape of a link is inside the union of its spheres: where no spheres touch, the robot is free.
#[derive(Debug, Clone, Copy)]
pub struct Covering;

/// The spheres are near the shapes; nothing is certain.
#[derive(Debug, Clone, Copy)]
pub struct Approximating;

/// What covering spheres say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CoveringAnswer {
    /// Certainly no contact.
    Free,
    /// Spheres touch; the shapes may.
    #[default]
    Maybe,
}

/// What approximating spheres say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ApproximateAnswer {
    /// No spheres touch; parts of shapes outside of them may.
    Free,
    /// Spheres touch; the shapes may be apart.
    #[default]
    Contact,
}

impl Coverage for Covering {
    type Answer = CoveringAnswer;
    const IS_CERTAIN: bool = true;
    fn answer(touches: bool) -> CoveringAnswer {
        if touches { CoveringAnswer::Maybe } else { CoveringAnswer::Free }
    }
}

impl Coverage for Approximating {
    type Answer = ApproximateAnswer;
    const IS_CERTAIN: bool = false;
    fn answer(touches: bool) -> ApproximateAnswer {
        if touches { ApproximateAnswer::Contact } else { ApproximateAnswer::Free }
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Covering {}
    impl Sealed for super::Approximating {}
}
