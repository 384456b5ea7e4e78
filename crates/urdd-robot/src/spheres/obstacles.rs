//! Obstacles in 32 bits, and spheres against them.

use std::sync::Arc;

use arrayvec::ArrayVec;
use fearless_simd::{Simd, prelude::*};
use nalgebra::{Isometry3, Point3, UnitQuaternion};

use super::model::{Ball, Model};
use super::placed::{Asked, Placed, touch};
use super::tape::ROUNDING;
use crate::copies::Copies;
use crate::error::RobotError;
use crate::lanes::{LANES, Row, Vec3, bits, splat};
use crate::obstacle::{Form, Obstacle, Part, World, check_moves};
use crate::robot::index;
use urdd_geometry::convex::across::{self, PlacedPair};
use urdd_geometry::convex::{ConvexShape, Level};
use urdd_geometry::vector::norm;

#[derive(Debug, Clone, Default)]
pub struct Obstacles {
    pub names: Vec<Arc<str>>,
    bodies: Vec<Solid>,
    /// Whether radii grow by what is rounded.
    is_certain: bool,
}

/// An obstacle, or a part of one.
#[derive(Debug, Clone)]
struct Solid {
    obstacle: usize,
    form: Kind,
    /// The columns of the rotation of its frame; `None` if it is not turned.
    axes: Option<[[f32; 3]; 3]>,
    origin: [f32; 3],
    /// Around it.
    around: Ball,
    /// What is rounded, for a sphere of the robot, m.
    rounding: f32,
    /// The bodies that may touch it.
    ignored: Arc<[bool]>,
}

#[derive(Debug, Clone)]
enum Kind {
    Ball(f32),
    Box([f32; 3]),
    Capsule { radius: f32, half: f32 },
    Cylinder { radius: f32, half: f32 },
    Convex(Part, Box<ConvexShape>, Isometry3<f64>),
    Copies(Part, Arc<Copies>),
}

impl Obstacles {
    /// # Errors
    /// [`RobotError::Unknown`] if an obstacle ignores a link that does not exist.
    pub fn new(
        model: &Model,
        links: &[String],
        world: &World,
        is_certain: bool,
    ) -> Result<Self, RobotError> {
        let mut made = Obstacles { is_certain, ..Obstacles::default() };
        for (obstacle, one) in world.obstacles.iter().enumerate() {
            made.names.push(Arc::clone(&one.name));
            let mut ignored = vec![false; model.bodies.len()];
            for name in one.ignored.iter() {
                let link = index("link", links, name)?;
                for (body, ignored) in model.bodies.iter().zip(&mut ignored) {
                    *ignored |= body.link == link;
                }
            }
            let ignored: Arc<[bool]> = ignored.into();
            for form in kinds(one)? {
                let mut solid = Solid {
                    obstacle,
                    form,
                    axes: None,
                    origin: [0.0; 3],
                    around: [0.0; 4],
                    rounding: 0.0,
                    ignored: Arc::clone(&ignored),
                };
                solid.place(model, &one.pose, is_certain);
                made.bodies.push(solid);
            }
        }
        Ok(made)
    }

    /// As [`WorldProximity::move_obstacles`](crate::WorldProximity::move_obstacles).
    pub fn place(
        &mut self,
        model: &Model,
        first: usize,
        poses: &[Isometry3<f64>],
    ) -> Result<(), RobotError> {
        check_moves(&self.names, first, poses)?;
        for solid in &mut self.bodies {
            if let Some(pose) = solid.obstacle.checked_sub(first).and_then(|k| poses.get(k)) {
                solid.place(model, pose, self.is_certain);
            }
        }
        Ok(())
    }

    /// The lanes in which the robot touches an obstacle, besides those of `found`.
    #[inline(always)]
    pub fn touching<S: Simd>(
        &self,
        simd: S,
        placed: &mut Placed,
        model: &Model,
        margin: f32,
        asked: Asked,
        found: u8,
    ) -> u8 {
        let mut found = found;
        if self.bodies.is_empty() {
            return found;
        }
        let slack = placed.slack(model) * 2.0 + margin;
        for (cluster, members) in model.members.iter().enumerate() {
            let around = model.clusters[cluster].around;
            let centre = Vec3::load(simd, &placed.clusters[cluster]);
            for solid in &self.bodies {
                let reach = around[3] + solid.around[3] + slack;
                let near = touch(simd, centre, Vec3::splat(simd, solid.centre()), reach);
                let near = bits(near) & asked.lanes & !found;
                if near == 0 {
                    continue;
                }
                let radius = around[3] + slack;
                let asked_near = Asked { lanes: near, any: false };
                let near = solid.touches(simd, model.level, centre, radius, asked_near);
                if near == 0 {
                    continue;
                }
                for body in members {
                    let lanes = near & !found;
                    if lanes == 0 || solid.ignored[*body] {
                        continue;
                    }
                    let asked_of = Asked { lanes, ..asked };
                    found |= placed.body_touches(simd, model, solid, *body, slack, asked_of);
                    if asked.is_done(found) {
                        return found;
                    }
                }
            }
        }
        found
    }
}

