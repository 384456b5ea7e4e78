//! The spheres of a robot on the frames of its joints, in 32 bits.

use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::Point3;

use super::level::{MOST, Sphere, SphereLevel};
use super::tape::{Frame, Place, ROUNDING, Step, StepMotion, Tape};
use crate::error::RobotError;
use crate::kept::Motion;
use crate::robot::check_link;
use urdd_geometry::bounding_sphere::about_spheres;
use urdd_geometry::convex::Level;
use urdd_geometry::vector::{norm, sub};

/// A centre in its frame and a radius, m.
pub type Ball = [f32; 4];

/// A link with spheres.
#[derive(Debug, Clone)]
pub struct Body {
    pub link: usize,
    pub frame: Frame,
    /// Around all spheres.
    pub around: Ball,
    /// The bodies that are on the same frame.
    pub cluster: usize,
}

/// The bodies of one frame.
#[derive(Debug, Clone)]
pub struct Cluster {
    pub frame: Frame,
    /// Around the spheres of all its bodies.
    pub around: Ball,
}

/// The spheres of one level, by body.
#[derive(Debug, Clone, Default)]
pub struct Balls {
    pub balls: Vec<Ball>,
    /// Where those of each body begin, and the end.
    pub first: Vec<usize>,
}

impl Balls {
    pub fn of(&self, body: usize) -> std::ops::Range<usize> {
        self.first[body]..self.first[body + 1]
    }
}

/// The pairs of bodies of two clusters.
#[derive(Debug, Clone)]
pub struct Group {
    pub clusters: [usize; 2],
    pub pairs: Vec<[usize; 2]>,
}

/// Without spheres.
const NOTHING: Sphere = Sphere { centre: [0.0; 3], radius: 0.0 };

static NUMBER: AtomicU64 = AtomicU64::new(1);

#[derive(Debug)]
pub struct Model {
    /// Another one for each model; not 0.
    pub number: u64,
    pub tape: Tape,
    pub bodies: Vec<Body>,
    /// From coarse to fine.
    pub levels: Vec<Balls>,
    pub clusters: Vec<Cluster>,
    /// The bodies of each cluster.
    pub members: Vec<Vec<usize>>,
    pub groups: Vec<Group>,
    /// What is added to radii for each metre of the slides.
    pub of_slides: f32,
    /// How far a point of a sphere is from the root's origin, at most, but for slides, m.
    pub reach: f64,
    /// For each step, how far a point of a sphere on its frame is from the frame's origin, at most, m.
    pub radii: Vec<f64>,
    /// The largest value of each DOF, rad or m.
    pub most: Vec<f64>,
    pub level: Level,
}

