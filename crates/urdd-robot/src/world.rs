//! Obstacles around a robot, and its distances to them.
//!
//! A [`World`] is a list of [`Obstacle`](crate::Obstacle)s: boxes, spheres, capsules, cylinders,
//! hulls, meshes, clouds of points and fields of heights.
//! [`Proximity::world_proximity`] combines a robot's shapes of one kind with a world. [`WorldProximity`] then has the
//! same [`Queries`](crate::Queries) as [`Proximity`]. Skips do not apply: every shape of the robot is tested against every obstacle,
//! except for links that the obstacle ignores.
//!
//! ```
//! use nalgebra::Isometry3;
//! use urdd_robot::{Obstacle, Queries, Robot, ShapeKind, World};
//!
//! # fn ask(urdd: &str) -> Result<(), urdd_robot::RobotError> {
//! let robot = Robot::open(urdd)?;
//! let table = Obstacle::cuboid("table", Isometry3::translation(0.0, 0.0, -0.05), [1.0, 1.0, 0.05])?;
//! let ball = Obstacle::sphere("ball", [0.4, 0.0, 0.3], 0.1)?;
//! let world = World::new([table.ignoring("base_link"), ball]);
//! let proximity = robot.proximity(ShapeKind::Pieces)?;
//! let proximity = proximity.world_proximity(&world)?;
//! let q = robot.configurations()?.zero();
//! if !proximity.in_collision(&q)? {
//!     let nearest = &proximity.nearest(&q, 1)?[0];
//!     println!("{} is {} m from {}", nearest.link, nearest.distance, nearest.obstacle);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! Positions are in the root link's frame, in metres. To move the robot's base, apply the inverse motion to the world.
//!
//! Obstacles that move only move: [`Obstacle::at`](crate::Obstacle::at) and [`WorldProximity::move_obstacles`] prepare nothing again, and the
//! latter does not allocate. A control loop, with `poses` from a tracker:
//!
//! ```
//! # use nalgebra::Isometry3;
//! # use urdd_robot::{Proximity, Queries, RobotError, World};
//! # fn cycle(proximity: &Proximity, world: &World, q: &[f64], poses: &[Isometry3<f64>]) -> Result<(), RobotError> {
//! let mut around = proximity.world_proximity(world)?;
//! // In each cycle:
//! around.move_obstacles(0, poses)?;
//! let distance = around.min_distance(q)?;
//! # Ok(())
//! # }
//! ```

use std::ops::Deref;
use std::sync::Arc;

use arrayvec::ArrayVec;
use nalgebra::Isometry3;

use super::checked::Checked;
use super::error::RobotError;
use super::obstacle::{World, check_moves};
use super::placed_part::{Group, PlacedPart, Tested};
use super::proximity::{Gradient, Proximity, Shape, SweptPair, Waiting, relative, to_root};
use super::workspace::Placed;
use urdd_geometry::convex::across::{self, AT_ONCE, PlacedPair};
use urdd_geometry::vector::norm;
use urdd_kinematics::Travel;

/// The distance between a shape of the robot and an obstacle, and their closest points.
#[derive(Debug, Clone, PartialEq)]
pub struct ObstacleDistance {
    /// The name of the link, or of the attached object.
    pub link: Arc<str>,
    /// The index of the link; for an attached object, of the link that it is attached to.
    pub link_idx: usize,
    /// The index of the body: of the link, or, from the number of links on, of the attached object, as in
    /// [`PairDistance::body_idxs`](crate::PairDistance::body_idxs).
    pub body_idx: usize,
    /// The index of the link's piece; 0 for a hull and its bounding volumes. For an attached object, of its part.
    pub piece: usize,
    /// The name of the obstacle.
    pub obstacle: Arc<str>,
    /// The index of the obstacle in its world.
    pub obstacle_idx: usize,
    /// In metres; 0 if they touch or overlap.
    pub distance: f64,
    /// The closest points, of the link's shape and of the obstacle, in the root link's frame, in metres. If the two
    /// overlap, both are the same point, which is in both.
    pub points: [[f64; 3]; 2],
}

/// The distance of a pair of a shape of the robot and an obstacle, and how it changes.
pub type ObstacleGradient = Gradient<ObstacleDistance>;

