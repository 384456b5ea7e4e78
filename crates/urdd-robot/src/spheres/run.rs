//! A block of configurations through the steps of a robot: where its frames are.

use fearless_simd::{Simd, f64x8, prelude::*};

use super::tape::{Frame, Input, StepMotion, Tape};
use crate::lanes::{LANES, MOST_ANGLE, Row, Vec3, WideRow, narrow, sin_cos, splat};
use urdd_kinematics::rotation::from_rotation_vector;

/// The values of the DOFs: one row for each.
pub type Values<'a> = &'a [WideRow];

/// Where the frames are, for each lane; kept from one block to the next.
#[derive(Debug, Default)]
pub struct Frames {
    /// The sine and the cosine of each angle.
    angles: Vec<[Row; 2]>,
    lengths: Vec<Row>,
    balls: Vec<[[Row; 3]; 3]>,
    /// Columns.
    rotations: Vec<[[Row; 3]; 3]>,
    origins: Vec<[Row; 3]>,
    /// The sum of the lengths of all slides, in the lane in which it is largest, m.
    pub slides: f32,
}

impl Frames {
    /// Makes room for a robot; the root's frame is the identity.
    pub fn fit(&mut self, tape: &Tape) {
        self.angles.resize(tape.angles.len(), Default::default());
        self.lengths.resize(tape.lengths.len(), Default::default());
        self.balls.resize(tape.balls.len(), Default::default());
        self.rotations.resize(tape.num_rotations, Default::default());
        self.origins.resize(tape.num_origins, Default::default());
        let [one, zero] = [Row([1.0; LANES]), Row::default()];
        self.rotations[0] = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        self.origins[0] = [zero; 3];
    }

    #[inline(always)]
    pub fn run<S: Simd>(&mut self, simd: S, tape: &Tape, values: Values) {
        self.read(simd, tape, values);
        for step in &tape.steps {
            let before = &self.rotations[step.from.rotation];
            let origin = Vec3::load(simd, &self.origins[step.from.origin]);
            let mut origin = along(simd, origin, before, step.shift);
            let turned = match &step.motion {
                StepMotion::Turn { columns: [a, b, c], is_reversed, angle } => {
                    let x = Vec3::load(simd, &before[*a]);
                    let y = Vec3::load(simd, &before[*b]);
                    let z = Vec3::load(simd, &before[*c]);
                    let z = if *is_reversed { z.negated() } else { z };
                    Some(self.turned(simd, x, y, z, *angle))
                }
                StepMotion::TurnAny { rotation, angle } => {
                    let [x, y, z] = product(simd, &loaded(simd, before), rotation);
                    Some(self.turned(simd, x, y, z, *angle))
                }
                StepMotion::Slide { axis, length } => {
                    let length = self.lengths[*length].load(simd);
                    let axis = rotated(simd, &loaded(simd, before), *axis);
                    origin = origin.plus(axis.scale(length));
                    None
                }
                StepMotion::Ball { rotation, ball } => {
                    let constant = product(simd, &loaded(simd, before), rotation);
                    let [x, y, z] = loaded(simd, &self.balls[*ball]);
                    Some([within(&constant, x), within(&constant, y), within(&constant, z)])
                }
            };
            if let Some(columns) = turned {
                let [x, y, z] = columns;
                self.rotations[step.to.rotation] = [x.store(), y.store(), z.store()];
            }
            self.origins[step.to.origin] = origin.store();
        }
    }

    /// Two columns, turned about the third.
    #[inline(always)]
    fn turned<S: Simd>(
        &self,
        simd: S,
        x: Vec3<S>,
        y: Vec3<S>,
        z: Vec3<S>,
        angle: usize,
    ) -> [Vec3<S>; 3] {
        let [sin, cos] = &self.angles[angle];
        let (sin, cos) = (sin.load(simd), cos.load(simd));
        [x.scale(cos).plus(y.scale(sin)), y.scale(cos).minus(x.scale(sin)), z]
    }

