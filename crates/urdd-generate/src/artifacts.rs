//! The meshes and shapes that stages pass on to later ones: built in this run, or loaded from files of an earlier run
//! that are still valid.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::de::DeserializeOwned;

use super::error::GenerateError;
use super::meshes::written::{LinkMeshes, LinkPieces, take_up};
use super::old;
use super::shapes::ConvexMeshes;
use urdd_directory::root::Root;
use urdd_format::convex_decomposition_meshes::ConvexDecompositionMeshesModule;
use urdd_format::convex_hull_meshes::ConvexHullMeshesModule;
use urdd_format::link_shapes_approximations::LinkShapesApproximationsModule;
use urdd_format::link_shapes_distance_statistics::LinkShapesDistanceStatisticsModule;
use urdd_format::link_shapes_simple_skips::LinkShapesSimpleSkipsModule;
use urdd_format::link_shapes_skips::LinkShapesSkipsModule;
use urdd_format::plain_meshes::PlainMeshesModule;
use urdd_format::registry::ModuleKind;

/// The results so far.
pub(super) struct Artifacts {
    root: PathBuf,
    pub plain: Option<LinkMeshes>,
    pub hulls: Option<LinkMeshes>,
    pub pieces: Option<LinkPieces>,
    pub approximations: Option<Arc<LinkShapesApproximationsModule>>,
    pub statistics: Option<Arc<LinkShapesDistanceStatisticsModule>>,
    pub simple_skips: Option<Arc<LinkShapesSimpleSkipsModule>>,
    pub skips: Option<Arc<LinkShapesSkipsModule>>,
}

impl Artifacts {
    /// For a new URDD that is written to `root`. The files of modules that were built or kept are already in it.
    pub fn new(root: &Path) -> Self {
        Artifacts {
            root: root.to_owned(),
            plain: None,
            hulls: None,
            pieces: None,
            approximations: None,
            statistics: None,
            simple_skips: None,
            skips: None,
        }
    }

    /// The plain meshes.
    pub fn plain(&mut self) -> Result<LinkMeshes, GenerateError> {
        self.have(
            |artifacts| &mut artifacts.plain,
            |artifacts| {
                let module: PlainMeshesModule = artifacts.document(ModuleKind::PlainMeshes)?;
                let root = artifacts.root()?;
                let links = module.link_meshes.iter().map(Option::as_ref);
                let meshes = links.map(|link| link.map(|mesh| take_up(&root, &mesh.files)));
                meshes.map(Option::transpose).collect()
            },
        )
    }

    /// The hulls.
    pub fn hulls(&mut self) -> Result<LinkMeshes, GenerateError> {
        self.have(
            |artifacts| &mut artifacts.hulls,
            |artifacts| {
                let module: ConvexHullMeshesModule =
                    artifacts.document(ModuleKind::ConvexHullMeshes)?;
                let root = artifacts.root()?;
                let links = module.link_hulls.iter().map(Option::as_ref);
                let meshes = links.map(|link| link.map(|files| take_up(&root, files)));
                meshes.map(Option::transpose).collect()
            },
        )
    }

    /// The pieces.
    pub fn pieces(&mut self) -> Result<LinkPieces, GenerateError> {
        self.have(
            |artifacts| &mut artifacts.pieces,
            |artifacts| {
                let module: ConvexDecompositionMeshesModule =
                    artifacts.document(ModuleKind::ConvexDecompositionMeshes)?;
                let root = artifacts.root()?;
                let links = module.link_pieces.iter();
                let pieces =
                    links.map(|link| link.iter().map(|files| take_up(&root, files)).collect());
                pieces.collect()
            },
        )
    }

    /// The hulls and the pieces, from which shapes are built.
    pub fn solids(&mut self) -> Result<ConvexMeshes, GenerateError> {
        Ok(ConvexMeshes {
            hulls: self.hulls()?,
            pieces: self.pieces()?,
        })
    }

    /// The boxes and spheres.
    pub fn approximations(&mut self) -> Result<Arc<LinkShapesApproximationsModule>, GenerateError> {
        self.have(
            |artifacts| &mut artifacts.approximations,
            |artifacts| artifacts.document(ModuleKind::LinkShapesApproximations),
        )
    }

    /// The distance statistics.
    pub fn statistics(&mut self) -> Result<Arc<LinkShapesDistanceStatisticsModule>, GenerateError> {
        self.have(
            |artifacts| &mut artifacts.statistics,
            |artifacts| artifacts.document(ModuleKind::LinkShapesDistanceStatistics),
        )
    }

    /// The simple skips.
    pub fn simple_skips(&mut self) -> Result<Arc<LinkShapesSimpleSkipsModule>, GenerateError> {
        self.have(
            |artifacts| &mut artifacts.simple_skips,
            |artifacts| artifacts.document(ModuleKind::LinkShapesSimpleSkips),
        )
    }

    /// The skips.
    pub fn skips(&mut self) -> Result<Arc<LinkShapesSkipsModule>, GenerateError> {
        self.have(
            |artifacts| &mut artifacts.skips,
            |artifacts| artifacts.document(ModuleKind::LinkShapesSkips),
        )
    }

    /// Returns a result; loads it on first use if this run did not build it.
    fn have<T>(
        &mut self,
        place: fn(&mut Artifacts) -> &mut Option<Arc<T>>,
        take_up: fn(&Artifacts) -> Result<T, GenerateError>,
    ) -> Result<Arc<T>, GenerateError> {
        if let Some(made) = place(self) {
            return Ok(Arc::clone(made));
        }
        let taken = Arc::new(take_up(self)?);
        *place(self) = Some(Arc::clone(&taken));
        Ok(taken)
    }

    fn root(&self) -> Result<Root, GenerateError> {
        Root::open(&self.root).map_err(|error| GenerateError::Internal {
            file: self.root.display().to_string(),
            reason: error.to_string(),
        })
    }

    fn document<T: DeserializeOwned>(&self, kind: ModuleKind) -> Result<T, GenerateError> {
        old::document(&self.root()?, kind).map_err(|reason| GenerateError::Internal {
            file: kind.folder().to_owned(),
            reason,
        })
    }
}
