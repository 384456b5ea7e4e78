//! The robots that a settings file declares.

use std::path::{Path, PathBuf};

use clap::Args;

use super::output::{Failure, one_line, shown};
use super::reporting::settings_file;
use urdd_lint::declared;
use urdd_source::{Declared, robots_of};

/// Where robots are declared.
#[derive(Args)]
pub(super) struct RobotArguments {
    /// Settings file that declares robots of xacro files, as [[robot]]; default: urdd.toml in the current folder, if it
    /// exists.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

impl RobotArguments {
    /// The robots that the settings file declares.
    pub(super) fn declared(&self) -> Result<Vec<Declared>, Failure> {
        Ok(declared(&settings_file(self.config.as_deref())?))
    }

    /// The arguments of the only robot that it declares of a file; none where it declares none.
    pub(super) fn arguments_of(&self, file: &Path) -> Result<Vec<String>, Failure> {
        match robots_of(file.to_owned(), &self.declared()?).as_slice() {
            [one] => Ok(one.arguments.clone()),
            several => {
                let first = several.first().map(|one| one.arguments.join(" ")).unwrap_or_default();
                let (file, count) = (shown(file), several.len());
                let words = format!(
                    "{file}: urdd.toml declares {count} robots of it; give the arguments of one, such as `{}`",
                    one_line(first)
                );
                Err(words.into())
            }
        }
    }
}