/// A robot's shapes and a world, prepared for distance queries.
#[derive(Debug, Clone)]
pub struct WorldProximity<P> {
    proximity: P,
    names: Vec<Arc<str>>,
    /// Those of an obstacle are contiguous.
    parts: Vec<PlacedPart>,
    tested: Arc<Tested>,
}

impl Proximity {
    /// Combines the robot's shapes with a world.
    ///
    /// # Errors
    /// [`RobotError::Unknown`] if an obstacle ignores a link that does not exist.
    pub fn world_proximity(&self, world: &World) -> Result<WorldProximity<&Proximity>, RobotError> {
        WorldProximity::new(self, world)
    }
}

impl<P: Deref<Target = Proximity> + Sync> WorldProximity<P> {
    /// As [`Proximity::world_proximity`], with borrowed or shared shapes.
    pub fn new(proximity: P, world: &World) -> Result<Self, RobotError> {
        let mut parts = Vec::new();
        let mut ignored = Vec::new();
        for (obstacle, one) in world.obstacles.iter().enumerate() {
            let bodies = one.ignored.iter().map(|name| proximity.body(name));
            ignored.push(bodies.collect::<Result<Vec<usize>, RobotError>>()?);
            let placed = one.parts.iter();
            parts.extend(placed.map(|part| PlacedPart::new(obstacle, part.clone(), &one.pose)));
        }
        let tested = Arc::new(Tested::new(&proximity.shapes, &parts, &ignored));
        let names = world.obstacles.iter().map(|one| one.name.clone()).collect();
        Ok(WorldProximity { proximity, names, parts, tested })
    }

    /// Moves the obstacles from `first` on to these poses: their shapes stay, and nothing else is prepared. It does not
    /// allocate. After an error, none has moved.
    ///
    /// # Errors
    /// [`RobotError::OutOfRange`] if there are fewer obstacles; [`RobotError::Obstacle`] as [`Obstacle::at`](crate::Obstacle::at).
    pub fn move_obstacles(
        &mut self,
        first: usize,
        poses: &[Isometry3<f64>],
    ) -> Result<(), RobotError> {
        check_moves(&self.names, first, poses)?;
        for part in &mut self.parts {
            if let Some(pose) = part.obstacle.checked_sub(first).and_then(|k| poses.get(k)) {
                part.place(pose);
            }
        }
        Ok(())
    }

    /// The tested pairs: each shape of the robot, as the indices of its link and piece, with the index of each obstacle
    /// that does not ignore its link. Sorted by shape, then by obstacle.
    pub fn pairs(&self) -> impl Iterator<Item = ([usize; 2], usize)> {
        self.each_tested().map(|[shape, obstacle]| {
            let shape = &self.proximity.shapes[shape];
            ([shape.link, shape.piece], obstacle)
        })
    }

    /// The body of each of the [pairs](WorldProximity::pairs), as [`ObstacleDistance::body_idx`].
    pub fn pair_bodies(&self) -> impl Iterator<Item = usize> {
        self.each_tested().map(|[shape, _]| self.proximity.shapes[shape].owner)
    }

    /// The name of the link of each of the [pairs](WorldProximity::pairs), or of the attached object.
    pub fn pair_names(&self) -> impl Iterator<Item = &str> {
        self.pair_bodies().map(|body| &*self.proximity.names[body])
    }

    /// The shapes of the robot and the obstacles that are tested against each other.
    fn each_tested(&self) -> impl Iterator<Item = [usize; 2]> {
        (0..self.tested.pairs.len()).filter(|pair| self.is_first(*pair)).map(|pair| self.of(pair))
    }

    /// The shape and the obstacle of a pair.
    fn of(&self, pair: usize) -> [usize; 2] {
        let [shape, part] = self.tested.pairs[pair].map(|index| index as usize);
        [shape, self.parts[part].obstacle]
    }

    /// The shape of the robot and the part of an obstacle of a pair.
    fn both(&self, pair: usize) -> (&Shape, &PlacedPart) {
        let [shape, part] = self.tested.pairs[pair].map(|index| index as usize);
        (&self.proximity.shapes[shape], &self.parts[part])
    }

