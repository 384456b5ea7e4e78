use super::configurations::configurations;
use crate::reference::loops::{Gap, sum};
use crate::rules::prelude::*;
use urdd_kinematics::{ConfigurationError, ForwardKinematics};

/// Most loops, couplings and links that are looked at, over all configurations.
const MOST_LOOKED_AT: usize = 20_000_000;

declare_rule! {
    /// A loop is open, or a coupling does not hold, in a configuration that is said to be closed.
    ///
    /// The finding says how far apart the ends of the loop are. A robot that is shown or simulated there is torn apart, or
    /// flies away when a simulator pulls it together. Common mistakes: the solver stopped too early; the frame of one end is
    /// that of the joint and not of the link; the robot was changed and the loops were not.
    ///
    /// Close the loops again: `urdd generate` does. If they cannot close, look at the two frames first.
    LOP008 "loop-open", Error, clause "6.8.6", since "1.4.0",
    phase Kinematics, needs [
        ModuleV1(Kind::Loops), ModuleV1(Kind::Chain), ModuleV1(Kind::Dof), Module(Kind::Urdf), ROBOT_SOUND,
        Passed(CHN001), Passed(CHN003), Passed(CHN006), Passed(CHN008), Passed(CHN009), Passed(CHN010), Passed(DOF007),
        Passed(LOP001), Passed(LOP003), Passed(LOP004), Passed(LOP007), Passed(LOP011),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let kinematics = ForwardKinematics::new(document!(context, Chain)?, document!(context, Dof)?);
    let kinematics = findings.or_skip(kinematics.map_err(SkipReason::obstacle))?;
    let reach = reach(context.robot()?, context.tree()?);
    let of_one = loops.loops.len() + loops.couplings.len() + kinematics.num_links();
    let most = (MOST_LOOKED_AT / of_one.max(1)).max(2);
    for (looked_at, (pointer, configuration)) in configurations(loops).enumerate() {
        if looked_at >= most {
            // What was found stands; else it is said that not all was looked at (SPEC 13.5).
            return if findings.is_empty() {
                findings.skip(skip::TOO_MANY_SAMPLES)
            } else {
                Some(())
            };
        }
        let poses = match kinematics.link_poses(configuration) {
            Err(ConfigurationError::Overflow { link_idx }) if holds(context, link_idx)? => {
                let message = format!(
                    "a loop holds link {link_idx} or one below it, whose pose here is beyond the range of 64-bit numbers"
                );
                finding_in(Kind::Loops, pointer, message).report(findings);
                continue;
            }
            poses => findings.or_skip(poses.map_err(SkipReason::obstacle))?,
        };
        for (place, one) in loops.loops.iter().enumerate() {
            let gap = Gap::of(one, &poses, reach)?;
            if gap.is_closed() {
                continue;
            }
            let message = format!(
                "the loop `{}` (/loops/{place}) is open here: its ends are {} m and {} rad from where it holds them",
                one.name,
                number(gap.position, 4),
                number(gap.rotation, 4)
            );
            let [position, rotation] = gap.most;
            let (off, most, unit) = match gap.position <= position {
                true => (gap.rotation, rotation, "rad"),
                false => (gap.position, position, "m"),
            };
            finding_in(Kind::Loops, pointer.clone(), message)
                .values(format!("at most {most:?} {unit}"), format!("{off:?} {unit}"))
                .off_by(off, unit)
                .report(findings);
        }
        for (place, coupling) in loops.couplings.iter().enumerate() {
            let (sum, tolerance) = sum(coupling, configuration)?;
            if sum.is_finite() && sum.abs() <= tolerance {
                continue;
            }
            let message =
                format!("the coupling `{}` (/couplings/{place}) does not hold here", coupling.name);
            finding_in(Kind::Loops, pointer.clone(), message)
                .values("a sum of 0", format!("{sum:?}"))
                .tolerance(tolerance)
                .report(findings);
        }
    }
    Some(())
}

/// Whether an end of a loop is this link, or hangs from it.
fn holds(context: &Context, link: usize) -> Option<bool> {
    let tree = context.tree()?;
    let loops = document!(context, Loops)?;
    let mut ends = loops.loops.iter().flat_map(|one| [one.link_a_idx.get(), one.link_b_idx.get()]);
    Some(ends.any(|end| tree.path(end).contains(&link)))
}
