//! The arguments that say where the mesh files of a URDF are.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::output::{Failure, one_line, shown};
use urdd_source::ImportOptions;
use urdd_source::{Packages, Settings};

/// Where the mesh files of a URDF are.
#[derive(Args)]
pub(super) struct PackageArguments {
    /// Folder of a ROS package that a URDF names. May be repeated.
    #[arg(long = "package", value_name = "NAME=PATH")]
    packages: Vec<String>,

    /// Additional folder that the mesh files of a URDF may be read from, and the parts of a recipe, besides those of the
    /// robot, its packages and the recipe. May be repeated.
    #[arg(long = "allow-folder", value_name = "DIR")]
    allowed_folders: Vec<PathBuf>,

    /// The body of an MJCF that is the root of the robot; default: told by the structure.
    #[arg(long, value_name = "NAME")]
    body: Option<String>,

    /// The model of an SDF file that has several.
    #[arg(long, value_name = "NAME")]
    model: Option<String>,

    /// How a ball joint of an MJCF or SDF is written: as a spherical joint, which few programs read, or as three revolute
    /// joints.
    #[arg(long, value_enum, default_value_t = Ball::Spherical, value_name = "JOINTS")]
    ball: Ball,

    /// The mass of the links between several joints of one body of an MJCF or SDF: none, or 1e-9 kg and 1e-9 kg m², which
    /// MuJoCo asks of what moves.
    #[arg(long, value_enum, default_value_t = Massless::None, value_name = "MASS")]
    massless: Massless,
}

/// The mass of links between joints.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Massless {
    /// None.
    None,
    /// 1e-9 kg and 1e-9 kg m².
    Tiny,
}

/// How a ball joint is written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Ball {
    /// As one joint of the type `spherical`.
    Spherical,
    /// As three revolute joints.
    Revolute,
}

/// Settings with the packages that the environment names; the others are the defaults.
pub(super) fn around() -> Settings {
    let packages = Packages::from_environment(|name| std::env::var_os(name));
    Settings { packages, ..Settings::default() }
}

impl PackageArguments {
    /// Settings that use them; the others are the defaults.
    pub(super) fn settings(&self) -> Result<Settings, Failure> {
        let mut settings = around();
        for argument in &self.packages {
            let added = settings.packages.add(argument);
            added.map_err(|error| format!("--package: {}", one_line(error)))?;
        }
        if let Some(folder) = self.allowed_folders.iter().find(|it| !it.is_dir()) {
            Err(format!("--allow-folder: {} is not a folder", shown(folder)))?;
        }
        Ok(Settings {
            allowed_folders: self.allowed_folders.clone(),
            import: ImportOptions {
                body: self.body.clone(),
                model: self.model.clone(),
                has_revolute_balls: self.ball == Ball::Revolute,
                has_tiny_masses: self.massless == Massless::Tiny,
            },
            ..settings
        })
    }
}
