//! A robot, opened: its modules, read on demand; the names of its parts; and its source URDF: as data, its text, its limits.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use crate::error::RobotError;
use crate::kept::{Closure, Configurations, LinkMass, LinkShape, Motion};
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::{Source, is_urdd};
use urdd_document::carried_urdf::read_file;
use urdd_document::kept::{Kept, keep};
use urdd_document::urdd::Urdd;
use urdd_format::loops::LoopsModule;
use urdd_format::named_configurations::NamedConfiguration;
use urdd_format::nearest::nearest;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};
use urdd_format::root_metadata;
use urdd_format::shape_kind::ShapeKind;
use urdd_format::urdf::UrdfModule;

/// A robot, described by a URDD.
///
/// It can be shared between threads, and never changes. It is the robot that was there when it was opened: a module is
/// read when it is first needed, and kept. If its files changed on disk before, the answer is [`RobotError::Changed`],
/// never a mix of two robots.
///
/// Opening a folder takes the device, inode number, size and ctime of each file; each read compares them after its last
/// byte. An edit that keeps size and mtime is noticed, and so are a file or folder in the place of another, and an edit
/// in the same tick of the clock: opening waits 20 ms where a file is that new. New hard links and permissions count as
/// changes. An edit that keeps the size can be missed on FAT, within the 3 s for which NFS keeps times, and on Windows if
/// it keeps the mtime too. Archives are read whole. Other sources in memory do not change.
#[derive(Debug)]
pub struct Robot {
    modules: Kept,
    motion: OnceLock<Arc<Motion>>,
    configurations: OnceLock<Configurations>,
    pub(super) named: OnceLock<Vec<NamedConfiguration>>,
    pub(super) loops: OnceLock<Option<LoopsModule>>,
    pub(super) closure: OnceLock<Option<Arc<Closure>>>,
    /// The largest speeds, and the largest efforts.
    pub(super) limits: OnceLock<[Vec<f64>; 2]>,
    pub(super) masses: OnceLock<Vec<LinkMass>>,
    pub(super) shapes: [OnceLock<Vec<LinkShape>>; ShapeKind::ALL.len()],
}

impl Robot {
    /// Opens the robot in a folder or a zip archive. Lists the files of a folder; reads no module yet.
    ///
    /// # Errors
    /// [`RobotError::Open`] if the path cannot be opened.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, RobotError> {
        let path = path.as_ref();
        let opened = Root::open(path)
            .map_err(|error| RobotError::Open { path: path.display().to_string(), error })?;
        Ok(Self::at(&opened))
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
        Self::at(&Root::of(source))
    }

    fn at(root: &Root) -> Self {
        Self {
            modules: Kept::new(root),
            motion: OnceLock::new(),
            configurations: OnceLock::new(),
            named: OnceLock::new(),
            loops: OnceLock::new(),
            closure: OnceLock::new(),
            limits: OnceLock::new(),
            masses: OnceLock::new(),
            shapes: Default::default(),
        }
    }

    /// The files that were there when it was opened: a read of one that changed is an error.
    #[doc(hidden)]
    pub fn root(&self) -> &Root {
        self.modules.root()
    }

    /// The name of the folder or archive.
    pub fn folder_name(&self) -> String {
        self.root().folder_name()
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
    #[doc(hidden)]
    pub fn part_as_it_is(&self, kinds: &[ModuleKind]) -> Result<Urdd, RobotError> {
        let loaded = self.modules.part(kinds);
        let loaded = loaded.map_err(|error| of_read(self.root(), error, RobotError::List))?;
        Ok(Urdd::new(Arc::new(loaded)))
    }

    /// The part with a module that a URDD may lack; `None` without it.
    pub(super) fn optional(&self, kind: ModuleKind) -> Result<Option<Urdd>, RobotError> {
        let part = self.part_as_it_is(&[kind])?;
        if part.module(kind).is_none() {
            return Ok(None);
        }
        usable(&part, kind)?;
        Ok(Some(part))
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
        keep(&self.motion, || Ok(Arc::new(Motion::new(&self.moving_part(&[])?)?)))
    }

    /// The robot's configurations and their bounds.
    ///
    /// # Errors
    /// If `chain_module`, `dof_module` or `bounds_module` is missing or unusable.
    pub fn configurations(&self) -> Result<&Configurations, RobotError> {
        keep(&self.configurations, || {
            Configurations::new(&self.moving_part(&[ModuleKind::Bounds])?)
        })
    }
}

