//! Spheres of links, level by level, and what an answer by them is worth.

use crate::error::RobotError;
use crate::proximity::Proximity;

/// A sphere in the frame of a link, m.
pub use urdd_geometry::bounding_sphere::BoundingSphere as Sphere;

/// The largest coordinate and radius, m.
pub const MOST: f64 = 1e9;

/// The spheres of a link.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkSpheres {
    /// The link.
    pub link_idx: usize,
    /// Its spheres; at least one.
    pub spheres: Vec<Sphere>,
}

/// One level of spheres of a robot: a set of spheres for each link that has geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereLevel {
    /// The links, each once.
    pub links: Vec<LinkSpheres>,
    /// Whether every shape of each link is inside the union of the link's spheres.
    pub covers: bool,
}

impl SphereLevel {
    /// The spheres of a link; none if it has none.
    pub(super) fn of(&self, link: usize) -> &[Sphere] {
        let own = self.links.iter().find(|own| own.link_idx == link);
        own.map_or(&[], |own| &own.spheres)
    }

    /// # Errors
    /// [`RobotError::Sphere`], [`RobotError::OutOfRange`].
    pub(super) fn check(&self, num_links: usize) -> Result<(), RobotError> {
        let mut known = vec![false; num_links];
        for LinkSpheres { link_idx, spheres } in &self.links {
            let fail = |sphere, reason| Err(RobotError::Sphere { link: *link_idx, sphere, reason });
            match known.get_mut(*link_idx) {
                None => {
                    let (index, count) = (*link_idx, num_links);
                    return Err(RobotError::OutOfRange { what: "link", index, count });
                }
                Some(true) => return fail(0, "its link is in the level twice"),
                Some(known) => *known = true,
            }
            for (k, Sphere { centre, radius }) in spheres.iter().enumerate() {
                if !centre.iter().all(|x| x.abs() <= MOST) {
                    return fail(k, "its centre is not finite, or farther than 1e9 m");
                }
                if !(*radius > 0.0 && *radius <= MOST) {
                    return fail(k, "its radius is not above 0, or larger than 1e9 m");
                }
            }
        }
        Ok(())
    }
}

impl Proximity {
    /// The bounding sphere of each shape: a level that covers these shapes.
    pub fn bounding_level(&self) -> SphereLevel {
        let mut links: Vec<LinkSpheres> = Vec::new();
        for shape in &self.shapes {
            let sphere = Sphere {
                centre: shape.sphere.centre,
                // A point is a sphere, too.
                radius: shape.sphere.radius.max(1e-9),
            };
            match links.iter_mut().find(|own| own.link_idx == shape.link) {
                Some(own) => own.spheres.push(sphere),
                None => links.push(LinkSpheres { link_idx: shape.link, spheres: vec![sphere] }),
            }
        }
        SphereLevel { links, covers: true }
    }

    /// The pairs of links with pairs of shapes that are checked.
    pub fn link_pairs(&self) -> Vec<[usize; 2]> {
        self.groups.iter().map(|group| group.links).collect()
    }
}

/// What the spheres of a robot say of its shapes, as a type: [`Covering`] or [`Approximating`].
pub trait Coverage: sealed::Sealed + Clone + Send + Sync {
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
