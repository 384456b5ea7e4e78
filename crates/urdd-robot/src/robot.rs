//! A robot, opened: its modules, read on demand.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use super::error::RobotError;
use super::motion::Motion;
use super::space::Configurations;
use urdd_directory::root::Root;
use urdd_directory::source::{Source, is_urdd};
use urdd_document::load::Loaded;
use urdd_document::urdd::Urdd;
use urdd_format::named_configurations::NamedConfiguration;
use urdd_format::registry::{ModuleKind, Profile};

/// A robot, described by a URDD.
///
/// It can be shared between threads.
#[derive(Debug)]
pub struct Robot {
    pub(super) root: Root,
    motion: OnceLock<Result<Arc<Motion>, RobotError>>,
    configurations: OnceLock<Result<Arc<Configurations>, RobotError>>,
    pub(super) named: OnceLock<Result<Vec<NamedConfiguration>, RobotError>>,
}

impl Robot {
    /// Opens the robot in a folder or a zip archive. Reads no module yet.
    ///
    /// # Errors
    /// [`RobotError::Open`] if the path cannot be opened.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, RobotError> {
        let path = path.as_ref();
        let opened = Root::open(path)
            .map_err(|error| RobotError::Open { path: path.display().to_string(), error })?;
        Ok(Self::at(opened))
    }

    /// As [`Robot::open`], for a path that a person gave: a folder without `urdd.json` and without the folder of a module
    /// is an error now, not when a module is needed.
    ///
    /// # Errors
    /// As there, and [`RobotError::NoUrdd`].
    pub fn open_urdd(path: impl AsRef<Path>) -> Result<Self, RobotError> {
        let path = path.as_ref();
        let robot = Self::open(path)?;
        if path.is_dir() && !is_urdd(path) {
            let path = path.display().to_string();
            return Err(RobotError::NoUrdd { path });
        }
        Ok(robot)
    }

    /// The robot whose files are in `source`.
    pub fn of(source: impl Source + 'static) -> Self {
        Self::at(Root::of(source))
    }

    fn at(root: Root) -> Self {
        Self {
            root,
            motion: OnceLock::new(),
            configurations: OnceLock::new(),
            named: OnceLock::new(),
        }
    }

    /// The name of the folder or archive.
    pub fn folder_name(&self) -> String {
        self.root.folder_name()
    }
}

impl Robot {
    /// These modules; an error if one is missing or unusable.
    pub(super) fn part(&self, kinds: &[ModuleKind]) -> Result<Urdd, RobotError> {
        let part = self.part_as_it_is(kinds)?;
        for kind in kinds {
            usable(&part, *kind)?;
        }
        Ok(part)
    }

    /// These modules, without a check that they are present and usable.
    pub(super) fn part_as_it_is(&self, kinds: &[ModuleKind]) -> Result<Urdd, RobotError> {
        let loaded = Loaded::read_only(self.root.clone(), kinds).map_err(RobotError::List)?;
        Ok(Urdd::new(Arc::new(loaded)))
    }

    /// The modules that kinematics needs, and `more`. For a legacy URDD also `urdf_module`, which alone has origins and
    /// axes.
    pub(super) fn moving_part(&self, more: &[ModuleKind]) -> Result<Urdd, RobotError> {
        let mut kinds = vec![ModuleKind::Chain, ModuleKind::Dof];
        kinds.extend_from_slice(more);
        let part = self.part(&kinds)?;
        if part.profile() == Profile::V1 {
            return Ok(part);
        }
        kinds.push(ModuleKind::Urdf);
        self.part(&kinds)
    }

    pub(super) fn motion(&self) -> Result<&Motion, RobotError> {
        Ok(self.shared_motion()?)
    }

    pub(super) fn shared_motion(&self) -> Result<&Arc<Motion>, RobotError> {
        let read = || Ok(Arc::new(Motion::new(&self.moving_part(&[])?)?));
        match self.motion.get_or_init(read) {
            Ok(motion) => Ok(motion),
            Err(error) => Err(error.clone()),
        }
    }

    /// The robot's configurations and their bounds.
    ///
    /// # Errors
    /// If `chain_module`, `dof_module` or `bounds_module` is missing or unusable.
    pub fn configurations(&self) -> Result<&Configurations, RobotError> {
        let read = || {
            let part = self.moving_part(&[ModuleKind::Bounds])?;
            Ok(Arc::new(Configurations::new(&part)?))
        };
        match self.configurations.get_or_init(read) {
            Ok(configurations) => Ok(configurations),
            Err(error) => Err(error.clone()),
        }
    }
}

/// An error if a module is missing or unusable.
pub(super) fn usable(part: &Urdd, kind: ModuleKind) -> Result<(), RobotError> {
    let module = part.module(kind).ok_or(RobotError::Missing(kind))?;
    match module.unusable() {
        None => Ok(()),
        Some(unusable) => Err(RobotError::Unusable {
            module: kind,
            reason: module
                .first_fault()
                .unwrap_or_else(|| unusable.to_string())
                .escape_debug()
                .to_string(),
        }),
    }
}