    /// The bounding sphere of the shapes of a group, and its part.
    fn around(&self, placed: &Placed, group: &Group) -> ([f64; 3], f64, &PlacedPart) {
        let link = group.link as usize;
        (placed.around[link], self.proximity.around(link), &self.parts[group.part as usize])
    }

    /// The two in the frame of the shape's link. Of an obstacle that is many copies, one of them.
    fn cores(&self, placed: &Placed, pair: usize, copy: usize) -> PlacedPair<'_> {
        let (own, other) = self.both(pair);
        let mut frame = other.frame;
        if let Some(copies) = &other.part.copies {
            frame[3] = to_root(&frame, copies.centres[copy]);
        }
        let b_in_a = relative(&placed.links[own.link], &frame);
        PlacedPair { a: &own.core, b: &other.part.core, b_in_a }
    }

    /// Asks copies near the shape of a pair, at first those at most `within` (m) from its bounding sphere; `each` gets some of
    /// them with the distances of the cores, and says within what distance the next ones count.
    fn near_copies(
        &self,
        placed: &Placed,
        pair: usize,
        within: f64,
        mut each: impl FnMut(usize, f64) -> f64,
    ) {
        let (own, other) = self.both(pair);
        let Some(copies) = &other.part.copies else { return };
        let centre = other.local(placed.centres[self.tested.pairs[pair][0] as usize]);
        let radius = own.sphere.radius + other.rounding;
        let squared = |within: f64| match within >= 0.0 {
            true => (within + radius) * (within + radius) * (1.0 + 1e-12),
            false => -1.0,
        };
        let mut within = squared(within);
        let mut some: ArrayVec<usize, AT_ONCE> = ArrayVec::new();
        let mut ask = |some: &mut ArrayVec<usize, AT_ONCE>, within: f64| {
            let cores = some.iter().map(|copy| self.cores(placed, pair, *copy));
            let cores: ArrayVec<PlacedPair, AT_ONCE> = cores.collect();
            let mut values = [0.0; AT_ONCE];
            across::distances(self.proximity.level, &cores, &mut values[..cores.len()]);
            let found = some.drain(..).zip(values);
            found.fold(within, |within, (copy, value)| within.min(squared(each(copy, value))))
        };
        copies.near(centre, within, |copy, _| {
            some.push(copy);
            if some.is_full() {
                within = ask(&mut some, within);
            }
            within
        });
        ask(&mut some, within);
    }

    /// The nearest copy of the obstacle of a pair, and the distance of the cores, m.
    fn nearest_copy(&self, placed: &Placed, pair: usize) -> (usize, f64) {
        let mut best = (usize::MAX, f64::INFINITY);
        self.near_copies(placed, pair, f64::INFINITY, |copy, distance| {
            if (distance, copy) < (best.1, best.0) {
                best = (copy, distance);
            }
            best.1
        });
        best
    }

    /// Whether any copy of the obstacle of a pair touches the shape.
    fn any_copy_touches(&self, placed: &Placed, pair: usize) -> bool {
        let radii = self.radii(pair).iter().sum::<f64>();
        let mut touches = false;
        self.near_copies(placed, pair, radii, |_, distance| {
            touches |= distance <= radii;
            if touches { -1.0 } else { radii }
        });
        touches
    }

    fn radii(&self, pair: usize) -> [f64; 2] {
        let (own, other) = self.both(pair);
        [own.radius, other.part.radius]
    }
}

impl<P: Deref<Target = Proximity> + Sync> Checked for WorldProximity<P> {
    type Pair = ObstacleDistance;
    /// There may be very many obstacles.
    const BLOCK: usize = 1;

    fn shapes(&self) -> &Proximity {
        &self.proximity
    }

    fn count(&self) -> usize {
        self.tested.pairs.len()
    }

    fn is_first(&self, pair: usize) -> bool {
        pair == 0 || self.of(pair - 1) != self.of(pair)
    }

    fn num_answers(&self) -> usize {
        self.each_tested().count()
    }

    /// Pairs of a shape of the robot share its rate.
    fn within(&self, _: f64) -> impl Iterator<Item = (usize, usize)> {
        self.tested.pairs.iter().enumerate().map(|(pair, [shape, _])| (pair, *shape as usize))
    }

