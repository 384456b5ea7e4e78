//! Distances between shapes in the sampled configurations (SPEC 9.3), recomputed from the modules: mesh files, boxes and
//! spheres, kinematics. The number of configurations depends on counted work: see [`samples`].

use nalgebra::Vector3;

use super::samples::{self, Poses, Work};
use crate::skip;
use crate::solids::Solids;
use crate::tolerance::{distance_tolerance, reach};
use crate::views::enclosure::Fit;
use urdd_document::shape_matrices::{Statistics, at, statistics};
use urdd_document::shapes::{ShapeList, Shapes, Volume, approximations};
use urdd_document::urdd::Urdd;
use urdd_findings::part::SkipReason;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;
use urdd_geometry::convex::{
    ConvexShape, Motion, OrientedBox, PairStatistics, PlacedShape, Sphere, pair_distances,
    pair_ranges, pair_statistics,
};
use urdd_geometry::farthest;
use urdd_kinematics::pose::from_xyz_rpy;

pub struct Distances {
    /// In the order of [`ShapeKind::ALL`]; `None` for a kind without statistics.
    pub kinds: [Option<KindDistances>; 6],
    /// Link poses in the first configurations.
    first: Motion,
    default: Motion,
}

/// The distances of one kind of shapes.
pub struct KindDistances {
    pub shapes: ShapeSet,
    /// Whether these are all configurations of the statistics.
    pub complete: bool,
    /// Where not complete, exact only outside the stated ranges, and without means.
    found: PairStatistics,
}

/// The distances of a pair. Where not all configurations were used, `min` and `max` are exact only outside the stated
/// range, and `mean` is not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Mean distance, m.
    pub mean: f64,
    /// Smallest distance, m.
    pub min: f64,
    /// Largest distance, m.
    pub max: f64,
}

impl Distances {
    /// Recomputes the statistics of a URDD of version 1, as far as the allowed work permits.
    ///
    /// # Errors
    /// Why there is nothing to compare with.
    pub fn new(urdd: &Urdd, solids: &Solids, deep: bool) -> Result<Self, SkipReason> {
        let recorded = urdd
            .document(ModuleKind::LinkShapesDistanceStatistics)
            .and_then(statistics)
            .ok_or(skip::STATISTICS_UNUSABLE)?;
        let mut stated = recorded.iter().flatten();
        let num_samples = stated.find_map(|one| one.num_samples).ok_or(skip::SAMPLES_UNKNOWN)?;
        if num_samples == 0 {
            return Err(skip::NO_SAMPLES);
        }
        let poses = Poses::new(urdd)?;
        let shapes = Shapes::new(urdd).ok_or(skip::NO_SHAPES)?;
        let sets: Vec<Option<ShapeSet>> = (ShapeKind::ALL.into_iter().zip(&recorded))
            .map(|(kind, one)| one.map(|_| ShapeSet::new(urdd, solids, &shapes, kind, true)))
            .collect();
        let work: Vec<Option<Work>> =
            sets.iter().map(|set| set.as_ref().map(|set| set.work(&poses))).collect();
        let configurations = samples::configurations(&work, num_samples, samples::budget(deep));

        let default = poses.default_motion()?;
        let first = poses.motion(0..num_samples.min(samples::AT_ONCE))?;
        let mut kinds: [Option<KindDistances>; 6] = Default::default();
        let planned = recorded.iter().zip(sets).zip(configurations);
        for (kind, ((stated, set), n)) in kinds.iter_mut().zip(planned) {
            let (Some(stated), Some(shapes)) = (stated, set) else { continue };
            let complete = n == num_samples;
            let found = over(&poses, &first, n, |motion| {
                if complete { shapes.statistics(motion) } else { shapes.ranges(motion, stated) }
            })?;
            *kind = Some(KindDistances { shapes, complete, found });
        }
        Ok(Distances { kinds, first, default })
    }

    /// The distances of all pairs in the default configuration, by the indices of [`ShapeSet::place`].
    pub fn at_default_configuration(&self, kind: &KindDistances) -> Vec<Vec<f64>> {
        kind.shapes.statistics(&self.default).min
    }

    /// The first of the configurations in which the distance of a pair satisfies `outside`, and that distance.
    pub fn find(
        &self,
        kind: &KindDistances,
        (i, j): (usize, usize),
        outside: impl Fn(f64) -> bool,
    ) -> Option<(usize, f64)> {
        let each = kind.shapes.pair(i, j, &self.first)?.into_iter();
        each.enumerate().find(|(_, distance)| outside(*distance))
    }
}

