//! `link_shapes_distance_statistics_module`: SPEC 8.5.

use std::sync::Arc;

use nalgebra::{Isometry3, Translation3, Vector3};
use rayon::prelude::*;

use super::{ConvexMeshes, MOST_PIECES_WITH_MATRICES, seven_digits};
use crate::context::Context;
use crate::error::Result;
use crate::made::{self, Shared, streamed};
use crate::meshes::WrittenMesh;
use crate::settings::Settings;
use urdd_directory::cancellation::Cancellation;
use urdd_format::chain::ChainModule;
use urdd_format::index::Count;
use urdd_format::link_shapes_approximations::{
    BoundingSphere, LinkShapesApproximationsModule, Obb,
};
use urdd_format::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule as Statistics,
};
use urdd_format::urdf::JointType;
use urdd_geometry::convex::{
    ConvexShape, Motion, OrientedBox, PairStatistics, PlacedShape, ShapeError, ShapeList, Sphere,
    statistics_of_kinds,
};
use urdd_kinematics::rotation::from_rpy;
use urdd_source::note::NoteKind;

pub(crate) fn statistics(
    context: &Context,
    solids: &ConvexMeshes,
    shapes: &Shapes,
) -> Shared<Statistics> {
    let Settings { num_samples, source, .. } = context.settings;
    let cancellation = &source.cancellation;
    let mut found = over(&sampled_motion(context)?, shapes, cancellation).into_iter();
    cancellation.check()?;
    let matrices = |pairs: PairStatistics| DistanceStatistics {
        mean_distances: to_seven_digits(pairs.mean),
        min_distances: to_seven_digits(pairs.min),
        max_distances: to_seven_digits(pairs.max),
    };
    let [full_convex_hulls, full_obbs, full_bounding_spheres] =
        [(); 3].map(|()| matrices(found.next().unwrap_or_default()));
    let [decomposition_convex_hulls, decomposition_obbs, decomposition_bounding_spheres] =
        [(); 3].map(|()| found.next().map(matrices));
    let module = Arc::new(Statistics {
        num_samples: Count(*num_samples),
        full_shapes: solids.full_shapes(),
        decomposition_shapes: solids.decomposition_shapes(),
        full_convex_hulls,
        full_obbs,
        full_bounding_spheres,
        decomposition_convex_hulls,
        decomposition_obbs,
        decomposition_bounding_spheres,
    });
    let mut made = streamed(made::statistics(&module), Arc::clone(&module))?;
    if module.decomposition_convex_hulls.is_none() {
        let pieces = module.decomposition_shapes.len();
        made.notes.push(context.note(
            NoteKind::TooLarge,
            format!(
                "the robot has {pieces} convex pieces; matrices over more than {MOST_PIECES_WITH_MATRICES} are too large"
            ),
            "distances and skips between pieces are left out; those between links are included",
        ));
    }
    Ok(made)
}

/// The link poses in the sampled configurations (SPEC 9.3).
pub(crate) fn sampled_motion(context: &Context) -> Result<Motion> {
    let configuration = |sample: u32| {
        let name = format!("sampled configuration {sample}");
        (name, context.space.sampled(u64::from(sample)))
    };
    motion(context, (0..context.settings.num_samples).into_par_iter().map(configuration))
}

/// The distances in a configuration that has this name in errors, metres: a matrix per kind of shape, as from [`over`].
pub(crate) fn distances_at(
    context: &Context,
    shapes: &Shapes,
    name: &str,
    configuration: &[f64],
) -> Result<Vec<Vec<Vec<f64>>>> {
    let configuration = [(name.to_owned(), configuration.to_vec())];
    let motion = motion(context, configuration.into_par_iter())?;
    let found = over(&motion, shapes, &Cancellation::default());
    // With one configuration, minimum, mean and maximum are all the distance.
    Ok(found.into_iter().map(|pairs| pairs.min).collect())
}

type Placed<S> = Vec<PlacedShape<S>>;

/// Hulls, boxes and spheres, of links or of pieces.
type Three = (Placed<ConvexShape>, Placed<OrientedBox>, Placed<Sphere>);

pub(crate) struct Shapes {
    full: Three,
    /// `None` if there are too many pieces.
    pieces: Option<Three>,
}

