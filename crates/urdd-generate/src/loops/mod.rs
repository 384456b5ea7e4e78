//! `loops_module`: SPEC 6.8.

mod closed;
mod made;
mod resolved;

use super::error::Result;
use closed::widen;
pub(super) use made::Made;
use urdd_format::index::{DofIdx, SampleIdx};
use urdd_format::loops::{ClosedSample, LoopsModule};
use urdd_format::named_configurations::{ConfigurationName, NamedConfiguration};
use urdd_format::short::Short;
use urdd_kinematics::loops::{Loops, Scratch};
use urdd_source::note::{Note, NoteKind};

/// What the reference configuration of loops is called in edits of skips.
const CLOSED: &str = "closed loops";
/// Number of closed samples.
const SAMPLES: u32 = 16;
/// Most multiplications of one step of the solver.
const MOST_WORK: usize = 50_000_000;
/// How much larger than what was found a stated tolerance is.
const MARGIN: f64 = 1.5;

impl Made<'_> {
    /// The module of a robot whose source tells loops; and what is to say of it. `beginning` is where a closed configuration
    /// is looked for first.
    pub fn module(&self, beginning: Option<&[f64]>) -> Result<(Option<LoopsModule>, Vec<Note>)> {
        let Some(said) = self.source.loops.as_ref().filter(|said| !said.file.is_empty()) else {
            return Ok((None, Vec::new()));
        };
        let mut module = self.resolved(said)?;
        let reach = urdd_kinematics::reach(&self.source.reading.robot, self.chain);
        let made = |module: &LoopsModule| {
            let loops = Loops::new(module, self.kinematics, self.dof, reach);
            loops.map_err(|error| self.refused(said, None, error.to_string()))
        };
        let mut loops = made(&module)?;
        if loops.work() > MOST_WORK {
            let fault = "the loops depend on too many joints at once for this program";
            return Err(self.refused(said, None, fault.to_owned()));
        }
        let limits = self.limits();
        let mut scratch = Scratch::default();
        let Some((reference, widest)) =
            self.reference(&loops, &limits, beginning, reach, &mut scratch)?
        else {
            return Ok((None, vec![self.open(&loops, &module, &limits, &mut scratch)]));
        };
        let reference = self.regular(&loops, reference, &widest, &limits, &mut scratch)?;
        // While samples are looked for, wider.
        for (one, gap) in module.loops.iter_mut().zip(&widest) {
            (one.position_tolerance, one.rotation_tolerance) =
                (10.0 * gap.position, 10.0 * gap.rotation);
        }
        loops = made(&module)?;
        let mut notes = Vec::new();
        let poses = self.kinematics.link_poses(&reference);
        let poses = poses.map_err(|error| self.refused(said, None, error.to_string()))?;
        let preferred = self.preferred(said, &loops, &mut notes)?;
        let mobility = loops.mobility(self.kinematics, &reference, &poses, |dof| preferred[dof]);
        let free = mobility.independent.iter().filter(|dof| !preferred[**dof]).count();
        let follow = mobility.dependent.iter().filter(|dof| preferred[**dof]).count();
        // Other formats name motors; rods turn about themselves besides.
        let is_complete = said.text.is_none();
        if said.file.independent.is_some() && (follow > 0 || is_complete && free > 0) {
            notes.push(self.note(
                NoteKind::Otherwise,
                format!(
                    "the DOFs that are said to move freely are not those that do: {follow} of them follow from others, and {free} others move freely"
                ),
                "loops_module says which DOFs are independent where all loops are closed",
            ));
        }
        let index = |dof: usize| DofIdx(u32::try_from(dof).unwrap_or(u32::MAX));
        module.independent_dof_idxs = mobility.independent.iter().copied().map(index).collect();
        let mut gaps = widest;
        for k in 0..SAMPLES {
            self.cancellation.check()?;
            let found =
                self.sample(k, &loops, &reference, &mobility.independent, &limits, &mut scratch);
            if found.is_some() {
                widen(&mut gaps, &loops.gaps(scratch.poses()));
            }
            module.closed_samples.push(ClosedSample {
                sample_idx: SampleIdx(k),
                configuration: found.map(|found| found.iter().map(|q| q + 0.0).collect()),
            });
        }
        for (one, gap) in module.loops.iter_mut().zip(&gaps) {
            one.position_tolerance = stated(gap.position, reach);
            one.rotation_tolerance = stated(gap.rotation, 1.0);
        }
        module.reference_configuration = reference.iter().map(|q| q + 0.0).collect();
        Ok((Some(module), notes))
    }

    /// What is said of a robot whose loops do not close.
    fn open(
        &self,
        loops: &Loops,
        module: &LoopsModule,
        limits: &[[f64; 2]],
        scratch: &mut Scratch,
    ) -> Note {
        let mut nearest = self.space.default_configuration();
        let _ = loops.close(self.kinematics, &mut nearest, limits, |_| false, scratch);
        let gaps = self.kinematics.link_poses(&nearest).map(|poses| loops.gaps(&poses));
        let gaps = gaps.unwrap_or_default();
        let worst = gaps.iter().enumerate().max_by(|(_, a), (_, b)| {
            (a.position + a.rotation).total_cmp(&(b.position + b.rotation))
        });
        let which = worst.map_or_else(
            || "the couplings do not hold".to_owned(),
            |(place, gap)| {
                format!(
                    "the loop `{}` stays {} m and {} rad apart",
                    Short::of(&module.loops[place].name),
                    urdd_format::readable::number(gap.position, 3),
                    urdd_format::readable::number(gap.rotation, 3)
                )
            },
        );
        self.note(
            NoteKind::LeftOut,
            format!(
                "no configuration was found in which all loops of the robot are closed: {which}"
            ),
            "the URDD has no loops_module: it is that of the tree with open ends",
        )
    }
}

/// The reference configuration as a named one, by which contacts are skipped.
pub(super) fn closed(module: &LoopsModule) -> Option<NamedConfiguration> {
    Some(NamedConfiguration {
        name: ConfigurationName::new(CLOSED)?,
        positions: Vec::new(),
        configuration: module.reference_configuration.clone(),
    })
}

/// What is stated for a gap: 0 where 1e-9 is enough, else a round number above it.
fn stated(gap: f64, unit: f64) -> f64 {
    if gap <= 1e-9 * unit * 0.5 {
        return 0.0;
    }
    let power = (gap * MARGIN).log10().floor();
    let step = 10.0_f64.powf(power);
    (gap * MARGIN / step).ceil() * step
}