impl KindDistances {
    /// The distances of a pair; `None` if one of the two shapes is unsound, which other rules report.
    pub fn pair(&self, i: usize, j: usize) -> Option<Found> {
        let (i, j) = (self.shapes.place(i)?, self.shapes.place(j)?);
        let at = |rows: &[Vec<f64>]| rows.get(i)?.get(j).copied();
        Some(Found {
            mean: at(&self.found.mean)?,
            min: at(&self.found.min)?,
            max: at(&self.found.max)?,
        })
    }
}

/// The statistics over the first `n` configurations, some of which are in `first`.
fn over(
    poses: &Poses,
    first: &Motion,
    n: u32,
    statistics: impl Fn(&Motion) -> PairStatistics,
) -> Result<PairStatistics, SkipReason> {
    if n as usize == first.num_samples() {
        return Ok(statistics(first));
    }
    let mut all = PairStatistics::default();
    let mut start = 0;
    while start < n {
        let end = n.min(start + samples::AT_ONCE);
        let part = statistics(&poses.motion(start..end)?);
        match start {
            0 => all = part,
            _ => join(&mut all, &part, start, end),
        }
        start = end;
    }
    Ok(all)
}

/// Adds the statistics of configurations `start..end`.
pub fn join(all: &mut PairStatistics, part: &PairStatistics, start: u32, end: u32) {
    let weight = f64::from(end - start) / f64::from(end);
    let each = |into: &mut [Vec<f64>], from: &[Vec<f64>], put: &dyn Fn(&mut f64, f64)| {
        let pairs = into.iter_mut().flatten().zip(from.iter().flatten());
        pairs.for_each(|(into, from)| put(into, *from));
    };
    each(&mut all.mean, &part.mean, &|into, from| {
        *into += (from - *into) * weight;
    });
    each(&mut all.min, &part.min, &|into, from| *into = into.min(from));
    each(&mut all.max, &part.max, &|into, from| *into = into.max(from));
}

/// The existing, sound shapes of a kind.
pub struct ShapeSet {
    pub kind: ShapeKind,
    /// Index in the list of each shape.
    places: Vec<Option<usize>>,
    list: List,
}

enum List {
    Hulls(Vec<PlacedShape<ConvexShape>>),
    Boxes(Vec<PlacedShape<OrientedBox>>),
    Spheres(Vec<PlacedShape<Sphere>>),
}

/// The same of a list, whatever its shapes.
macro_rules! of_list {
    ($list:expr, $of:ident => $same:expr) => {
        match $list {
            List::Hulls($of) => $same,
            List::Boxes($of) => $same,
            List::Spheres($of) => $same,
        }
    };
}

impl ShapeSet {
    /// Leaves out unreadable hulls and pieces and, if only `fitting` ones are wanted, boxes and spheres that do not fit
    /// theirs (SHP017, SHP018).
    pub fn new(
        urdd: &Urdd,
        solids: &Solids,
        shapes: &Shapes,
        kind: ShapeKind,
        fitting: bool,
    ) -> Self {
        let volumes = volumes(urdd, kind);
        let mesh = |link, piece| solids.sound(kind.meshes(), link, piece);
        let volume = |link: usize, piece: usize| {
            let volume = volumes.as_ref()?.links.get(link)?.get(piece)?;
            let mesh = mesh(link, piece).filter(|_| fitting);
            let sound = mesh.is_none_or(|mesh| Fit::new(volume, mesh).is_tight(mesh));
            sound.then_some(*volume)
        };
        let mut places = Vec::new();
        let list = match kind {
            ShapeKind::Hulls | ShapeKind::Pieces => {
                let hull = |link, piece| ConvexShape::new(mesh(link, piece)?).ok();
                List::Hulls(placed(shapes, kind, hull, &mut places))
            }
            ShapeKind::Spheres | ShapeKind::PieceSpheres => {
                let sphere = |link, piece| sphere(volume(link, piece)?);
                List::Spheres(placed(shapes, kind, sphere, &mut places))
            }
            ShapeKind::Boxes | ShapeKind::PieceBoxes => {
                let cuboid = |link, piece| cuboid(volume(link, piece)?);
                List::Boxes(placed(shapes, kind, cuboid, &mut places))
            }
        };
        ShapeSet { kind, places, list }
    }

    /// Index of a shape in the matrices of [`ShapeSet::statistics`].
    pub fn place(&self, shape: usize) -> Option<usize> {
        self.places.get(shape).copied().flatten()
    }

