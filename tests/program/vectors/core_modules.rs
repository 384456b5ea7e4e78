//! Mimics and inertia: through a URDF, by the generator, the validator's reference and its rules.

use std::fs;
use std::path::Path;

use nalgebra::Vector3;
use serde::Deserialize;
use urdd_format::dof::{DofModule, ResolvedMimic};
use urdd_generate::{Settings as HowToGenerate, generate};
use urdd_kinematics::rotation::to_rotation_vector;
use urdd_validate::reference::{MimicDofs, Reference};
use urdd_validate::settings::Settings;
use urdd_validate::validate;

use super::{assert_near, vectors};

#[derive(Deserialize)]
struct Robots {
    robots: Vec<Robot>,
}

#[derive(Deserialize)]
struct Robot {
    name: String,
    joints: Vec<Joint>,
    resolved: Vec<Option<ResolvedMimic>>,
    configuration: Vec<f64>,
    positions: Vec<Vec<f64>>,
}

#[derive(Deserialize)]
struct Joint {
    name: String,
    #[serde(rename = "type")]
    joint_type: String,
    mimic: Option<Mimic>,
}

#[derive(Deserialize)]
struct Mimic {
    joint: String,
    multiplier: f64,
    offset: f64,
}

/// Each joint attached to the root, about or along z.
fn urdf(robot: &Robot) -> String {
    let joints = robot.joints.iter().map(|joint| {
        let mimic = joint.mimic.as_ref().map(|mimic| {
            format!(
                r#"<mimic joint="{}" multiplier="{}" offset="{}"/>"#,
                mimic.joint, mimic.multiplier, mimic.offset
            )
        });
        let Joint { name, joint_type, .. } = joint;
        let mimic = mimic.unwrap_or_default();
        format!(
            r#"<link name="{name}_link"/><joint name="{name}" type="{joint_type}"><parent link="root"/><child link="{name}_link"/><axis xyz="0 0 1"/><limit lower="-9" upper="9" effort="1" velocity="1"/>{mimic}</joint>"#
        )
    });
    let joints: String = joints.collect();
    format!(r#"<robot name="r"><link name="root"/>{joints}</robot>"#)
}

fn generated(urdf: &str, folder: &Path) -> std::path::PathBuf {
    let source = folder.join("r.urdf");
    fs::write(&source, urdf).unwrap();
    let target = folder.join("r");
    generate(&source, &target, &HowToGenerate::default(), &()).unwrap();
    target
}

#[test]
fn mimics() {
    let robots: Robots = vectors("mimics.json");
    assert!(robots.robots.len() > 5);
    for robot in robots.robots {
        let urdf = urdf(&robot);
        let folder = testkit::temporary::folder();
        let target = generated(&urdf, folder.path());
        let text = fs::read_to_string(target.join("dof_module/module.json")).unwrap();
        let module: DofModule = serde_json::from_str(&text).unwrap();
        assert_eq!(module.num_dofs.get(), robot.configuration.len(), "{}", robot.name);
        assert_eq!(module.joint_idx_to_mimic_mapping.len(), robot.resolved.len());
        let resolved = module.joint_idx_to_mimic_mapping.iter().zip(&robot.resolved);
        for (found, expected) in resolved {
            let dof = |mimic: &Option<ResolvedMimic>| mimic.as_ref().map(|mimic| mimic.dof_idx);
            assert_eq!(dof(found), dof(expected), "{}", robot.name);
            let numbers = |mimic: &Option<ResolvedMimic>| {
                mimic.as_ref().map_or([0.0; 2], |mimic| [mimic.multiplier, mimic.offset])
            };
            assert_near(&numbers(found), &numbers(expected), 1e-15, &robot.name);
        }
        let own = module.joint_idx_to_dof_idxs_mapping.iter();
        for (dofs, (expected, mimic)) in own.zip(robot.positions.iter().zip(&robot.resolved)) {
            let found: Vec<f64> = dofs.iter().map(|dof| robot.configuration[dof.get()]).collect();
            assert!(mimic.is_some() || found == *expected, "{}", robot.name);
        }
        let reference = Reference::new(
            &urdd_validate::urdf_text::read(&urdf).robot.unwrap(),
            MimicDofs::Follow,
        )
        .unwrap();
        let poses = reference.link_poses(&robot.configuration).unwrap();
        for ((joint, pose), expected) in robot.joints.iter().zip(&poses[1..]).zip(&robot.positions)
        {
            let turn: Vector3<f64> = to_rotation_vector(&pose.rotation).into();
            let found = match joint.joint_type.as_str() {
                "revolute" | "continuous" => {
                    // A turn by more than pi appears as a turn in the other direction.
                    let turns = ((expected[0] - turn.z) / std::f64::consts::TAU).round();
                    vec![turn.z + turns * std::f64::consts::TAU]
                }
                "prismatic" => vec![pose.translation.z],
                "fixed" => {
                    assert_eq!((pose.translation.vector.norm(), turn.norm()), (0.0, 0.0));
                    vec![]
                }
                // Joints with several DOFs cannot be mimics; forward_kinematics.json has their motion.
                _ => continue,
            };
            let place = format!("{}, joint {}", robot.name, joint.name);
            assert_near(&found, expected, 1e-14, &place);
        }
    }
}

#[derive(Deserialize)]
struct Tensors {
    tensors: Vec<Tensor>,
}

#[derive(Deserialize)]
struct Tensor {
    name: String,
    inertia: Inertia,
    principal_moments: [f64; 3],
    positive_definite: bool,
    triangle_inequality: Option<bool>,
}

#[derive(Deserialize)]
struct Inertia {
    ixx: f64,
    ixy: f64,
    ixz: f64,
    iyy: f64,
    iyz: f64,
    izz: f64,
}

#[test]
fn inertia() {
    let tensors: Tensors = vectors("inertia.json");
    assert!(tensors.tensors.len() > 10);
    for case in tensors.tensors {
        let Inertia { ixx, ixy, ixz, iyy, iyz, izz } = case.inertia;
        let urdf = format!(
            r#"<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="{ixx}" ixy="{ixy}" ixz="{ixz}" iyy="{iyy}" iyz="{iyz}" izz="{izz}"/></inertial></link></robot>"#
        );
        let folder = testkit::temporary::folder();
        let target = generated(&urdf, folder.path());
        let run = validate(&[target], &Settings::default()).unwrap();
        let urdd = &run.report.urdds[0];
        let found = |code: &str| {
            assert!(urdd.checks.iter().any(|check| check.code == code));
            urdd.findings.iter().find(|finding| finding.code == code)
        };
        let (definite, triangle) = (found("SRC004"), found("SRC005"));
        assert_eq!(definite.is_none(), case.positive_definite, "{}", case.name);
        let breaks = case.triangle_inequality == Some(false);
        assert_eq!(triangle.is_some(), breaks, "{}", case.name);
        // The moments, as the finding shows them: to five digits.
        if let Some(finding) = definite.or(triangle) {
            let actual = finding.actual.as_ref().unwrap();
            let shown = actual.split("principal moments ").nth(1).unwrap();
            let shown: Vec<f64> = shown
                .split(", ")
                .map(|number| number.trim_end_matches(" kg m²").parse().unwrap())
                .collect();
            let largest = case.principal_moments.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            assert_near(&shown, &case.principal_moments, 6e-5 * largest, &case.name);
        }
    }
}
