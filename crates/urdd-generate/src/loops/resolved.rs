//! What a source says of loops, by the robot's indices; and the terms of a coupling, added up.

use std::collections::{BTreeMap, HashSet};
use std::ops::Range;

use toml::Spanned;

use super::Made;
use super::names::Names;
use crate::error::{Result, first_names};
use urdd_directory::export_toml::Name;
use urdd_directory::loops_toml::{CouplingTable, FrameTable, LoopTable};
use urdd_format::index::DofIdx;
use urdd_format::loops::{Coupling, CouplingTerm, Loop, LoopsModule};
use urdd_format::short::Short;
use urdd_format::urdf::JointType;
use urdd_kinematics::loops::{Loops, Mobility};
use urdd_kinematics::pose::{from_isometry, from_xyz_rpy};
use urdd_source::loops::{File, Said};
use urdd_source::note::{Note, NoteKind};

/// A place in the source, and what is wrong there.
type Faulty = (Range<usize>, String);

impl Made<'_> {
    /// The loops and couplings by index, without configurations.
    pub(super) fn resolved(
        &self,
        said: &Said,
        known: &Names<'_>,
        notes: &mut Vec<Note>,
    ) -> Result<LoopsModule> {
        let File { loops, couplings, .. } = &said.file;
        let mut names: HashSet<&str> = HashSet::new();
        let mut is_new = |name| match names.insert(name) {
            true => Ok(()),
            false => Err(format!("another loop or coupling is called `{}`", Short::of(name))),
        };
        let mut module = LoopsModule {
            loops: Vec::new(),
            couplings: Vec::new(),
            independent_dof_idxs: Vec::new(),
            reference_configuration: Vec::new(),
            closed_samples: Vec::new(),
        };
        for one in loops {
            let name = &one.get_ref().name;
            let read = is_new(name).map_err(|fault| (one.span(), fault));
            match read.and_then(|()| self.closing(one, known)) {
                Ok(one) => module.loops.push(one),
                Err((place, fault)) => {
                    notes.push(self.fault(said, (one.span(), place), name, fault)?);
                }
            }
        }
        for one in couplings {
            let name = &one.get_ref().name;
            let read = is_new(name).map_err(|fault| (one.span(), fault));
            let sum = match read.and_then(|()| self.sum(one, known)) {
                Ok(sum) => sum,
                Err((place, fault)) => {
                    notes.push(self.fault(said, (one.span(), place), name, fault)?);
                    continue;
                }
            };
            if sum.terms.is_empty() {
                let problem = match sum.constant == 0.0 {
                    true => format!(
                        "the coupling `{}` adds nothing: its terms cancel once mimic joints are replaced by what they follow",
                        Short::of(name)
                    ),
                    false => format!(
                        "the coupling `{}` contradicts the other joints: its terms cancel, and {} is left, which is not 0",
                        Short::of(name),
                        urdd_format::readable::number(sum.constant, 3)
                    ),
                };
                notes.push(self.left_out(said, one.span(), problem, name));
                continue;
            }
            module.couplings.push(sum);
        }
        Ok(module)
    }

    /// A loop, or what is wrong and where.
    fn closing(&self, one: &Spanned<LoopTable>, known: &Names<'_>) -> Result<Loop, Faulty> {
        let of = one.get_ref();
        let link = |name: &Name| {
            let word = name.get_ref().as_str();
            known.link(word).ok_or_else(|| {
                let all = self.chain.links_in_chain.iter().map(|link| link.name.as_str());
                (name.span(), known.unknown("link", word, all))
            })
        };
        let (link_a_idx, link_b_idx) = (link(&of.link_a)?, link(&of.link_b)?);
        if link_a_idx == link_b_idx {
            let fault = format!("the loop `{}` connects a link with itself", Short::of(&of.name));
            return Err((of.link_b.span(), fault));
        }
        for (frame, called) in [(&of.frame_a, "frame_a"), (&of.frame_b, "frame_b")] {
            if !frame.xyz.iter().chain(&frame.rpy).all(|x| x.is_finite()) {
                let name = Short::of(&of.name);
                let fault = format!("a number in `{called}` of the loop `{name}` is not finite");
                return Err((one.span(), fault));
            }
        }
        let pose = |frame: &FrameTable| from_isometry(&from_xyz_rpy(frame.xyz, frame.rpy));
        Ok(Loop {
            name: of.name.clone(),
            kind: of.kind,
            link_a_idx,
            frame_a: pose(&of.frame_a),
            link_b_idx,
            frame_b: pose(&of.frame_b),
            position_tolerance: 0.0,
            rotation_tolerance: 0.0,
        })
    }

    /// A coupling, maybe without terms, or what is wrong and where.
    fn sum(&self, one: &Spanned<CouplingTable>, known: &Names<'_>) -> Result<Coupling, Faulty> {
        let of = one.get_ref();
        let name = Short::of(&of.name);
        if !of.constant.is_finite() {
            let fault = format!("the constant of the coupling `{name}` is not finite");
            return Err((one.span(), fault));
        }
        let mut sum = Terms::new(of.constant);
        let mut names_dof = false;
        for (name, coefficients) in &of.terms {
            let word = &**name.get_ref();
            let coefficients = four(coefficients).ok_or_else(|| {
                let word = Short::of(word);
                let fault = format!("one to four finite coefficients are needed for `{word}`");
                (name.span(), fault)
            })?;
            match *known.dofs(word) {
                [idx] => {
                    sum.add(DofIdx(u32::try_from(idx).unwrap_or(u32::MAX)), coefficients, None);
                    names_dof = true;
                }
                [] => match self.coupled(word, coefficients, known, &mut sum) {
                    Some(moves) => names_dof |= moves,
                    None => {
                        let all = self.dof.dofs.iter().map(|dof| dof.name.as_str());
                        return Err((name.span(), known.unknown("DOF", word, all)));
                    }
                },
                ref dofs => {
                    let dofs: Vec<&str> =
                        dofs.iter().map(|dof| self.dof.dofs[*dof].name.as_str()).collect();
                    let (word, dofs) = (Short::of(word), named(&dofs));
                    let fault = format!("the joint `{word}` has several DOFs: name one of {dofs}");
                    return Err((name.span(), fault));
                }
            }
        }
        if !names_dof {
            let fault = format!(
                "the coupling `{name}` says nothing of a DOF: it names no joint that moves"
            );
            return Err((one.span(), fault));
        }
        let (constant, terms) = sum.done();
        Ok(Coupling { name: of.name.clone(), constant, terms })
    }

    /// What a joint without a DOF of its own adds to a coupling: a mimic joint a term of its driver, a fixed one nothing.
    /// Whether it moves; `None` if there is no such joint.
    fn coupled(
        &self,
        name: &str,
        coefficients: [f64; 4],
        known: &Names<'_>,
        sum: &mut Terms,
    ) -> Option<bool> {
        let idx = known.joint(name)?;
        if self.chain.joints_in_chain[idx].joint_type == JointType::Fixed {
            return Some(false);
        }
        let mimic = self.dof.joint_idx_to_mimic_mapping[idx].as_ref()?;
        let (m, o) = (mimic.multiplier, mimic.offset);
        let sizes = substituted(coefficients.map(f64::abs), m.abs(), o.abs());
        let (constant, coefficients) = substituted(coefficients, m, o);
        sum.add_constant(constant, sizes.0);
        if let Some(dof_idx) = mimic.dof_idx {
            sum.add(dof_idx, coefficients, Some(sizes.1));
        }
        Some(true)
    }

    /// For each DOF, how much rather it is to move freely than to follow: 0 to 2.
    pub(super) fn preferred(
        &self,
        (said, known): (&Said, &Names<'_>),
        loops: &Loops,
        notes: &mut Vec<Note>,
    ) -> Result<Vec<u8>> {
        let mut preferred = vec![2; self.dof.dofs.len()];
        for dof in loops.dofs() {
            preferred[dof.get()] = 0;
        }
        let names = said.file.independent.iter().flatten();
        let mut none = Vec::new();
        let mut fixed = Vec::new();
        let mut says_one = false;
        for name in names {
            let word = name.get_ref().as_str();
            let dofs = known.dofs(word);
            if dofs.is_empty() && said.text.is_some() {
                match known.joint(word).is_some() {
                    true => fixed.push(word),
                    false => none.push(word),
                }
            }
            for dof in dofs {
                says_one |= preferred[*dof] < 2;
                preferred[*dof] = preferred[*dof].max(1);
            }
        }
        for dof in said.first.iter().flat_map(|word| known.dofs(word)) {
            preferred[*dof] = 2;
        }
        if let Some(first) = none.first() {
            let all = self.dof.dofs.iter().map(|dof| dof.name.as_str());
            let problem = known.unknown("joint", first, all);
            let problem = format!("a joint is said to move freely, but {problem}");
            let assumed = "the name is passed over";
            notes.push(self.note(NoteKind::LeftOut, problem, assumed));
        }
        if !fixed.is_empty() {
            let problem = format!("{} cannot move freely: no DOF is of this name", named(&fixed));
            notes.push(self.note(NoteKind::LeftOut, problem, "the names are passed over"));
        }
        if !says_one {
            // Where nobody says it, joints that are nearest to the root move the others.
            let depths = self.depths();
            let depth = |dof: usize| depths[self.dof.dofs[dof].joint_idx.get()];
            for group in loops.groups() {
                let least = group.iter().map(|dof| depth(*dof)).min();
                for dof in group {
                    preferred[*dof] = if Some(depth(*dof)) == least { 2 } else { 0 };
                }
            }
        }
        Ok(preferred)
    }

    /// What moves freely though the source does not say so, or follows though it does.
    pub(super) fn otherwise(
        &self,
        (said, known): (&Said, &Names<'_>),
        loops: &Loops,
        mobility: &Mobility,
    ) -> Option<Note> {
        let told = said.file.independent.as_ref()?;
        let told: HashSet<&usize> =
            told.iter().flat_map(|name| known.dofs(name.get_ref())).collect();
        let first: HashSet<&usize> = said.first.iter().flat_map(|name| known.dofs(name)).collect();
        let moved: HashSet<usize> = loops.dofs().map(|dof| dof.get()).collect();
        let name = |dof: &usize| self.dof.dofs[*dof].name.as_str();
        let free: Vec<&str> = mobility
            .independent
            .iter()
            .filter(|dof| !told.contains(dof))
            .filter(|dof| moved.contains(dof))
            .map(name)
            .collect();
        let follow: Vec<&str> = mobility
            .dependent
            .iter()
            .filter(|dof| if first.is_empty() { &told } else { &first }.contains(dof))
            .map(name)
            .collect();
        let mut parts = Vec::new();
        if !follow.is_empty() {
            parts.push(format!(
                "{} follow from others, and are said to move freely",
                named(&follow)
            ));
        }
        if !free.is_empty() {
            parts.push(format!("{} move freely, and are not said to", named(&free)));
        }
        if parts.is_empty() {
            return None;
        }
        Some(self.note(
            NoteKind::Otherwise,
            format!("other DOFs move freely than the source says: {}", parts.join("; ")),
            "loops_module says which DOFs are independent where all loops are closed",
        ))
    }

    /// For each joint, how many joints are above it.
    fn depths(&self) -> Vec<usize> {
        let mut of_link = vec![0; self.chain.links_in_chain.len()];
        for (depth, links) in self.chain.kinematic_hierarchy.iter().enumerate() {
            for link in links {
                of_link[link.get()] = depth;
            }
        }
        let joints = self.chain.joints_in_chain.iter();
        joints.map(|joint| of_link[joint.parent_link_idx.get()]).collect()
    }
}

/// Up to four coefficients, the others 0.
fn four(coefficients: &[f64]) -> Option<[f64; 4]> {
    let mut four = [0.0; 4];
    four.get_mut(..coefficients.len())?.copy_from_slice(coefficients);
    (!coefficients.is_empty() && four.iter().all(|x| x.is_finite())).then_some(four)
}

fn named(names: &[&str]) -> String {
    first_names(names.iter().map(|name| Short::of(name)))
}

/// A sum that is smaller than this fraction of its summands is 0.
const ROUNDING: f64 = 1e-14;

/// The polynomial in m q + o as one in q: its constant and coefficients.
fn substituted([a, b, c, d]: [f64; 4], m: f64, o: f64) -> (f64, [f64; 4]) {
    let coefficients = [
        m * (a + o * (2.0 * b + o * (3.0 * c + o * 4.0 * d))),
        m * m * (b + o * (3.0 * c + o * 6.0 * d)),
        m * m * m * (c + 4.0 * o * d),
        m * m * m * m * d,
    ];
    (o * (a + o * (b + o * (c + o * d))), coefficients)
}

/// What is added up for a coupling; of each number, the sum and the sum of the absolute values.
struct Terms {
    constant: [f64; 2],
    /// For each DOF, its coefficients and their absolute values, added up.
    terms: BTreeMap<DofIdx, [[f64; 4]; 2]>,
}

impl Terms {
    pub(super) fn new(constant: f64) -> Self {
        Terms { constant: [constant, constant.abs()], terms: BTreeMap::new() }
    }

    fn add_constant(&mut self, constant: f64, size: f64) {
        self.constant[0] += constant;
        self.constant[1] += size;
    }

    pub(super) fn add(&mut self, dof_idx: DofIdx, coefficients: [f64; 4], sizes: Option<[f64; 4]>) {
        let sizes = sizes.unwrap_or_else(|| coefficients.map(f64::abs));
        let Some(sums) = self.terms.get_mut(&dof_idx) else {
            self.terms.insert(dof_idx, [coefficients, sizes]);
            return;
        };
        for place in 0..4 {
            sums[0][place] += coefficients[place];
            sums[1][place] += sizes[place];
        }
    }

    /// The constant, and the terms that are not 0, by their DOFs. What is left by rounding alone is 0.
    pub(super) fn done(self) -> (f64, Vec<CouplingTerm>) {
        let rounded = |sum: f64, size: f64| if sum.abs() <= ROUNDING * size { 0.0 } else { sum };
        let [constant, size] = self.constant;
        let terms = self.terms.into_iter().map(|(dof_idx, [mut coefficients, sizes])| {
            for (sum, size) in coefficients.iter_mut().zip(sizes) {
                *sum = rounded(*sum, size);
            }
            CouplingTerm { dof_idx, coefficients }
        });
        let is_there = |term: &CouplingTerm| term.coefficients.iter().any(|x| *x != 0.0);
        (rounded(constant, size), terms.filter(is_there).collect())
    }
}
