//! Selects the rules to report. All rules run, because rules need others.

use std::str::FromStr;

use thiserror::Error;

use super::check::{Check, Outcome};
use super::code::Code;

/// A rule or a family of rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Codes {
    /// One rule.
    One(Code),
    /// All rules of a family.
    Family(&'static str),
}

/// Neither the code of a rule nor a family.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no rule and no family of rules `{0}`; `urdd explain` lists them")]
pub struct UnknownCodes(String);

impl FromStr for Codes {
    type Err = UnknownCodes;

    fn from_str(text: &str) -> Result<Self, UnknownCodes> {
        let family = || {
            let mut families = Code::ALL.iter().map(|code| code.family());
            families.find(|family| family.eq_ignore_ascii_case(text))
        };
        let one = Code::parse(text).map(Codes::One);
        one.or_else(|| family().map(Codes::Family)).ok_or_else(|| UnknownCodes(text.to_owned()))
    }
}

impl Codes {
    /// Whether it includes a rule.
    pub fn holds(self, code: Code) -> bool {
        match self {
            Codes::One(one) => one == code,
            Codes::Family(family) => code.family() == family,
        }
    }
}

/// The rules to report.
#[derive(Debug, Clone, Default)]
pub struct Selection {
    /// Only these; all if empty.
    pub select: Vec<Codes>,
    /// Except these.
    pub ignore: Vec<Codes>,
}

impl Selection {
    /// Removes what is not reported. A crashed rule is always reported.
    pub(super) fn apply(&self, checks: &mut Vec<Check>) {
        let holds = |list: &[Codes], code| list.iter().any(|codes| codes.holds(code));
        checks.retain(|check| {
            let code = check.rule.code;
            let selected = self.select.is_empty() || holds(&self.select, code);
            matches!(check.outcome, Outcome::Crashed(_)) || (selected && !holds(&self.ignore, code))
        });
    }
}