/// Why files could not be read: they changed, or what `other` makes of the error.
pub(super) fn of_read(
    root: &Root,
    error: ReadError,
    other: impl FnOnce(ReadError) -> RobotError,
) -> RobotError {
    match error {
        ReadError::Changed => RobotError::Changed(root.folder_name()),
        error => other(error),
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

/// Names of links, joints and DOFs, in the order of their indices.
///
/// Each method fails if `chain_module` or `dof_module` is missing or unusable, and one that is given a name with
/// [`RobotError::Unknown`] if there is none such, with the nearest name.
impl Robot {
    /// The name of each link.
    pub fn link_names(&self) -> Result<&[String], RobotError> {
        Ok(&self.motion()?.links)
    }

    /// The index of the root link, whose frame poses are in.
    pub fn root_link(&self) -> Result<usize, RobotError> {
        Ok(self.motion()?.kinematics.root())
    }

    /// The index of a link.
    pub fn link(&self, name: &str) -> Result<usize, RobotError> {
        index("link", self.link_names()?, name)
    }

    /// The name of each joint.
    pub fn joint_names(&self) -> Result<&[String], RobotError> {
        Ok(&self.motion()?.joints)
    }

    /// The index of a joint.
    pub fn joint(&self, name: &str) -> Result<usize, RobotError> {
        index("joint", self.joint_names()?, name)
    }

    /// The name of each DOF: that of its joint, with the coordinate if the joint has several DOFs.
    pub fn dof_names(&self) -> Result<&[String], RobotError> {
        Ok(&self.motion()?.dofs)
    }

    /// The index of a DOF.
    pub fn dof(&self, name: &str) -> Result<usize, RobotError> {
        index("DOF", self.dof_names()?, name)
    }

    /// The unit of each DOF: `rad` or `m`.
    pub fn dof_units(&self) -> Result<&[&'static str], RobotError> {
        Ok(&self.motion()?.units)
    }
}

/// # Errors
/// [`RobotError::OutOfRange`] if there are at most `link` links.
pub(super) fn check_link(link: usize, count: usize) -> Result<(), RobotError> {
    match link < count {
        true => Ok(()),
        false => Err(RobotError::OutOfRange { what: "link", index: link, count }),
    }
}

pub(super) fn index(
    what: &'static str,
    names: &[impl AsRef<str>],
    name: &str,
) -> Result<usize, RobotError> {
    names.iter().position(|known| known.as_ref() == name).ok_or_else(|| RobotError::Unknown {
        what,
        name: name.to_owned(),
        nearest: nearest(names.iter().map(AsRef::as_ref), name),
    })
}

/// The file that a URDD was generated from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// The file's path in the URDD.
    pub path: String,
    /// The SHA-256 of its content, as 64 hexadecimal digits.
    pub sha256: String,
}

impl Robot {
    /// The robot's URDF as data: links with mass, visuals and collisions, joints with limits. Link and joint indices
    /// refer to this order. Zeros that a legacy URDD writes for missing values are absent here.
    ///
    /// # Errors
    /// If `urdf_module` is missing or unusable.
    pub fn description(&self) -> Result<UrdfModule, RobotError> {
        let part = self.part(&[ModuleKind::Urdf])?;
        part.description().cloned().ok_or(RobotError::Missing(ModuleKind::Urdf))
    }

    /// The source URDF that the URDD includes, according to its metadata. `None` if there is none, or in a legacy URDD.
    ///
    /// # Errors
    /// If the files cannot be listed.
    pub fn source(&self) -> Result<Option<SourceFile>, RobotError> {
        let part = self.part_as_it_is(&[])?;
        let source = part.metadata().and_then(|metadata| metadata.source.as_ref());
        Ok(source.map(|root_metadata::Source::Urdf(file)| SourceFile {
            path: file.path.clone(),
            sha256: file.sha256.to_string(),
        }))
    }

    /// The text of the source URDF. `None` if there is none, or it cannot be read.
    ///
    /// # Errors
    /// If the files cannot be listed, or this one changed on disk.
    pub fn source_text(&self) -> Result<Option<String>, RobotError> {
        let Some(file) = self.source()? else { return Ok(None) };
        match read_file(self.root(), &file.path) {
            Err(ReadError::Changed) => Err(RobotError::Changed(self.folder_name())),
            read => Ok(read.ok().map(|read| read.text)),
        }
    }
}

/// Each method fails if `bounds_module` is missing or unusable, or that of a legacy URDD, which has neither.
impl Robot {
    /// The largest speed of each DOF, rad/s or m/s, as the source states it; infinite where it states none.
    pub fn velocity_limits(&self) -> Result<&[f64], RobotError> {
        Ok(&self.limits()?[0])
    }

    /// The largest effort of each DOF, N m or N, as the source states it; infinite where it states none.
    pub fn effort_limits(&self) -> Result<&[f64], RobotError> {
        Ok(&self.limits()?[1])
    }

    fn limits(&self) -> Result<&[Vec<f64>; 2], RobotError> {
        keep(&self.limits, || {
            let part = self.part(&[ModuleKind::Bounds])?;
            let Some(ModuleDocument::Bounds(bounds)) = part.document_v1(ModuleKind::Bounds) else {
                return Err(RobotError::Missing(ModuleKind::Bounds));
            };
            let limits = [&bounds.dof_velocity_limits, &bounds.dof_effort_limits];
            Ok(limits.map(|all| all.iter().map(|limit| limit.unwrap_or(f64::INFINITY)).collect()))
        })
    }
}
