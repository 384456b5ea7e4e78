//! Configurations that a person named, such as `home`.

use super::Robot;
use super::edited_files::Files;
use super::error::RobotError;
use super::robot::usable;
use urdd_document::kept::keep;
use urdd_format::named_configurations::{
    ConfigurationEdit, DofPosition, NamedConfiguration, NamedConfigurationsModule, NamedDofs,
    PositionFault,
};
use urdd_format::registry::{ModuleDocument, ModuleKind};

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
            let part = self.part_as_it_is(&[NAMED])?;
            if part.module(NAMED).is_none() {
                return Ok(Vec::new());
            }
            usable(&part, NAMED)?;
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
        let idx = super::names::index("configuration", &names.collect::<Vec<_>>(), name)?;
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
                super::names::index("DOF", &names, &position.dof_name).map(|_| ())
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
