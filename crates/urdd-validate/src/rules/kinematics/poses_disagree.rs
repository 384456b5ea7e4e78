use nalgebra::Isometry3;

use crate::reference::{MimicDofs, Reference};
use crate::rules::prelude::*;
use urdd_document::consumer;
use urdd_kinematics::rotation::canonical;
use urdd_kinematics::{ConfigurationError, ForwardKinematics, unit};

declare_rule! {
    /// The poses that follow from the modules are not those that follow from the carried URDF.
    ///
    /// Forward kinematics is computed twice: as a consumer does it, from `chain_module` and
    /// `dof_module` (for legacy URDDs `urdf_module` besides), and from the text of the URDF by an
    /// independent path. Configurations are zero, the middle, lower and upper ends of the limits,
    /// and a few of the specification's samples. A robot that is driven by such modules goes
    /// somewhere else than its URDF says.
    ///
    /// The finding names the first joint, from the root outwards, at which the two differ. Write the
    /// modules again from the carried URDF, or carry the URDF from which they were written.
    KIN001 "poses-disagree", Error, clause "9.1", since "0.1.0",
    phase Kinematics, needs [
        CarriedUrdf, Module(Kind::Urdf), Module(Kind::Chain), Module(Kind::Dof), Passed(URD001), ROBOT_SOUND,
        Passed(URD009), Passed(URD012), Passed(URD010), Passed(CHN002), Passed(CHN003), Passed(CHN006),
        Passed(DOF003), Passed(DOF004), Passed(DOF005),
        // These report what moves links, and where. Legacy modules do not have these fields.
        NoneFailed(&[DOF007, CHN007, CHN008, CHN009, CHN010]),
    ],
}

/// Number of the specification's sampled configurations that are compared.
const SAMPLES: u64 = 8;

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let legacy = context.profile() == Profile::Legacy;
    let source = context.urdf_text()?.robot.as_ref()?;
    let robot = context.robot()?;
    let tree = context.tree()?;
    let dofs = context.dofs()?;
    let modules = findings.or_skip(consumer::modules(context).ok_or(skip::KINEMATICS_OPEN))?;
    let mut joints = robot.joints.iter().zip(&dofs.joint_idx_to_dof_idxs_mapping);
    let mimics =
        match joints.any(|(joint, dofs)| joint.active_mimic().is_some() && !dofs.is_empty()) {
            true => MimicDofs::Own,
            false => MimicDofs::Follow,
        };
    let reference = Reference::new(source, mimics).map_err(SkipReason::obstacle);
    let reference = findings.or_skip(reference)?;
    if legacy && reference.has(JointType::Planar) {
        return findings.skip(skip::LEGACY_COORDINATES);
    }
    let file = format!("{}/module.json", Kind::Chain.folder());
    let kinematics = match ForwardKinematics::new(&modules.chain, &modules.dof) {
        Ok(kinematics) => kinematics,
        Err(error) => {
            let message =
                format!("forward kinematics cannot be computed from the modules: {error}");
            Finding::in_file(file, message).report(findings);
            return Some(());
        }
    };
    let tolerance = POSITION_OF_REACH * reach(robot, tree);
    for (name, configuration) in configurations(&reference) {
        let found = match kinematics.link_poses(&configuration) {
            Ok(found) => Some(found),
            // Numbers beyond 64 bits.
            Err(error @ ConfigurationError::Overflow { .. }) => {
                let message = format!("the link poses cannot be computed ({name}): {error}");
                Finding::in_file(file, message).report(findings);
                return Some(());
            }
            Err(_) => None,
        };
        let Some((found, expected)) = found.zip(reference.link_poses(&configuration)) else {
            let message = "the modules and the URDF have configurations of different lengths";
            Finding::in_file(file, message)
                .counts(reference.num_dofs(), kinematics.num_dofs(), "DOFs")
                .report(findings);
            return Some(());
        };
        let first = tree.order.iter().find(|link| {
            let pair = found.get(**link).zip(expected.get(**link));
            pair.is_none_or(|(found, expected)| !agree(found, expected, tolerance))
        });
        let Some(&link) = first else { continue };
        let (found, expected) = (found.get(link)?, expected.get(link)?);
        let joint = tree.parent_joint[link].unwrap_or(0);
        let (shift, turn) = pose_distance(found, expected);
        let turn = angle_of_distance(turn);
        let pointer = format!("/joints_in_chain/{joint}");
        let message = format!(
            "in configuration {name}, link {:?} (joint {:?}) is {} m and {} rad from where the URDF has it",
            robot.links[link].name,
            robot.joints[joint].name,
            number(shift, 4),
            number(turn, 4)
        );
        Finding::at(file, pointer, message)
            .values(describe(expected), describe(found))
            .tolerance(tolerance)
            .off_by(shift, "m")
            .report(findings);
        // Other configurations would report the same joint.
        return Some(());
    }
    Some(())
}

fn configurations(reference: &Reference) -> Vec<(String, Vec<f64>)> {
    let intervals = reference.intervals();
    let each = |value: &dyn Fn(usize, [f64; 2]) -> f64| -> Vec<f64> {
        let intervals = intervals.iter().enumerate();
        intervals.map(|(i, interval)| value(i, *interval)).collect()
    };
    let middle = each(&|_, [lower, upper]| lower / 2.0 + upper / 2.0);
    let mut configurations = vec![
        ("zero".to_owned(), each(&|_, _| 0.0)),
        ("middle".to_owned(), middle),
        ("lower".to_owned(), each(&|_, [lower, _]| lower)),
        ("upper".to_owned(), each(&|_, [_, upper]| upper)),
    ];
    for k in 0..SAMPLES {
        let sampled = each(&|i, [lower, upper]| lower + unit(k, i as u64) * (upper - lower));
        configurations.push((format!("sample {k}"), sampled));
    }
    configurations.retain(|(_, configuration)| configuration.iter().all(|q| q.is_finite()));
    configurations
}

fn agree(a: &Isometry3<f64>, b: &Isometry3<f64>, tolerance: f64) -> bool {
    let (shift, turn) = pose_distance(a, b);
    shift <= tolerance && turn <= ROTATION
}

fn describe(pose: &Isometry3<f64>) -> String {
    let p = pose.translation;
    let rotation = canonical(&pose.rotation);
    let q = rotation.quaternion();
    format!(
        "position ({:.9}, {:.9}, {:.9}), quaternion ({:.9}, {:.9}, {:.9}, {:.9})",
        p.x, p.y, p.z, q.w, q.i, q.j, q.k
    )
}