    fn num_groups(&self) -> usize {
        self.tested.groups.len()
    }

    fn group_bound(&self, placed: &Placed, group: usize) -> f64 {
        let (centre, radius, other) = self.around(placed, &self.tested.groups[group]);
        // Less by more than any rounding error.
        other.bound(centre, radius) - 1e-12
    }

    fn is_group_beyond(&self, placed: &Placed, group: usize, distance: f64) -> bool {
        let (centre, radius, other) = self.around(placed, &self.tested.groups[group]);
        other.is_beyond(centre, radius, distance + 1e-12)
    }

    fn members(&self, group: usize) -> impl Iterator<Item = usize> {
        self.tested.groups[group].pairs()
    }

    fn bound(&self, placed: &Placed, pair: usize) -> f64 {
        let (own, other) = self.both(pair);
        other.bound(placed.centres[self.tested.pairs[pair][0] as usize], own.sphere.radius)
    }

    fn is_beyond(&self, placed: &Placed, pair: usize, distance: f64) -> bool {
        let (own, other) = self.both(pair);
        other.is_beyond(
            placed.centres[self.tested.pairs[pair][0] as usize],
            own.sphere.radius,
            distance,
        )
    }

    fn values(&self, placed: &Placed, pairs: &[usize], values: &mut [f64]) {
        let cores = pairs.iter().map(|pair| self.cores(placed, *pair, 0));
        let cores: ArrayVec<PlacedPair, AT_ONCE> = cores.collect();
        across::distances(self.proximity.level, &cores, values);
        for (value, pair) in values.iter_mut().zip(pairs) {
            if self.both(*pair).1.part.copies.is_some() {
                *value = self.nearest_copy(placed, *pair).1;
            }
            *value = (*value - self.radii(*pair).iter().sum::<f64>()).max(0.0);
        }
    }

    fn touches(&self, placed: &Placed) -> bool {
        let mut waiting = Waiting::new(self.proximity.level);
        let near = self.tested.groups.iter().filter(|group| {
            let (centre, radius, other) = self.around(placed, group);
            !other.is_beyond(centre, radius, 1e-12)
        });
        let near = near.flat_map(|group| group.pairs());
        let mut near = near.filter(|pair| !self.is_beyond(placed, *pair, 0.0));
        near.any(|pair| match self.both(pair).1.part.copies.is_some() {
            true => self.any_copy_touches(placed, pair),
            false => {
                let radii = self.radii(pair).iter().sum();
                waiting.touches_with(self.cores(placed, pair, 0), radii)
            }
        }) || waiting.any_touches()
    }

    fn swept(&self, placed: &Placed, pair: usize) -> SweptPair<'_> {
        let copy = match self.both(pair).1.part.copies.is_some() {
            true => self.nearest_copy(placed, pair).0,
            false => 0,
        };
        SweptPair { cores: self.cores(placed, pair, copy), radii: self.radii(pair) }
    }

    fn links(&self, pair: usize) -> (usize, Option<usize>) {
        (self.both(pair).0.link, None)
    }

    fn found(
        &self,
        _: &Placed,
        pair: usize,
        distance: f64,
        points: [[f64; 3]; 2],
    ) -> ObstacleDistance {
        let (own, other) = self.both(pair);
        ObstacleDistance {
            link: Arc::clone(self.proximity.owner(own)),
            link_idx: own.link,
            body_idx: own.owner,
            piece: own.piece,
            obstacle: self.names[other.obstacle].clone(),
            obstacle_idx: other.obstacle,
            distance,
            points,
        }
    }

    /// One for each shape of the robot.
    fn rates(&self, travel: &Travel) -> Vec<f64> {
        let root = self.proximity.motion.kinematics.root();
        let shapes = self.proximity.shapes.iter();
        let rate = shapes.map(|shape| {
            let radius = norm(shape.sphere.centre) + shape.sphere.radius;
            travel.of_points(shape.link, radius, root)
        });
        rate.collect()
    }

    fn farthest(&self, travel: &Travel) -> f64 {
        self.rates(travel).into_iter().fold(0.0, f64::max)
    }
}
