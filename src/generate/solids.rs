//! What stages of meshes and shapes hand on to later ones: made in this run, or taken up from the
//! files of an earlier one that still hold.

use std::sync::Arc;

use serde::de::DeserializeOwned;

use super::error::GenerateError;
use super::meshes::written::{WrittenMesh, take_up};
use crate::directory::json;
use crate::directory::limits::MAX_DOCUMENT_BYTES;
use crate::directory::root::Root;
use crate::format::convex_decomposition_meshes::ConvexDecompositionMeshesModule;
use crate::format::convex_hull_meshes::ConvexHullMeshesModule;
use crate::format::link_shapes_approximations::LinkShapesApproximationsModule;
use crate::format::link_shapes_distance_statistics::LinkShapesDistanceStatisticsModule;
use crate::format::link_shapes_simple_skips::LinkShapesSimpleSkipsModule;
use crate::format::meshes::MeshFiles;
use crate::format::plain_meshes::PlainMeshesModule;
use crate::format::registry::ModuleKind;

/// For each link its mesh.
pub(super) type LinkMeshes = Arc<Vec<Option<WrittenMesh>>>;
/// For each link its pieces.
pub(super) type LinkPieces = Arc<Vec<Vec<WrittenMesh>>>;

/// What was made so far.
pub(super) struct Hoard {
    root: std::path::PathBuf,
    pub plain: Option<LinkMeshes>,
    pub hulls: Option<LinkMeshes>,
    pub pieces: Option<LinkPieces>,
    pub approximations: Option<Arc<LinkShapesApproximationsModule>>,
    pub statistics: Option<Arc<LinkShapesDistanceStatisticsModule>>,
    pub simple_skips: Option<Arc<LinkShapesSimpleSkipsModule>>,
}

impl Hoard {
    /// Of a new URDD that is written to `root`: the files of modules that were made, or kept, are
    /// there already.
    pub fn new(root: &std::path::Path) -> Self {
        Hoard {
            root: root.to_owned(),
            plain: None,
            hulls: None,
            pieces: None,
            approximations: None,
            statistics: None,
            simple_skips: None,
        }
    }

    /// The plain meshes.
    pub fn plain(&mut self) -> Result<LinkMeshes, GenerateError> {
        if self.plain.is_none() {
            let module: PlainMeshesModule = self.document(ModuleKind::PlainMeshes)?;
            let files = module.link_meshes.into_iter();
            self.plain = Some(self.take(files.map(|link| link.map(|mesh| mesh.files)))?);
        }
        Ok(self.plain.clone().unwrap_or_default())
    }

    /// The hulls.
    pub fn hulls(&mut self) -> Result<LinkMeshes, GenerateError> {
        if self.hulls.is_none() {
            let module: ConvexHullMeshesModule = self.document(ModuleKind::ConvexHullMeshes)?;
            self.hulls = Some(self.take(module.link_hulls.into_iter())?);
        }
        Ok(self.hulls.clone().unwrap_or_default())
    }

    /// The pieces.
    pub fn pieces(&mut self) -> Result<LinkPieces, GenerateError> {
        if self.pieces.is_none() {
            let module: ConvexDecompositionMeshesModule =
                self.document(ModuleKind::ConvexDecompositionMeshes)?;
            let root = self.root()?;
            let links = module.link_pieces.iter();
            let pieces = links.map(|link| link.iter().map(|files| take_up(&root, files)).collect());
            self.pieces = Some(Arc::new(pieces.collect::<Result<_, _>>()?));
        }
        Ok(self.pieces.clone().unwrap_or_default())
    }

    /// The boxes and spheres.
    pub fn approximations(&mut self) -> Result<Arc<LinkShapesApproximationsModule>, GenerateError> {
        if let Some(made) = &self.approximations {
            return Ok(Arc::clone(made));
        }
        let module = Arc::new(self.document(ModuleKind::LinkShapesApproximations)?);
        self.approximations = Some(Arc::clone(&module));
        Ok(module)
    }

    /// The distance statistics.
    pub fn statistics(&mut self) -> Result<Arc<LinkShapesDistanceStatisticsModule>, GenerateError> {
        if let Some(made) = &self.statistics {
            return Ok(Arc::clone(made));
        }
        let module = Arc::new(self.document(ModuleKind::LinkShapesDistanceStatistics)?);
        self.statistics = Some(Arc::clone(&module));
        Ok(module)
    }

    /// The simple skips.
    pub fn simple_skips(&mut self) -> Result<Arc<LinkShapesSimpleSkipsModule>, GenerateError> {
        if let Some(made) = &self.simple_skips {
            return Ok(Arc::clone(made));
        }
        let module = Arc::new(self.document(ModuleKind::LinkShapesSimpleSkips)?);
        self.simple_skips = Some(Arc::clone(&module));
        Ok(module)
    }

    fn root(&self) -> Result<Root, GenerateError> {
        Root::open(&self.root).map_err(|error| GenerateError::Internal {
            file: self.root.display().to_string(),
            reason: error.to_string(),
        })
    }

    fn take(
        &self,
        links: impl Iterator<Item = Option<MeshFiles>>,
    ) -> Result<LinkMeshes, GenerateError> {
        let root = self.root()?;
        let meshes = links.map(|files| files.map(|files| take_up(&root, &files)).transpose());
        Ok(Arc::new(meshes.collect::<Result<_, _>>()?))
    }

    fn document<T: DeserializeOwned>(&self, kind: ModuleKind) -> Result<T, GenerateError> {
        let path = format!("{}/module.json", kind.folder());
        let internal = |reason: String| GenerateError::Internal {
            file: path.clone(),
            reason,
        };
        let bytes = self
            .root()?
            .read(&path, MAX_DOCUMENT_BYTES)
            .map_err(|error| internal(error.to_string()))?;
        let read = json::read(&bytes).map_err(|error| internal(error.to_string()))?;
        serde_json::from_value(read.value).map_err(|error| internal(error.to_string()))
    }
}
