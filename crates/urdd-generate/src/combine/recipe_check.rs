//! Checks a recipe before any part is read. Recipes are untrusted input: the work is linear in the number of parts,
//! which is limited to the maximum number of links.

use std::collections::HashMap;

use super::error::CombineError;
use super::recipe::{Recipe, Word};
use super::recipe_fault::RecipeFault;
use crate::MOST_LINKS;
use urdd_source::cycles;

/// Maximum length of a robot's name in bytes: files are named after it.
const MAX_NAME_BYTES: usize = 200;

/// Maximum length of a prefix in bytes: it is repeated before thousands of names.
const MAX_PREFIX_BYTES: usize = 100;

impl Recipe {
    /// Checks the number of parts, their names and their attachments.
    pub(super) fn check(&self) -> Result<(), CombineError> {
        if self.parts.is_empty() {
            return Err(self.refused(&Word::default(), RecipeFault::NoParts));
        }
        if let Some(part) = self.parts.get(MOST_LINKS) {
            let fault = RecipeFault::TooManyLinks { found: self.parts.len(), limit: MOST_LINKS };
            return Err(self.refused(&part.id, fault));
        }
        self.check_words()?;
        self.check_ids()?;
        let mut roots = self.parts.iter().filter(|part| part.attach.is_none());
        let first = roots.next();
        if let (Some(first), Some(second)) = (first, roots.next()) {
            let fault = RecipeFault::TwoRoots {
                first: first.id.text.clone(),
                second: second.id.text.clone(),
            };
            return Err(self.refused(&second.id, fault));
        }
        self.check_attachments()
    }

    /// Checks that names and prefixes can be written in a URDF.
    fn check_words(&self) -> Result<(), CombineError> {
        let unlimited = usize::MAX;
        self.check_word("the name", &self.name, MAX_NAME_BYTES)?;
        if let Some(base) = &self.base {
            self.check_word("the link", &base.link, unlimited)?;
            self.check_word("the joint", &base.joint.name, unlimited)?;
        }
        for part in &self.parts {
            if !part.prefix.text.is_empty() {
                self.check_word("the prefix", &part.prefix, MAX_PREFIX_BYTES)?;
            }
            if let Some(attach) = &part.attach {
                self.check_word("the joint", &attach.joint.name, unlimited)?;
            }
        }
        Ok(())
    }

    fn check_word(
        &self,
        what: &'static str,
        word: &Word,
        limit: usize,
    ) -> Result<(), CombineError> {
        let text = &word.text;
        // XML does not allow other control characters, and turns these into spaces.
        let is_unfit = |c: &char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}');
        let why = if text.trim().is_empty() {
            "is only white space; write a name".to_owned()
        } else if let Some(found) = text.chars().find(is_unfit) {
            format!(
                "has the character U+{:04X}, which names in a URDF cannot contain; remove it",
                u32::from(found)
            )
        } else if text.len() > limit {
            format!("has {} bytes; write at most {limit}", text.len())
        } else {
            return Ok(());
        };
        let found = text.clone();
        Err(self.refused(word, RecipeFault::BadWord { what, found, why }))
    }

    fn check_ids(&self) -> Result<(), CombineError> {
        let mut first_of: HashMap<String, &Word> = HashMap::new();
        for part in &self.parts {
            let id = &part.id;
            let is_of_id = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
            if id.text.is_empty() || !id.text.chars().all(is_of_id) {
                return Err(self.refused(id, RecipeFault::BadId(id.text.clone())));
            }
            if let Some(first) = first_of.insert(id.text.to_ascii_lowercase(), id) {
                let fault = RecipeFault::IdTwice { id: id.text.clone(), first: first.at };
                return Err(self.refused(id, fault));
            }
        }
        Ok(())
    }

    /// Checks that each part is attached to the root part, or to one that is.
    fn check_attachments(&self) -> Result<(), CombineError> {
        let mut holders = Vec::new();
        for part in &self.parts {
            holders.push(match &part.attach {
                Some(attach) => self.target(&attach.to)?.0,
                None => None,
            });
        }
        let Some(ring) = cycles(&holders).into_iter().next() else {
            return Ok(());
        };
        let first = &self.parts[ring[0]];
        let at = first.attach.as_ref().map_or(&first.id, |attach| &attach.to);
        let ids = ring.iter().map(|part| self.parts[*part].id.text.clone());
        let mut ids: Vec<String> = ids.collect();
        let fault = match ids.len() {
            1 => RecipeFault::OnItself(ids.swap_remove(0)),
            _ => RecipeFault::Ring(ids),
        };
        Err(self.refused(at, fault))
    }
}
