//! The joints that move the spheres of a robot, as a list of steps without a tree.
//!
//! Fixed joints are merged into the joint above. Each frame is chosen so that its joint turns about its z axis, and so that
//! the constant rotation before it is a permutation of the axes wherever the joint's axis is along one of the parent's.

use nalgebra::{Isometry3, Matrix3, Rotation3, Unit, UnitQuaternion, Vector3};

use crate::lanes::SIN_COS_ERROR;
use urdd_kinematics::{ForwardKinematics, Motion, Position};

/// A direction that is this near an axis is that axis, and a length below it is zero, m: files have angles with as many digits.
const SNAP: f64 = 1e-9;

/// Half of the distance of 1 and the next 32-bit number.
pub const ROUNDING: f64 = 5.960_464_5e-8;

/// A value that a step needs: `multiplier * q[dof] + offset`.
#[derive(Debug, Clone, Copy)]
pub struct Input {
    pub dof: usize,
    pub multiplier: f64,
    pub offset: f64,
}

/// A frame: where its rotation and its origin are in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frame {
    pub rotation: usize,
    pub origin: usize,
}

/// From one frame to the next: a constant translation, a constant rotation, the motion.
#[derive(Debug, Clone)]
pub struct Step {
    pub from: Frame,
    pub to: Frame,
    /// m, in the frame before.
    pub shift: [f32; 3],
    pub motion: StepMotion,
    /// The step of the frame before; `None` for the root.
    pub parent: Option<usize>,
}

#[derive(Debug, Clone)]
pub enum StepMotion {
    /// The columns of the frame before that are the new x, y and z axis; z turned round if so; then a turn about z.
    Turn { columns: [usize; 3], is_reversed: bool, angle: usize },
    /// The same with any rotation: its columns.
    TurnAny { rotation: [[f32; 3]; 3], angle: usize },
    /// Along an axis of the frame before.
    Slide { axis: [f32; 3], length: usize },
    /// A rotation, its columns, then that of a rotation vector.
    Ball { rotation: [[f32; 3]; 3], ball: usize },
}

/// How far what is computed in 32 bits is from what is true, at most. `S` is the sum of the lengths of all slides, m.
#[derive(Debug, Clone, Copy, Default)]
pub struct Bound {
    /// Of the rotation, as the norm of a matrix.
    rotation: f64,
    /// Of the origin, m: the first number plus the second times `S`.
    origin: [f64; 2],
    /// How far the origin is from the root's, at most, m: likewise.
    reach: [f64; 2],
}

impl Bound {
    /// A constant translation, and one by a slide.
    fn shifted(self, length: f64, slides: bool) -> Self {
        let slide = if slides { 1.0 } else { 0.0 };
        let [a, b] = self.reach;
        let reach = [a + length, b + slide];
        let by = |reach: f64, length: f64| {
            self.rotation * length + ROUNDING * (6.0 * length + 7.0 * reach)
        };
        let [c, d] = self.origin;
        let origin = [c + by(reach[0], length) + 2.0 * SNAP, d + by(reach[1], slide)];
        Bound { origin, reach, ..self }
    }

    fn turned(self, is_any: bool) -> Self {
        let constant = if is_any { ROUNDING * 11.0 } else { 2.0 * SNAP };
        let turn = 1.5 * SIN_COS_ERROR + 4.1 * ROUNDING;
        Bound { rotation: (self.rotation + constant + turn) * (1.0 + 1e-6), ..self }
    }

    /// A rotation by three numbers for each lane, made in 64 bits.
    fn balled(self) -> Self {
        Bound { rotation: (self.rotation + 24.0 * ROUNDING) * (1.0 + 1e-6), ..self }
    }

    /// Of a point of the frame at this distance from its origin: as [`Bound::origin`].
    pub fn of_point(self, length: f64) -> [f64; 2] {
        let Bound { origin, .. } = self.shifted(length, false);
        origin
    }

