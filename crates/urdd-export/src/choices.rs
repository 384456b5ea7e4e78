//! What a person chose of the options of all formats, and which of it fits a format.

use std::path::PathBuf;

use thiserror::Error;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_robot::ShapeKind;

use crate::{
    Detail, DrakeOptions, Fit, Format, LinkOptions, MeshOptions, MjcfOptions, ModelOptions,
    MoveitOptions, Options, Ros, Setup, Shapes, SphereBudget, SphereOptions, UsdOptions,
};
use urdd_directory::export_toml::ActuatorKind;

/// What a person chose, by the names that options have in Python; the command line has `robot_file` as `--config`.
/// The fields are documented where they go: in the options of each format.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "named and documented as in the options of each format")]
pub struct Choices {
    pub shapes: Shapes,
    pub reasons: Option<Vec<SkippedReason>>,
    pub keep_pairs: bool,
    pub merge_fixed: bool,
    pub root: Option<String>,
    pub fit: Option<Fit>,
    pub spheres: SphereBudget,
    pub cover: bool,
    pub samples: usize,
    pub visuals: Option<Detail>,
    /// By default named after [`Choices::output`], or `meshes`.
    pub mesh_folder: Option<String>,
    /// Where the file, or the folder of a package, will be written.
    pub output: Option<PathBuf>,
    /// Of MoveIt, by default named after [`Choices::output`], or [`Choices::PACKAGE`].
    pub package: Option<String>,
    /// Of MoveIt, by default [`Ros::Jazzy`].
    pub ros: Option<Ros>,
    pub robot_file: Option<String>,
    pub floating_base: bool,
    pub actuators: Option<ActuatorKind>,
    pub bandwidth: Option<f64>,
    pub sensors: bool,
    /// Whether a scene is written beside [`Choices::output`].
    pub scene: bool,
    pub setup: Option<Setup>,
}

impl Default for Choices {
    fn default() -> Self {
        Choices {
            shapes: ShapeKind::Pieces.into(),
            reasons: None,
            keep_pairs: false,
            merge_fixed: false,
            root: None,
            fit: None,
            spheres: SphereBudget::default(),
            cover: false,
            samples: 10_000,
            visuals: Some(Detail::Full),
            mesh_folder: None,
            output: None,
            package: None,
            ros: None,
            robot_file: None,
            floating_base: false,
            actuators: None,
            bandwidth: None,
            sensors: false,
            scene: false,
            setup: None,
        }
    }
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
        self.of.iter().map(|format| format.word()).collect::<Vec<_>>().join(" and ")
    }
}

/// An option, whether it was chosen, and the formats that have it.
type Only = (&'static str, fn(&Choices) -> bool, &'static [Format]);

/// Formats of links with shapes. Spheres are fitted to links as the URDD has them.
const WITH_TREE: &[Format] = &[
    Format::Srdf,
    Format::Urdf,
    Format::Drake,
    Format::Mjcf,
    Format::Moveit,
    Format::Sdf,
    Format::Usd,
];

/// Options that are refused for formats that do not have them. Others are passed over there.
const ONLY: [Only; 10] = [
    ("fit", |of| of.fit.is_some(), WITH_TREE),
    ("merge_fixed", |of| of.merge_fixed, WITH_TREE),
    ("root", |of| of.root.is_some(), WITH_TREE),
    ("actuators", |of| of.actuators.is_some(), &[Format::Mjcf, Format::Usd]),
    ("sensors", |of| of.sensors, &[Format::Mjcf]),
    ("scene", |of| of.scene, &[Format::Mjcf]),
    ("floating_base", |of| of.floating_base, &[Format::Mjcf, Format::Sdf, Format::Usd]),
    ("robot_file", |of| of.robot_file.is_some(), &[Format::Curobo]),
    ("ros", |of| of.ros.is_some(), &[Format::Moveit]),
    ("package", |of| of.package.is_some(), &[Format::Moveit, Format::Drake]),
];

