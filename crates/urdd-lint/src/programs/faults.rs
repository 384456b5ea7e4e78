//! What programs say, by the fault that they say it of.

use std::collections::BTreeMap;

use urdd_programs::{Deed, Fault, Part, Program};

use super::answers::Answer;

/// A fault, by all programs that do something because of it.
#[derive(Debug, Clone)]
pub struct Faulty {
    /// Where it is: the first byte of the element or attribute in the file.
    pub at: usize,
    /// What is wrong, as the program has it that does the worst.
    pub fault: Fault,
    /// What programs do.
    pub said: Vec<Said>,
}

/// What a program does because of a fault.
#[derive(Debug, Clone)]
pub struct Said {
    pub program: Program,
    /// Whether the settings name it.
    pub is_chosen: bool,
    pub deed: Deed,
    /// What is lost or read otherwise; empty for the whole file.
    pub part: Part,
    /// What it makes of the part.
    pub makes: Option<String>,
}

/// The faults of a file, in order of place. What a program does with every robot is none. All that is wrong with an attribute
/// is one fault.
pub fn faults(answers: Vec<Answer>, bytes: &[u8]) -> Vec<Faulty> {
    let refusing = answers.iter().filter(|answer| !answer.effects.loads());
    let refusing: Vec<Program> = refusing.map(|answer| answer.program).collect();
    let mut by_place: BTreeMap<usize, Vec<Faulty>> = BTreeMap::new();
    for answer in answers {
        for effect in answer.effects.0.into_iter().filter(|effect| effect.fault.is_of_robot()) {
            let said = Said {
                program: answer.program,
                is_chosen: answer.is_chosen,
                deed: effect.deed,
                part: effect.part,
                makes: effect.makes,
            };
            let is_attribute = bytes.get(effect.at).is_some_and(|byte| *byte != b'<');
            let here = by_place.entry(effect.at).or_default();
            let new = Faulty { at: effect.at, fault: effect.fault, said: vec![said] };
            let is_same = |one: &&mut Faulty| is_attribute || one.fault.is_alike(&new.fault);
            match here.iter_mut().find(is_same) {
                Some(known) => known.add(new),
                None => here.push(new),
            }
        }
    }
    // What a program loses of a robot that it does not have says nothing.
    let is_something = |faulty: &Faulty| {
        let mut said = faulty.said.iter();
        said.any(|said| said.deed >= Deed::Refuses || !refusing.contains(&said.program))
    };
    by_place.into_values().flatten().filter(is_something).collect()
}

impl Faulty {
    /// The worst that a program does because of it.
    fn worst(&self) -> Option<Deed> {
        self.said.iter().map(|said| said.deed).max()
    }

    /// Whether colours and textures are all that programs lose or read otherwise.
    pub fn is_of_looks(&self) -> bool {
        let is_look = |part: &str| part.starts_with("material/") || part.ends_with("/material");
        self.said.iter().all(|said| is_look(&said.part))
    }

    /// Adds what programs do because of the same fault. Of each program, the worst counts.
    pub fn add(&mut self, other: Faulty) {
        if self.worst() < other.worst() {
            (self.at, self.fault) = (other.at, other.fault);
        }
        for said in other.said {
            match self.said.iter_mut().find(|known| known.program == said.program) {
                Some(known) if known.deed < said.deed => *known = said,
                Some(_) => {}
                None => self.said.push(said),
            }
        }
    }
}