    /// As [`Bound::reach`].
    pub fn reach_of(self, length: f64) -> [f64; 2] {
        [self.reach[0] + length, self.reach[1]]
    }
}

/// Where a link is: its pose in a frame.
#[derive(Debug, Clone)]
pub struct Place {
    pub frame: Frame,
    pub pose: Isometry3<f64>,
    pub bound: Bound,
    /// The step that leads to the frame; `None` for the root.
    pub step: Option<usize>,
}

#[derive(Debug, Clone, Default)]
pub struct Tape {
    pub steps: Vec<Step>,
    pub angles: Vec<Input>,
    pub lengths: Vec<Input>,
    /// Rotation vectors.
    pub balls: Vec<[usize; 3]>,
    pub num_rotations: usize,
    pub num_origins: usize,
}

impl Tape {
    /// The steps that lead to the wanted links, and where these are.
    pub fn new(kinematics: &ForwardKinematics, wanted: &[bool]) -> (Self, Vec<Option<Place>>) {
        let mut needed = wanted.to_vec();
        for step in kinematics.steps().iter().rev() {
            needed[step.parent] |= needed[step.child];
        }
        let mut tape = Tape { num_rotations: 1, num_origins: 1, ..Tape::default() };
        let mut places: Vec<Option<Place>> = vec![None; needed.len()];
        let root = Frame { rotation: 0, origin: 0 };
        let (pose, bound) = (Isometry3::identity(), Bound::default());
        places[kinematics.root()] = Some(Place { frame: root, pose, bound, step: None });
        for step in kinematics.steps().iter().filter(|step| needed[step.child]) {
            if let Some(above) = places[step.parent].clone() {
                let pose = above.pose * step.origin;
                places[step.child] = Some(tape.moved(Place { pose, ..above }, &step.motion));
            }
        }
        (tape, places)
    }

    fn moved(&mut self, place: Place, motion: &Motion) -> Place {
        match motion {
            Motion::Fixed => place,
            Motion::Turn { position: Position { dof: None, .. }, .. }
            | Motion::Slide { position: Position { dof: None, .. }, .. } => {
                Place { pose: place.pose * motion.at(&[]), ..place }
            }
            Motion::Turn { axis, position } => self.turned(place, axis, input(position)),
            Motion::Slide { axis, position } => self.slid(place, axis, input(position)),
            Motion::Plane { axis, basis: [x, y], dofs: [a, b, c] } => {
                let place = self.slid(place, &Unit::new_normalize(*x), own(*a));
                let place = self.slid(place, &Unit::new_normalize(*y), own(*b));
                self.turned(place, axis, own(*c))
            }
            Motion::Float { dofs: [x, y, z, a, b, c] } => {
                let mut place = place;
                for (axis, dof) in
                    [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()].iter().zip([x, y, z])
                {
                    place = self.slid(place, axis, own(*dof));
                }
                self.balled(place, [*a, *b, *c])
            }
            Motion::Ball { dofs } => self.balled(place, *dofs),
        }
    }

