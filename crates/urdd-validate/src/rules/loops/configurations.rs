use std::cell::LazyCell;
use std::f64::consts::PI;

use crate::reference::loops::{Gap, sum};
use crate::rules::kinematics::samples::{pick, turn_alike};
use crate::rules::prelude::*;
use urdd_format::loops::LoopsModule;
use urdd_format::short::Short;
use urdd_kinematics::{ConfigurationError, ConfigurationSpace, ForwardKinematics};

/// Most loops, couplings and links that are looked at, over all configurations.
const MOST_LOOKED_AT: usize = 20_000_000;

declare_rule! {
    /// A configuration of `loops_module` has not one value for each DOF.
    ///
    /// A program that sets the robot to it reads the values of other joints, or stops.
    ///
    /// Write one value for each DOF, in DOF order.
    LOP006 "closed-configuration-length-wrong", Error, clause "6.8.6", since "1.4.0",
    phase References, needs [ModuleV1(Kind::Loops), ModuleV1(Kind::Dof), Passed(DOF001)],
    check closed_configuration_length_wrong,

    /// A closed sample has another number than its place, or independent DOFs elsewhere than the sampled configuration.
    ///
    /// Sample k has the independent DOFs where the specification's sampled configuration k has them, so that all programs
    /// mean the same by it, and can be compared.
    ///
    /// Number samples from 0 without gaps, and take the values of the independent DOFs from the formulas of SPEC 9.3. Where all
    /// samples are wrong in one DOF, that DOF may be none of the independent ones: LOP009 is judged when the samples are right.
    LOP013 "closed-sample-wrong", Error, clause "6.8.8", since "1.4.0",
    phase References, needs [
        ModuleV1(Kind::Loops), ModuleV1(Kind::Dof), ModuleV1(Kind::Chain), ModuleV1(Kind::Bounds), Passed(DOF001),
        Passed(DOF003), Passed(DOF004), Passed(CHN002), Passed(CHN007), Passed(BND001), Passed(BND002), Passed(BND003),
        Passed(BND006), Passed(LOP005), Passed(LOP006),
    ], check closed_sample_wrong,

    /// A configuration of `loops_module` has a limited joint beyond its limits, or a rotation vector longer than half a turn.
    ///
    /// The robot cannot be there. Most often a solver closed the loops without looking at the limits.
    ///
    /// Look for another closed configuration, within the bounds; a sample without one is null. A rotation vector v longer
    /// than pi is the same rotation as v (1 - 2 pi / |v|).
    LOP007 "closed-configuration-out-of-bounds", Error, clause "6.8.6", since "1.4.0",
    phase References, needs [
        ModuleV1(Kind::Loops), ModuleV1(Kind::Dof), ModuleV1(Kind::Chain), ModuleV1(Kind::Bounds), Passed(BND001),
        Passed(BND002), Passed(BND003), Passed(BND004), Passed(LOP006), Passed(LOP013),
    ], check closed_configuration_out_of_bounds,

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
    ], check loop_open,

    /// The number of independent DOFs is not the robot's mobility.
    ///
    /// So many DOFs can be set; the loops and couplings decide the others. With one too many, a program sets what cannot be
    /// set; with one too few, part of the robot hangs loose. The finding says how many there are at the reference
    /// configuration: the number of DOFs less the rank of what the loops hold. A loop may hold more than it needs (a planar
    /// four-bar of hinges does); that changes no rank.
    ///
    /// Count again; `urdd generate` does. Where the reference configuration is one in which the robot is stretched out, take
    /// another: there the rank is smaller than elsewhere.
    LOP009 "mobility-wrong", Error, clause "6.8.7", since "1.4.0",
    phase Kinematics, needs [
        ModuleV1(Kind::Loops), ModuleV1(Kind::Chain), ModuleV1(Kind::Dof), Passed(LOP005), Passed(LOP008), Passed(DOF006),
    ], check mobility_wrong,

    /// The other DOFs do not follow from the independent ones.
    ///
    /// The number is right, but the choice is not: a loop ties two of the independent DOFs to each other, and leaves another
    /// free. Setting the independent ones does not settle where the robot is.
    ///
    /// Take one of the two out, and put the free one in its place.
    LOP010 "independent-dofs-tied", Error, clause "6.8.7", since "1.4.0",
    phase Kinematics, needs [
        ModuleV1(Kind::Loops), ModuleV1(Kind::Chain), ModuleV1(Kind::Dof), Passed(LOP009),
    ], check independent_dofs_tied,
}

