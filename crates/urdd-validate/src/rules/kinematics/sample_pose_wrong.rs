use nalgebra::{Isometry3, Quaternion, UnitQuaternion};

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use crate::tolerance::{
    POSITION_OF_REACH, ROTATION, UNIT_NORM, angle_of_distance, reach, rotation_distance,
};
use urdd_format::readable::number;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_kinematics::ForwardKinematics;
use urdd_kinematics::pose::to_isometry;
use urdd_kinematics::rotation::canonical;

declare_rule! {
    /// A stored link pose is not where forward kinematics puts the link.
    ///
    /// Consumers take these poses for truth when they test their own kinematics: a wrong one makes
    /// right programs look wrong. (Poses are compared with those that follow from `chain_module` and
    /// `dof_module`, which are held to the carried URDF by KIN001.)
    ///
    /// Compute the poses again. Where only some links are off, look at the joint above the first of
    /// them; where all are off by one transform, look at the frame: poses are in the root link's.
    KIN003 "sample-pose-wrong", Error, clause "9.2", since "0.1.0",
    phase Kinematics,
    needs [
        Version1, Module(Kind::KinematicsSamples), Module(Kind::Chain), Module(Kind::Dof), Module(Kind::Urdf), Passed(KIN002),
        Passed(CHN001), Passed(CHN003), Passed(CHN006), Passed(CHN008), Passed(CHN009), Passed(CHN010), Passed(DOF007),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(module), Some(robot), Some(tree)) = (
        context.module(ModuleKind::KinematicsSamples),
        context.robot(),
        context.tree(),
    ) else {
        return;
    };
    let (
        Some(ModuleDocument::KinematicsSamples(samples)),
        Some(ModuleDocument::Chain(chain)),
        Some(ModuleDocument::Dof(dof)),
    ) = (
        &module.document,
        context.document(ModuleKind::Chain),
        context.document(ModuleKind::Dof),
    )
    else {
        return;
    };
    let kinematics = match ForwardKinematics::new(chain, dof) {
        Ok(kinematics) => kinematics,
        Err(error) => return findings.skip(SkipReason::Kinematics(error.to_string())),
    };
    let tolerance = POSITION_OF_REACH * reach(robot, tree);
    for (place, sample) in samples.samples.iter().enumerate() {
        let Ok(poses) = kinematics.link_poses(&sample.configuration) else {
            continue;
        };
        for (link, (expected, stored)) in poses.iter().zip(&sample.link_poses).enumerate() {
            let name = robot
                .links
                .get(link)
                .map(|link| link.name.as_str())
                .unwrap_or_default();
            let pointer = format!("/samples/{place}/link_poses/{link}");
            let found = match to_isometry(stored) {
                Ok(found) => found,
                Err(error) => {
                    let message = format!(
                        "the pose of link {name:?} in {} cannot be read as a pose: {error}",
                        sample.kind
                    );
                    findings.report(Finding::at(module.file("module.json"), pointer, message));
                    continue;
                }
            };
            let [w, ..] = stored.quaternion_wxyz;
            let norm = stored.quaternion_wxyz.iter().map(|x| x * x).sum::<f64>();
            let norm = norm.sqrt();
            if (norm - 1.0).abs() > UNIT_NORM {
                let message = format!(
                    "the quaternion of link {name:?} in {} has length {norm:?}; divide it by that",
                    sample.kind
                );
                findings.report(
                    Finding::at(module.file("module.json"), pointer, message)
                        .expected("length 1")
                        .actual(norm)
                        .tolerance(UNIT_NORM),
                );
                continue;
            }
            let (shift, turn) = difference(&found, expected);
            if shift > tolerance || turn > ROTATION {
                let reordered = in_order_xyzw(stored.quaternion_wxyz);
                let is_xyzw = shift <= tolerance
                    && (difference(
                        &Isometry3::from_parts(found.translation, reordered),
                        expected,
                    )
                    .1) <= ROTATION;
                let (off, unit) = match shift > tolerance {
                    true => (shift, "m"),
                    false => (angle_of_distance(turn), "rad"),
                };
                let message = match is_xyzw {
                    true => format!(
                        "in {}, the quaternion of link {name:?} is written x, y, z, w; write w first",
                        sample.kind
                    ),
                    false => format!(
                        "in {}, link {name:?} is {} m and {} rad from where forward kinematics puts it",
                        sample.kind,
                        number(shift, 4),
                        number(angle_of_distance(turn), 4)
                    ),
                };
                findings.report(
                    Finding::at(module.file("module.json"), pointer, message)
                        .expected(describe(expected))
                        .actual(format!(
                            "position {:?}, quaternion {:?}",
                            stored.position, stored.quaternion_wxyz
                        ))
                        .tolerance(tolerance)
                        .off_by(off, unit),
                );
            } else if w < -UNIT_NORM {
                let message = format!(
                    "the quaternion of link {name:?} in {} has w < 0; negate all four numbers, which is the same rotation",
                    sample.kind
                );
                findings.report(
                    Finding::at(module.file("module.json"), pointer, message)
                        .expected("w >= 0")
                        .actual(w),
                );
            }
        }
    }
}

/// The rotation of four numbers that were written x, y, z, w.
fn in_order_xyzw([x, y, z, w]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}

fn difference(a: &Isometry3<f64>, b: &Isometry3<f64>) -> (f64, f64) {
    let shift = (a.translation.vector - b.translation.vector).norm();
    let turn = rotation_distance(
        a.rotation.to_rotation_matrix().matrix(),
        b.rotation.to_rotation_matrix().matrix(),
    );
    (shift, turn)
}

fn describe(pose: &Isometry3<f64>) -> String {
    let p = pose.translation;
    let rotation = canonical(&pose.rotation);
    let q = rotation.quaternion();
    format!(
        "position [{}, {}, {}], quaternion [{}, {}, {}, {}]",
        p.x, p.y, p.z, q.w, q.i, q.j, q.k
    )
}
