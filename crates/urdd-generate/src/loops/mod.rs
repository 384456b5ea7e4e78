//! `loops_module`: SPEC 6.8.

mod closed;
mod names;
mod resolved;

use std::ops::Range;

use crate::error::{GenerateError, Result};
use urdd_directory::cancellation::Cancellation;
use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::dof::DofModule;
use urdd_format::index::{DofIdx, SampleIdx};
use urdd_format::loops::{ClosedSample, LoopsModule};
use urdd_format::named_configurations::{ConfigurationName, NamedConfiguration};
use urdd_format::short::Short;
use urdd_kinematics::loops::{Gap, Loops, Scratch};
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics};
use urdd_source::Source;
use urdd_source::loops::Said;
use urdd_source::note::{Note, NoteKind};

/// What the reference configuration of loops is called in edits of skips.
const CLOSED: &str = "closed loops";
const SAMPLES: u32 = 16;
/// Most work for the loops of a robot, in the unit of [`Loops::work`]: some seconds.
const MOST_SPENT: u64 = 20_000_000_000;
/// Most work of one step of the solver.
const MOST_WORK: usize = 1_000_000_000;
/// What is made of a robot whose loops are not closed.
const OF_TREE: &str = "the URDD has no loops_module: it is that of the tree with open ends";
/// How much larger than what was found a stated tolerance is.
const MARGIN: f64 = 1.5;

impl Made<'_> {
    /// The module of a robot whose source tells loops; and what is to say of it. `beginning` is where a closed configuration
    /// is looked for first.
    pub fn module(&self, beginning: Option<&[f64]>) -> Result<(Option<LoopsModule>, Vec<Note>)> {
        let Some(said) = self.source.loops.as_ref().filter(|said| !said.file.is_empty()) else {
            return Ok((None, Vec::new()));
        };
        let mut notes = Vec::new();
        let known = self.names();
        let mut module = self.resolved(said, &known, &mut notes)?;
        if module.loops.is_empty() && module.couplings.is_empty() {
            return Ok((None, notes));
        }
        let reach = urdd_kinematics::reach(&self.source.reading.robot, self.chain);
        let made = |module: &LoopsModule| {
            let loops = Loops::new(module, self.kinematics, self.dof, reach);
            loops.map_err(|error| self.refused(said, None, error.to_string()))
        };
        let mut loops = made(&module)?;
        if loops.work(self.kinematics) > MOST_WORK
            || loops.mobility_work(self.kinematics) > MOST_SPENT
        {
            notes.push(self.note(
                NoteKind::LeftOut,
                "the loops depend on too many joints at once for this program".to_owned(),
                OF_TREE,
            ));
            return Ok((None, notes));
        }
        let limits = self.limits();
        let mut scratch = Scratch::within(MOST_SPENT);
        let Some((reference, widest)) =
            self.reference(&loops, &limits, beginning, reach, &mut scratch)?
        else {
            notes.push(self.open(&loops, &module, (&limits, reach), &mut scratch));
            return Ok((None, notes));
        };
        let reference = self.regular(&loops, reference, &widest, &limits, &mut scratch)?;
        // While samples are looked for, wider.
        for (one, gap) in module.loops.iter_mut().zip(&widest) {
            (one.position_tolerance, one.rotation_tolerance) =
                (10.0 * gap.position, 10.0 * gap.rotation);
        }
        loops = made(&module)?;
        let poses = self.kinematics.link_poses(&reference);
        let poses = poses.map_err(|error| self.refused(said, None, error.to_string()))?;
        let preferred = self.preferred((said, &known), &loops, &mut notes)?;
        let mobility = loops.mobility(self.kinematics, &reference, &poses, |dof| preferred[dof]);
        notes.extend(self.otherwise((said, &known), &loops, &mobility));
        let index = |dof: usize| DofIdx(u32::try_from(dof).unwrap_or(u32::MAX));
        module.independent_dof_idxs = mobility.independent.iter().copied().map(index).collect();
        let mut gaps = widest;
        let mut spent_at = None;
        for k in 0..SAMPLES {
            self.cancellation.check()?;
            let found =
                self.sample(k, &loops, &reference, &mobility.independent, &limits, &mut scratch);
            if found.is_none() && scratch.is_spent() {
                spent_at.get_or_insert(k);
            }
            if found.is_some() {
                for (widest, gap) in gaps.iter_mut().zip(loops.gaps(scratch.poses())) {
                    widest.position = widest.position.max(gap.position);
                    widest.rotation = widest.rotation.max(gap.rotation);
                }
            }
            module.closed_samples.push(ClosedSample {
                sample_idx: SampleIdx(k),
                configuration: found.map(|found| found.iter().map(|q| q + 0.0).collect()),
            });
        }
        if let Some(k) = spent_at {
            notes.push(self.note(
                NoteKind::TooLarge,
                format!("the loops are large: the work that one robot may take was spent at closed sample {k} of {SAMPLES}"),
                "this sample and those after it are null",
            ));
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
        (limits, reach): (&[[f64; 2]], f64),
        scratch: &mut Scratch,
    ) -> Note {
        let was_spent = scratch.is_spent();
        let mut nearest = self.space.default_configuration();
        let _ = loops.close(self.kinematics, &mut nearest, limits, |_| false, scratch);
        let poses = self.kinematics.link_poses(&nearest).ok();
        let gaps: Vec<Gap> = poses.iter().flat_map(|poses| loops.gaps(poses)).collect();
        let worst = gaps.iter().enumerate().max_by(|(_, a), (_, b)| {
            (a.position + a.rotation).total_cmp(&(b.position + b.rotation))
        });
        let coupling = || {
            let sums = loops.sums(&nearest).enumerate();
            let (place, sum) = sums.max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))?;
            let name = Short::of(&module.couplings[place].name);
            Some(match sum.is_finite() {
                true => format!(
                    "the sum of the coupling `{name}` stays {}",
                    urdd_format::readable::number(sum, 3)
                ),
                false => format!("the sum of the coupling `{name}` is not finite"),
            })
        };
        let of_loop = |(place, gap): (usize, &Gap)| {
            let name = Short::of(&module.loops[place].name);
            if !gap.position.is_finite() || !gap.rotation.is_finite() {
                return format!("the gap of the loop `{name}` is not finite");
            }
            format!(
                "the loop `{name}` stays {} m and {} rad apart",
                urdd_format::readable::number(gap.position, 3),
                urdd_format::readable::number(gap.rotation, 3)
            )
        };
        let is_open =
            |(_, gap): &(usize, &Gap)| !(gap.position <= 1e-9 * reach && gap.rotation <= 1e-9);
        let which = worst.filter(is_open).map(of_loop).or_else(coupling);
        let which = which.or_else(|| worst.map(of_loop)).unwrap_or_default();
        let which = match was_spent {
            true => format!("{which} (the work that one robot may take was spent)"),
            false => which,
        };
        self.note(
            NoteKind::LeftOut,
            format!(
                "no configuration was found in which all loops of the robot are closed: {which}"
            ),
            OF_TREE,
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

/// What loops are made from.
pub struct Made<'a> {
    pub source: &'a Source,
    pub chain: &'a ChainModule,
    pub dof: &'a DofModule,
    pub bounds: &'a BoundsModule,
    pub space: &'a ConfigurationSpace,
    pub kinematics: &'a ForwardKinematics,
    pub cancellation: &'a Cancellation,
}

