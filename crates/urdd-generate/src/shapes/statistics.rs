//! `link_shapes_distance_statistics_module`: SPEC 8.5.

use nalgebra::{Isometry3, Translation3, Vector3};
use rayon::prelude::*;

use super::rounding::seven_digits;
use super::{ConvexMeshes, MOST_PIECES_WITH_MATRICES};
use crate::meshes::written::WrittenMesh;
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::dof::DofModule;
use urdd_format::index::Count;
use urdd_format::link_shapes_approximations::{
    BoundingSphere, LinkShapesApproximationsModule, Obb,
};
use urdd_format::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule,
};
use urdd_format::urdf::JointType;
use urdd_geometry::convex::{
    ConvexShape, Motion, OrientedBox, PairStatistics, PlacedShape, ShapeError, ShapeList, Sphere,
    statistics_of_kinds,
};
use urdd_kinematics::rotation::from_rpy;
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics};

/// One value per kind of shape, in the order of the documents: hulls, boxes and spheres of links, then those of pieces
/// if the robot has matrices over pieces.
pub(crate) struct Kinds<T> {
    pub full: [T; 3],
    pub pieces: Option<[T; 3]>,
}

/// Builds the module, or returns the reason why it cannot be built.
///
/// # Errors
/// If cancelled.
pub(crate) fn statistics(
    solids: &ConvexMeshes,
    shapes: &Shapes,
    (dof, chain, bounds): Kinematics,
    num_samples: u32,
    cancellation: &Cancellation,
) -> Result<Result<LinkShapesDistanceStatisticsModule, String>, Cancelled> {
    let found = sampled(shapes, (dof, chain, bounds), num_samples, cancellation);
    cancellation.check()?;
    Ok(found.map(|found| module(solids, num_samples, found)))
}

/// The statistics of all pairs; invalid after a cancellation.
fn sampled(
    shapes: &Shapes,
    (dof, chain, bounds): Kinematics,
    num_samples: u32,
    cancellation: &Cancellation,
) -> Result<Kinds<PairStatistics>, String> {
    let space =
        ConfigurationSpace::new(dof, chain, &bounds.bounds).map_err(|error| error.to_string())?;
    let configuration = |sample: u32| {
        let name = format!("sampled configuration {sample}");
        (name, space.sampled(u64::from(sample)))
    };
    let configurations = (0..num_samples).into_par_iter().map(configuration);
    let motion = motion(dof, chain, configurations)?;
    Ok(over(&motion, shapes, cancellation))
}

fn module(
    solids: &ConvexMeshes,
    num_samples: u32,
    found: Kinds<PairStatistics>,
) -> LinkShapesDistanceStatisticsModule {
    let matrices = |pairs: PairStatistics| DistanceStatistics {
        mean_distances: to_seven_digits(pairs.mean),
        min_distances: to_seven_digits(pairs.min),
        max_distances: to_seven_digits(pairs.max),
    };
    let [full_convex_hulls, full_obbs, full_bounding_spheres] = found.full.map(matrices);
    let pieces = found.pieces.map(|pieces| pieces.map(|one| Some(matrices(one))));
    let [decomposition_convex_hulls, decomposition_obbs, decomposition_bounding_spheres] =
        pieces.unwrap_or_default();
    LinkShapesDistanceStatisticsModule {
        num_samples: Count(num_samples),
        full_shapes: solids.full_shapes(),
        decomposition_shapes: solids.decomposition_shapes(),
        full_convex_hulls,
        full_obbs,
        full_bounding_spheres,
        decomposition_convex_hulls,
        decomposition_obbs,
        decomposition_bounding_spheres,
    }
}

/// The distances in the default configuration (SPEC 9.4), metres.
pub(crate) fn at_default_configuration(
    shapes: &Shapes,
    (dof, chain, bounds): Kinematics,
) -> Result<Kinds<Vec<Vec<f64>>>, String> {
    let space =
        ConfigurationSpace::new(dof, chain, &bounds.bounds).map_err(|error| error.to_string())?;
    let name = "the default configuration".to_owned();
    let configuration = [(name, space.default_configuration())];
    let motion = motion(dof, chain, configuration.into_par_iter())?;
    let never = Cancellation::default();
    let found = over(&motion, shapes, &never);
    // With one configuration, minimum, mean and maximum are all the distance.
    let distances = |pairs: PairStatistics| pairs.min;
    Ok(Kinds {
        full: found.full.map(distances),
        pieces: found.pieces.map(|pieces| pieces.map(distances)),
    })
}

/// The modules from which sampled configurations and link poses are computed.
pub(crate) type Kinematics<'a> = (&'a DofModule, &'a ChainModule, &'a BoundsModule);

/// The shapes of one kind.
type Placed<S> = Vec<PlacedShape<S>>;

/// Hulls, boxes and spheres, of links or of pieces.
type Three = (Placed<ConvexShape>, Placed<OrientedBox>, Placed<Sphere>);

/// All shapes, prepared for distances.
pub(crate) struct Shapes {
    full: Three,
    /// `None` if there are too many pieces.
    pieces: Option<Three>,
}

