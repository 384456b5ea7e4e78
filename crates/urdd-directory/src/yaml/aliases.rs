//! What a YAML file of another program becomes once its aliases are replaced by what they name, and how deep it is: before
//! anything is made of it.

use std::collections::HashMap;

use saphyr_parser::{Event, Parser};

use crate::account::Account;
use crate::limits::DEPTH_LIMIT;
use crate::yaml::places::WordsFault;

/// What is made of a part, bytes, beside its text.
const PART: usize = 100;

/// Charges all that a file says, and what its aliases name as often as they name it.
///
/// # Errors
/// With the place, if it is not YAML, is nested too deep, or the account does not have what it costs.
pub fn check(text: &str, account: &Account) -> Result<(), WordsFault> {
    // What each anchor names costs.
    let mut named: HashMap<usize, usize> = HashMap::new();
    // The open lists and mappings, each with its anchor and what it costs so far.
    let mut open: Vec<(usize, usize)> = Vec::new();
    for next in Parser::new_from_str(text) {
        let (event, span) =
            next.map_err(|error| WordsFault::new(*error.marker(), error.info().to_owned()))?;
        let (anchor, cost, is_new) = match event {
            Event::SequenceStart(..) | Event::MappingStart(..) if open.len() >= DEPTH_LIMIT => {
                return Err(WordsFault::new(span.start, "it is nested too deep"));
            }
            Event::SequenceStart(anchor, _) | Event::MappingStart(anchor, _) => {
                open.push((anchor, PART));
                continue;
            }
            Event::Scalar(word, _, anchor, _) => (anchor, PART + word.len(), true),
            Event::Alias(anchor) => (0, named.get(&anchor).copied().unwrap_or(PART), true),
            Event::SequenceEnd | Event::MappingEnd => {
                let (anchor, cost) = open.pop().unwrap_or_default();
                (anchor, cost, false)
            }
            _ => continue,
        };
        if is_new {
            let charged = account.charge(cost);
            charged.map_err(|error| WordsFault::new(span.start, error.to_string()))?;
        }
        if anchor != 0 {
            named.insert(anchor, cost);
        }
        if let Some((_, sum)) = open.last_mut() {
            *sum = sum.saturating_add(cost);
        }
    }
    Ok(())
}
