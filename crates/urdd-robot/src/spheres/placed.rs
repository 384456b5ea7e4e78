//! A block of configurations: where the frames and the spheres of a robot are, and which spheres touch.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

use super::model::{Ball, Body, Group, Model};
use super::tape::{Frame, Input, StepMotion, Tape};
use crate::lanes::{
    LANES, MOST_ANGLE, Mask, Point, Row, Vec3, WideRow, bits, narrow, sin_cos, splat,
};
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
            if let Some([x, y, z]) = turned {
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

/// What a thread keeps from one block to the next.
#[derive(Debug, Default)]
pub struct Placed {
    pub frames: Frames,
    /// The centres of the spheres around clusters.
    pub clusters: Vec<Point>,
    /// The centres of the spheres around bodies, and whether they are there.
    pub around: Vec<Point>,
    pub is_around: Vec<bool>,
    /// The centres of the spheres of each level.
    pub centres: Vec<Vec<Point>>,
    /// Whether those of each body are there.
    pub is_placed: Vec<Vec<bool>>,
}

impl Placed {
    pub fn fit(&mut self, model: &Model) {
        self.frames.fit(&model.tape);
        self.clusters.resize(model.clusters.len(), Point::default());
        self.around.resize(model.bodies.len(), Point::default());
        self.is_around.resize(model.bodies.len(), false);
        self.centres.resize_with(model.levels.len(), Vec::new);
        self.is_placed.resize_with(model.levels.len(), Vec::new);
        for ((centres, is_placed), level) in
            self.centres.iter_mut().zip(&mut self.is_placed).zip(&model.levels)
        {
            centres.resize(level.balls.len(), Point::default());
            is_placed.resize(model.bodies.len(), false);
        }
    }
}

/// Which lanes are asked for, and when it is enough.
#[derive(Debug, Clone, Copy)]
pub struct Asked {
    /// A bit for each lane.
    pub lanes: u8,
    /// Whether one lane in contact is enough.
    pub any: bool,
}

impl Asked {
    #[inline(always)]
    pub fn is_done(self, found: u8) -> bool {
        let found = found & self.lanes;
        if self.any { found != 0 } else { found == self.lanes }
    }
}

impl Placed {
    /// Places the frames and the spheres around clusters.
    #[inline(always)]
    pub fn place<S: Simd>(&mut self, simd: S, model: &Model, values: Values) {
        self.frames.run(simd, &model.tape, values);
        for (to, cluster) in self.clusters.iter_mut().zip(&model.clusters) {
            *to = self.frames.point(simd, cluster.frame, centre(&cluster.around)).store();
        }
        self.is_around.fill(false);
        for is_placed in &mut self.is_placed {
            is_placed.fill(false);
        }
    }

    /// The centre of the sphere around a body.
    #[inline(always)]
    pub fn around<S: Simd>(&mut self, simd: S, model: &Model, body: usize) -> Vec3<S> {
        if self.is_around[body] {
            return Vec3::load(simd, &self.around[body]);
        }
        self.is_around[body] = true;
        let Body { frame, around, .. } = &model.bodies[body];
        let found = self.frames.point(simd, *frame, centre(around));
        self.around[body] = found.store();
        found
    }

    /// Places the spheres of a body at a level.
    #[inline(always)]
    pub fn place_level<S: Simd>(&mut self, simd: S, model: &Model, level: usize, body: usize) {
        if self.is_placed[level][body] {
            return;
        }
        self.is_placed[level][body] = true;
        let balls = &model.levels[level];
        let frame = model.bodies[body].frame;
        let range = balls.of(body);
        let own = self.centres[level][range.clone()].iter_mut().zip(&balls.balls[range]);
        for (to, ball) in own {
            *to = self.frames.point(simd, frame, centre(ball)).store();
        }
    }

    /// The lanes in which two bodies touch at the finest level. `grown` is added to the sum of two radii.
    #[inline(always)]
    pub fn pair_touches<S: Simd>(
        &mut self,
        simd: S,
        model: &Model,
        [a, b]: [usize; 2],
        grown: f32,
        asked: Asked,
    ) -> u8 {
        let [around_a, around_b] = [&model.bodies[a].around, &model.bodies[b].around];
        let p = self.around(simd, model, a);
        let q = self.around(simd, model, b);
        let near = touch(simd, p, q, around_a[3] + around_b[3] + grown);
        let mut found = bits(near) & asked.lanes;
        for level in 0..model.levels.len() {
            if found == 0 {
                break;
            }
            let asked = Asked { lanes: found, ..asked };
            found = self.level_touches(simd, model, level, [a, b], grown, asked);
        }
        found
    }

    #[inline(always)]
    fn level_touches<S: Simd>(
        &mut self,
        simd: S,
        model: &Model,
        level: usize,
        [a, b]: [usize; 2],
        grown: f32,
        asked: Asked,
    ) -> u8 {
        self.place_level(simd, model, level, a);
        self.place_level(simd, model, level, b);
        // At a level before the last, each lane counts: the next one may decide otherwise.
        let asked = Asked { any: asked.any && level + 1 == model.levels.len(), ..asked };
        let balls = &model.levels[level];
        let (own, others) = (balls.of(a), balls.of(b));
        let around = self.around(simd, model, b);
        let reach = model.bodies[b].around[3] + grown;
        let mut found = 0;
        for k in own {
            let centre = Vec3::load(simd, &self.centres[level][k]);
            let radius = balls.balls[k][3];
            let near = bits(touch(simd, centre, around, radius + reach)) & asked.lanes & !found;
            if near == 0 {
                continue;
            }
            for j in others.clone() {
                let other = Vec3::load(simd, &self.centres[level][j]);
                let touching = touch(simd, centre, other, radius + balls.balls[j][3] + grown);
                found |= bits(touching) & near;
                if asked.is_done(found) {
                    return found;
                }
            }
        }
        found
    }

    /// The lanes in which bodies of a pair touch.
    #[inline(always)]
    pub fn touches_itself<S: Simd>(
        &mut self,
        simd: S,
        model: &Model,
        margin: f32,
        asked: Asked,
    ) -> u8 {
        let grown = 2.0 * self.slack(model) + margin;
        let mut found = 0;
        for Group { clusters: [a, b], pairs } in &model.groups {
            if margin > 0.0 && a == b {
                continue;
            }
            let mut lanes = asked.lanes & !found;
            if let [_, _, ..] = pairs[..] {
                let p = Vec3::load(simd, &self.clusters[*a]);
                let q = Vec3::load(simd, &self.clusters[*b]);
                let reach = model.clusters[*a].around[3] + model.clusters[*b].around[3] + grown;
                lanes &= bits(touch(simd, p, q, reach));
            }
            for pair in pairs {
                if lanes == 0 {
                    break;
                }
                let touching =
                    self.pair_touches(simd, model, *pair, grown, Asked { lanes, ..asked });
                found |= touching;
                lanes &= !touching;
                if asked.is_done(found) {
                    return found;
                }
            }
        }
        found
    }

    /// What is added to a radius for slides, m.
    #[inline(always)]
    pub fn slack(&self, model: &Model) -> f32 {
        model.of_slides * self.frames.slides
    }
}

#[inline(always)]
pub fn centre(ball: &Ball) -> [f32; 3] {
    [ball[0], ball[1], ball[2]]
}

/// Where two points are at most `reach` apart.
#[inline(always)]
pub fn touch<S: Simd>(simd: S, a: Vec3<S>, b: Vec3<S>, reach: f32) -> Mask<S> {
    a.apart(b).simd_le(splat(simd, reach * reach))
}
