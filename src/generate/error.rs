//! Why a URDD could not be made.

use std::fmt;
use std::path::PathBuf;

use thiserror::Error;

use super::fault::PlacedFault;
use crate::directory::staging::StagingError;
use crate::format::escape;

/// Most faults of a file that are told one by one.
const MOST_TOLD: usize = 5;

/// Why a URDD could not be made. Nothing was written then, and what was there before still is.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GenerateError {
    /// The source cannot be read.
    #[error("{file}: cannot be read: {reason}")]
    Read {
        /// The file, as the user named it.
        file: String,
        /// Why.
        reason: String,
    },
    /// The source is no robot.
    #[error("{}", Told(file, faults))]
    Refused {
        /// The file, as the user named it.
        file: String,
        /// What is wrong with it, in the order of the file; never empty.
        faults: Vec<PlacedFault>,
    },
    /// A xacro file, and no xacro program.
    #[error(
        "{file}: this is a xacro file, and there is no program `xacro` on the PATH to expand it; install it (`pip install xacro`, or ROS), or expand the file elsewhere: `xacro {file} > robot.urdf`"
    )]
    NoXacro {
        /// The file, as the user named it.
        file: String,
    },
    /// The xacro program failed.
    #[error("{file}: `xacro` could not expand it: {reason}")]
    Xacro {
        /// The file, as the user named it.
        file: String,
        /// The last lines that the program wrote.
        reason: String,
    },
    /// The URDD would replace its own source.
    #[error("{file}: it lies in the output folder {}, which is to be replaced; give another output folder", target.display())]
    SourceInTarget {
        /// The file, as the user named it.
        file: String,
        /// The output folder.
        target: PathBuf,
    },
    /// The URDD cannot be written.
    #[error(transparent)]
    Write(#[from] StagingError),
    /// The robot's geometry is beyond what can be computed.
    #[error("{file}: {reason}; mend the mesh, or leave out the distances: `--modules geometry`")]
    Geometry {
        /// The file, as the user named it.
        file: String,
        /// Why.
        reason: String,
    },
    /// A fault of this program.
    #[error(
        "{file}: the generator failed: {reason}; this is a fault of the program, please report it with the file"
    )]
    Internal {
        /// The file, as the user named it.
        file: String,
        /// What happened.
        reason: String,
    },
}

impl GenerateError {
    /// A word for programs: what kind of error it is.
    pub fn code(&self) -> &'static str {
        match self {
            GenerateError::Read { .. } => "unreadable",
            GenerateError::Refused { .. } => "refused",
            GenerateError::NoXacro { .. } => "no-xacro",
            GenerateError::Xacro { .. } => "xacro-failed",
            GenerateError::SourceInTarget { .. } => "source-in-output",
            GenerateError::Write(_) => "not-written",
            GenerateError::Geometry { .. } => "geometry",
            GenerateError::Internal { .. } => "internal",
        }
    }
}

/// The faults of a file, as lines.
struct Told<'a>(&'a str, &'a [PlacedFault]);

impl fmt::Display for Told<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Told(file, faults) = self;
        // A line for each: no name may add another.
        let file = escape::line(file);
        for (number, placed) in faults.iter().take(MOST_TOLD).enumerate() {
            if number > 0 {
                f.write_str("\n")?;
            }
            let (line, column) = (placed.line, placed.column);
            let fault = placed.fault.to_string();
            write!(f, "{file}:{line}:{column}: {}", escape::line(&fault))?;
        }
        if faults.len() > MOST_TOLD {
            write!(
                f,
                "\n{file}: and {} more of such faults",
                faults.len() - MOST_TOLD
            )?;
        }
        Ok(())
    }
}