    #[inline(always)]
    fn read<S: Simd>(&mut self, simd: S, tape: &Tape, values: Values) {
        for (to, input) in self.angles.iter_mut().zip(&tape.angles) {
            let mut angle = value(simd, input, values);
            if !angle.abs().simd_le(MOST_ANGLE).all_true() {
                angle = reduced(simd, angle);
            }
            let [sin, cos] = sin_cos(simd, angle);
            *to = [Row::of(sin), Row::of(cos)];
        }
        self.slides = 0.0;
        if !tape.lengths.is_empty() {
            let mut sum = splat(simd, 0.0);
            for (to, input) in self.lengths.iter_mut().zip(&tape.lengths) {
                let length = narrow(value(simd, input, values));
                sum += length.abs();
                *to = Row::of(length);
            }
            self.slides = sum.reduce_max_precise();
        }
        for (to, dofs) in self.balls.iter_mut().zip(&tape.balls) {
            for lane in 0..LANES {
                let rotation = from_rotation_vector(dofs.map(|dof| values[dof].0[lane]));
                let rotation = rotation.to_rotation_matrix();
                for (k, column) in to.iter_mut().enumerate() {
                    for (j, row) in column.iter_mut().enumerate() {
                        row.0[lane] = rotation[(j, k)] as f32;
                    }
                }
            }
        }
    }

    /// Where a point of a frame is.
    #[inline(always)]
    pub fn point<S: Simd>(&self, simd: S, frame: Frame, point: [f32; 3]) -> Vec3<S> {
        let columns = loaded(simd, &self.rotations[frame.rotation]);
        let turned = rotated(simd, &columns, point);
        Vec3::load(simd, &self.origins[frame.origin]).plus(turned)
    }
}

#[inline(always)]
fn value<S: Simd>(simd: S, input: &Input, values: Values) -> f64x8<S> {
    f64x8::load_array_ref(simd, &values[input.dof].0) * input.multiplier + input.offset
}

/// The same angles, between minus and plus half a turn.
#[inline(never)]
fn reduced<S: Simd>(simd: S, angle: f64x8<S>) -> f64x8<S> {
    let angles = angle.to_array().map(|angle| {
        let (sin, cos) = angle.sin_cos();
        sin.atan2(cos)
    });
    f64x8::load_array(simd, angles)
}

// No closures from here on: what `map` calls is not compiled for the processor's instructions.

#[inline(always)]
fn loaded<S: Simd>(simd: S, columns: &[[Row; 3]; 3]) -> [Vec3<S>; 3] {
    let [x, y, z] = columns;
    [Vec3::load(simd, x), Vec3::load(simd, y), Vec3::load(simd, z)]
}

/// A vector of a frame, in the root's.
#[inline(always)]
fn within<S: Simd>(columns: &[Vec3<S>; 3], v: Vec3<S>) -> Vec3<S> {
    columns[0].scale(v.x).plus(columns[1].scale(v.y)).plus(columns[2].scale(v.z))
}

/// A constant vector of a frame, in the root's.
#[inline(always)]
fn rotated<S: Simd>(simd: S, columns: &[Vec3<S>; 3], v: [f32; 3]) -> Vec3<S> {
    within(columns, Vec3::splat(simd, v))
}

/// The columns of a constant rotation of a frame, in the root's.
#[inline(always)]
fn product<S: Simd>(simd: S, columns: &[Vec3<S>; 3], by: &[[f32; 3]; 3]) -> [Vec3<S>; 3] {
    [rotated(simd, columns, by[0]), rotated(simd, columns, by[1]), rotated(simd, columns, by[2])]
}

/// A point moved by a constant vector of a frame.
#[inline(always)]
fn along<S: Simd>(simd: S, from: Vec3<S>, columns: &[[Row; 3]; 3], shift: [f32; 3]) -> Vec3<S> {
    let mut to = from;
    for (column, by) in columns.iter().zip(shift) {
        if by != 0.0 {
            to = to.plus(Vec3::load(simd, column).scale(splat(simd, by)));
        }
    }
    to
}