impl Shapes {
    pub fn new(
        context: &Context,
        solids: &ConvexMeshes,
        of: &LinkShapesApproximationsModule,
    ) -> Result<Self> {
        let full = (
            placed(context, solids.hulls, of_mesh)?,
            placed(context, &of.full_obbs, of_box)?,
            placed(context, &of.full_bounding_spheres, of_sphere)?,
        );
        let pieces = match solids.decomposition_shapes().len() <= MOST_PIECES_WITH_MATRICES {
            true => Some((
                placed(context, solids.pieces, of_mesh)?,
                placed(context, &of.decomposition_obbs, of_box)?,
                placed(context, &of.decomposition_bounding_spheres, of_sphere)?,
            )),
            false => None,
        };
        Ok(Shapes { full, pieces })
    }

    /// The shapes that decide about a collision: the pieces, or the hulls where there are too many pieces.
    pub fn deciding(&self) -> &[PlacedShape<ConvexShape>] {
        self.pieces.as_ref().map_or(&self.full.0, |pieces| &pieces.0)
    }

    /// Their place among the kinds, in the order of the documents.
    pub fn deciding_kind(&self) -> usize {
        if self.pieces.is_some() { 3 } else { 0 }
    }
}

/// The distances of all shapes over a motion, by kind in the order of the documents: hulls, boxes and spheres of links,
/// then those of pieces if the robot has matrices over pieces. Empty after a cancellation.
fn over(motion: &Motion, shapes: &Shapes, cancellation: &Cancellation) -> Vec<PairStatistics> {
    let (hulls, boxes, spheres) = &shapes.full;
    let (hulls, boxes, spheres) = (&hulls[..], &boxes[..], &spheres[..]);
    let mut kinds: Vec<&dyn ShapeList> = vec![&hulls, &boxes, &spheres];
    let of_pieces = shapes.pieces.as_ref().map(|(a, b, c)| (&a[..], &b[..], &c[..]));
    if let Some((pieces, boxes, spheres)) = &of_pieces {
        kinds.extend::<[&dyn ShapeList; 3]>([pieces, boxes, spheres]);
    }
    // Every body is a link of the chain, and the motion has a pose for each.
    statistics_of_kinds(&kinds, motion, &|| cancellation.is_cancelled()).unwrap_or_default()
}

/// The link poses in named configurations.
fn motion(
    context: &Context,
    configurations: impl IndexedParallelIterator<Item = (String, Vec<f64>)>,
) -> Result<Motion> {
    let poses: Vec<Vec<Isometry3<f64>>> = configurations
        .map(|(name, configuration)| {
            let poses = context.kinematics.link_poses(&configuration);
            poses.map_err(|error| context.unmeasurable(format!("{name}: {error}")))
        })
        .collect::<Result<_>>()?;
    Motion::new(&poses, &rigid_groups(&context.chain)).map_err(|error| context.unmeasurable(error))
}

/// The group number of each link: links connected by fixed joints only have the same one.
fn rigid_groups(chain: &ChainModule) -> Vec<usize> {
    let mut groups: Vec<usize> = (0..chain.links_in_chain.len()).collect();
    for link in chain.kinematic_hierarchy.iter().flatten() {
        let joint = chain.links_in_chain[link.get()].parent_joint_idx;
        let Some(joint) = joint.map(|joint| &chain.joints_in_chain[joint.get()]) else { continue };
        if joint.joint_type == JointType::Fixed {
            groups[link.get()] = groups[joint.parent_link_idx.get()];
        }
    }
    groups
}

/// The shapes of each link with its index.
fn placed<L, T, S>(
    context: &Context,
    links: &[L],
    shape: fn(&T) -> Result<S, ShapeError>,
) -> Result<Vec<PlacedShape<S>>>
where
    for<'a> &'a L: IntoIterator<Item = &'a T>,
{
    let mut shapes = Vec::new();
    for (body, of_link) in links.iter().enumerate() {
        for of in of_link {
            let shape = shape(of).map_err(|error| {
                let name = &context.chain.links_in_chain[body].name;
                context.unmeasurable(format!(
                    "distances cannot be computed for the mesh of link `{name}`: {error}"
                ))
            })?;
            shapes.push(PlacedShape { body, shape });
        }
    }
    Ok(shapes)
}

fn to_seven_digits(mut matrix: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    matrix.iter_mut().flatten().for_each(|element| *element = seven_digits(*element));
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
