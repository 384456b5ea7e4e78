//! `link_shapes_distance_statistics_module`: SPEC 8.5.

use nalgebra::{Isometry3, Translation3, Vector3};
use rayon::prelude::*;

use super::{ConvexMeshes, MOST_PIECES_WITH_MATRICES};
use crate::format::bounds::BoundsModule;
use crate::format::chain::ChainModule;
use crate::format::dof::DofModule;
use crate::format::index::Count;
use crate::format::link_shapes_approximations::{
    BoundingSphere, LinkShapesApproximationsModule, Obb,
};
use crate::format::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule,
};
use crate::format::urdf::JointType;
use crate::generate::meshes::written::WrittenMesh;
use crate::geometry::convex::{
    ConvexShape, Motion, OrientedBox, PlacedShape, Shape, ShapeError, Sphere, pair_statistics,
};
use crate::kinematics::rotation::from_rpy;
use crate::kinematics::{ConfigurationSpace, ForwardKinematics};

/// Makes the module, or says in words why there is none.
pub(crate) fn statistics(
    solids: &ConvexMeshes,
    approximations: &LinkShapesApproximationsModule,
    (dof, chain, bounds): Kinematics,
    num_samples: u32,
) -> Result<LinkShapesDistanceStatisticsModule, String> {
    let space = ConfigurationSpace::new(dof, chain, bounds).map_err(|error| error.to_string())?;
    let configuration = |sample: u32| {
        let name = format!("sampled configuration {sample}");
        (name, space.sampled(u64::from(sample)))
    };
    let configurations = (0..num_samples).into_par_iter().map(configuration);
    let motion = motion(dof, chain, configurations)?;
    over(&motion, solids, approximations, chain, num_samples)
}

/// The same over the default configuration alone (SPEC 9.4): each smallest distance is the distance.
pub(crate) fn at_default_configuration(
    solids: &ConvexMeshes,
    approximations: &LinkShapesApproximationsModule,
    (dof, chain, bounds): Kinematics,
) -> Result<LinkShapesDistanceStatisticsModule, String> {
    let space = ConfigurationSpace::new(dof, chain, bounds).map_err(|error| error.to_string())?;
    let name = "the default configuration".to_owned();
    let configuration = [(name, space.default_configuration())];
    let motion = motion(dof, chain, configuration.into_par_iter())?;
    over(&motion, solids, approximations, chain, 1)
}

/// What sampled configurations and their poses follow from.
pub(crate) type Kinematics<'a> = (&'a DofModule, &'a ChainModule, &'a BoundsModule);

/// The distances of all shapes while the robot moves.
fn over(
    motion: &Motion,
    solids: &ConvexMeshes,
    approximations: &LinkShapesApproximationsModule,
    chain: &ChainModule,
    num_samples: u32,
) -> Result<LinkShapesDistanceStatisticsModule, String> {
    let full = |(link, error): (usize, ShapeError)| {
        let name = &chain.links_in_chain[link].name;
        format!("the mesh of link `{name}` is not one that distances can be taken of: {error}")
    };
    let of = approximations;
    let pieces = solids.decomposition_shapes();
    let with_pieces = pieces.len() <= MOST_PIECES_WITH_MATRICES;
    let over = |wanted: bool,
                make: &dyn Fn() -> Result<DistanceStatistics, (usize, ShapeError)>| {
        wanted.then(make).transpose().map_err(full)
    };
    Ok(LinkShapesDistanceStatisticsModule {
        num_samples: Count(num_samples),
        full_shapes: solids.full_shapes(),
        decomposition_shapes: pieces,
        full_convex_hulls: pairs(&solids.hulls, motion, of_mesh).map_err(full)?,
        full_obbs: pairs(&of.full_obbs, motion, of_box).map_err(full)?,
        full_bounding_spheres: pairs(&of.full_bounding_spheres, motion, of_sphere).map_err(full)?,
        decomposition_convex_hulls: over(with_pieces, &|| pairs(&solids.pieces, motion, of_mesh))?,
        decomposition_obbs: over(with_pieces, &|| {
            pairs(&of.decomposition_obbs, motion, of_box)
        })?,
        decomposition_bounding_spheres: over(with_pieces, &|| {
            pairs(&of.decomposition_bounding_spheres, motion, of_sphere)
        })?,
    })
}

/// The links' poses in configurations, each with its name.
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

/// For each link the number of its group: links that only fixed joints are between.
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

/// The statistics of all pairs of the links' shapes; or which link has none that can be used.
fn pairs<L, T, S>(
    links: &[L],
    motion: &Motion,
    shape: fn(&T) -> Result<S, ShapeError>,
) -> Result<DistanceStatistics, (usize, ShapeError)>
where
    for<'a> &'a L: IntoIterator<Item = &'a T>,
    S: Shape,
{
    let mut shapes = Vec::new();
    for (body, of_link) in links.iter().enumerate() {
        for of in of_link {
            let shape = shape(of).map_err(|error| (body, error))?;
            shapes.push(PlacedShape { body, shape });
        }
    }
    // Every body is one of the chain's links, which the motion is of.
    let pairs = pair_statistics(&shapes, motion).unwrap_or_default();
    Ok(DistanceStatistics {
        mean_distances: pairs.mean,
        min_distances: pairs.min,
        max_distances: pairs.max,
    })
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