impl Placed {
    /// The lanes in which a body touches an obstacle at the finest level.
    #[inline(always)]
    fn body_touches<S: Simd>(
        &mut self,
        simd: S,
        model: &Model,
        solid: &Solid,
        body: usize,
        slack: f32,
        asked: Asked,
    ) -> u8 {
        let centre = self.around(simd, model, body);
        let radius = model.bodies[body].around[3] + slack;
        let mut lanes =
            solid.touches(simd, model.level, centre, radius, Asked { any: false, ..asked });
        for (level, balls) in model.levels.iter().enumerate() {
            if lanes == 0 {
                return 0;
            }
            self.place_level(simd, model, level, body);
            let asked = Asked { lanes, any: asked.any && level + 1 == model.levels.len() };
            let mut found = 0;
            for k in balls.of(body) {
                let centre = Vec3::load(simd, &self.centres[level][k]);
                let lanes = lanes & !found;
                let asked_of = Asked { lanes, ..asked };
                found |=
                    solid.touches(simd, model.level, centre, balls.balls[k][3] + slack, asked_of);
                if asked.is_done(found) {
                    break;
                }
            }
            lanes = found;
        }
        lanes
    }
}

impl Solid {
    fn place(&mut self, model: &Model, pose: &Isometry3<f64>, is_certain: bool) {
        let rotation = pose.rotation.to_rotation_matrix();
        let column = |k: usize| [0, 1, 2].map(|j| rotation[(j, k)] as f32);
        let is_turned = pose.rotation != UnitQuaternion::identity();
        self.axes = is_turned.then(|| [column(0), column(1), column(2)]);
        let (centre, radius) = match &mut self.form {
            Kind::Ball(radius) => ([0.0; 3], f64::from(*radius)),
            Kind::Box(half) => ([0.0; 3], norm(half.map(f64::from))),
            Kind::Capsule { radius, half } => ([0.0; 3], f64::from(*radius) + f64::from(*half)),
            Kind::Cylinder { radius, half } => {
                ([0.0; 3], f64::from(*radius).hypot(f64::from(*half)))
            }
            Kind::Convex(part, _, to) => {
                *to = *pose;
                (part.sphere.centre, part.sphere.radius)
            }
            Kind::Copies(part, _) => (part.sphere.centre, part.sphere.radius),
        };
        // The frame of copies is where their tree is.
        let origin = match &self.form {
            Kind::Copies(_, copies) => copies.middle,
            _ => [0.0; 3],
        };
        let placed = |p: [f64; 3]| pose * Point3::from(p);
        let (origin, centre) = (placed(origin), placed(centre));
        self.origin = [0, 1, 2].map(|k| origin[k] as f32);
        let size = origin.coords.norm() + centre.coords.norm() + radius + model.reach;
        self.rounding = if is_certain { (32.0 * ROUNDING * size) as f32 } else { 0.0 };
        let radius = radius as f32 + self.rounding;
        self.around = [centre.x as f32, centre.y as f32, centre.z as f32, radius];
    }

    #[inline(always)]
    fn centre(&self) -> [f32; 3] {
        [self.around[0], self.around[1], self.around[2]]
    }

