//! What is odd in a source besides masses and inertias: limits, lost meshes, repeated elements.

use crate::rules::prelude::*;
use urdd_directory::position::LineIndex;
use urdd_document::schema_check::excerpt;
use urdd_format::index::Count;
use urdd_format::report::{Fix, TextEdit};

declare_rule! {
    /// The lower limit of a joint is above its upper limit.
    ///
    /// No position is within the limits. Planners find no configuration, and programs that clamp a
    /// position to the limits disagree. Where one of the two limits is absent, it is 0.
    ///
    /// Swap or correct `lower` and `upper` in the URDF, and write the URDD again.
    SRC001 "crossed-limits", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [SourceRobot], of Robot, check crossed_limits,

    /// A revolute or prismatic joint has no limits.
    ///
    /// URDF requires `<limit>` of these types. Without it some readers refuse the file, some take
    /// the joint for locked at 0, and in a URDD it is a joint that is not limited. A joint that
    /// follows another needs none.
    ///
    /// Write `<limit lower=… upper=… effort=… velocity=…/>` in the URDF, or make the joint
    /// `continuous` where it turns without end. Then write the URDD again.
    SRC006 "joint-without-limits", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [SourceRobot, Version1], of Robot, check no_limits,

    /// A joint that can move has the limits `effort="0"` and `velocity="0"`.
    ///
    /// By these numbers the joint can neither push nor move. Exporters write them where no number was
    /// given. Planners divide by the speed, controllers clip the effort to 0, and the robot does not
    /// move. A joint that follows another is not reported, nor one whose `lower` equals its `upper`,
    /// nor one that leaves the numbers out.
    ///
    /// Write the joint's real limits into the URDF; of a joint that no motor drives, such as a
    /// suspension, what it bears and how fast it moves. ROS refuses a `<limit>` without them. Then write
    /// the URDD again.
    SRC009 "no-effort-and-no-speed", Warning, clause "6.1.7", since "0.2.0",
    phase References, needs [SourceRobot, Version1], of Robot, check no_effort_and_no_speed,

    /// A mimic joint leaves its own limits while its driver is within its limits.
    ///
    /// The bounds in a URDD are those of the driver. A position within these bounds puts the mimic joint
    /// beyond its own `<limit>`: some programs refuse such a state, some stop the driver early, some
    /// ignore it. Chains of mimics are followed to their end. Mimics of a driver without limits are not
    /// checked.
    ///
    /// Narrow the driver's limits, widen the mimic's, or correct `multiplier` and `offset`, in the
    /// URDF, and write the URDD again.
    SRC002 "mimic-leaves-its-limits", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [SourceRobot, Passed(URD008), Passed(URD009), Passed(URD012)], of Robot, check mimic_leaves_limits,

    /// A mesh that the URDF names is not carried.
    ///
    /// The file was not found when the URDD was made. The link lacks this part of its geometry: it is
    /// not shown, and nothing collides with it. Most often a `package://` could not be resolved, or a
    /// file is missing from the package.
    ///
    /// Give the producer the folder of the package, or remove the element from the URDF. Then write the
    /// URDD again.
    SRC007 "mesh-not-carried", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf), Module(Kind::OriginalMeshes), Version1, NotFailed(MSH012), ModuleV1(Kind::OriginalMeshes),
    ], check mesh_not_carried,

    /// The carried URDF repeats an element that URDF allows once.
    ///
    /// A URDD takes the first, as most readers do; others take the last, or refuse the file. So two
    /// programs may see two robots: another axis, another mass. Two shapes in one `<geometry>` are
    /// one shape and another that no program sees.
    ///
    /// Keep one of them in the URDF; write several shapes as several `<visual>` or `<collision>`
    /// elements. Then write the URDD again.
    SRC008 "repeated-element", Warning, clause "6.1.8", since "0.1.0",
    phase References, needs [CarriedUrdf, Passed(URD011)], of Robot, check repeated_element,
}

fn crossed_limits(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let limits = joint.position_limits().zip(joint.limit);
        if let Some(((lower, upper), limit)) = limits
            && lower > upper
        {
            let name = &joint.name;
            let absent = match (limit.lower, limit.upper) {
                (None, _) => " (`lower` is absent, which means 0)",
                (_, None) => " (`upper` is absent, which means 0)",
                _ => "",
            };
            let message =
                format!("the limits of joint `{name}` are crossed{absent}: no position is allowed");
            finding_in(described, format!("/joints/{index}/limit"), message)
                .values("lower <= upper", format!("joint `{name}`: {lower} > {upper}"))
                .report(findings);
        }
    }
    Some(())
}

fn no_limits(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let (name, kind) = (&joint.name, joint.joint_type);
        let needs_limits = matches!(kind, JointType::Revolute | JointType::Prismatic);
        if !needs_limits || joint.mimic.is_some() || joint.position_limits().is_some() {
            continue;
        }
        let actual = match joint.limit {
            None => "no `limit`",
            Some(_) => "a `limit` with neither `lower` nor `upper`",
        };
        let message = format!("joint `{name}` ({kind}) has no limits; it counts as unlimited");
        finding_in(described, format!("/joints/{index}/limit"), message)
            .values("`lower` and `upper`", format!("joint `{name}`: {actual}"))
            .report(findings);
    }
    Some(())
}

