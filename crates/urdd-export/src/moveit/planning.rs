//! Limits, solvers of inverse kinematics, and planners.

use super::config::Config;
use crate::yaml::head;
use crate::{ExportError, Ros, Yaml};

/// Plugins and adapters, by the names that a distribution's MoveIt has for them.
fn pipeline(ros: Ros) -> &'static str {
    match ros {
        Ros::Humble => include_str!("ompl_humble.yaml.in"),
        Ros::Jazzy => include_str!("ompl_jazzy.yaml.in"),
    }
}

/// Planners. Their parameters are OMPL's defaults.
const OMPL: &str = include_str!("ompl_planning.yaml.in");

/// The planners of a group, the default one first.
const PLANNERS: [&str; 5] = [
    "RRTConnectkConfigDefault",
    "RRTstarkConfigDefault",
    "BiTRRTkConfigDefault",
    "PRMkConfigDefault",
    "PRMstarkConfigDefault",
];

pub(super) fn files(config: &Config) -> Result<Vec<(String, String)>, ExportError> {
    let limits = config.comments("Limits of velocity are the URDF's, of acceleration and jerk the URDF's or those of `[limits]`: rad/s, m/s and so on.")?;
    let kinematics =
        config.comments("Solvers of inverse kinematics, for each group that is a chain.")?;
    let planning = config.comments("Planners, with OMPL's default parameters.")?;
    Ok(vec![
        ("config/joint_limits.yaml".to_owned(), self::limits(config).document(&limits)),
        ("config/kinematics.yaml".to_owned(), self::kinematics(config).document(&kinematics)),
        (
            "config/ompl_planning.yaml".to_owned(),
            head(&planning) + pipeline(config.ros) + OMPL + &groups(config),
        ),
    ])
}

fn limits(config: &Config) -> Yaml {
    let subject = config.subject;
    let joints = (0..subject.view.joints.len()).filter(|joint| subject.is_driven(*joint));
    let limits = joints.map(|joint| {
        let [velocity, acceleration, jerk] = config.limits(joint);
        let mut entries = Vec::new();
        for (has, most, value) in [
            ("has_velocity_limits", "max_velocity", velocity),
            ("has_acceleration_limits", "max_acceleration", acceleration),
            ("has_jerk_limits", "max_jerk", jerk),
        ] {
            entries.push((has.to_owned(), Yaml::Plain(value.is_some().to_string())));
            entries.push((most.to_owned(), Yaml::number(value.unwrap_or(0.0))));
        }
        (config.joint(joint), Yaml::Map(entries))
    });
    Yaml::map([
        ("default_velocity_scaling_factor", Yaml::number(0.1)),
        ("default_acceleration_scaling_factor", Yaml::number(0.1)),
        ("joint_limits", Yaml::named(limits)),
    ])
}

fn kinematics(config: &Config) -> Yaml {
    let solver = || {
        Yaml::map([
            ("kinematics_solver", Yaml::plain("kdl_kinematics_plugin/KDLKinematicsPlugin")),
            ("kinematics_solver_search_resolution", Yaml::number(0.005)),
            ("kinematics_solver_timeout", Yaml::number(0.05)),
        ])
    };
    let chains = config.chains();
    Yaml::named(chains.map(|group| (config.setup.groups[group].value.name.as_str(), solver())))
}

/// The planners of each group that something drives.
fn groups(config: &Config) -> String {
    let groups = config.setup.groups.iter().zip(&config.joints);
    let groups = groups.filter(|(group, joints)| !group.value.passive && !joints.is_empty());
    let groups = groups.map(|(group, _)| {
        let of_group = Yaml::map([
            ("default_planner_config", Yaml::plain(PLANNERS[0])),
            ("planner_configs", Yaml::List(PLANNERS.map(Yaml::plain).into())),
        ]);
        Yaml::named([(group.value.name.as_str(), of_group)]).document(&[])
    });
    groups.collect()
}