    /// The lanes in which a sphere touches it.
    #[inline(always)]
    fn touches<S: Simd>(
        &self,
        simd: S,
        level: Level,
        centre: Vec3<S>,
        radius: f32,
        asked: Asked,
    ) -> u8 {
        if let Kind::Ball(_) = self.form {
            let around = Vec3::splat(simd, self.centre());
            return bits(touch(simd, centre, around, radius + self.around[3])) & asked.lanes;
        }
        let from = centre.minus(Vec3::splat(simd, self.origin));
        let local = match &self.axes {
            None => from,
            Some([x, y, z]) => Vec3 {
                x: from.dot(Vec3::splat(simd, *x)),
                y: from.dot(Vec3::splat(simd, *y)),
                z: from.dot(Vec3::splat(simd, *z)),
            },
        };
        let reach = radius + self.rounding;
        let zero = splat(simd, 0.0);
        let apart = match &self.form {
            Kind::Ball(_) => zero,
            Kind::Box(half) => {
                let x = (local.x.abs() - half[0]).max(zero);
                let y = (local.y.abs() - half[1]).max(zero);
                let z = (local.z.abs() - half[2]).max(zero);
                x * x + y * y + z * z
            }
            Kind::Capsule { radius, half } => {
                let z = (local.z.abs() - *half).max(zero);
                let apart = local.x * local.x + local.y * local.y + z * z;
                let reach = reach + radius;
                return bits(apart.simd_le(splat(simd, reach * reach))) & asked.lanes;
            }
            Kind::Cylinder { radius, half } => {
                let z = (local.z.abs() - *half).max(zero);
                let across = (local.x * local.x + local.y * local.y).sqrt();
                let across = (across - *radius).max(zero);
                across * across + z * z
            }
            Kind::Convex(part, point, pose) => {
                let near = self.near(simd, centre, radius) & asked.lanes;
                return match near {
                    0 => 0,
                    near => {
                        convex(level, part, point, pose, &centre.store(), f64::from(reach), near)
                    }
                };
            }
            Kind::Copies(part, copies) => {
                let near = self.near(simd, centre, radius) & asked.lanes;
                let mut found = 0;
                let (local, mut left) = (local.store(), near);
                while left != 0 {
                    let lane = left.trailing_zeros() as usize;
                    left &= left - 1;
                    let point = [local[0].0[lane], local[1].0[lane], local[2].0[lane]];
                    let touches = copies.any_touches(simd, point, reach + part.radius as f32);
                    found |= u8::from(touches) << lane;
                    if asked.is_done(found) {
                        break;
                    }
                }
                return found;
            }
        };
        bits(apart.simd_le(splat(simd, reach * reach))) & asked.lanes
    }

    #[inline(always)]
    fn near<S: Simd>(&self, simd: S, centre: Vec3<S>, radius: f32) -> u8 {
        let around = Vec3::splat(simd, self.centre());
        bits(touch(simd, centre, around, radius + self.around[3]))
    }
}

/// The lanes of `near` in which a sphere touches a convex part, exactly.
#[inline(never)]
fn convex(
    level: Level,
    part: &Part,
    point: &ConvexShape,
    pose: &Isometry3<f64>,
    centre: &[Row; 3],
    reach: f64,
    near: u8,
) -> u8 {
    let mut lanes: ArrayVec<usize, LANES> = ArrayVec::new();
    let mut pairs: ArrayVec<PlacedPair, LANES> = ArrayVec::new();
    for lane in (0..LANES).filter(|lane| near >> lane & 1 != 0) {
        let at = [0, 1, 2].map(|k| f64::from(centre[k].0[lane]));
        let local = pose.inverse_transform_point(&Point3::from(at));
        let [x, y, z] = [local.x, local.y, local.z];
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let b_in_a = [axes[0], axes[1], axes[2], [x, y, z]];
        lanes.push(lane);
        pairs.push(PlacedPair { a: &part.core, b: point, b_in_a });
    }
    let mut apart = [0.0; LANES];
    across::distances(level, &pairs, &mut apart[..pairs.len()]);
    let touches = lanes.iter().zip(apart).filter(|(_, apart)| *apart <= reach + part.radius);
    touches.fold(0, |found, (lane, _)| found | 1 << lane)
}

fn kinds(one: &Obstacle) -> Result<Vec<Kind>, RobotError> {
    let kind = match one.form {
        Form::Box(half) => Kind::Box(half.map(|x| x as f32)),
        Form::Sphere(radius) => Kind::Ball(radius as f32),
        Form::Capsule { radius, half } => {
            Kind::Capsule { radius: radius as f32, half: half as f32 }
        }
        Form::Cylinder { radius, half } => {
            Kind::Cylinder { radius: radius as f32, half: half as f32 }
        }
        Form::Parts => {
            let kind = |part: &Part| match &part.copies {
                Some(copies) => Ok(Kind::Copies(part.clone(), Arc::clone(copies))),
                None => {
                    let point = ConvexShape::of_points(&[[0.0; 3]]);
                    let point = point.map_err(|error| crate::obstacle::fault(&one.name, &error))?;
                    Ok(Kind::Convex(part.clone(), Box::new(point), Isometry3::identity()))
                }
            };
            return one.parts.iter().map(kind).collect();
        }
    };
    Ok(vec![kind])
}