fn no_effort_and_no_speed(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let (name, kind) = (&joint.name, joint.joint_type);
        let limits = joint.position_limits();
        let moves = match kind {
            JointType::Revolute | JointType::Prismatic => limits.is_none_or(|(a, b)| a != b),
            _ => kind == JointType::Continuous,
        };
        let zeros = joint
            .limit
            .is_some_and(|limit| limit.effort == Some(0.0) && limit.velocity == Some(0.0));
        if moves && zeros && joint.mimic.is_none() {
            let message = format!(
                "joint `{name}` ({kind}) has effort 0 and velocity 0: by its limits it cannot move"
            );
            finding_in(described, format!("/joints/{index}/limit"), message)
                .expected("the joint's limits, above 0")
                .actual(format!("joint `{name}`: effort 0, velocity 0"))
                .report(findings);
        }
    }
    Some(())
}

fn mimic_leaves_limits(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    let mimics = described.mimics()?;
    for (index, (joint, resolved)) in robot.joints.iter().zip(&mimics.by_joint).enumerate() {
        let (Some(resolved), Some(own)) = (resolved, joint.position_limits()) else { continue };
        let driver = robot.joints.get(resolved.driver)?;
        // A fixed driver stays at 0.
        let limits = match driver.joint_type {
            JointType::Fixed => Some((0.0, 0.0)),
            _ => driver.position_limits(),
        };
        // SRC001 reports crossed limits.
        let Some(limits) = limits.filter(|limits| limits.0 <= limits.1 && own.0 <= own.1) else {
            continue;
        };
        let range = follow(limits, resolved.multiplier, resolved.offset);
        let tolerance = MIMIC_LIMIT * own.0.abs().max(own.1.abs());
        let beyond = (own.0 - range.0).max(range.1 - own.1);
        if beyond <= tolerance {
            continue;
        }
        let pointer = format!("/joints/{index}/limit");
        let message = format!(
            "joint `{}` follows joint `{}`, and leaves its own limits by up to {} while the driver is within its limits",
            joint.name,
            driver.name,
            number(beyond, 6)
        );
        finding_in(described, pointer, message)
            .expected(format!("joint `{}` within {}", joint.name, interval(own)))
            .actual(format!(
                "{} for `{}` from {} to {}",
                interval(range),
                driver.name,
                number(limits.0, 6),
                number(limits.1, 6)
            ))
            .tolerance(tolerance)
            .report(findings);
    }
    Some(())
}

/// The interval of a mimic while its driver moves through an interval.
pub fn follow(driver: (f64, f64), multiplier: f64, offset: f64) -> (f64, f64) {
    let at = |position: f64| multiplier * position + offset;
    let (a, b) = (at(driver.0), at(driver.1));
    (a.min(b), a.max(b))
}

fn interval((lower, upper): (f64, f64)) -> String {
    format!("[{}, {}]", number(lower, 6), number(upper, 6))
}

fn mesh_not_carried(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let meshes = document!(context, OriginalMeshes)?;
    let references = meshes.references.iter().enumerate();
    for (index, reference) in references.filter(|(_, reference)| reference.path.is_none()) {
        let link = robot.links.get(reference.link_idx.get()).map_or("", |link| &link.name);
        let filename = excerpt(&reference.filename.as_str().into());
        let message = format!("a mesh of link `{link}` was not found and is not carried");
        finding_in(Kind::OriginalMeshes, format!("/references/{index}/path"), message)
            .values("a file", format!("null for {filename} of link `{link}`"))
            .report(findings);
    }
    Some(())
}

fn repeated_element(described: &Described, findings: &mut Findings) -> Option<()> {
    let carried = described.urdf.ok()?;
    let reading = described.urdf_text()?;
    let lines = LineIndex::new(&carried.text);
    for again in &reading.repeated {
        let (start, end) = (lines.position(again.range.start), lines.position(again.range.end));
        let message = format!(
            "a second `<{}>` in a `<{}>`: only the first counts; remove one of them",
            again.element, again.parent
        );
        Finding::in_file(&carried.path, message)
            .position(Some(start))
            .related(
                Finding::in_file(&carried.path, "the first, which counts")
                    .position(Some(lines.position(again.first))),
            )
            // Other readers take the last: which of them the author means is his to say.
            .fix(Fix {
                message: format!("remove the second `<{}>`", again.element),
                is_safe: false,
                edits: vec![TextEdit {
                    file: carried.path.clone(),
                    line: Count(start.line),
                    column: Count(start.column),
                    end_line: Count(end.line),
                    end_column: Count(end.column),
                    text: String::new(),
                }],
            })
            .report(findings);
    }
    Some(())
}
