//! What planners ask beside distances: margins, motions, gradients, overlaps.

use std::sync::Arc;

use urdd_robot::FirstContact;

use crate::failure::Status;
use crate::memory::plain;
use crate::proximity::{PairDistance, Proximity};
use crate::queries::Asked;
use crate::world::{ObstacleDistance, WorldProximity};

/// Two shapes that touch or overlap.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Overlap {
    /// The two shapes. Their distance is 0; the points are those that touch once the second shape has moved, before it
    /// moves.
    pub pair: PairDistance,
    /// The length of the least translation that separates the two, metres; 0 if they touch.
    pub depth: f64,
    /// The unit vector, in the root link's frame, along which the second shape would move.
    pub direction: [f64; 3],
}

/// A shape of the robot and an obstacle that touch or overlap.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ObstacleOverlap {
    /// The two. Their distance is 0; the points are those that touch once the obstacle has moved, before it moves.
    pub pair: ObstacleDistance,
    /// The length of the least translation that separates the two, metres; 0 if they touch.
    pub depth: f64,
    /// The unit vector, in the root link's frame, along which the obstacle would move.
    pub direction: [f64; 3],
}

plain!(Overlap, ObstacleOverlap);

impl Asked for Proximity {
    type Of = urdd_robot::Proximity;
    type Pair = PairDistance;
    type Overlap = Overlap;

    fn queries(&self) -> &Self::Of {
        &self.0
    }

    fn overlap(pair: PairDistance, depth: f64, direction: [f64; 3]) -> Overlap {
        Overlap { pair, depth, direction }
    }
}

impl Asked for WorldProximity {
    type Of = urdd_robot::WorldProximity<Arc<urdd_robot::Proximity>>;
    type Pair = ObstacleDistance;
    type Overlap = ObstacleOverlap;

    fn queries(&self) -> &Self::Of {
        &self.0
    }

    fn overlap(pair: ObstacleDistance, depth: f64, direction: [f64; 3]) -> ObstacleOverlap {
        ObstacleOverlap { pair, depth, direction }
    }
}

/// Writes whether any pair is at most `margin` apart, metres, for each configuration. With a margin above 0, pairs count
/// whose links can move against each other.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `within` has room for `rows` values. One row is computed
/// on this thread, without an allocation.
///
/// Errors: `VALUE` for a margin below 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_is_within(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    within: *mut bool,
) -> Status {
    unsafe { Asked::is_within(handle, (configurations, rows, dofs), margin, within) }
}

/// As `urdd_proximity_is_within`, for the pairs of a shape of the robot and an obstacle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_is_within(
    handle: *const WorldProximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    within: *mut bool,
) -> Status {
    unsafe { Asked::is_within(handle, (configurations, rows, dofs), margin, within) }
}

/// Writes where each straight motion is blocked by the robot itself, as a part of it from 0 to 1; NaN where it is free.
///
/// `starts` and `ends` have `rows` rows of `dofs` values each, rad or m; `blocked` has room for `rows` values. `margin`
/// is the distance that must be kept, metres. With a `resolution` above 0, metres, configurations are checked between
/// which no point of the robot travels farther, the end and the halves first: the answer is one that is blocked, and need
/// not be the first, which `urdd_proximity_first_contact` has. With 0, the motion is proved free by conservative
/// advancement; it then needs 0.1 mm more than the margin, and the answer is the first part where it has less.
///
/// Where the robot has kinematic loops, they stay closed in the motion: see `urdd_proximity_motions`.
///
/// Errors: `VALUE` for a margin or a resolution below 0, or a motion that needs more than a
/// million configurations, or 100,000 steps of a proof; for a robot with loops as `urdd_proximity_motions`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_blocked_edge(
    handle: *const Proximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    blocked: *mut f64,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution));
    unsafe { Asked::blocked_edge(handle, ends, (rows, dofs), settings, blocked) }
}

/// As `urdd_proximity_blocked_edge`, for motions that obstacles block.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_blocked_edge(
    handle: *const WorldProximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    blocked: *mut f64,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution));
    unsafe { Asked::blocked_edge(handle, ends, (rows, dofs), settings, blocked) }
}

/// Writes where each straight motion is blocked by the robot itself first, and how far it is free.
///
/// As `urdd_proximity_blocked_edge`; `contacts` has room for `length` values, rows x 2: the last part of the motion that is
/// known to be free (0 if the start is not), then the first that is not; both NaN where the motion is free. With a
/// resolution, configurations are checked in order, and the part between the first that is blocked and the one before is
/// halved ten times: between the two no point of the robot travels farther than a thousandth of the resolution. A contact
/// that begins and ends between two configurations can be missed. With 0, all up to the first part is proved free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_first_contact(
    handle: *const Proximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    contacts: *mut f64,
    length: usize,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution));
    unsafe { Asked::first_contact(handle, ends, (rows, dofs), settings, (contacts, length)) }
}