    fn turned(&mut self, place: Place, axis: &Unit<Vector3<f64>>, mut input: Input) -> Place {
        let z = snapped((place.pose.rotation * axis).into_inner());
        let (columns, is_permutation) = about(z);
        let constant = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&columns));
        // The link's frame in the new one, before the motion. What it turns about z goes to the angle.
        let constant = UnitQuaternion::from_rotation_matrix(&constant);
        let link = constant.inverse() * place.pose.rotation;
        let (after, twist) = without_twist(&link, axis);
        input.offset += twist;
        let angle = self.angles.len();
        self.angles.push(input);
        let motion = match is_permutation {
            true => {
                let at = |k: usize| columns[k].iamax();
                StepMotion::Turn {
                    columns: [at(0), at(1), at(2)],
                    is_reversed: columns[2].sum() < 0.0,
                    angle,
                }
            }
            false => StepMotion::TurnAny { rotation: columns.map(narrow), angle },
        };
        let bound = place
            .bound
            .shifted(place.pose.translation.vector.norm(), false)
            .turned(!is_permutation);
        self.pushed(&place, motion, bound, after)
    }

    fn slid(&mut self, place: Place, axis: &Unit<Vector3<f64>>, input: Input) -> Place {
        let axis = snapped((place.pose.rotation * axis).into_inner());
        let length = self.lengths.len();
        self.lengths.push(input);
        let motion = StepMotion::Slide { axis: narrow(axis), length };
        let bound = place.bound.shifted(place.pose.translation.vector.norm(), true);
        let after = place.pose.rotation;
        self.pushed(&place, motion, bound, after)
    }

    fn balled(&mut self, place: Place, dofs: [usize; 3]) -> Place {
        let rotation = place.pose.rotation.to_rotation_matrix();
        let rotation = [0, 1, 2].map(|k| narrow(rotation.matrix().column(k).into_owned()));
        let motion = StepMotion::Ball { rotation, ball: self.balls.len() };
        self.balls.push(dofs);
        let bound = place.bound.shifted(place.pose.translation.vector.norm(), false).balled();
        self.pushed(&place, motion, bound, UnitQuaternion::identity())
    }

    /// `after` is the rotation of the link in the new frame.
    fn pushed(
        &mut self,
        place: &Place,
        motion: StepMotion,
        bound: Bound,
        after: UnitQuaternion<f64>,
    ) -> Place {
        let rotation = match motion {
            StepMotion::Slide { .. } => place.frame.rotation,
            _ => self.num_rotations,
        };
        self.num_rotations = self.num_rotations.max(rotation + 1);
        let frame = Frame { rotation, origin: self.num_origins };
        self.num_origins += 1;
        let shift = place.pose.translation.vector;
        let shift = narrow(shift.map(|x| if x.abs() < SNAP { 0.0 } else { x }));
        self.steps.push(Step { from: place.frame, to: frame, shift, motion, parent: place.step });
        let pose = Isometry3::from_parts(Default::default(), after);
        Place { frame, pose, bound, step: Some(self.steps.len() - 1) }
    }
}

fn input(position: &Position) -> Input {
    Input {
        dof: position.dof.unwrap_or(0),
        multiplier: position.multiplier,
        offset: position.offset,
    }
}

fn own(dof: usize) -> Input {
    Input { dof, multiplier: 1.0, offset: 0.0 }
}

fn narrow(v: Vector3<f64>) -> [f32; 3] {
    [0, 1, 2].map(|k| v[k] as f32)
}

/// A direction that is almost an axis is that axis.
fn snapped(v: Vector3<f64>) -> Vector3<f64> {
    let largest = v.iamax();
    let is_axis = (0..3).all(|k| k == largest || v[k].abs() < SNAP);
    match is_axis {
        true => Vector3::ith(largest, v[largest].signum()),
        false => v,
    }
}

/// A right-handed frame with this z axis, and whether it only permutes the axes, with z perhaps turned round.
fn about(z: Vector3<f64>) -> ([Vector3<f64>; 3], bool) {
    let largest = z.iamax();
    if z[largest].abs() == 1.0 {
        let [a, b] = [(largest + 1) % 3, (largest + 2) % 3].map(|k| Vector3::ith(k, 1.0));
        return match z[largest] > 0.0 {
            true => ([a, b, z], true),
            false => ([b, a, z], true),
        };
    }
    let least = Vector3::ith(z.iamin(), 1.0);
    let x = z.cross(&least).normalize();
    ([x, z.cross(&x), z], false)
}

/// A rotation that takes an axis to z, without its turn about z, and that turn, rad: an axis of the frame before stays in the
/// plane of x and z. The axes of the joints that follow are then mostly along axes of the frame.
fn without_twist(
    rotation: &UnitQuaternion<f64>,
    axis: &Unit<Vector3<f64>>,
) -> (UnitQuaternion<f64>, f64) {
    let across = rotation * Vector3::ith(axis.iamin(), 1.0);
    let twist = across.y.atan2(across.x);
    (UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -twist) * rotation, twist)
}