impl Shapes {
    /// Prepares the shapes, or returns the reason why one cannot be used.
    pub fn new(
        solids: &ConvexMeshes,
        of: &LinkShapesApproximationsModule,
        chain: &ChainModule,
    ) -> Result<Self, String> {
        let with_pieces = solids.decomposition_shapes().len() <= MOST_PIECES_WITH_MATRICES;
        let full = (
            placed(solids.hulls, chain, of_mesh)?,
            placed(&of.full_obbs, chain, of_box)?,
            placed(&of.full_bounding_spheres, chain, of_sphere)?,
        );
        let pieces = with_pieces.then(|| {
            let pieces = placed(solids.pieces, chain, of_mesh)?;
            let boxes = placed(&of.decomposition_obbs, chain, of_box)?;
            let spheres = placed(&of.decomposition_bounding_spheres, chain, of_sphere)?;
            Ok::<_, String>((pieces, boxes, spheres))
        });
        let pieces = pieces.transpose()?;
        Ok(Shapes { full, pieces })
    }
}

/// The distances of all shapes over a motion; invalid after a cancellation.
fn over(motion: &Motion, shapes: &Shapes, cancellation: &Cancellation) -> Kinds<PairStatistics> {
    let (hulls, boxes, spheres) = &shapes.full;
    let (hulls, boxes, spheres) = (&hulls[..], &boxes[..], &spheres[..]);
    let mut kinds: Vec<&dyn ShapeList> = vec![&hulls, &boxes, &spheres];
    let of_pieces = shapes.pieces.as_ref();
    let of_pieces = of_pieces.map(|(a, b, c)| (&a[..], &b[..], &c[..]));
    if let Some((pieces, boxes, spheres)) = &of_pieces {
        kinds.extend::<[&dyn ShapeList; 3]>([pieces, boxes, spheres]);
    }
    // Every body is a link of the chain, and the motion has a pose for each.
    let mut found = statistics_of_kinds(&kinds, motion, &|| cancellation.is_cancelled())
        .unwrap_or_default()
        .into_iter();
    let mut three = || [(); 3].map(|()| found.next().unwrap_or_default());
    Kinds { full: three(), pieces: of_pieces.map(|_| three()) }
}

/// The link poses in named configurations.
fn motion(
    dof: &DofModule,
    chain: &ChainModule,
    configurations: impl IndexedParallelIterator<Item = (String, Vec<f64>)>,
) -> Result<Motion, String> {
    let kinematics = ForwardKinematics::new(chain, dof).map_err(|error| error.to_string())?;
    let poses: Vec<Vec<Isometry3<f64>>> = configurations
        .map(|(name, configuration)| {
            let poses = kinematics.link_poses(&configuration);
            poses.map_err(|error| format!("{name}: {error}"))
        })
        .collect::<Result<_, String>>()?;
    Motion::new(&poses, &rigid_groups(chain)).map_err(|error| error.to_string())
}

/// The group number of each link: links connected by fixed joints only have the same one.
fn rigid_groups(chain: &ChainModule) -> Vec<usize> {
    let mut groups: Vec<usize> = (0..chain.links_in_chain.len()).collect();
    for link in chain.kinematic_hierarchy.iter().flatten() {
        let joint = chain.links_in_chain[link.get()].parent_joint_idx;
        let Some(joint) = joint.map(|joint| &chain.joints_in_chain[joint.get()]) else {
            continue;
        };
        if joint.joint_type == JointType::Fixed {
            groups[link.get()] = groups[joint.parent_link_idx.get()];
        }
    }
    groups
}

/// The shapes of each link with its index, or the reason why one cannot be used.
fn placed<L, T, S>(
    links: &[L],
    chain: &ChainModule,
    shape: fn(&T) -> Result<S, ShapeError>,
) -> Result<Vec<PlacedShape<S>>, String>
where
    for<'a> &'a L: IntoIterator<Item = &'a T>,
{
    let mut shapes = Vec::new();
    for (body, of_link) in links.iter().enumerate() {
        for of in of_link {
            let shape = shape(of).map_err(|error| {
                let name = &chain.links_in_chain[body].name;
                format!("distances cannot be computed for the mesh of link `{name}`: {error}")
            })?;
            shapes.push(PlacedShape { body, shape });
        }
    }
    Ok(shapes)
}

fn to_seven_digits(mut matrix: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let elements = matrix.iter_mut().flatten();
    elements.for_each(|element| *element = seven_digits(*element));
    matrix
}

fn of_mesh(mesh: &WrittenMesh) -> Result<ConvexShape, ShapeError> {
    ConvexShape::new(&mesh.mesh)
}

fn of_box(of: &Obb) -> Result<OrientedBox, ShapeError> {
    let place = Translation3::from(of.offset_xyz);
    let pose = Isometry3::from_parts(place, from_rpy(of.offset_rpy));
    OrientedBox::new(pose, of.half_extents)
}

fn of_sphere(of: &BoundingSphere) -> Result<Sphere, ShapeError> {
    Sphere::new(Vector3::from(of.offset_xyz), of.radius)
}