impl Choices {
    /// The name of the package of a configuration of MoveIt that is not written to a folder.
    pub const PACKAGE: &str = "robot_moveit_config";

    /// The options of a format.
    ///
    /// # Errors
    /// If something was chosen that the format does not have.
    pub fn options(&self, format: Format) -> Result<Options, Misfit> {
        for (option, is_chosen, of) in ONLY {
            if is_chosen(self) && !of.contains(&format) {
                return Err(Misfit { option, of });
            }
        }
        let model = self.model(format);
        Ok(match format {
            Format::Srdf => Options::Srdf(model),
            Format::Urdf => Options::Urdf(model),
            Format::Sdf => Options::Sdf(model),
            Format::Usd => Options::Usd(UsdOptions { model, file: self.file() }),
            Format::Drake => {
                let (package, file) = (self.package.clone(), self.file());
                Options::Drake(DrakeOptions { model, package, file })
            }
            Format::Mjcf => {
                let scene_of = self.file().filter(|_| self.scene);
                Options::Mjcf(MjcfOptions { model, sensors: self.sensors, scene_of })
            }
            Format::Moveit => {
                let mut model = model;
                let package = self.package.clone().or_else(|| self.package_of_output());
                if let (Some(package), None) = (&package, &self.mesh_folder) {
                    model.meshes.folder = format!("package://{package}/meshes");
                }
                let package = package.unwrap_or_else(|| Self::PACKAGE.to_owned());
                let ros = self.ros.unwrap_or_default();
                Options::Moveit(MoveitOptions { model, package, ros })
            }
            Format::Curobo => Options::Curobo(self.spheres(format)),
            Format::Foam => Options::Foam(self.spheres(format)),
            Format::Spherized => Options::Spherized(self.spheres(format)),
        })
    }

    fn model(&self, format: Format) -> ModelOptions {
        let has_setup = !matches!(format, Format::Srdf | Format::Urdf);
        let has_actuators = matches!(format, Format::Mjcf | Format::Usd);
        ModelOptions {
            shapes: self.shapes,
            reasons: self.reasons.clone(),
            keep_pairs: self.keep_pairs,
            links: LinkOptions {
                merge_fixed: self.merge_fixed,
                root: self.root.clone(),
                fit: self.fit,
            },
            meshes: self.meshes(format != Format::Srdf),
            floating_base: self.floating_base,
            actuators: self.actuators,
            bandwidth: self.bandwidth.filter(|_| has_actuators),
            setup: self.setup.clone().filter(|_| has_setup),
        }
    }

    fn spheres(&self, format: Format) -> SphereOptions {
        SphereOptions {
            shapes: self.shapes,
            reasons: self.reasons.clone(),
            budget: self.spheres,
            cover: self.cover,
            samples: self.samples,
            meshes: self.meshes(format == Format::Spherized),
            robot_file: self.robot_file.clone(),
            setup: self.setup.clone().filter(|_| format == Format::Curobo),
        }
    }

    fn meshes(&self, has_visuals: bool) -> MeshOptions {
        let stem = self.output.as_ref().map(|file| file.file_stem().unwrap_or_default());
        let named = || stem.map(|stem| format!("{}_meshes", stem.to_string_lossy()));
        let folder = self.mesh_folder.clone().or_else(named);
        MeshOptions {
            visuals: self.visuals.filter(|_| has_visuals),
            folder: folder.unwrap_or_else(|| "meshes".to_owned()),
        }
    }

    /// The name of the file.
    fn file(&self) -> Option<String> {
        let name = self.output.as_ref()?.file_name()?;
        Some(name.to_string_lossy().into_owned())
    }

    /// The name of a package in the folder where it is written. Whether ROS takes it, the export says.
    fn package_of_output(&self) -> Option<String> {
        let name = self.output.as_ref()?.file_name().unwrap_or_default().to_string_lossy();
        Some(name.to_lowercase().replace(['-', ' ', '.'], "_"))
    }
}
