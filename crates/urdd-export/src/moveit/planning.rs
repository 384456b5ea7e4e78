//! Limits, solvers of inverse kinematics, and planners.

use super::super::error::ExportError;
use super::super::yaml::{Yaml, entries, named};
use super::config::Config;

/// Planners, by MoveIt's names of their settings. Their parameters are OMPL's defaults.
const PLANNERS: [(&str, &str); 5] = [
    ("RRTConnectkConfigDefault", "geometric::RRTConnect"),
    ("RRTstarkConfigDefault", "geometric::RRTstar"),
    ("BiTRRTkConfigDefault", "geometric::BiTRRT"),
    ("PRMkConfigDefault", "geometric::PRM"),
    ("PRMstarkConfigDefault", "geometric::PRMstar"),
];

pub(super) fn files(config: &Config) -> Result<Vec<(String, String)>, ExportError> {
    let limits = config.comments("Limits of velocity are the URDF's, of acceleration and jerk the URDF's or those of `[limits]`: rad/s, m/s and so on.")?;
    let kinematics =
        config.comments("Solvers of inverse kinematics, for each group that is a chain.")?;
    let planning = config.comments("Planners, with OMPL's default parameters.")?;
    Ok(vec![
        ("config/joint_limits.yaml".to_owned(), self::limits(config).document(&limits)),
        ("config/kinematics.yaml".to_owned(), self::kinematics(config).document(&kinematics)),
        ("config/ompl_planning.yaml".to_owned(), ompl(config).document(&planning)),
    ])
}

fn limits(config: &Config) -> Yaml {
    let subject = config.subject;
    let joints = (0..subject.view.joints.len()).filter(|joint| subject.is_driven(*joint));
    let limits = joints.map(|joint| {
        let source = subject.urdf.joints[joint].limit.as_ref();
        let positive = |value: Option<f64>| value.filter(|value| *value > 0.0 && value.is_finite());
        let velocity = positive(source.and_then(|limit| limit.velocity));
        let acceleration = positive(source.and_then(|limit| limit.acceleration));
        let jerk = positive(source.and_then(|limit| limit.jerk));
        let mut entries = Vec::new();
        for (has, most, value) in [
            ("has_velocity_limits", "max_velocity", velocity),
            (
                "has_acceleration_limits",
                "max_acceleration",
                acceleration.or(config.setup.acceleration),
            ),
            ("has_jerk_limits", "max_jerk", jerk.or(config.setup.jerk)),
        ] {
            entries.push((
                has.to_owned(),
                Yaml::plain(if value.is_some() { "true" } else { "false" }),
            ));
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

fn ompl(config: &Config) -> Yaml {
    let requests = [
        "ResolveConstraintFrames",
        "ValidateWorkspaceBounds",
        "CheckStartStateBounds",
        "CheckStartStateCollision",
    ];
    let responses = ["AddTimeOptimalParameterization", "ValidateSolution", "DisplayMotionPath"];
    let adapters = |kind: &str, names: &[&str]| {
        let names = names
            .iter()
            .map(|name| Yaml::Plain(format!("default_planning_{kind}_adapters/{name}")));
        Yaml::List(names.collect())
    };
    let planners = PLANNERS.map(|(name, kind)| (name, Yaml::map([("type", Yaml::plain(kind))])));
    let names = || Yaml::List(PLANNERS.iter().map(|(name, _)| Yaml::plain(name)).collect());
    let mut settings = entries([
        ("planning_plugins", Yaml::List(vec![Yaml::plain("ompl_interface/OMPLPlanner")])),
        ("request_adapters", adapters("request", &requests)),
        ("response_adapters", adapters("response", &responses)),
        ("planner_configs", Yaml::map(planners)),
    ]);
    let groups = config.setup.groups.iter().zip(&config.joints);
    let groups = groups.filter(|(group, joints)| !group.value.passive && !joints.is_empty());
    let groups = groups.map(|(group, _)| {
        let of_group = Yaml::map([
            ("default_planner_config", Yaml::plain(PLANNERS[0].0)),
            ("planner_configs", names()),
        ]);
        (group.value.name.as_str(), of_group)
    });
    settings.extend(named(groups));
    Yaml::Map(settings)
}