impl Model {
    /// Radii grow by what is rounded if `is_certain`.
    pub fn new(
        motion: &Motion,
        levels: &[SphereLevel],
        pairs: &[[usize; 2]],
        is_certain: bool,
    ) -> Result<Self, RobotError> {
        let kinematics = &motion.kinematics;
        for level in levels {
            level.check(kinematics.num_links())?;
        }
        let finest = levels.last().ok_or(RobotError::Setting("there is no level of spheres"))?;
        let mut wanted = vec![false; kinematics.num_links()];
        for own in finest.links.iter().filter(|own| !own.spheres.is_empty()) {
            wanted[own.link_idx] = true;
        }
        let (tape, places) = Tape::new(kinematics, &wanted);
        let mut model = Model {
            number: NUMBER.fetch_add(1, Ordering::Relaxed),
            radii: vec![0.0; tape.steps.len()],
            most: most(&tape, kinematics.num_dofs()),
            tape,
            bodies: Vec::new(),
            levels: vec![Balls::default(); finer(levels).len()],
            clusters: Vec::new(),
            members: Vec::new(),
            groups: Vec::new(),
            of_slides: 0.0,
            reach: 0.0,
            level: Level::new(),
        };
        for (link, place) in places.iter().enumerate().filter(|(link, _)| wanted[*link]) {
            let Some(place) = place else { continue };
            let around = around(levels, link);
            let placed = |sphere: &Sphere| model_ball(place, sphere, is_certain);
            let (ball, of_slides) = placed(&around);
            model.of_slides = model.of_slides.max(of_slides);
            for (balls, level) in model.levels.iter_mut().zip(finer(levels)) {
                let own = match level.of(link) {
                    [] => std::slice::from_ref(&around),
                    own => own,
                };
                balls.first.push(balls.balls.len());
                balls.balls.extend(own.iter().map(|sphere| placed(sphere).0));
            }
            let farthest = norm(sub(around.centre, [0.0; 3])) + around.radius;
            model.reach = model.reach.max(place.bound.reach_of(farthest)[0]);
            if let Some(step) = place.step {
                model.radii[step] = model.radii[step].max(farthest);
            }
            let cluster = model.clusters.iter().position(|one| one.frame == place.frame);
            let cluster = cluster.unwrap_or(model.clusters.len());
            if cluster == model.clusters.len() {
                model.clusters.push(Cluster { frame: place.frame, around: ball });
            }
            model.bodies.push(Body { link, frame: place.frame, around: ball, cluster });
        }
        for balls in &mut model.levels {
            balls.first.push(balls.balls.len());
        }
        model.members = vec![Vec::new(); model.clusters.len()];
        for (k, body) in model.bodies.iter().enumerate() {
            model.members[body.cluster].push(k);
        }
        for k in 0..model.clusters.len() {
            model.clusters[k].around = model.around_all(k);
        }
        model.pair(pairs, kinematics.num_links())?;
        Ok(model)
    }

    fn pair(&mut self, pairs: &[[usize; 2]], num_links: usize) -> Result<(), RobotError> {
        let mut known = std::collections::HashSet::new();
        for links in pairs {
            for link in links {
                check_link(*link, num_links)?;
            }
            let [a, b] = links.map(|link| self.bodies.iter().position(|body| body.link == link));
            let (Some(a), Some(b)) = (a, b) else { continue };
            if a == b {
                return Err(RobotError::Setting("a pair of spheres is of two links"));
            }
            if !known.insert([a.min(b), a.max(b)]) {
                continue;
            }
            let clusters = [a, b].map(|body| self.bodies[body].cluster);
            let (clusters, pair) = match clusters[0] <= clusters[1] {
                true => (clusters, [a, b]),
                false => ([clusters[1], clusters[0]], [b, a]),
            };
            match self.groups.iter_mut().find(|group| group.clusters == clusters) {
                Some(group) => group.pairs.push(pair),
                None => self.groups.push(Group { clusters, pairs: vec![pair] }),
            }
        }
        Ok(())
    }

    /// A sphere around those of all bodies of a cluster.
    fn around_all(&self, cluster: usize) -> Ball {
        let own = || self.bodies.iter().filter(|body| body.cluster == cluster);
        let mut only = own().map(|body| body.around);
        if let (Some(one), None) = (only.next(), only.next()) {
            return one;
        }
        let wide = |ball: &Ball| Sphere {
            centre: [0, 1, 2].map(|k| f64::from(ball[k])),
            radius: f64::from(ball[3]),
        };
        let bounds: Vec<Sphere> = own().map(|body| wide(&body.around)).collect();
        let found = about_spheres(bounds.iter());
        let Sphere { centre, radius } = found.unwrap_or(NOTHING);
        // More than what is rounded here, and than what the frame's origin adds for the farther centres.
        let radius = radius + (radius + norm(centre) + self.reach) * 64.0 * ROUNDING;
        [centre[0] as f32, centre[1] as f32, centre[2] as f32, radius as f32]
    }