/// The configurations of the module, each with its place.
fn configurations(loops: &LoopsModule) -> impl Iterator<Item = (String, &[f64])> {
    let reference = ("/reference_configuration".to_owned(), &*loops.reference_configuration);
    let samples = loops.closed_samples.iter().enumerate().filter_map(|(place, sample)| {
        let configuration = sample.configuration.as_deref()?;
        Some((format!("/closed_samples/{place}/configuration"), configuration))
    });
    std::iter::once(reference).chain(samples)
}

fn closed_configuration_length_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let count = document!(context, Dof)?.num_dofs.get();
    for (pointer, configuration) in configurations(document!(context, Loops)?) {
        if configuration.len() != count {
            finding_in(Kind::Loops, pointer, "this configuration needs one value per DOF")
                .counts(count, configuration.len(), "values")
                .report(findings);
        }
    }
    Some(())
}

fn closed_sample_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let dof = document!(context, Dof)?;
    let chain = document!(context, Chain)?;
    let bounds = &document!(context, Bounds)?.bounds;
    let numbers = loops.closed_samples.iter().map(|sample| sample.sample_idx.0);
    let wrong = numbers.enumerate().find(|(place, number)| *place != *number as usize);
    if let Some((place, number)) = wrong {
        let pointer = format!("/closed_samples/{place}/sample_idx");
        finding_in(Kind::Loops, pointer, "closed samples are numbered from 0 without gaps")
            .values(place, number)
            .report(findings);
        return Some(());
    }
    let space = ConfigurationSpace::new(dof, chain, bounds).map_err(SkipReason::obstacle);
    let space = findings.or_skip(space)?;
    for (place, sample) in loops.closed_samples.iter().enumerate() {
        let Some(found) = &sample.configuration else { continue };
        let sampled = space.sampled(u64::from(sample.sample_idx.0));
        let independent: Vec<usize> =
            loops.independent_dof_idxs.iter().map(|idx| idx.get()).collect();
        // A rotation may be written in two ways.
        let turned = |dofs: &&[usize; 3]| {
            let whole = dofs.iter().all(|dof| independent.binary_search(dof).is_ok());
            let both = pick(&sampled, dofs).zip(pick(found, dofs));
            whole && both.is_some_and(|(a, b)| turn_alike(a, b))
        };
        let same: HashSet<usize> =
            space.rotation_vectors().iter().filter(turned).flatten().copied().collect();
        for idx in independent.iter().copied().filter(|idx| !same.contains(idx)) {
            let (expected, found) = (*sampled.get(idx)?, *found.get(idx)?);
            let name = &dof.dofs.get(idx)?.name;
            report_off_by_bounds(*bounds.get(idx)?, [expected, found], findings, || {
                let pointer = format!("/closed_samples/{place}/configuration/{idx}");
                let message = format!(
                    "the independent DOF `{name}` is not where sampled configuration {place} has it"
                );
                finding_in(Kind::Loops, pointer, message)
            });
        }
    }
    Some(())
}

