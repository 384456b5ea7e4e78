use crate::rules::prelude::*;
use std::f64::consts::PI;
use urdd_format::loops::LoopsModule;

use urdd_kinematics::ConfigurationSpace;
use urdd_kinematics::rotation::from_rotation_vector;

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
}

/// The configurations of the module, each with its place.
pub(super) fn configurations(loops: &LoopsModule) -> impl Iterator<Item = (String, &[f64])> {
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
            let [a, b] = [&sampled, found].map(|of| dofs.map(|dof| of.get(dof).copied()));
            let matrix = |v: [Option<f64>; 3]| {
                let v = v.map(Option::unwrap_or_default);
                from_rotation_vector(v).to_rotation_matrix().into_inner()
            };
            whole && rotation_distance(&matrix(a), &matrix(b)) <= ROTATION
        };
        let same: HashSet<usize> =
            space.rotation_vectors().iter().filter(turned).flatten().copied().collect();
        for idx in independent.iter().copied().filter(|idx| !same.contains(idx)) {
            let (expected, found) = (*sampled.get(idx)?, *found.get(idx)?);
            let &[a, b] = bounds.get(idx)?;
            let size = a.abs().max(b.abs());
            let tolerance = number_tolerance(expected, found).max(NUMBER_RELATIVE * size);
            if (expected - found).abs() <= tolerance {
                continue;
            }
            let pointer = format!("/closed_samples/{place}/configuration/{idx}");
            let message = format!(
                "the independent DOF `{}` is not where sampled configuration {place} has it",
                dof.dofs.get(idx)?.name
            );
            finding_in(Kind::Loops, pointer, message)
                .values(expected, found)
                .tolerance(tolerance)
                .report(findings);
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
        for (idx, (q, (&[a, b], limited))) in configuration.iter().zip(limited).enumerate() {
            let (lower, upper) = (a.min(b), a.max(b));
            let size = lower.abs().max(upper.abs());
            let tolerance = (NUMBER_RELATIVE * size).max(NUMBER_ABSOLUTE);
            if !limited || (lower - q).max(q - upper) <= tolerance {
                continue;
            }
            finding_in(Kind::Loops, format!("{pointer}/{idx}"), "a limited DOF cannot be there")
                .values(format!("{lower:?} to {upper:?}"), format!("{q:?}"))
                .tolerance(tolerance)
                .report(findings);
        }
    }
    Some(())
}
