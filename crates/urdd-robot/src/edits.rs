//! What a person edits in a URDD: configurations with a name, such as `home`, and skips; and the files that change.

use std::collections::BTreeMap;

use serde_json::Value;

use super::Robot;
use super::error::RobotError;
use super::robot::{index, of_read, usable};
use super::shapes::ShapeKind;
use super::skips::{SIMPLE, SKIPS, Skips};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::ReadError;
use urdd_directory::{canonical, file_entry, json};
use urdd_document::kept::keep;
use urdd_format::link_shapes_skips::{LinkShapesSkipsModule, SkipEdit, SkippedReason};
use urdd_format::named_configurations::{
    ConfigurationEdit, DofPosition, NamedConfiguration, NamedConfigurationsModule, NamedDofs,
    PositionFault,
};
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::skips::skips_module;

/// Files by path relative to the root.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The version of the modules that this program writes.
const VERSION: &str = "1.0.0";

impl Robot {
    /// A module's JSON and YAML from its document, and `urdd.json` with their sizes and hashes. A module that the URDD lacks is added.
    pub(super) fn edited_files(
        &self,
        kind: ModuleKind,
        document: serde_json::Result<Value>,
    ) -> Result<Files, RobotError> {
        let document = document
            .map_err(|error| RobotError::Unusable { module: kind, reason: error.to_string() })?;
        let path = |name: &str| format!("{}/{name}", kind.folder());
        let (json, yaml) = (canonical::json_string(&document), canonical::yaml_string(&document));
        let mut files = Files::from([
            (path("module.json"), json.into_bytes()),
            (path("module.yaml"), yaml.into_bytes()),
        ]);
        // Not from what was kept: an edit of a URDD that changed meanwhile would undo that change.
        let text = self.root().read(ROOT_METADATA, MAX_DOCUMENT_BYTES);
        let metadata = |error: ReadError| RobotError::Metadata(error.to_string());
        let text = text.map_err(|error| of_read(self.root(), error, metadata))?;
        let metadata = json::read(&text);
        let metadata = metadata.map_err(|error| RobotError::Metadata(error.to_string()))?;
        let mut metadata = metadata.value;
        let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
        let modules =
            modules.ok_or_else(|| RobotError::Metadata("`modules` is missing".to_owned()))?;
        if !modules.iter().any(|module| module["name"] == kind.name()) {
            files.insert(path("VERSION"), format!("{VERSION}\n").into_bytes());
            let own = files.iter();
            let own = own.map(|(path, bytes)| (path.clone(), bytes.as_slice()));
            let (name, folder) = (kind.name(), kind.folder());
            file_entry::insert_module(modules, name, VERSION, folder, kind.depends_on(), own);
        }
        file_entry::raise_version(&mut metadata, kind);
        file_entry::reseal(&mut metadata, |path| files.get(path).map(Vec::as_slice));
        let metadata = canonical::json_string(&metadata).into_bytes();
        files.insert(ROOT_METADATA.to_owned(), metadata);
        Ok(files)
    }
}

const NAMED: ModuleKind = ModuleKind::NamedConfigurations;

/// A module of named configurations with other content, and the files of the URDD that change.
#[derive(Debug)]
pub struct EditedConfigurations {
    /// `named_configurations_module`.
    pub module: NamedConfigurationsModule,
    /// Changed files by path relative to the root: those of the module, and `urdd.json` with their sizes and hashes.
    pub files: Files,
}

impl Robot {
    /// The configurations that a person named, in their order. Empty without `named_configurations_module`.
    ///
    /// # Errors
    /// If the module is unusable.
    pub fn named_configurations(&self) -> Result<&[NamedConfiguration], RobotError> {
        keep(&self.named, || {
            let Some(part) = self.optional(NAMED)? else { return Ok(Vec::new()) };
            match part.document(NAMED) {
                Some(ModuleDocument::NamedConfigurations(module)) => {
                    Ok(module.configurations.clone())
                }
                _ => Err(RobotError::Missing(NAMED)),
            }
        })
        .map(Vec::as_slice)
    }

    /// The values of a named configuration.
    ///
    /// # Errors
    /// [`RobotError::Unknown`], with the nearest name; and as [`Robot::named_configurations`].
    pub fn named_configuration(&self, name: &str) -> Result<&[f64], RobotError> {
        let all = self.named_configurations()?;
        let names = all.iter().map(|named| named.name.to_string());
        let idx = index("configuration", &names.collect::<Vec<_>>(), name)?;
        Ok(&all[idx].configuration)
    }

    /// Replaces the URDD's named configurations. Returns the changed files and writes nothing. A URDD without the module
    /// gets it.
    ///
    /// # Errors
    /// [`RobotError::Unknown`] if a position names an unknown DOF; [`RobotError::OutOfBounds`] if a limited DOF cannot be
    /// there; if `dof_module` or `bounds_module` of version 1 is missing or unusable; [`RobotError::Metadata`] if
    /// `urdd.json` is.
    pub fn with_named_configurations(
        &self,
        edits: &[ConfigurationEdit],
    ) -> Result<EditedConfigurations, RobotError> {
        let resolved = self.resolved_configurations(edits)?.into_iter();
        let module = NamedConfigurationsModule {
            configurations: resolved.collect::<Result<_, RobotError>>()?,
        };
        let files = self.edited_files(NAMED, serde_json::to_value(&module))?;
        Ok(EditedConfigurations { module, files })
    }

