//! The learned self-collision model.

use urdd_kinematics::ConfigurationError;
use urdd_robot::RobotError;

use crate::failure::{Failure, Status, run};
use crate::handle::{Handle, at, free, make};
use crate::memory::{Plain, exact_room, put};
use crate::robot::Robot;
use crate::rows::Rows;
use crate::text::{Owned, Text};

/// The learned self-collision model of a URDD (SPEC 8.8): an estimate of the clearance between links.
pub struct CollisionModel {
    model: urdd_robot::CollisionModel,
    evaluation: Owned,
}

impl Handle for CollisionModel {
    const NAME: &'static str = "urdd_collision_model";
}

/// Two links.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct LinkPair {
    /// Their indices.
    pub links: [usize; 2],
}

// SAFETY: zeros are numbers.
unsafe impl Plain for LinkPair {}

/// Reads the learned self-collision model. It filters out configurations far from contact, before an exact check of the
/// rest. It is an estimate, not a guarantee: `urdd_collision_model_evaluation` has its measured error rates.
///
/// Errors: `MISSING_MODULE`, `UNUSABLE`: self_collision_model_module, chain_module or dof_module.
///
/// # Safety
/// `handle` is null or open; `out` is null or has room for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_collision_model(
    handle: *const Robot,
    out: *mut *mut CollisionModel,
) -> Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        make(out, || {
            let model = at(handle)?.robot.collision_model()?;
            let text = serde_json::to_string(model.evaluation())
                .map_err(|error| Failure::new(Status::Internal, error.to_string()))?;
            Ok(CollisionModel { model, evaluation: Owned::new(&text) })
        })
    }
}

/// Frees a model. Null is ignored.
///
/// # Safety
/// `model` is null, or open and not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_free(model: *mut CollisionModel) -> Status {
    // SAFETY: guaranteed by the caller.
    unsafe { free(model) }
}

/// Writes the error rates that the module states, measured on configurations that were not used to make the model: the
/// JSON of `evaluation` in self_collision_model_module. It lives as long as the model.
///
/// # Safety
/// `handle` is null or open; `out` is null or has room for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_evaluation(
    handle: *const CollisionModel,
    out: *mut Text,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe { put("out", out, at(handle)?.evaluation.text()) })
}

/// Writes the number of link pairs and of DOFs. Each of the two can be null.
///
/// # Safety
/// `handle` is null or open; each of the two is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_sizes(
    handle: *const CollisionModel,
    pairs: *mut usize,
    dofs: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let model = &at(handle)?.model;
        if !pairs.is_null() {
            put("pairs", pairs, model.pairs().len())?;
        }
        if !dofs.is_null() {
            put("dofs", dofs, model.num_dofs())?;
        }
        Ok(())
    })
}

/// Writes the link pairs, in the order of `urdd_collision_model_clearances`.
///
/// Errors: `LENGTH`.
///
/// # Safety
/// `handle` is null or open; there is room for `length` pairs at `pairs`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_pairs(
    handle: *const CollisionModel,
    pairs: *mut LinkPair,
    length: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let known = at(handle)?.model.pairs();
        let out = exact_room("pairs", pairs, length, (known.len(), 1))?;
        for (out, pair) in out.iter_mut().zip(known) {
            out.links = [pair.link_a_idx.get(), pair.link_b_idx.get()];
        }
        Ok(())
    })
}

/// Writes the estimated clearance of each link pair for each configuration, metres. 0 or less: the pair may be in
/// contact.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `clearances` has room for `length` values: rows x pairs.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_clearances(
    handle: *const CollisionModel,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    clearances: *mut f64,
    length: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let model = &at(handle)?.model;
        let q = Rows::new("configurations", configurations, (rows, dofs), model.num_dofs())?;
        let width = model.pairs().len();
        let out = q.room(("clearances", clearances, length), width)?;
        write(q.values, (model.num_dofs(), width), out, |q| model.clearances_batch(q))
    })
}

/// Writes whether any pair may be in contact, for each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `colliding` has room for `rows` values.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_may_collide(
    handle: *const CollisionModel,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    colliding: *mut bool,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let model = &at(handle)?.model;
        let q = Rows::new("configurations", configurations, (rows, dofs), model.num_dofs())?;
        let out = q.room(("colliding", colliding, rows), 1)?;
        write(q.values, (model.num_dofs(), 1), out, |q| model.may_collide_batch(q))
    })
}

/// Writes `width` results of each configuration, some configurations at a time: what a batch allocates does not grow with
/// the caller's rows.
fn write<T: Copy>(
    q: &[f64],
    (dofs, width): (usize, usize),
    out: &mut [T],
    ask: impl Fn(&[f64]) -> Result<Vec<T>, ConfigurationError>,
) -> Result<(), Failure> {
    const ROWS: usize = 512;
    for (block, out) in out.chunks_mut(ROWS * width.max(1)).enumerate() {
        let (first, rows) = (block * ROWS * dofs, out.len() / width);
        let found = ask(&q[first..first + rows * dofs])?;
        if found.len() != out.len() {
            return Err(RobotError::Room { found: out.len(), count: found.len(), width: 1 }.into());
        }
        out.copy_from_slice(&found);
    }
    Ok(())
}
