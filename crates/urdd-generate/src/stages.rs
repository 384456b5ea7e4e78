//! Builds the modules of a URDD. Each stage is a function of what it uses: the robot and the settings ([`Context`]), the
//! products of earlier stages, and what donors have. It returns its module and its product.

use std::cell::OnceCell;
use std::sync::Arc;

use serde::de::DeserializeOwned;

use crate::context::Context;
use crate::donor::links::DonorLinks;
use crate::error::{GenerateError, Result};
use crate::given::Named;
use crate::kinematics::{MOST_LINKS_IN_PAIRS, MOST_LINKS_WITH_PAIRS, connections_module};
use crate::made::{Made, made, streamed};
use crate::meshes::original::original_meshes;
use crate::meshes::{MeshCount, Meshes, Pieces, derived, plain, read_mesh};
use crate::modules::Modules;
use crate::shapes::statistics::Shapes;
use crate::shapes::{ConvexMeshes, skips, statistics};
use crate::{checked_pieces, donor, inputs, shapes};
use urdd_directory::root::Root;
use urdd_directory::writer::{Document, Member, Rows};
use urdd_format::convex_decomposition_meshes::ConvexDecompositionMeshesModule;
use urdd_format::convex_hull_meshes::ConvexHullMeshesModule;
use urdd_format::meshes::MeshFiles;
use urdd_format::named_configurations::NamedConfigurationsModule;
use urdd_format::plain_meshes::PlainMeshesModule;
use urdd_format::registry::ModuleKind;
use urdd_source::note::NoteKind;

/// Runs every stage, in the order of the specification. Returns how the mesh references were resolved.
pub(super) fn run(context: &Context, modules: &mut Modules) -> Result<MeshCount> {
    let donors = &DonorLinks::of(&context.settings.donors, &|kind| inputs::text(kind, context));

    modules.add(ModuleKind::Urdf, |_| made(&context.source.reading.robot))?;
    modules.add(ModuleKind::Dof, |_| made(&context.dof))?;
    modules.add(ModuleKind::Chain, |_| made(&context.chain))?;
    modules.add(ModuleKind::Connections, |_| connections(context))?;
    modules.add(ModuleKind::Bounds, |_| made(&context.bounds))?;
    modules.add(ModuleKind::KinematicsSamples, |_| made(&context.samples))?;
    modules.add(ModuleKind::Composition, |_| made(&context.composition))?;
    modules.add(ModuleKind::NamedConfigurations, |_| named_configurations(context))?;

    let original = modules.add(ModuleKind::OriginalMeshes, |_| original_meshes(context))?;
    let count = original.as_ref().map(|original| original.count);
    // Moved: the contents of mesh files are dropped with this stage.
    let plain = modules.product(ModuleKind::PlainMeshes, load_plain, move |digests| {
        let taken = donors.plain(context, original.as_ref(), digests);
        derived::plain(context, original.as_ref(), &taken)
    })?;
    if modules.has(ModuleKind::PlainMeshes) {
        let taken: Arc<PlainMeshesModule> = load_document(modules.root(), ModuleKind::PlainMeshes)?;
        modules.notes.extend(plain::notes(context, &taken));
    }
    let kind = ModuleKind::ConvexHullMeshes;
    let hulls = modules.product(kind, load_hulls, |digests| {
        let plain = plain.get()?;
        derived::hulls(context, plain, donors.solids(context, kind, plain, digests))
    })?;
    let kind = ModuleKind::ConvexDecompositionMeshes;
    let pieces = modules.product(kind, load_pieces, |digests| {
        let plain = plain.get()?;
        derived::pieces(context, plain, donors.solids(context, kind, plain, digests))
    })?;

    let solids = || -> Result<_> {
        let (hulls, pieces) = (hulls.get()?, pieces.get()?);
        Ok(ConvexMeshes { hulls, pieces })
    };
    let kind = ModuleKind::LinkShapesApproximations;
    let approximations = modules.product(kind, load_document, |digests| {
        let solids = solids()?;
        shapes::approximations(context, &solids, donors.shapes(context, &solids, digests))
    })?;
    modules.add(ModuleKind::LinkShapesMaxDistanceFromOrigin, |_| {
        made(&shapes::max_distances(&solids()?, approximations.get()?))
    })?;
    // Preparing the shapes takes long. The next two stages use them.
    let known = OnceCell::new();
    let prepared = || match known.get() {
        Some(shapes) => Ok(shapes),
        None => Shapes::new(context, &solids()?, approximations.get()?)
            .map(|shapes| known.get_or_init(|| shapes)),
    };
    let kind = ModuleKind::LinkShapesDistanceStatistics;
    let statistics = modules.product(kind, load_document, |_| {
        statistics::statistics(context, &solids()?, prepared()?)
    })?;
    let kind = ModuleKind::LinkShapesSimpleSkips;
    let simple_skips = modules.product(kind, load_document, |_| {
        skips::simple_skips(context, prepared()?, statistics.get()?)
    })?;
    let kind = ModuleKind::LinkShapesSkips;
    let skips = modules.product(kind, load_document, |_| {
        skips::edited_skips(context, prepared, simple_skips.get()?)
    })?;
    if modules.has(kind) {
        let (simple, skips) = (simple_skips.get()?, skips.get()?);
        modules.notes.extend(skips::notes(context, prepared, simple, skips)?);
    }
    drop(known);
    modules.add(ModuleKind::SelfCollisionModel, |digests| {
        let (pieces, skips) = (pieces.get()?, skips.get()?);
        checked_pieces::self_collision_model(context, pieces, skips, statistics.get()?, digests)
    })?;
    modules.add(ModuleKind::LinkShapesSpheres, |_| {
        checked_pieces::spheres(context, pieces.get()?, skips.get()?)
    })?;
    modules.add(ModuleKind::Loops, |_| made(&context.loops))?;
    modules.notes.extend(context.loop_notes.iter().cloned());
    Ok(count.unwrap_or_default())
}

