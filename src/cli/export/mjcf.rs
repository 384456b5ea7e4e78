//! Arguments of `urdd export` for single formats.

use clap::{Args, ValueEnum};

use urdd_export::{ActuatorKind, BANDWIDTH, Choices};

/// Arguments of MJCF alone.
#[derive(Args)]
pub struct MjcfArguments {
    /// MJCF and USD: adds an actuator, or a drive, to each joint of one DOF. Gains are computed from inertias, for `--bandwidth`.
    #[arg(long, value_enum, value_name = "KIND", default_value_t = Actuators::None)]
    actuators: Actuators,

    /// MJCF and USD: the frequency below which a joint follows its actuator, Hz.
    /// Default: that of `NAME.export.toml`, or 10.
    #[arg(long, value_name = "HZ", value_parser = |word: &str| BANDWIDTH.parse::<f64>(word))]
    bandwidth: Option<f64>,

    /// MJCF: a gyroscope and an accelerometer at each IMU frame of `NAME.export.toml`.
    #[arg(long)]
    sensors: bool,

    /// MJCF: writes a scene with floor and light beside the file: `NAME_scene.xml`.
    #[arg(long)]
    scene: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Actuators {
    /// No actuators.
    None,
    /// They are told positions, rad or m.
    Position,
    /// They are told velocities, rad/s or m/s.
    Velocity,
    /// They are told torques or forces, N m or N.
    Motor,
}

impl MjcfArguments {
    pub(super) fn choose(&self, choices: &mut Choices) {
        let word = self.actuators.to_possible_value();
        choices.actuators = word.and_then(|word| ActuatorKind::named(word.get_name()));
        choices.bandwidth = self.bandwidth;
        choices.sensors = self.sensors;
        choices.scene = self.scene;
    }
}
