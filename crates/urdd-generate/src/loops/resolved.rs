//! What a source says of loops, by the robot's indices.

use std::collections::HashMap;

use nalgebra::{Isometry3, Translation3};

use super::made::Made;
use crate::error::Result;
use urdd_directory::export_toml::Name;
use urdd_directory::loops_toml::FrameTable;
use urdd_format::index::{DofIdx, LinkIdx};
use urdd_format::loops::{Coupling, CouplingTerm, Loop, LoopsModule};
use urdd_format::nearest::nearest;
use urdd_format::short::Short;
use urdd_format::urdf::JointType;
use urdd_kinematics::loops::Loops;
use urdd_kinematics::pose::from_isometry;
use urdd_kinematics::rotation::from_rpy;
use urdd_source::loops::{File, Said};
use urdd_source::note::{Note, NoteKind};

impl Made<'_> {
    /// The loops and couplings by index, without configurations.
    pub(super) fn resolved(&self, said: &Said) -> Result<LoopsModule> {
        let links: HashMap<&str, usize> = self
            .chain
            .links_in_chain
            .iter()
            .enumerate()
            .map(|(idx, link)| (link.name.as_str(), idx))
            .collect();
        let link = |name: &Name| -> Result<LinkIdx> {
            let word = name.get_ref().as_str();
            // Extended URDF also names joints, and means their children.
            let joints = || {
                let mut joints = self.chain.joints_in_chain.iter();
                joints.find(|joint| joint.joint_name == word).map(|joint| joint.child_link_idx)
            };
            let link = links.get(word).and_then(|idx| u32::try_from(*idx).ok()).map(LinkIdx);
            link.or_else(joints).ok_or_else(|| {
                let known = self.chain.links_in_chain.iter().map(|link| link.name.as_str());
                self.refused(said, Some(name.span()), unknown("link", word, known))
            })
        };
        let File { loops, couplings, .. } = &said.file;
        let mut names: HashMap<&str, ()> = HashMap::new();
        let all = loops.iter().map(|one| (&*one.get_ref().name, one.span()));
        let all = all.chain(couplings.iter().map(|one| (&*one.get_ref().name, one.span())));
        for (name, place) in all {
            if names.insert(name, ()).is_some() {
                let fault = format!("another loop or coupling is called `{}`", Short::of(name));
                return Err(self.refused(said, Some(place), fault));
            }
        }
        let mut module = LoopsModule {
            loops: Vec::new(),
            couplings: Vec::new(),
            independent_dof_idxs: Vec::new(),
            reference_configuration: Vec::new(),
            closed_samples: Vec::new(),
        };
        for one in loops {
            let of = one.get_ref();
            let (link_a_idx, link_b_idx) = (link(&of.link_a)?, link(&of.link_b)?);
            if link_a_idx == link_b_idx {
                let fault =
                    format!("the loop `{}` connects a link with itself", Short::of(&of.name));
                return Err(self.refused(said, Some(one.span()), fault));
            }
            let is_usable =
                |frame: &FrameTable| frame.xyz.iter().chain(&frame.rpy).all(|x| x.is_finite());
            if !is_usable(&of.frame_a) || !is_usable(&of.frame_b) {
                let fault = "a number of a frame is not finite".to_owned();
                return Err(self.refused(said, Some(one.span()), fault));
            }
            module.loops.push(Loop {
                name: of.name.clone(),
                kind: of.kind,
                link_a_idx,
                frame_a: from_isometry(&isometry(&of.frame_a)),
                link_b_idx,
                frame_b: from_isometry(&isometry(&of.frame_b)),
                position_tolerance: 0.0,
                rotation_tolerance: 0.0,
            });
        }
        for one in couplings {
            let of = one.get_ref();
            let mut terms: Vec<CouplingTerm> = Vec::new();
            let mut constant = of.constant;
            for (name, coefficients) in &of.terms {
                let [idx] = *self.dofs(name.get_ref()) else {
                    match self.coupled(name.get_ref(), coefficients, &mut constant) {
                        Some(Some(term)) => add(&mut terms, term),
                        Some(None) => {}
                        None => {
                            let known = self.dof.dofs.iter().map(|dof| dof.name.as_str());
                            let fault = unknown("DOF", name.get_ref(), known);
                            return Err(self.refused(said, Some(name.span()), fault));
                        }
                    }
                    continue;
                };
                let Some(coefficients) = four(coefficients) else {
                    let fault = "one to four finite coefficients are needed".to_owned();
                    return Err(self.refused(said, Some(name.span()), fault));
                };
                let dof_idx = DofIdx(u32::try_from(idx).unwrap_or(u32::MAX));
                add(&mut terms, CouplingTerm { dof_idx, coefficients });
            }
            terms.retain(|term| term.coefficients.iter().any(|x| *x != 0.0));
            terms.sort_by_key(|term| term.dof_idx);
            if terms.is_empty() {
                let fault = format!("the coupling `{}` says nothing of a DOF", Short::of(&of.name));
                return Err(self.refused(said, Some(one.span()), fault));
            }
            module.couplings.push(Coupling { name: of.name.clone(), constant, terms });
        }
        Ok(module)
    }

    /// The DOFs of this name: of a DOF, or all of a joint.
    fn dofs(&self, name: &str) -> Vec<usize> {
        let all = self.dof.dofs.iter().enumerate();
        let named: Vec<usize> =
            all.clone().filter(|(_, dof)| dof.name == name).map(|(idx, _)| idx).take(1).collect();
        match named.is_empty() {
            true => all.filter(|(_, dof)| dof.joint_name == name).map(|(idx, _)| idx).collect(),
            false => named,
        }
    }

    /// What a joint without a DOF of its own adds to a coupling: a mimic joint a term of its driver, a fixed one nothing.
    /// `None` if there is no such joint, or its part is not a multiple.
    fn coupled(
        &self,
        name: &str,
        coefficients: &[f64],
        constant: &mut f64,
    ) -> Option<Option<CouplingTerm>> {
        let idx = self.chain.joints_in_chain.iter().position(|joint| joint.joint_name == name)?;
        let [a, b, c, d] = four(coefficients)?;
        if self.chain.joints_in_chain[idx].joint_type == JointType::Fixed {
            return Some(None);
        }
        let mimic = self.dof.joint_idx_to_mimic_mapping[idx].as_ref()?;
        let (dof_idx, m, o) = (mimic.dof_idx, mimic.multiplier, mimic.offset);
        // The polynomial of m q + o.
        *constant += o * (a + o * (b + o * (c + o * d)));
        let coefficients = [
            m * (a + o * (2.0 * b + o * (3.0 * c + o * 4.0 * d))),
            m * m * (b + o * (3.0 * c + o * 6.0 * d)),
            m * m * m * (c + 4.0 * o * d),
            m * m * m * m * d,
        ];
        Some(dof_idx.map(|dof_idx| CouplingTerm { dof_idx, coefficients }))
    }

    /// For each DOF, whether it is rather to move freely than to follow.
    pub(super) fn preferred(
        &self,
        said: &Said,
        loops: &Loops,
        notes: &mut Vec<Note>,
    ) -> Result<Vec<bool>> {
        let mut preferred = vec![true; self.dof.dofs.len()];
        for dof in loops.dofs() {
            preferred[dof.get()] = false;
        }
        let Some(names) = &said.file.independent else {
            // Where nobody says it, joints that are nearest to the root move the others.
            let depths = self.depths();
            let depth = |dof: usize| depths[self.dof.dofs[dof].joint_idx.get()];
            for group in loops.groups() {
                let least = group.iter().map(|dof| depth(*dof)).min();
                for dof in group {
                    preferred[*dof] = Some(depth(*dof)) == least;
                }
            }
            return Ok(preferred);
        };
        let mut none = Vec::new();
        for name in names {
            let dofs = self.dofs(name.get_ref());
            let is_joint = || {
                self.chain.joints_in_chain.iter().any(|joint| joint.joint_name == *name.get_ref())
            };
            if dofs.is_empty() && !is_joint() {
                none.push(name.get_ref().as_str());
            }
            for dof in dofs {
                preferred[dof] = true;
            }
        }
        if let Some(first) = none.first() {
            let known = self.dof.dofs.iter().map(|dof| dof.name.as_str());
            let problem = unknown("joint", first, known);
            let problem = format!("a joint is said to move freely, but {problem}");
            let assumed = "the name is passed over";
            notes.push(self.note(NoteKind::LeftOut, problem, assumed));
        }
        Ok(preferred)
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

fn isometry(frame: &FrameTable) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(frame.xyz), from_rpy(frame.rpy))
}

/// Up to four coefficients, the others 0.
fn four(coefficients: &[f64]) -> Option<[f64; 4]> {
    let mut four = [0.0; 4];
    four.get_mut(..coefficients.len())?.copy_from_slice(coefficients);
    (!coefficients.is_empty() && four.iter().all(|x| x.is_finite())).then_some(four)
}

fn add(terms: &mut Vec<CouplingTerm>, term: CouplingTerm) {
    match terms.iter_mut().find(|other| other.dof_idx == term.dof_idx) {
        Some(other) => {
            for (sum, more) in other.coefficients.iter_mut().zip(term.coefficients) {
                *sum += more;
            }
        }
        None => terms.push(term),
    }
}

fn unknown<'n>(what: &str, name: &str, known: impl Iterator<Item = &'n str>) -> String {
    let near = nearest(known, name);
    let near =
        near.map_or_else(String::new, |near| format!("; did you mean `{}`?", Short::of(&near)));
    format!("there is no {what} `{}`{near}", Short::of(name))
}
