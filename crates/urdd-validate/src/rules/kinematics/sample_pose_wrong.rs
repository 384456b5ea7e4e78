use nalgebra::{Isometry3, Quaternion, UnitQuaternion};

use crate::rules::prelude::*;
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
    phase Kinematics, needs [
        Version1, Module(Kind::KinematicsSamples), ModuleV1(Kind::Chain), ModuleV1(Kind::Dof), Module(Kind::Urdf),
        Passed(KIN002), Passed(CHN001), Passed(CHN003), Passed(CHN006), Passed(CHN008), Passed(CHN009),
        Passed(CHN010), Passed(DOF007),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
                    .expected(describe(expected))
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

fn describe(pose: &Isometry3<f64>) -> String {
    let p = pose.translation;
    let rotation = canonical(&pose.rotation);
    let q = rotation.quaternion();
    format!("position [{}, {}, {}], quaternion [{}, {}, {}, {}]", p.x, p.y, p.z, q.w, q.i, q.j, q.k)
}