/// As `urdd_proximity_first_contact`, for motions that obstacles block.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_first_contact(
    handle: *const WorldProximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    contacts: *mut f64,
    length: usize,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution));
    unsafe { Asked::first_contact(handle, ends, (rows, dofs), settings, (contacts, length)) }
}

/// Why a motion cannot go on.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Obstruction {
    /// It can.
    #[default]
    None = 0,
    /// A pair is at most the margin apart, or is not proved farther apart.
    Contact = 1,
    /// No configuration was found there in which the loops of the robot are closed, within its bounds.
    Open = 2,
    /// The DOFs that follow would have to jump, or arrive elsewhere than at the end: it is on another branch of the closed
    /// configurations.
    Branch = 3,
}

/// Where a motion is blocked first, as parts of it from 0 to 1.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default)]
pub struct Motion {
    /// The last part that is known to be free; 0 if the start is not, NaN if the motion is free.
    pub free: f64,
    /// The first part that is not; NaN if the motion is free.
    pub blocked: f64,
    /// Why it is not.
    pub obstruction: Obstruction,
}

plain!(Motion);

impl From<Option<FirstContact>> for Motion {
    fn from(contact: Option<FirstContact>) -> Self {
        use urdd_robot::Obstruction as Of;
        let Some(FirstContact { free, blocked, obstruction }) = contact else {
            let none = Obstruction::None;
            return Motion { free: f64::NAN, blocked: f64::NAN, obstruction: none };
        };
        let obstruction = match obstruction {
            Of::Open => Obstruction::Open,
            Of::Branch => Obstruction::Branch,
            _ => Obstruction::Contact,
        };
        Motion { free, blocked, obstruction }
    }
}

/// Writes where each motion is blocked by the robot itself first, and why.
///
/// As `urdd_proximity_first_contact`; `motions` has room for `rows`. Where the robot has kinematic loops, the motion is the
/// one in which they stay closed: the independent DOFs go straight, the others follow, each configuration closed from the
/// last one, within the bounds. It is blocked where no closed configuration is found, and at the end where the others
/// arrive on another branch than `ends` is on. It has no proof. With `open_loops`, it is the straight motion of the
/// spanning tree.
///
/// Errors: as there; for a robot with loops also `VALUE` without a resolution, for an end that is not closed, and for a
/// motion that needs more than 100,000 configurations.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_motions(
    handle: *const Proximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    open_loops: bool,
    motions: *mut Motion,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution, open_loops));
    unsafe { Asked::motions(handle, ends, (rows, dofs), settings, motions) }
}

/// As `urdd_proximity_motions`, for motions that obstacles block.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_motions(
    handle: *const WorldProximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    open_loops: bool,
    motions: *mut Motion,
) -> Status {
    let (ends, settings) = ([starts, ends], (margin, resolution, open_loops));
    unsafe { Asked::motions(handle, ends, (rows, dofs), settings, motions) }
}

/// Writes the `k` nearest pairs of one configuration, nearest first, and the gradients of their distances.
///
/// `configuration` has `dofs` values, rad or m; `nearest` has room for `k`; `gradients` for k x dofs values, m/rad or
/// m/m: NaN for pairs that touch or overlap. `found` is the number that is written: the lesser of `k` and the number of
/// pairs. A gradient is that of the closest points as they are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_gradients(
    handle: *const Proximity,
    configuration: *const f64,
    dofs: usize,
    k: usize,
    nearest: *mut PairDistance,
    gradients: *mut f64,
    found: *mut usize,
) -> Status {
    let out = (nearest, gradients);
    unsafe { Asked::gradients(handle, (configuration, dofs), k, out, found) }
}

/// As `urdd_proximity_gradients`, for the pairs of a shape of the robot and a convex part of an obstacle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_gradients(
    handle: *const WorldProximity,
    configuration: *const f64,
    dofs: usize,
    k: usize,
    nearest: *mut ObstacleDistance,
    gradients: *mut f64,
    found: *mut usize,
) -> Status {
    let out = (nearest, gradients);
    unsafe { Asked::gradients(handle, (configuration, dofs), k, out, found) }
}

/// Writes the pairs that touch or overlap in one configuration, with the least translation that separates them.
///
/// `configuration` has `dofs` values, rad or m; `overlaps` has room for `length`, of which the first `found` are written:
/// `found` may be more than `length`, and is at most the number of pairs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_penetrations(
    handle: *const Proximity,
    configuration: *const f64,
    dofs: usize,
    overlaps: *mut Overlap,
    length: usize,
    found: *mut usize,
) -> Status {
    unsafe { Asked::penetrations(handle, (configuration, dofs), (overlaps, length), found) }
}

/// As `urdd_proximity_penetrations`, for the pairs of a shape of the robot and a convex part of an obstacle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_penetrations(
    handle: *const WorldProximity,
    configuration: *const f64,
    dofs: usize,
    overlaps: *mut ObstacleOverlap,
    length: usize,
    found: *mut usize,
) -> Status {
    unsafe { Asked::penetrations(handle, (configuration, dofs), (overlaps, length), found) }
}
