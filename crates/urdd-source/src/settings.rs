//! How a description is found and read.

use std::path::PathBuf;
use std::sync::Arc;

use super::declared::Declared;
use super::files::Files;
use super::packages::Packages;
use super::xacro::XacroSettings;

/// How a description is found and read. By default, with only the packages around it, from the disk.
#[derive(Debug, Clone, Default)]
pub struct Settings {
    /// The folders of packages.
    pub packages: Packages,
    /// Folders, besides those of the robot and its packages, from which mesh files may be read.
    pub allowed_folders: Vec<PathBuf>,
    /// How xacro files are expanded.
    pub xacro: XacroSettings,
    /// What is chosen of a description that is no URDF.
    pub import: ImportOptions,
    /// The robots that are declared of files: of one in a folder, and of one that is named without arguments.
    pub robots: Arc<[Declared]>,
    /// The file that says what closes the robot's loops. By default the one beside the URDF.
    pub loops: Option<PathBuf>,
    /// Where files are.
    pub files: Files,
}

impl Settings {
    /// The settings with arguments for xacro that are declared of a file. Of two values of an argument, xacro takes the last.
    pub fn with_declared(&self, arguments: &[String]) -> Settings {
        let mut settings = self.clone();
        settings.xacro.arguments = arguments.iter().chain(&self.xacro.arguments).cloned().collect();
        settings
    }
}

/// What a person can choose of an import.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ImportOptions {
    /// The body of an MJCF or USD that is the root of the robot. By default it is told by the structure.
    pub body: Option<String>,
    /// The model of an SDF. By default it is the only one.
    pub model: Option<String>,
    /// Whether a ball is written as three revolute joints.
    pub has_revolute_balls: bool,
    /// Whether links between the joints of one body get a tiny mass, which MuJoCo asks of what moves.
    pub has_tiny_masses: bool,
}
