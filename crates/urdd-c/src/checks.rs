//! Spheres of links that the caller has, and what is asked of the spheres of a robot, once for both handles.

use crate::collision_model::LinkPair;
use crate::failure::{Failure, Status, run};
use crate::memory::{Handle, Plain, at, at_mut, enough, make, plain, values};
use crate::names::out_of_range;
use crate::obstacle::{Obstacle, with_moves, world_of};
use crate::queries::{Rows, edge_settings, edges};
use urdd_directory::cancellation::Cancellation;
use urdd_robot::spheres::{Coverage, LinkSpheres, Sphere, SphereChecker, SphereLevel};
use urdd_robot::{Robot, RobotError, fill};

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

/// Configurations that are checked at once.
const LANES: usize = 8;

/// As many of these, or of motions, are one block of work.
const BLOCKS: usize = 32;
const EDGES: usize = 32;

/// Memory of a part of an obstacle, bytes.
const PART: usize = 2048;

/// A handle that answers from spheres. The functions have the contract of the interface.
pub(crate) trait Checks: Handle + 'static {
    type Coverage: Coverage;
    type Answer: Plain + Send;

    fn of(checker: SphereChecker<Self::Coverage>) -> Self;
    fn checker(&self) -> &SphereChecker<Self::Coverage>;
    fn checker_mut(&mut self) -> &mut SphereChecker<Self::Coverage>;
    fn answer(found: <Self::Coverage as Coverage>::Answer) -> Self::Answer;

    unsafe fn around(
        handle: *const Self,
        (obstacles, count): (*const *const Obstacle, usize),
        out: *mut *mut Self,
    ) -> Status {
        unsafe {
            make(out, || {
                let world = world_of(obstacles, count, PART)?;
                Ok(Self::of(at(handle)?.checker().around(&world)?))
            })
        }
    }

    unsafe fn move_obstacles(
        handle: *mut Self,
        first: usize,
        (poses, count): (*const f64, usize),
    ) -> Status {
        run(|| unsafe {
            let checker = at_mut(handle)?.checker_mut();
            with_moves((poses, count), |poses| Ok(checker.move_obstacles(first, poses)?))
        })
    }

    unsafe fn is_within(
        handle: *const Self,
        (data, rows, dofs): (*const f64, usize, usize),
        margin: f64,
        answers: *mut Self::Answer,
    ) -> Status {
        run(|| unsafe {
            let checker = at(handle)?.checker();
            let q = Rows::new("configurations", data, (rows, dofs), checker.num_dofs())?;
            // Without DOFs, many configurations are as long as one.
            if rows == 1 || dofs == 0 {
                return q.answer(("answers", answers, rows), 1, |q, out| {
                    out[0] = Self::answer(checker.is_within(q, margin)?);
                    Ok(())
                });
            }
            let on = Cancellation::default();
            let out = q.room(("answers", answers, rows), 1)?;
            Ok(fill(out, LANES, BLOCKS, |(): &mut (), block, out: &mut [Self::Answer]| {
                let first = block * LANES;
                let mut touches = [false; LANES];
                let touches = &mut touches[..out.len()];
                checker.touches_batch_into(
                    q.some(first..first + out.len()),
                    margin,
                    &on,
                    touches,
                )?;
                for (out, touches) in out.iter_mut().zip(touches) {
                    *out = Self::answer(Self::Coverage::answer(*touches));
                }
                Ok::<(), RobotError>(())
            })?)
        })
    }

    /// NaN where a motion is free.
    unsafe fn blocked_edge(
        handle: *const Self,
        ends: [*const f64; 2],
        shape: (usize, usize),
        (margin, resolution, open_loops): (f64, f64, bool),
        blocked: *mut f64,
    ) -> Status {
        let settings = edge_settings(margin, resolution, open_loops);
        let out = ("blocked", blocked, shape.0);
        run(|| unsafe {
            let checker = at(handle)?.checker();
            edges(ends, (shape, checker.num_dofs()), out, EDGES, |start, end| {
                Ok([checker.blocked_edge(start, end, &settings)?.unwrap_or(f64::NAN)])
            })
        })
    }

    /// As [`Checks::blocked_edge`], with two numbers for each motion.
    unsafe fn first_contact(
        handle: *const Self,
        ends: [*const f64; 2],
        shape: (usize, usize),
        (margin, resolution, open_loops): (f64, f64, bool),
        (contacts, length): (*mut f64, usize),
    ) -> Status {
        let settings = edge_settings(margin, resolution, open_loops);
        let out = ("contacts", contacts, length);
        run(|| unsafe {
            let checker = at(handle)?.checker();
            edges(ends, (shape, checker.num_dofs()), out, EDGES, |start, end| {
                let contact = checker.first_contact(start, end, &settings)?;
                Ok(contact.map_or([f64::NAN; 2], |contact| [contact.free, contact.blocked]))
            })
        })
    }
}