fn load_document<T: DeserializeOwned>(root: &Root, kind: ModuleKind) -> Result<Arc<T>> {
    let read = donor::document(root, kind).map(Arc::new);
    read.map_err(|reason| GenerateError::internal(kind.folder(), reason))
}

fn load_plain(root: &Root, kind: ModuleKind) -> Result<Meshes> {
    let module: Arc<PlainMeshesModule> = load_document(root, kind)?;
    let links = module.link_meshes.iter().map(Option::as_ref);
    one_each(root, links.map(|link| link.map(|mesh| &mesh.files)))
}

fn load_hulls(root: &Root, kind: ModuleKind) -> Result<Meshes> {
    let module: Arc<ConvexHullMeshesModule> = load_document(root, kind)?;
    one_each(root, module.link_hulls.iter().map(Option::as_ref))
}

fn one_each<'a>(root: &Root, links: impl Iterator<Item = Option<&'a MeshFiles>>) -> Result<Meshes> {
    links.map(|link| link.map(|files| read_mesh(root, files))).map(Option::transpose).collect()
}

fn load_pieces(root: &Root, kind: ModuleKind) -> Result<Pieces> {
    let module: Arc<ConvexDecompositionMeshesModule> = load_document(root, kind)?;
    let links = module.link_pieces.iter();
    links.map(|link| link.iter().map(|files| read_mesh(root, files)).collect()).collect()
}

/// With 180 links in a line these tables have 5 million numbers.
fn connections(context: &Context) -> Result<Made> {
    let module = connections_module(&context.chain);
    let too_large = module.link_to_link_paths.is_none().then(|| {
        let links = context.chain.links_in_chain.len();
        context.note(
            NoteKind::TooLarge,
            format!(
                "the robot has {links} links; the paths of all pairs are too large above {MOST_LINKS_WITH_PAIRS} links, or {MOST_LINKS_IN_PAIRS} links in the paths"
            ),
            "connections_module leaves them out; they follow from its root paths and lowest common ancestors",
        )
    });
    let pairs = module.link_to_link_paths.map(Rows::new);
    let descents = module.link_connection_paths.map(Rows::new);
    let document = Document::Object(vec![
        ("root_paths", Member::Rows(Rows::new(module.root_paths))),
        ("lowest_common_ancestors", Member::Rows(Rows::new(module.lowest_common_ancestors))),
        ("link_to_link_paths", Member::rows_or_null(pairs)),
        ("link_connection_paths", Member::rows_or_null(descents)),
    ]);
    let made = streamed(Ok(document), ())?;
    Ok(Made { notes: too_large.into_iter().collect(), ..made })
}

/// SPEC 6.7, from the user's decisions.
fn named_configurations(context: &Context) -> Result<Made> {
    let Named { configurations, lost } = &context.named;
    let assumed = "the position is left out; the DOF has its default value there";
    let note =
        |(_, problem): &(String, String)| context.note(NoteKind::LeftOut, problem.clone(), assumed);
    let notes = lost.iter().map(note).collect();
    let configurations = configurations.clone();
    Ok(Made { notes, ..made(&NamedConfigurationsModule { configurations })? })
}
