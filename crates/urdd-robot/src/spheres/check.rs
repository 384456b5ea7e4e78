//! A block of configurations against the robot itself: sphere against sphere, from coarse to fine.

use fearless_simd::{Simd, prelude::*};

use super::model::{Ball, Body, Group, Model, Placed};
use super::run::Values;
use crate::lanes::{Mask, Vec3, bits, splat};

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
            found = self.level_touches(
                simd,
                model,
                level,
                [a, b],
                grown,
                Asked { lanes: found, ..asked },
            );
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
