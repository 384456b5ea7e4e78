//! Spheres in the place of a robot's shapes. Configurations and answers cross as bytes: a JSON text takes longer than a check.

use serde::Deserialize;
use serde_json::{Value, json};
use urdd_directory::cancellation::Cancellation;
use urdd_robot::spheres::{Approximating, Covering, SphereChecker};
use urdd_robot::{EdgeSettings, RobotError};

use crate::bodies::{Body, Obstacles};
use crate::robot::Handle;
use crate::{answer, memory};

/// The spheres of a robot, and obstacles.
pub struct Checker {
    either: Either,
    /// Those that were asked about last.
    obstacles: Obstacles,
}

enum Either {
    Covering(SphereChecker<Covering>),
    Approximating(SphereChecker<Approximating>),
}

/// The same for both kinds of checkers.
macro_rules! both {
    ($either:expr, $checker:ident => $ask:expr) => {
        match $either {
            Either::Covering($checker) => $ask,
            Either::Approximating($checker) => $ask,
        }
    };
}

/// Which spheres of the URDD are taken.
#[derive(Deserialize)]
struct Question {
    /// The finest level that covers the shapes; otherwise the last that does not.
    covers: bool,
}

impl Checker {
    /// Its address, which JavaScript keeps, and the number of values of a configuration.
    fn told(either: Either) -> Value {
        let num_dofs = both!(&either, checker => checker.num_dofs());
        let checker = Checker { either, obstacles: Obstacles::default() };
        json!({ "checker": Box::into_raw(Box::new(checker)) as usize, "num_dofs": num_dofs })
    }
}

/// Prepares the spheres of the URDD: `{"covers": true}` in, `checker` and `num_dofs` out, or an error.
///
/// # Safety
/// `handle` is an open robot that is not used concurrently; the bytes are valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_sphere_checker(
    handle: *mut Handle,
    question: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (handle, question) = unsafe { (&*handle, memory::bytes(question, length)) };
    let made = || {
        let question: Question =
            serde_json::from_slice(question).map_err(|error| error.to_string())?;
        let made = match question.covers {
            true => handle.robot.covering_checker().map(Either::Covering),
            false => handle.robot.approximating_checker().map(Either::Approximating),
        };
        made.map(Checker::told).map_err(|error| error.to_string())
    };
    answer::result(made())
}

/// The same spheres among obstacles, a list of bodies in JSON: as [`urdd_robot_sphere_checker`] answers. Obstacles that stay or
/// move are not prepared again.
///
/// # Safety
/// `checker` is an open checker that is not used concurrently; the bytes are valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_spheres_around(
    checker: *mut Checker,
    bodies: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (checker, bodies) = unsafe { (&mut *checker, memory::bytes(bodies, length)) };
    let mut made = || {
        let bodies: Vec<Body> =
            serde_json::from_slice(bodies).map_err(|error| error.to_string())?;
        let world = checker.obstacles.world(&bodies)?;
        let made = match &checker.either {
            Either::Covering(checker) => checker.around(world).map(Either::Covering),
            Either::Approximating(checker) => checker.around(world).map(Either::Approximating),
        };
        made.map(Checker::told).map_err(|error| error.to_string())
    };
    answer::result(made())
}

/// Closes a checker.
///
/// # Safety
/// `checker` is an open checker, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_spheres_close(checker: *mut Checker) {
    // SAFETY: guaranteed by the caller.
    drop(unsafe { Box::from_raw(checker) });
}

/// Whether spheres are at most `margin` (m) apart, a byte 0 or 1 for each of the configurations stored one after another in
/// `values`; of one alone with `is_one`. An answer of [`answer::bytes_or_error`].
///
/// # Safety
/// `checker` is an open checker; there are `count` numbers at `values`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_spheres_within(
    checker: *const Checker,
    values: *const u8,
    count: usize,
    margin: f64,
    is_one: bool,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (checker, values) = unsafe { (&*checker, memory::numbers(values, count)) };
    let found = both!(&checker.either, checker => rows(&values, checker.num_dofs(), is_one).and_then(|count| {
        let mut out = vec![false; count];
        checker.touches_batch_into(&values, margin, &Cancellation::default(), &mut out)?;
        Ok(out)
    }));
    let found = found.map(|found| found.into_iter().map(u8::from).collect());
    answer::bytes_or_error(found.map_err(|error| error.to_string()))
}

/// Where straight motions are blocked, from 0 to 1, as little-endian binary64; NaN where they are free. With `is_first`, two
/// numbers for each: the last part that is free, and the first that is blocked. The `count` numbers at `starts` and at `ends`
/// are configurations stored one after another; one alone with `is_one`.
///
/// # Safety
/// `checker` is an open checker; there are `count` numbers at `starts` and at `ends`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_spheres_edges(
    checker: *const Checker,
    starts: *const u8,
    ends: *const u8,
    count: usize,
    margin: f64,
    resolution: f64,
    open_loops: bool,
    is_first: bool,
    is_one: bool,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (checker, starts) = unsafe { (&*checker, memory::numbers(starts, count)) };
    // SAFETY: as above.
    let ends = unsafe { memory::numbers(ends, count) };
    let settings = EdgeSettings { margin, resolution: Some(resolution), open_loops };
    let (edges, on) = ([&starts[..], &ends[..]], Cancellation::default());
    let found = both!(&checker.either, checker => rows(&ends, checker.num_dofs(), is_one).and_then(|count| {
        let mut out = vec![0.0; if is_first { 2 * count } else { count }];
        match is_first {
            true => checker.first_contact_batch_into(edges, &settings, &on, &mut out)?,
            false => checker.blocked_edge_batch_into(edges, &settings, &on, &mut out)?,
        }
        Ok(out)
    }));
    let found = found.map(|found| found.into_iter().flat_map(f64::to_le_bytes).collect());
    answer::bytes_or_error(found.map_err(|error| error.to_string()))
}

/// The number of configurations.
fn rows(values: &[f64], dofs: usize, is_one: bool) -> Result<usize, RobotError> {
    let found = values.len();
    match (is_one, dofs) {
        (true, _) if found != dofs => Err(RobotError::Batch { found, dofs }),
        (true, _) | (_, 0) => Ok(1),
        _ => Ok(found / dofs),
    }
}
