//! What a person chose, for a format.

use thiserror::Error;
use urdd_directory::range::OutOfRange;

use crate::choices::CHOICES;
use crate::{Choices, Format};

/// The options of a format. [`Choices::options`] makes it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The format.
    pub format: Format,
    /// What was chosen. What the format has no place for is not read.
    pub chosen: Choices,
    /// The folder of the mesh files, relative to the text: without a trailing `/`, and empty for the same folder.
    pub mesh_folder: String,
    /// The name of the package, which MoveIt's configuration always has.
    pub package: Option<String>,
    /// The name of the file.
    pub file: Option<String>,
}

/// An option that does not fit the format.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{option} is for {} only", self.formats())]
pub struct Misfit {
    /// The option, as in [`Choices`].
    pub option: &'static str,
    /// The formats that it is for.
    pub of: &'static [Format],
}

impl Misfit {
    /// The words of the formats that the option is for.
    pub fn formats(&self) -> String {
        let words: Vec<&str> = self.of.iter().map(|format| format.word()).collect();
        match words.split_last() {
            Some((last, others)) if !others.is_empty() => {
                format!("{} and {last}", others.join(", "))
            }
            _ => words.concat(),
        }
    }
}

impl Choices {
    /// The name of the package of a configuration of MoveIt that is not written to a folder.
    pub const PACKAGE: &str = "robot_moveit_config";

    /// The options of a format. Meshes and packages are named after what is written.
    ///
    /// # Errors
    /// If something was chosen that the format does not have.
    pub fn options(&self, format: Format) -> Result<Options, Misfit> {
        let misfit = |of: &&crate::Choice| (of.is_chosen)(self) && !of.of.contains(&format);
        if let Some(choice) = CHOICES.iter().find(misfit) {
            return Err(Misfit { option: choice.name, of: choice.of });
        }
        let mut chosen = self.clone();
        chosen.bandwidth =
            chosen.bandwidth.filter(|_| matches!(format, Format::Mjcf | Format::Usd));
        let has_setup = !matches!(format, Format::Srdf | Format::Foam | Format::Spherized)
            && !format.is_plain_urdf();
        chosen.setup = chosen.setup.filter(|_| has_setup);
        let text = |of: &std::ffi::OsStr| of.to_string_lossy().into_owned();
        let output = self.output.as_ref();
        let file = output.and_then(|output| output.file_name()).map(text);
        let named = output.map(|file| text(file.file_stem().unwrap_or_default()) + "_meshes");
        let mut mesh_folder = self.mesh_folder.clone().or(named);
        let mut package = self.package.clone();
        if format == Format::Moveit {
            // Whether ROS takes it, the export says.
            let folder = output.map(|_| file.clone().unwrap_or_default().to_lowercase());
            package = package.or(folder.map(|folder| folder.replace(['-', ' ', '.'], "_")));
            let inside = package.as_ref().map(|package| format!("package://{package}/meshes"));
            mesh_folder = self.mesh_folder.clone().or(inside).or(mesh_folder);
            package = package.or_else(|| Some(Self::PACKAGE.to_owned()));
        }
        let mesh_folder = mesh_folder.unwrap_or_else(|| "meshes".to_owned());
        Ok(Options { format, chosen, mesh_folder, package, file })
    }
}

impl Options {
    /// Checks that each option is in its range.
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        CHOICES.iter().try_for_each(|choice| (choice.check)(&self.chosen))
    }
}
