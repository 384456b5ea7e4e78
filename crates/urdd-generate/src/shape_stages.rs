//! The stages that build the shapes of links, and the distances and skips between them.

use std::sync::Arc;

use super::context::Context;
use super::error::GenerateError;
use super::made::{Made, made_with, streamed};
use super::shape_documents;
use super::shapes::approximations::approximations;
use super::shapes::statistics::{Shapes, distances_at, statistics};
use super::shapes::{ConvexMeshes, MOST_PIECES_WITH_MATRICES, Shape, simple_skips};
use urdd_format::link_shapes_approximations::LinkShapesApproximationsModule as Approximations;
use urdd_format::link_shapes_distance_statistics::LinkShapesDistanceStatisticsModule as Statistics;
use urdd_format::link_shapes_simple_skips::LinkShapesSimpleSkipsModule as SimpleSkips;
use urdd_format::link_shapes_skips::{LinkShapesSkipsModule as Skips, SkipEdit};
use urdd_format::skips::skips_module;
use urdd_source::note::NoteKind;

/// `known` are the boxes and spheres that a donor has: of the hulls, then of the pieces.
pub(super) fn boxes_and_spheres(
    context: &Context,
    solids: &ConvexMeshes,
    known: Vec<Option<Shape>>,
) -> Result<Made<Arc<Approximations>>, GenerateError> {
    let module = Arc::new(approximations(context, solids, known)?);
    made_with(&*module, Vec::new(), Arc::clone(&module))
}

pub(super) fn distance_statistics(
    context: &Context,
    solids: &ConvexMeshes,
    shapes: &Shapes,
) -> Result<Made<Arc<Statistics>>, GenerateError> {
    let module = Arc::new(statistics(context, solids, shapes)?);
    let mut made = streamed(shape_documents::statistics(&module), Arc::clone(&module))?;
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

pub(super) fn skips_by_distance(
    context: &Context,
    shapes: &Shapes,
    statistics: &Statistics,
) -> Result<Made<Arc<SimpleSkips>>, GenerateError> {
    let name = "the default configuration";
    let default = distances_at(context, shapes, name, &context.space.default_configuration())?;
    let module = Arc::new(simple_skips::simple_skips(statistics, &default, &context.chain));
    streamed(shape_documents::simple_skips(&module), module)
}

/// `by_reference` are the edits that follow from the reference configuration. A person's edits are applied after them.
pub(super) fn edited_skips(
    context: &Context,
    simple: &SimpleSkips,
    by_reference: Vec<SkipEdit>,
) -> Result<Made<Arc<Skips>>, GenerateError> {
    let links = context.chain.links_in_chain.iter();
    let names: Vec<&str> = links.map(|link| link.name.as_str()).collect();
    let edits = [by_reference, context.edits.kept.clone()].concat();
    let module = Arc::new(skips_module(simple, context.skipped_reasons(), edits, &names));
    let mut made = streamed(shape_documents::skips(&module), module)?;
    let lost = context.edits.lost.iter().map(|edit| {
        let problem = format!(
            "the previous URDD has an edit of the skips between `{}` and `{}`, but the robot no longer has both links",
            edit.link_a, edit.link_b
        );
        context.note(NoteKind::LeftOut, problem, "the edit is left out")
    });
    made.notes.extend(lost);
    Ok(made)
}
