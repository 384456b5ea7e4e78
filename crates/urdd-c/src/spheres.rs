//! Spheres in the place of a robot's shapes.

use urdd_robot::spheres::{self, Approximating, Covering, SphereChecker};

use crate::checks::{Checks, LinkSphere, levels};
use crate::collision_model::LinkPair;
use crate::failure::{Status, run};
use crate::memory::{at, free, handle, make, plain, put};
use crate::obstacle::Obstacle;
use crate::robot::Robot;

/// Spheres that contain the shapes of a robot: where none touch, the robot is certainly free.
pub struct CoveringChecker(SphereChecker<Covering>);

/// Spheres that are near the shapes of a robot: nothing is certain.
pub struct ApproximatingChecker(SphereChecker<Approximating>);

handle!(CoveringChecker, "urdd_covering_checker");
handle!(ApproximatingChecker, "urdd_approximating_checker");

/// What covering spheres say.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoveringAnswer {
    /// Spheres touch; the shapes may.
    Maybe = 0,
    /// Certainly no contact.
    Free = 1,
}

/// What approximating spheres say.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ApproximateAnswer {
    /// Spheres touch; the shapes may be apart.
    Contact = 0,
    /// No spheres touch; parts of shapes outside of them may.
    Free = 1,
}

plain!(CoveringAnswer, ApproximateAnswer);

macro_rules! checks {
    ($checker:ident, $coverage:ident, $answer:ident: $($said:ident),+) => {
        impl Checks for $checker {
            type Coverage = $coverage;
            type Answer = $answer;

            fn of(checker: SphereChecker<$coverage>) -> Self {
                $checker(checker)
            }

            fn checker(&self) -> &SphereChecker<$coverage> {
                &self.0
            }

            fn checker_mut(&mut self) -> &mut SphereChecker<$coverage> {
                &mut self.0
            }

            fn answer(found: spheres::$answer) -> $answer {
                match found {
                    $(spheres::$answer::$said => $answer::$said),+
                }
            }
        }
    };
}

checks!(CoveringChecker, Covering, CoveringAnswer: Maybe, Free);
checks!(ApproximatingChecker, Approximating, ApproximateAnswer: Contact, Free);

/// Prepares the finest level of spheres that covers the links, with the coarser ones around it, as the URDD has them
/// (link_shapes_spheres_module), for the pairs of links that are neither skipped nor ignored by the level.
///
/// Errors: `MISSING_MODULE` without the module, or without a level that covers; `UNUSABLE`: the module, a skips module,
/// chain_module or dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_covering_checker(
    handle: *const Robot,
    out: *mut *mut CoveringChecker,
) -> Status {
    unsafe { make(out, || Ok(CoveringChecker(at(handle)?.robot.covering_checker()?))) }
}

/// As `urdd_robot_covering_checker`, of spheres of the caller's that cover the shapes, and of `num_pairs` pairs of links,
/// such as those of `urdd_proximity_pairs`. A link without spheres on the finest level is left out.
///
/// Errors: `VALUE` for a centre that is not finite or farther than 1e9 m, a radius that is not above 0 or larger than that,
/// a level that is left out, no spheres, or a pair of a link with itself; `OUT_OF_RANGE` for a link.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_covering_checker_of(
    handle: *const Robot,
    spheres: *const LinkSphere,
    count: usize,
    pairs: *const LinkPair,
    num_pairs: usize,
    out: *mut *mut CoveringChecker,
) -> Status {
    unsafe {
        make(out, || {
            let robot = &at(handle)?.robot;
            let (levels, pairs) = levels(robot, (spheres, count), (pairs, num_pairs), true)?;
            Ok(CoveringChecker(SphereChecker::covering(robot, &levels, &pairs)?))
        })
    }
}

/// Frees a checker. What was made of it stays. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_covering_checker_free(checker: *mut CoveringChecker) -> Status {
    unsafe { free(checker) }
}

/// Writes the number of DOFs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_covering_checker_num_dofs(
    handle: *const CoveringChecker,
    out: *mut usize,
) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.0.num_dofs()) })
}

/// Makes a checker of the same spheres among `count` obstacles: each query then asks for both, contacts of links with each
/// other and with obstacles. What it needs of the obstacles is copied; those of `handle` are not kept.
///
/// Errors: `UNKNOWN_NAME` if an obstacle ignores an unknown link.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_covering_checker_around(
    handle: *const CoveringChecker,
    obstacles: *const *const Obstacle,
    count: usize,
    out: *mut *mut CoveringChecker,
) -> Status {
    unsafe { Checks::around(handle, (obstacles, count), out) }
}

/// Moves obstacles, as `urdd_world_proximity_move_obstacles` does: it changes the handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_covering_checker_move_obstacles(
    handle: *mut CoveringChecker,
    first: usize,
    poses: *const f64,
    count: usize,
) -> Status {
    unsafe { Checks::move_obstacles(handle, first, (poses, count)) }
}

/// Writes what the spheres say of each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m, at most 1e9; `answers` has room for `rows` values. Eight rows
/// are checked at once. One row is computed on this thread, without an allocation.
///
/// Errors: `VALUE` for a value beyond 1e9.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_covering_checker_in_collision(
    handle: *const CoveringChecker,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    answers: *mut CoveringAnswer,
) -> Status {
    unsafe { Checks::is_within(handle, (configurations, rows, dofs), 0.0, answers) }
}

