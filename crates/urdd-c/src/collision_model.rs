//! The learned self-collision model.

use urdd_kinematics::ConfigurationError;
use urdd_robot::RobotError;

use crate::failure::{Failure, Owned, Status, Text, run};
use crate::memory::{at, free, handle, make, plain, put, put_all, put_numbers};
use crate::queries::Rows;
use crate::robot::Robot;

/// The learned self-collision model of a URDD (SPEC 8.8): an estimate of the clearance between links.
pub struct CollisionModel {
    model: urdd_robot::CollisionModel,
    evaluation: Owned,
}

handle!(CollisionModel, "urdd_collision_model");

/// Two links.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct LinkPair {
    /// Their indices.
    pub links: [usize; 2],
}

plain!(LinkPair);

/// Reads the learned self-collision model. It filters out configurations far from contact, before an exact check of the
/// rest. It is an estimate, not a guarantee: `urdd_collision_model_evaluation` has its measured error rates.
///
/// Errors: `MISSING_MODULE`, `UNUSABLE`: self_collision_model_module, chain_module or dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_collision_model(
    handle: *const Robot,
    out: *mut *mut CollisionModel,
) -> Status {
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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_free(model: *mut CollisionModel) -> Status {
    unsafe { free(model) }
}

/// Writes the error rates that the module states, measured on configurations that were not used to make the model: the
/// JSON of `evaluation` in self_collision_model_module. It lives as long as the model.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_evaluation(
    handle: *const CollisionModel,
    out: *mut Text,
) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.evaluation.text()) })
}

/// Writes the number of link pairs and of DOFs. Each of the two can be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_sizes(
    handle: *const CollisionModel,
    pairs: *mut usize,
    dofs: *mut usize,
) -> Status {
    run(|| unsafe {
        let model = &at(handle)?.model;
        put_numbers([("pairs", pairs, model.pairs().len()), ("dofs", dofs, model.num_dofs())])
    })
}

/// Writes the link pairs, in the order of `urdd_collision_model_clearances`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_pairs(
    handle: *const CollisionModel,
    pairs: *mut LinkPair,
    length: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.model.pairs();
        let links = known.iter().map(|pair| [pair.link_a_idx.get(), pair.link_b_idx.get()]);
        let links = links.map(|links| LinkPair { links });
        put_all(("pairs", pairs, length), (known.len(), 1), links)
    })
}

/// Writes the estimated clearance of each link pair for each configuration, metres. 0 or less: the pair may be in
/// contact.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `clearances` has room for `length` values: rows x pairs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_clearances(
    handle: *const CollisionModel,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    clearances: *mut f64,
    length: usize,
) -> Status {
    run(|| unsafe {
        let model = &at(handle)?.model;
        let q = Rows::new("configurations", configurations, (rows, dofs), model.num_dofs())?;
        let width = model.pairs().len();
        write(q, q.room(("clearances", clearances, length), width)?, |q| model.clearances_batch(q))
    })
}

/// Writes whether any pair may be in contact, for each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `colliding` has room for `rows` values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_collision_model_may_collide(
    handle: *const CollisionModel,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    colliding: *mut bool,
) -> Status {
    run(|| unsafe {
        let model = &at(handle)?.model;
        let q = Rows::new("configurations", configurations, (rows, dofs), model.num_dofs())?;
        write(q, q.room(("colliding", colliding, rows), 1)?, |q| model.may_collide_batch(q))
    })
}

/// Writes the results of each configuration, some configurations at a time: what a batch allocates does not grow with the
/// caller's rows.
fn write<T: Copy>(
    q: Rows,
    out: &mut [T],
    ask: impl Fn(&[f64]) -> Result<Vec<T>, ConfigurationError>,
) -> Result<(), Failure> {
    const ROWS: usize = 512;
    let width = out.len() / q.count.max(1);
    for (block, out) in out.chunks_mut(ROWS * width.max(1)).enumerate() {
        let first = block * ROWS;
        let found = ask(q.some(first..first + out.len() / width))?;
        if found.len() != out.len() {
            return Err(RobotError::Room { found: out.len(), count: found.len(), width: 1 }.into());
        }
        out.copy_from_slice(&found);
    }
    Ok(())
}
