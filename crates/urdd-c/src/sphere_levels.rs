//! Spheres of links that the caller has.

use urdd_robot::Robot;
use urdd_robot::spheres::{LinkSpheres, Sphere, SphereLevel};

use crate::collision_model::LinkPair;
use crate::failure::{Failure, Status};
use crate::memory::{enough, plain, values};
use crate::names::out_of_range;

/// A sphere of a link, on a level.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct LinkSphere {
    /// The level, from 0, the coarsest, on. Each finer level is inside the coarser one, and the finest decides.
    pub level: usize,
    /// The index of the link.
    pub link: usize,
    /// In the link's frame, metres.
    pub centre: [f64; 3],
    /// Metres.
    pub radius: f64,
}

plain!(LinkSphere);

/// Memory of a sphere or pair, and of a link on a level, bytes.
const SPHERE: usize = 512;
const LEVEL: usize = 256;

/// Levels of spheres, and pairs of links.
pub(crate) type Levels = (Vec<SphereLevel>, Vec<[usize; 2]>);

/// The caller's spheres and pairs of links.
pub(crate) unsafe fn levels(
    robot: &Robot,
    (spheres, count): (*const LinkSphere, usize),
    (pairs, num_pairs): (*const LinkPair, usize),
    covers: bool,
) -> Result<Levels, Failure> {
    let spheres = unsafe { values("spheres", spheres, count) }?;
    let pairs = unsafe { values("pairs", pairs, num_pairs) }?;
    let (most, links) = (spheres.iter().map(|one| one.level).max(), robot.link_names()?.len());
    let on_levels = most.map_or(0, |most| most.min(count) + 1).saturating_mul(links);
    enough("spheres", count.saturating_add(on_levels / (SPHERE / LEVEL)), SPHERE)?;
    enough("pairs", num_pairs, SPHERE)?;
    let mut levels: Vec<SphereLevel> = Vec::new();
    for (k, LinkSphere { level, link, centre, radius }) in spheres.iter().enumerate() {
        if *link >= links {
            return Err(out_of_range("link", *link, links));
        }
        if *level == levels.len() {
            levels.push(SphereLevel { links: Vec::new(), covers });
        }
        let Some(on) = levels.get_mut(*level) else { return Err(gap(k, *level, levels.len())) };
        let sphere = Sphere { centre: *centre, radius: *radius };
        match on.links.iter_mut().find(|own| own.link_idx == *link) {
            Some(own) => own.spheres.push(sphere),
            None => on.links.push(LinkSpheres { link_idx: *link, spheres: vec![sphere] }),
        }
    }
    Ok((levels, pairs.iter().map(|pair| pair.links).collect()))
}

fn gap(sphere: usize, level: usize, known: usize) -> Failure {
    let message = format!(
        "sphere {sphere} is on level {level}, and before it there are spheres on {known} levels: begin with level 0, and leave no level out"
    );
    Failure::new(Status::Value, message)
}