    /// The work of all distances.
    pub fn work(&self, poses: &Poses) -> Work {
        let bodies: Vec<usize> =
            of_list!(&self.list, list => list.iter().map(|placed| placed.body).collect());
        let one = match &self.list {
            List::Hulls(_) => samples::HULL,
            List::Boxes(_) => samples::BOX,
            List::Spheres(_) => 1,
        };
        let mut work = Work { once: 0, each: poses.num_links() as u64 * samples::POSE };
        for (i, a) in bodies.iter().enumerate() {
            for b in &bodies[i + 1..] {
                if poses.is_rigid(*a, *b) { work.once += one } else { work.each += one }
            }
        }
        work
    }

    pub fn statistics(&self, motion: &Motion) -> PairStatistics {
        // Every shape is on a link, and the motion contains all links.
        of_list!(&self.list, list => pair_statistics(list, motion)).unwrap_or_default()
    }

    /// The smallest and largest distances of all pairs: exact where they are outside the stated ones.
    pub fn ranges(&self, motion: &Motion, stated: &Statistics) -> PairStatistics {
        let shapes: Vec<usize> =
            (0..self.places.len()).filter(|shape| self.place(*shape).is_some()).collect();
        let range = |i: usize, j: usize| {
            let (i, j) = (*shapes.get(i)?, *shapes.get(j)?);
            Some([at(stated.min, i, j)?, at(stated.max, i, j)?])
        };
        of_list!(&self.list, list => pair_ranges(list, motion, range)).unwrap_or_default()
    }

    /// The distance of a pair in each configuration.
    pub fn pair(&self, i: usize, j: usize, motion: &Motion) -> Option<Vec<f64>> {
        let (i, j) = (self.place(i)?, self.place(j)?);
        of_list!(&self.list, list => pair_distances(list.get(i)?, list.get(j)?, motion))
    }
}

/// The boxes or spheres of a kind.
fn volumes(urdd: &Urdd, kind: ShapeKind) -> Option<ShapeList<Volume>> {
    let lists = approximations(urdd.document(ModuleKind::LinkShapesApproximations)?)?;
    lists.into_iter().find(|list| list.kind == kind)
}

/// The shapes of a kind that can be made of link and piece. `places` gets the index among them of each shape.
fn placed<T>(
    shapes: &Shapes,
    kind: ShapeKind,
    make: impl Fn(usize, usize) -> Option<T>,
    places: &mut Vec<Option<usize>>,
) -> Vec<PlacedShape<T>> {
    let mut list = Vec::new();
    places.extend((0..shapes.count(kind)).map(|shape| {
        let (body, piece) = shapes.place(kind, shape)?;
        let shape = make(body, piece)?;
        list.push(PlacedShape { body, shape });
        Some(list.len() - 1)
    }));
    list
}

fn sphere(volume: Volume) -> Option<Sphere> {
    let Volume::Sphere { radius, offset } = volume else { return None };
    Sphere::new(Vector3::from(offset), radius).ok()
}

fn cuboid(volume: Volume) -> Option<OrientedBox> {
    let Volume::Box { half_extents, offset, rpy } = volume else { return None };
    OrientedBox::new(from_xyz_rpy(offset, rpy), half_extents).ok()
}

/// The tolerances of the distances of one kind of shapes (SPEC 8.5).
pub struct Tolerances {
    /// The robot's reach, m.
    reach: f64,
    /// Reach of each shape from its link's origin, m.
    shapes: Vec<f64>,
}

impl Tolerances {
    /// For the shapes of a kind. A missing shape, which other rules report, adds nothing.
    pub fn new(urdd: &Urdd, solids: &Solids, shapes: &Shapes, kind: ShapeKind) -> Self {
        let volumes = volumes(urdd, kind);
        let of_shape = |shape: usize| -> Option<f64> {
            let (link, piece) = shapes.place(kind, shape)?;
            Some(match kind.is_convex_mesh() {
                true => farthest::of_mesh(solids.sound(kind.meshes(), link, piece)?),
                false => volumes.as_ref()?.links.get(link)?.get(piece)?.reach(),
            })
        };
        let robot = urdd.robot().zip(urdd.tree());
        Tolerances {
            reach: robot.map_or(0.0, |(robot, tree)| reach(robot, tree)),
            shapes: (0..shapes.count(kind)).map(|shape| of_shape(shape).unwrap_or(0.0)).collect(),
        }
    }

    /// Tolerance of the distances of two shapes, m.
    pub fn pair(&self, i: usize, j: usize) -> f64 {
        let of = |shape: usize| self.shapes.get(shape).copied().unwrap_or(0.0);
        distance_tolerance(self.reach, of(i) + of(j))
    }
}