    /// The farthest that a point of a sphere travels on the straight line between two configurations, at most, m.
    ///
    /// A joint that turns by an angle moves a point by at most the angle times its distance from the joint's origin.
    pub fn farthest(&self, ends: [&[f64]; 2], memory: &mut Vec<[f64; 2]>) -> f64 {
        let moved = |dof: usize| (ends[1][dof] - ends[0][dof]).abs();
        memory.clear();
        memory.extend(self.radii.iter().map(|radius| [*radius, 0.0]));
        let mut farthest = 0.0f64;
        for (k, Step { shift, motion, parent, .. }) in self.tape.steps.iter().enumerate().rev() {
            let [distance, below] = memory[k];
            let [mut reach, mut travel] = [norm(shift.map(f64::from)) + distance, below];
            match motion {
                StepMotion::Turn { angle, .. } | StepMotion::TurnAny { angle, .. } => {
                    let input = &self.tape.angles[*angle];
                    travel += (input.multiplier * moved(input.dof)).abs() * distance;
                }
                StepMotion::Slide { length, .. } => {
                    let input = &self.tape.lengths[*length];
                    let at = |end: &[f64]| (input.multiplier * end[input.dof] + input.offset).abs();
                    reach += at(ends[0]).max(at(ends[1]));
                    travel += (input.multiplier * moved(input.dof)).abs();
                }
                StepMotion::Ball { ball, .. } => {
                    travel += norm(self.tape.balls[*ball].map(moved)) * distance;
                }
            }
            match parent {
                Some(parent) => {
                    let above = &mut memory[*parent];
                    *above = [above[0].max(reach), above[1].max(travel)];
                }
                None => farthest = farthest.max(travel),
            }
        }
        farthest
    }
}

/// What each DOF may be, so that no angle and no slide is beyond [`MOST`].
fn most(tape: &Tape, num_dofs: usize) -> Vec<f64> {
    let mut most = vec![MOST; num_dofs];
    for input in tape.angles.iter().chain(&tape.lengths) {
        let own = (MOST - input.offset.abs()) / input.multiplier.abs();
        // Zero times anything is zero.
        most[input.dof] = most[input.dof].min(own);
    }
    most
}

/// The levels that are checked after the spheres around links: level 0 is those if it has one sphere for each link.
fn finer(levels: &[SphereLevel]) -> &[SphereLevel] {
    match levels {
        [first, .., _] if first.links.iter().all(|own| own.spheres.len() <= 1) => &levels[1..],
        _ => levels,
    }
}

/// A sphere around all spheres of a link: the smaller of that of level 0, enlarged where it has to be, and one of ours.
fn around(levels: &[SphereLevel], link: usize) -> Sphere {
    let all = || levels.iter().flat_map(|level| level.of(link));
    let finer = || finer(levels).iter().flat_map(|level| level.of(link));
    let found = about_spheres(finer()).unwrap_or(NOTHING);
    let given = all().next().copied().unwrap_or(found);
    let enlarged = |centre: [f64; 3]| {
        let to = finer().map(|own| norm(sub(own.centre, centre)) + own.radius);
        Sphere { centre, radius: to.fold(0.0, f64::max) * (1.0 + 1e-12) }
    };
    let [given, found] = [given.centre, found.centre].map(enlarged);
    if given.radius <= found.radius { given } else { found }
}

/// A sphere of a link on its frame, and what its radius grows by for each metre of slides.
fn model_ball(place: &Place, sphere: &Sphere, is_certain: bool) -> (Ball, f32) {
    let centre = place.pose * Point3::from(sphere.centre);
    let [fixed, of_slides] = match is_certain {
        true => place.bound.of_point(centre.coords.norm()),
        false => [0.0; 2],
    };
    let grown = if is_certain { 1.0 + 16.0 * ROUNDING } else { 1.0 };
    let radius = (sphere.radius + fixed) * grown;
    ([centre.x as f32, centre.y as f32, centre.z as f32, radius as f32], (of_slides * grown) as f32)
}