impl Made<'_> {
    pub fn note(&self, kind: NoteKind, problem: String, assumed: &str) -> Note {
        let file = self.source.shown.clone();
        Note { kind, file, line: 0, column: 0, problem, assumed: assumed.to_owned() }
    }

    /// The fault of a loop or coupling: of the URDF itself, it is left out with a note; of a file beside, it is refused.
    pub fn fault(
        &self,
        said: &Said,
        (element, place): (Range<usize>, Range<usize>),
        called: &str,
        fault: String,
    ) -> Result<Note, GenerateError> {
        if said.text.is_some() {
            return Err(self.refused(said, Some(place), fault));
        }
        Ok(self.left_out(said, element, fault, called))
    }

    /// The note about a loop or coupling that is left out.
    pub fn left_out(
        &self,
        said: &Said,
        element: Range<usize>,
        problem: String,
        called: &str,
    ) -> Note {
        let assumed = format!("`{}` is left out", Short::of(called));
        let mut note = self.note(NoteKind::LeftOut, problem, &assumed);
        if let Some(place) = said.place(element.start) {
            (note.file, note.line, note.column) = (place.file.clone(), place.line, place.column);
        }
        note
    }

    pub fn refused(
        &self,
        said: &Said,
        place: Option<Range<usize>>,
        fault: String,
    ) -> GenerateError {
        said.error(place, &self.source.shown, fault).into()
    }
}
