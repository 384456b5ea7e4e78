use nalgebra::{Isometry3, Quaternion, UnitQuaternion};

use crate::reference::{MimicDofs, Reference};
use crate::rules::prelude::*;
use urdd_document::consumer;
use urdd_kinematics::pose::to_isometry;
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
    ], check poses_disagree,

    /// A stored link pose is not where forward kinematics puts the link.
    ///
    /// Consumers take these poses for truth when they test their own kinematics: a wrong one makes
    /// right programs look wrong. (Poses are compared with those that follow from `chain_module` and
    /// `dof_module`, which are held to the carried URDF by KIN001.)
    ///
    /// Compute the poses again. Where only some links are off, look at the joint above the first of
    /// them; where all are off by one transform, look at the frame: poses are in the root link's.
    KIN003 "sample-pose-wrong", Error, clause "9.2", since "0.1.0",
    phase Kinematics, needs [
        Version1, Module(Kind::KinematicsSamples), ModuleV1(Kind::Chain), ModuleV1(Kind::Dof), Module(Kind::Urdf),
        Passed(KIN002), Passed(CHN001), Passed(CHN003), Passed(CHN006), Passed(CHN008), Passed(CHN009),
        Passed(CHN010), Passed(DOF007),
    ], check sample_pose_wrong,
}

/// Number of the specification's sampled configurations that are compared.
const SAMPLES: u64 = 8;

fn poses_disagree(context: &Context, findings: &mut Findings) -> Option<()> {
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

fn sample_pose_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let tree = context.tree()?;
    let samples = document!(context, KinematicsSamples)?;
    let chain = document!(context, Chain)?;
    let dof = document!(context, Dof)?;
    let kinematics = ForwardKinematics::new(chain, dof);
    let kinematics = findings.or_skip(kinematics.map_err(SkipReason::obstacle))?;
    let tolerance = POSITION_OF_REACH * reach(robot, tree);
    for (place, sample) in samples.samples.iter().enumerate() {
        let Ok(poses) = kinematics.link_poses(&sample.configuration) else { continue };
        for (link, (expected, stored)) in poses.iter().zip(&sample.link_poses).enumerate() {
            let (kind, name) = (sample.kind, &robot.links.get(link)?.name);
            let pointer = format!("/samples/{place}/link_poses/{link}");
            let found = match to_isometry(stored) {
                Ok(found) => found,
                Err(error) => {
                    let message = format!(
                        "the pose of link {name:?} in {kind} cannot be read as a pose: {error}"
                    );
                    finding_in(Kind::KinematicsSamples, pointer, message).report(findings);
                    continue;
                }
            };
            let [w, ..] = stored.quaternion_wxyz;
            let norm = stored.quaternion_wxyz.iter().map(|x| x * x).sum::<f64>();
            let norm = norm.sqrt();
            if (norm - 1.0).abs() > UNIT_NORM {
                let message = format!(
                    "the quaternion of link {name:?} in {kind} has length {norm:?}; divide it by that"
                );
                finding_in(Kind::KinematicsSamples, pointer, message)
                    .values("length 1", norm)
                    .tolerance(UNIT_NORM)
                    .report(findings);
                continue;
            }
            let (shift, turn) = pose_distance(&found, expected);
            if shift > tolerance || turn > ROTATION {
                let reordered = in_order_xyzw(stored.quaternion_wxyz);
                let reordered = Isometry3::from_parts(found.translation, reordered);
                let is_xyzw =
                    shift <= tolerance && pose_distance(&reordered, expected).1 <= ROTATION;
                let angle = angle_of_distance(turn);
                let (off, unit) = if shift > tolerance { (shift, "m") } else { (angle, "rad") };
                let message = match is_xyzw {
                    true => format!(
                        "in {kind}, the quaternion of link {name:?} is written x, y, z, w; write w first"
                    ),
                    false => format!(
                        "in {kind}, link {name:?} is {} m and {} rad from where forward kinematics puts it",
                        number(shift, 4),
                        number(angle, 4)
                    ),
                };
                finding_in(Kind::KinematicsSamples, pointer, message)
                    .expected(describe_sample(expected))
                    .actual(format!(
                        "position {:?}, quaternion {:?}",
                        stored.position, stored.quaternion_wxyz
                    ))
                    .tolerance(tolerance)
                    .off_by(off, unit)
                    .report(findings);
            } else if w < -UNIT_NORM {
                let message = format!(
                    "the quaternion of link {name:?} in {kind} has w < 0; negate all four numbers, which is the same rotation"
                );
                finding_in(Kind::KinematicsSamples, pointer, message)
                    .values("w >= 0", w)
                    .report(findings);
            }
        }
    }
    Some(())
}

/// The rotation of four numbers that were written x, y, z, w.
fn in_order_xyzw([x, y, z, w]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}

fn describe_sample(pose: &Isometry3<f64>) -> String {
    let p = pose.translation;
    let rotation = canonical(&pose.rotation);
    let q = rotation.quaternion();
    format!("position [{}, {}, {}], quaternion [{}, {}, {}, {}]", p.x, p.y, p.z, q.w, q.i, q.j, q.k)
}