    /// What follows from each of these, as [`Robot::with_named_configurations`] writes it; or why the robot cannot have it:
    /// [`RobotError::Unknown`] or [`RobotError::OutOfBounds`].
    ///
    /// # Errors
    /// If `dof_module` or `bounds_module` of version 1 is missing or unusable.
    pub fn resolved_configurations(
        &self,
        edits: &[ConfigurationEdit],
    ) -> Result<Vec<Result<NamedConfiguration, RobotError>>, RobotError> {
        let part = self.part(&[ModuleKind::Dof, ModuleKind::Bounds])?;
        let documents = (part.document_v1(ModuleKind::Dof), part.document_v1(ModuleKind::Bounds));
        let (Some(ModuleDocument::Dof(dof)), Some(ModuleDocument::Bounds(bounds))) = documents
        else {
            return Err(RobotError::Metadata("it is not of version 1".to_owned()));
        };
        let dofs = NamedDofs::new(dof, bounds);
        let check = |position: &DofPosition| match dofs.fault(position) {
            None => Ok(()),
            Some(PositionFault::UnknownDof) => {
                let names: Vec<String> = dof.dofs.iter().map(|dof| dof.name.clone()).collect();
                index("DOF", &names, &position.dof_name).map(|_| ())
            }
            Some(PositionFault::OutOfBounds([lower, upper])) => Err(RobotError::OutOfBounds {
                dof: position.dof_name.clone(),
                position: position.position,
                lower,
                upper,
            }),
        };
        let resolve = |edit: &ConfigurationEdit| {
            edit.positions.iter().try_for_each(check)?;
            Ok(dofs.named(edit))
        };
        Ok(edits.iter().map(resolve).collect())
    }
}

/// A skips module with new edits, and the files of the URDD that change.
#[derive(Debug)]
pub struct EditedSkips {
    /// `link_shapes_skips_module`.
    pub module: LinkShapesSkipsModule,
    /// Changed files by path relative to the root: the module's JSON and YAML, and `urdd.json` with their sizes and
    /// hashes.
    pub files: Files,
    /// Whether the URDD has a self-collision model. It was trained with the previous skips and must be regenerated.
    pub model_is_stale: bool,
    /// The modules of the URDD that rest on the skips, that model among them: they must be generated again.
    pub stale: Vec<ModuleKind>,
}

impl EditedSkips {
    /// The skips between shapes of a kind with the edits applied; `before` are those of the robot.
    pub fn skips(&self, kind: ShapeKind, before: &Skips) -> Skips {
        before.of_module(kind, self.module.clone())
    }
}

impl Robot {
    /// Replaces the URDD's skip edits and, if given, its skipped reasons. Returns the changed files and writes nothing.
    ///
    /// # Errors
    /// [`RobotError::Unknown`] if an edit names an unknown link; [`RobotError::Missing`] and [`RobotError::Unusable`]
    /// if `urdf_module`, `link_shapes_simple_skips_module` or `link_shapes_skips_module` of version 1 is missing or
    /// unusable; [`RobotError::Metadata`] if `urdd.json` is.
    pub fn with_skip_edits(
        &self,
        edits: Vec<SkipEdit>,
        skipped_reasons: Option<Vec<SkippedReason>>,
    ) -> Result<EditedSkips, RobotError> {
        let part = self.part(&[ModuleKind::Urdf, SIMPLE, SKIPS])?;
        let documents = (part.document(SIMPLE), part.document(SKIPS));
        let (
            Some(ModuleDocument::LinkShapesSimpleSkips(simple)),
            Some(ModuleDocument::LinkShapesSkips(now)),
        ) = documents
        else {
            usable(&part, SIMPLE)?;
            return Err(RobotError::Missing(SKIPS));
        };
        let described = part.robot().ok_or(RobotError::Missing(ModuleKind::Urdf))?;
        let links = described.links.iter();
        let names: Vec<String> = links.map(|link| link.name.clone()).collect();
        for edit in &edits {
            for link in [&edit.link_a, &edit.link_b] {
                if described.link(link).is_none() {
                    index("link", &names, link)?;
                }
            }
        }
        let reasons = skipped_reasons.unwrap_or_else(|| now.skipped_reasons.clone());
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let module = skips_module(simple, reasons, edits, &names);
        let files = self.edited_files(SKIPS, serde_json::to_value(&module))?;
        let rests_on_skips = |kind: &ModuleKind| kind.depends_on().contains(&SKIPS);
        let kinds = ModuleKind::ALL.iter().copied().filter(rests_on_skips);
        let stale: Vec<ModuleKind> =
            kinds.filter(|kind| part.listing().has_folder(kind.folder())).collect();
        let model_is_stale = stale.contains(&ModuleKind::SelfCollisionModel);
        Ok(EditedSkips { module, files, model_is_stale, stale })
    }
}
