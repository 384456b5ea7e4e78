//! The shapes of one kind, prepared for distances.

use nalgebra::{Isometry3, Translation3, Vector3};

use super::plan::{self, Work};
use super::poses::Poses;
use crate::solids::Solids;
use crate::views::enclosure::Fit;
use urdd_document::shape_matrices::{Statistics, at};
use urdd_document::shapes::{Shapes, Volume, approximations};
use urdd_document::urdd::Urdd;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;
use urdd_geometry::convex::{
    ConvexShape, Motion, OrientedBox, PairStatistics, PlacedShape, Shape, Sphere, pair_distances,
    pair_ranges, pair_statistics,
};
use urdd_kinematics::rotation::from_rpy;

/// The existing, sound shapes of a kind.
pub struct ShapeSet {
    kind: ShapeKind,
    /// Index in the list of each shape.
    places: Vec<Option<usize>>,
    list: List,
}

enum List {
    Hulls(Vec<PlacedShape<ConvexShape>>),
    Boxes(Vec<PlacedShape<OrientedBox>>),
    Spheres(Vec<PlacedShape<Sphere>>),
}

/// A shape.
enum Made {
    Hull(ConvexShape),
    Box(OrientedBox),
    Sphere(Sphere),
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
        let volumes = urdd
            .document(ModuleKind::LinkShapesApproximations)
            .and_then(approximations)
            .and_then(|lists| lists.into_iter().find(|list| list.kind == kind));
        let make = |link: usize, piece: usize| -> Option<Made> {
            let mesh = solids.sound(kind.meshes(), link, piece);
            if kind.is_convex_mesh() {
                return ConvexShape::new(mesh?).ok().map(Made::Hull);
            }
            let volume = volumes.as_ref()?.links.get(link)?.get(piece)?;
            let sound = || mesh.is_none_or(|mesh| Fit::new(volume, mesh).is_tight(mesh));
            if fitting && !sound() {
                return None;
            }
            of_volume(volume)
        };
        let mut set = ShapeSet {
            kind,
            places: Vec::with_capacity(shapes.count(kind)),
            list: List::Hulls(Vec::new()),
        };
        for shape in 0..shapes.count(kind) {
            let made = shapes
                .place(kind, shape)
                .and_then(|(link, piece)| Some((link, make(link, piece)?)));
            let place = made.map(|(link, made)| set.add(link, made));
            set.places.push(place);
        }
        set
    }

    /// Adds a shape of a link and returns its index.
    fn add(&mut self, body: usize, made: Made) -> usize {
        macro_rules! push {
            ($list:ident, $shape:expr) => {{
                let placed = PlacedShape {
                    body,
                    shape: $shape,
                };
                match &mut self.list {
                    List::$list(list) => {
                        list.push(placed);
                        list.len() - 1
                    }
                    // The first element determines the kind of the list.
                    list => {
                        *list = List::$list(vec![placed]);
                        0
                    }
                }
            }};
        }
        match made {
            Made::Hull(shape) => push!(Hulls, shape),
            Made::Box(shape) => push!(Boxes, shape),
            Made::Sphere(shape) => push!(Spheres, shape),
        }
    }

    /// The kind.
    pub fn kind(&self) -> ShapeKind {
        self.kind
    }

    /// Index of a shape in the matrices of [`ShapeSet::statistics`].
    pub fn place(&self, shape: usize) -> Option<usize> {
        self.places.get(shape).copied().flatten()
    }

    /// The work of all distances.
    pub fn work(&self, poses: &Poses) -> Work {
        let (bodies, one) = match &self.list {
            List::Hulls(list) => (bodies(list), plan::HULL),
            List::Boxes(list) => (bodies(list), plan::BOX),
            List::Spheres(list) => (bodies(list), 1),
        };
        let mut work = Work {
            once: 0,
            each: poses.num_links() as u64 * plan::POSE,
        };
        for (i, a) in bodies.iter().enumerate() {
            for b in &bodies[i + 1..] {
                match poses.is_rigid(*a, *b) {
                    true => work.once += one,
                    false => work.each += one,
                }
            }
        }
        work
    }

    /// The statistics of all pairs.
    pub fn statistics(&self, motion: &Motion) -> PairStatistics {
        // Every shape is on a link, and the motion contains all links.
        let statistics = match &self.list {
            List::Hulls(list) => pair_statistics(list, motion),
            List::Boxes(list) => pair_statistics(list, motion),
            List::Spheres(list) => pair_statistics(list, motion),
        };
        statistics.unwrap_or_default()
    }

    /// The smallest and largest distances of all pairs: exact where they are outside the stated ones.
    pub fn ranges(&self, motion: &Motion, stated: &Statistics) -> PairStatistics {
        let shapes: Vec<usize> = (0..self.places.len())
            .filter(|shape| self.place(*shape).is_some())
            .collect();
        let range = |i: usize, j: usize| {
            let (i, j) = (*shapes.get(i)?, *shapes.get(j)?);
            Some([at(stated.min, i, j)?, at(stated.max, i, j)?])
        };
        let ranges = match &self.list {
            List::Hulls(list) => pair_ranges(list, motion, range),
            List::Boxes(list) => pair_ranges(list, motion, range),
            List::Spheres(list) => pair_ranges(list, motion, range),
        };
        ranges.unwrap_or_default()
    }

    /// The distance of a pair in each configuration.
    pub fn pair(&self, i: usize, j: usize, motion: &Motion) -> Option<Vec<f64>> {
        fn of<T: Shape>(
            list: &[PlacedShape<T>],
            i: usize,
            j: usize,
            motion: &Motion,
        ) -> Option<Vec<f64>> {
            pair_distances(list.get(i)?, list.get(j)?, motion)
        }
        let (i, j) = (self.place(i)?, self.place(j)?);
        match &self.list {
            List::Hulls(list) => of(list, i, j, motion),
            List::Boxes(list) => of(list, i, j, motion),
            List::Spheres(list) => of(list, i, j, motion),
        }
    }
}

fn bodies<T>(list: &[PlacedShape<T>]) -> Vec<usize> {
    list.iter().map(|placed| placed.body).collect()
}

fn of_volume(volume: &Volume) -> Option<Made> {
    match *volume {
        Volume::Sphere { radius, offset } => {
            let sphere = Sphere::new(Vector3::from(offset), radius);
            sphere.ok().map(Made::Sphere)
        }
        Volume::Box {
            half_extents,
            offset,
            rpy,
        } => {
            let pose = Isometry3::from_parts(Translation3::from(offset), from_rpy(rpy));
            OrientedBox::new(pose, half_extents).ok().map(Made::Box)
        }
    }
}
