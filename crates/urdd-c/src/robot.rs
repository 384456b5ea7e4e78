//! A robot: opened, and freed.

use std::ffi::c_char;
use std::sync::OnceLock;

use urdd_directory::source::Archive;
use urdd_format::named_configurations::NamedConfiguration;
use urdd_robot::RobotError;

use crate::failure::{Failure, Owned, Status};
use crate::memory::{enough, free, handle, make, read_text, values};
use crate::queries::Rows;

/// A robot, as its URDD describes it.
pub struct Robot {
    pub(crate) robot: urdd_robot::Robot,
    /// Of links, of joints, of DOFs.
    names: OnceLock<[Vec<Owned>; 3]>,
    configurations: OnceLock<Vec<Owned>>,
    loops: OnceLock<[Vec<Owned>; 2]>,
}

handle!(Robot, "urdd_robot");

impl Robot {
    fn new(robot: urdd_robot::Robot) -> Self {
        Robot {
            robot,
            names: OnceLock::new(),
            configurations: OnceLock::new(),
            loops: OnceLock::new(),
        }
    }

    pub(crate) fn names(&self) -> Result<&[Vec<Owned>; 3], RobotError> {
        let robot = &self.robot;
        let names = [robot.link_names()?, robot.joint_names()?, robot.dof_names()?];
        let owned = |names: &[String]| names.iter().map(|name| Owned::new(name)).collect();
        Ok(self.names.get_or_init(|| names.map(owned)))
    }

    /// The names of the configurations that a person named.
    pub(crate) fn configuration_names(&self) -> Result<&[Owned], RobotError> {
        let named = self.robot.named_configurations()?;
        let name = |named: &NamedConfiguration| Owned::new(&named.name.to_string());
        let names = || named.iter().map(name).collect();
        Ok(self.configurations.get_or_init(names))
    }

    /// The names of the loops, and of the couplings.
    pub(crate) fn loop_names(&self) -> Result<&[Vec<Owned>; 2], RobotError> {
        let module = self.robot.loops()?;
        let names = || match module {
            None => [Vec::new(), Vec::new()],
            Some(module) => [
                module.loops.iter().map(|one| Owned::new(&one.name)).collect(),
                module.couplings.iter().map(|one| Owned::new(&one.name)).collect(),
            ],
        };
        Ok(self.loops.get_or_init(names))
    }

    pub(crate) fn num_dofs(&self) -> Result<usize, RobotError> {
        Ok(self.robot.dof_names()?.len())
    }

    pub(crate) unsafe fn rows<'a>(
        &self,
        what: &'static str,
        data: *const f64,
        shape: (usize, usize),
    ) -> Result<Rows<'a>, Failure> {
        unsafe { Rows::new(what, data, shape, self.num_dofs()?) }
    }
}

/// Opens the URDD in a folder or zip archive. Lists a folder's files, and reads no module yet: a call that needs one
/// reads it, and it is kept.
///
/// `path` is in UTF-8. Errors: `OPEN` if there is no URDD.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_open(path: *const c_char, out: *mut *mut Robot) -> Status {
    unsafe {
        make(out, || {
            let robot = urdd_robot::Robot::open_urdd(read_text("path", path)?)?;
            Ok(Robot::new(robot))
        })
    }
}

/// Opens the URDD in a zip archive in memory. The bytes are copied. `name` stands for the archive in messages.
///
/// Errors: `OPEN` if the bytes are not a zip archive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_of_archive(
    name: *const c_char,
    bytes: *const u8,
    length: usize,
    out: *mut *mut Robot,
) -> Status {
    unsafe {
        make(out, || {
            let archive = archive(read_text("name", name)?, values("bytes", bytes, length)?)?;
            Ok(Robot::new(urdd_robot::Robot::of(archive)))
        })
    }
}

pub(crate) fn archive(name: &str, bytes: &[u8]) -> Result<Archive, Failure> {
    enough("bytes", bytes.len(), 2)?;
    Archive::new(name, bytes.to_vec()).map_err(|error| {
        let message = format!("{}: {error}", name.escape_debug());
        Failure::new(Status::Open, message)
    })
}

/// Frees a robot. What was made of it stays. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_free(robot: *mut Robot) -> Status {
    unsafe { free(robot) }
}