fn closed_configuration_out_of_bounds(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let bounds = document!(context, Bounds)?;
    let space = ConfigurationSpace::new(
        document!(context, Dof)?,
        document!(context, Chain)?,
        &bounds.bounds,
    );
    let space = findings.or_skip(space.map_err(SkipReason::obstacle))?;
    for (pointer, configuration) in configurations(loops) {
        for dofs in space.rotation_vectors() {
            let vector = dofs.map(|dof| configuration.get(dof).copied().unwrap_or_default());
            let length = Vector3::from(vector).norm();
            if length <= PI * (1.0 + NUMBER_RELATIVE) {
                continue;
            }
            let at = format!("{pointer}/{}", dofs[0]);
            finding_in(Kind::Loops, at, "this rotation vector is longer than half a turn")
                .values("at most pi", length)
                .report(findings);
        }
        let limited = bounds.bounds.iter().zip(&bounds.dof_limited);
        let limited = configuration.iter().zip(limited).enumerate();
        for (idx, (q, (bounds, _))) in limited.filter(|(_, (_, (_, limited)))| **limited) {
            report_beyond_bounds(*bounds, *q, findings, || {
                let pointer = format!("{pointer}/{idx}");
                finding_in(Kind::Loops, pointer, "a limited DOF cannot be there")
            });
        }
    }
    Some(())
}

fn loop_open(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let kinematics = ForwardKinematics::new(document!(context, Chain)?, document!(context, Dof)?);
    let kinematics = findings.or_skip(kinematics.map_err(SkipReason::obstacle))?;
    let reach = reach(context.robot()?, context.tree()?);
    let terms: usize = loops.couplings.iter().map(|one| 1 + one.terms.len()).sum();
    let of_one = loops.loops.len() + terms + kinematics.num_links();
    let held = LazyCell::new(|| held(context));
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
            Err(ConfigurationError::Overflow { link_idx }) if *held.as_ref()?.get(link_idx)? => {
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
            let [position, rotation] = gap.most;
            if gap.position <= position && gap.rotation <= rotation {
                continue;
            }
            let message = format!(
                "the loop `{}` (/loops/{place}) is open here: its ends are {} m and {} rad from where it holds them",
                Short::of(&one.name),
                number(gap.position, 4),
                number(gap.rotation, 4)
            );
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
                format!("the coupling `{}` (/couplings/{place}) does not hold here", Short::of(&coupling.name));
            finding_in(Kind::Loops, pointer.clone(), message)
                .values("a sum of 0", format!("{sum:?}"))
                .tolerance(tolerance)
                .report(findings);
        }
    }
    Some(())
}

/// Of each link, whether an end of a loop is it, or hangs from it.
fn held(context: &Context) -> Option<Vec<bool>> {
    let tree = context.tree()?;
    let loops = document!(context, Loops)?;
    let mut held = vec![false; tree.parent_link.len()];
    for end in loops.loops.iter().flat_map(|one| [one.link_a_idx.get(), one.link_b_idx.get()]) {
        let mut at = Some(end);
        while let Some(link) = at
            && let Some(is_held) = held.get_mut(link)
            && !std::mem::replace(is_held, true)
        {
            at = tree.parent_link[link];
        }
    }
    Some(held)
}

fn mobility_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let dofs = document!(context, Dof)?.dofs.len();
    let [[least, greatest], _] = *findings.or_skip(context.loop_ranks())?;
    let stated = loops.independent_dof_idxs.len();
    if (least..=greatest).contains(&(dofs.saturating_sub(stated))) && stated <= dofs {
        return Some(());
    }
    let message = format!(
        "of {dofs} DOFs, loops and couplings tie {greatest} to others at the reference configuration"
    );
    finding_in(Kind::Loops, "/independent_dof_idxs", message)
        .counts(dofs - greatest, stated, "independent DOFs")
        .report(findings);
    Some(())
}

fn independent_dofs_tied(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let dofs = document!(context, Dof)?.dofs.len();
    let [_, [_, greatest]] = *findings.or_skip(context.loop_ranks())?;
    // What LOP009 accepted.
    let rank = dofs - loops.independent_dof_idxs.len();
    if greatest >= rank {
        return Some(());
    }
    let message = format!(
        "{rank} DOFs are to follow from the independent ones, but only {greatest} of them do: {} of the independent ones are tied to others of them",
        rank - greatest
    );
    finding_in(Kind::Loops, "/independent_dof_idxs", message)
        .counts(rank, greatest, "DOFs that follow")
        .report(findings);
    Some(())
}
