//! The robots that a settings file declares.

use std::path::{Path, PathBuf};

use clap::Args;

use super::output::{Failure, one_line, shown};
use super::reporting::settings_file;
use urdd_lint::declared;
use urdd_source::{Declared, declared_of};
use urdd_validate::settings_file::SETTINGS_FILE;

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

    /// The arguments of the only robot that it declares of a file; `None` where it declares none.
    pub(super) fn arguments_of(&self, file: &Path) -> Result<Option<Vec<String>>, Failure> {
        match declared_of(file, &self.declared()?).as_slice() {
            [] => Ok(None),
            [one] => Ok(Some(one.arguments.clone())),
            several @ [first, ..] => {
                let settings = self.config.as_deref().unwrap_or(Path::new(SETTINGS_FILE));
                let words = format!(
                    "{}: {} declares {} robots of it; give the arguments of one, such as `{}`",
                    shown(file),
                    shown(settings),
                    several.len(),
                    one_line(first.arguments.join(" "))
                );
                Err(words.into())
            }
        }
    }
}