/// As `urdd_covering_checker_in_collision`, of spheres that are at most `margin` apart, metres. With a margin above 0, pairs
/// count whose links can move against each other.
///
/// Errors: also `VALUE` for a margin below 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_covering_checker_is_within(
    handle: *const CoveringChecker,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    answers: *mut CoveringAnswer,
) -> Status {
    unsafe { Checks::is_within(handle, (configurations, rows, dofs), margin, answers) }
}

/// Writes where spheres touch on each straight motion, as a part of it from 0 to 1; NaN where they do not.
///
/// `starts` and `ends` have `rows` rows of `dofs` values each, rad or m; `blocked` has room for `rows` values. `margin` is
/// the distance that must be kept, metres. Configurations are checked between which no point of a sphere travels farther
/// than `resolution`, metres, eight at once, spread over the whole motion: the answer need not be the first part, which
/// `urdd_covering_checker_first_contact` has. `open_loops` says that kinematic loops may be open on the way: spheres follow
/// no motion in which they stay closed.
///
/// Errors: `VALUE` for a margin below 0, a resolution that is not above 0, a value beyond 1e9, or a motion that needs more
/// than a million configurations; for a robot with loops without `open_loops`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_covering_checker_blocked_edge(
    handle: *const CoveringChecker,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    open_loops: bool,
    blocked: *mut f64,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution, open_loops));
    unsafe { Checks::blocked_edge(handle, ends, (rows, dofs), settings, blocked) }
}

/// Writes where spheres touch first on each straight motion, and how far they are free.
///
/// As `urdd_covering_checker_blocked_edge`; `contacts` has room for `length` values, rows x 2: the last part of the motion in
/// which no spheres touch (0 if they do at the start), then the first in which some do; both NaN where the motion is free.
/// The part between two configurations is divided by 4096.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_covering_checker_first_contact(
    handle: *const CoveringChecker,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    open_loops: bool,
    contacts: *mut f64,
    length: usize,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution, open_loops));
    unsafe { Checks::first_contact(handle, ends, (rows, dofs), settings, (contacts, length)) }
}

/// Prepares the last level of spheres that does not cover the links: fitted ones, or those that a person gave. How often it
/// is wrong stands in the level's `evaluation` in link_shapes_spheres_module.
///
/// Errors: as `urdd_robot_covering_checker`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_approximating_checker(
    handle: *const Robot,
    out: *mut *mut ApproximatingChecker,
) -> Status {
    unsafe { make(out, || Ok(ApproximatingChecker(at(handle)?.robot.approximating_checker()?))) }
}

/// As `urdd_robot_covering_checker_of`, of spheres that need not cover the shapes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_approximating_checker_of(
    handle: *const Robot,
    spheres: *const LinkSphere,
    count: usize,
    pairs: *const LinkPair,
    num_pairs: usize,
    out: *mut *mut ApproximatingChecker,
) -> Status {
    unsafe {
        make(out, || {
            let robot = &at(handle)?.robot;
            let (levels, pairs) = levels(robot, (spheres, count), (pairs, num_pairs), false)?;
            Ok(ApproximatingChecker(SphereChecker::approximating(robot, &levels, &pairs)?))
        })
    }
}

/// Frees a checker. What was made of it stays. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_approximating_checker_free(
    checker: *mut ApproximatingChecker,
) -> Status {
    unsafe { free(checker) }
}

/// Writes the number of DOFs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_approximating_checker_num_dofs(
    handle: *const ApproximatingChecker,
    out: *mut usize,
) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.0.num_dofs()) })
}

/// As `urdd_covering_checker_around`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_approximating_checker_around(
    handle: *const ApproximatingChecker,
    obstacles: *const *const Obstacle,
    count: usize,
    out: *mut *mut ApproximatingChecker,
) -> Status {
    unsafe { Checks::around(handle, (obstacles, count), out) }
}

/// As `urdd_covering_checker_move_obstacles`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_approximating_checker_move_obstacles(
    handle: *mut ApproximatingChecker,
    first: usize,
    poses: *const f64,
    count: usize,
) -> Status {
    unsafe { Checks::move_obstacles(handle, first, (poses, count)) }
}

/// As `urdd_covering_checker_in_collision`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_approximating_checker_in_collision(
    handle: *const ApproximatingChecker,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    answers: *mut ApproximateAnswer,
) -> Status {
    unsafe { Checks::is_within(handle, (configurations, rows, dofs), 0.0, answers) }
}

/// As `urdd_covering_checker_is_within`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_approximating_checker_is_within(
    handle: *const ApproximatingChecker,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    answers: *mut ApproximateAnswer,
) -> Status {
    unsafe { Checks::is_within(handle, (configurations, rows, dofs), margin, answers) }
}

/// As `urdd_covering_checker_blocked_edge`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_approximating_checker_blocked_edge(
    handle: *const ApproximatingChecker,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    open_loops: bool,
    blocked: *mut f64,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution, open_loops));
    unsafe { Checks::blocked_edge(handle, ends, (rows, dofs), settings, blocked) }
}

/// As `urdd_covering_checker_first_contact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_approximating_checker_first_contact(
    handle: *const ApproximatingChecker,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    open_loops: bool,
    contacts: *mut f64,
    length: usize,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution, open_loops));
    unsafe { Checks::first_contact(handle, ends, (rows, dofs), settings, (contacts, length)) }
}
