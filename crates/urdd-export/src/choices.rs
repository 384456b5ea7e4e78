//! What a person chose of the options of all formats, and which of it fits a format.

use std::path::PathBuf;

use thiserror::Error;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_robot::ShapeKind;

use super::actuator_kind::ActuatorKind;
use super::fit::Fit;
use super::format::Format;
use super::options::{
    CuroboOptions, Detail, DrakeOptions, LinkOptions, MeshOptions, MjcfOptions, ModelOptions,
    MoveitOptions, Options, PairOptions, SdfOptions, SphereBudget, SphereOptions, SpherizedOptions,
    UrdfOptions, UsdOptions,
};
use super::ros::Ros;
use super::setup::Setup;
use super::shapes::Shapes;

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
        Ok(match format {
            Format::Srdf => Options::Srdf(self.pairs()),
            Format::Urdf => Options::Urdf(UrdfOptions {
                shapes: self.shapes,
                meshes: self.meshes(),
                links: self.links(),
            }),
            Format::Drake => Options::Drake(DrakeOptions {
                model: self.model(),
                package: self.package.clone(),
                file: self.file(),
            }),
            Format::Mjcf => Options::Mjcf(MjcfOptions {
                shapes: self.shapes,
                reasons: self.reasons.clone(),
                meshes: self.meshes(),
                floating_base: self.floating_base,
                actuators: self.actuators,
                bandwidth: self.bandwidth,
                sensors: self.sensors,
                scene_of: self.file().filter(|_| self.scene),
                links: self.links(),
                setup: self.setup.clone(),
            }),
            Format::Curobo => Options::Curobo(CuroboOptions {
                spheres: self.spheres(),
                robot_file: self.robot_file.clone(),
                setup: self.setup.clone(),
            }),
            Format::Foam => Options::Foam(self.spheres()),
            Format::Spherized => Options::Spherized(SpherizedOptions {
                spheres: self.spheres(),
                meshes: self.meshes(),
            }),
            Format::Moveit => {
                let mut model = self.model();
                let package = self.package.clone().or_else(|| self.package_of_output());
                if let (Some(package), None) = (&package, &self.mesh_folder) {
                    model.meshes.folder = format!("package://{package}/meshes");
                }
                let package = package.unwrap_or_else(|| Self::PACKAGE.to_owned());
                let ros = self.ros.unwrap_or_default();
                Options::Moveit(MoveitOptions { model, package, ros })
            }
            Format::Sdf => {
                Options::Sdf(SdfOptions { model: self.model(), floating_base: self.floating_base })
            }
            Format::Usd => Options::Usd(UsdOptions {
                pairs: self.pairs(),
                meshes: self.meshes(),
                floating_base: self.floating_base,
                actuators: self.actuators,
                bandwidth: self.bandwidth,
                file: self.file(),
                setup: self.setup.clone(),
            }),
        })
    }

    fn model(&self) -> ModelOptions {
        ModelOptions { pairs: self.pairs(), meshes: self.meshes(), setup: self.setup.clone() }
    }

    fn pairs(&self) -> PairOptions {
        let reasons = self.reasons.clone();
        let (shapes, keep_pairs) = (self.shapes, self.keep_pairs);
        PairOptions { shapes, reasons, keep_pairs, links: self.links() }
    }

    fn links(&self) -> LinkOptions {
        LinkOptions { merge_fixed: self.merge_fixed, root: self.root.clone(), fit: self.fit }
    }

    fn meshes(&self) -> MeshOptions {
        let stem = self.output.as_ref().map(|file| file.file_stem().unwrap_or_default());
        let named = || stem.map(|stem| format!("{}_meshes", stem.to_string_lossy()));
        let folder = self.mesh_folder.clone().or_else(named);
        MeshOptions { visuals: self.visuals, folder: folder.unwrap_or_else(|| "meshes".to_owned()) }
    }

    fn spheres(&self) -> SphereOptions {
        SphereOptions {
            shapes: self.shapes,
            reasons: self.reasons.clone(),
            budget: self.spheres,
            cover: self.cover,
            samples: self.samples,
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
