//! Finds codes of rules in what a command prints, and scores them.

use std::collections::BTreeSet;

use crate::case::{CaseKind, Verdict};
use crate::catalogue::Item;
use urdd_format::conformance::PrintedCodes;
use urdd_format::index::Count;
use urdd_validate::code::Code;

/// Length of a code: three letters, three digits.
const LENGTH: usize = 6;

/// Searches a stream in pieces. A code does not count inside a longer word, nor as a folder of a path: the folder of a
/// case has the name of its code.
#[derive(Debug)]
pub struct Scan {
    /// The byte before the next possible code, and all after it.
    rest: Vec<u8>,
    found: BTreeSet<Code>,
}

impl Default for Scan {
    fn default() -> Scan {
        Scan { rest: vec![b'\n'], found: BTreeSet::new() }
    }
}

impl Scan {
    /// Searches the next piece.
    pub fn read(&mut self, piece: &[u8]) {
        self.rest.extend(piece);
        let is_word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
        for window in self.rest.windows(LENGTH + 2) {
            let [before, code @ .., after] = window else { continue };
            let (letters, digits) = code.split_at(3);
            let has_form =
                letters.iter().all(u8::is_ascii_uppercase) && digits.iter().all(u8::is_ascii_digit);
            if !has_form || is_word(*before) || is_word(*after) || matches!(after, b'/' | b'\\') {
                continue;
            }
            let code = std::str::from_utf8(code).ok().and_then(Code::parse);
            self.found.extend(code);
        }
        let searched = self.rest.len().saturating_sub(LENGTH + 1);
        self.rest.drain(..searched);
    }

    /// All codes, at the end of the stream.
    pub fn finish(mut self) -> BTreeSet<Code> {
        self.read(b"\n");
        self.found
    }
}

/// Scores the codes that a command printed for cases; `None` if it printed none at all. What cannot be read has no code:
/// any that is printed for it is one too many.
pub fn score<'a>(
    ran: impl Iterator<Item = (&'a Item, &'a BTreeSet<Code>)> + Clone,
) -> Option<PrintedCodes> {
    if ran.clone().all(|(_, codes)| codes.is_empty()) {
        return None;
    }
    let (mut of, mut missing, mut extra) = (0, Vec::new(), Vec::new());
    for (item, codes) in ran {
        if item.verdict == Verdict::Unreadable {
            if !codes.is_empty() {
                extra.push(item.id.clone());
            }
            of += 1;
            continue;
        }
        let Some(code) = item.code.as_deref() else { continue };
        let is_printed = codes.iter().any(|printed| printed.as_str() == code);
        match (item.kind, item.verdict) {
            (CaseKind::Valid, _) | (CaseKind::Invalid, Verdict::Accept) => continue,
            (CaseKind::Invalid, Verdict::Reject) if !is_printed => missing.push(item.id.clone()),
            (CaseKind::NearMiss, _) if is_printed => extra.push(item.id.clone()),
            _ => {}
        }
        of += 1;
    }
    Some(PrintedCodes {
        of: Count::saturating(of),
        right: Count::saturating(of - missing.len() - extra.len()),
        missing,
        extra,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn item(kind: CaseKind, verdict: Verdict, code: Option<&str>) -> Item {
        Item {
            id: format!("{kind:?} {verdict:?}"),
            folder: String::new(),
            kind,
            code: code.map(str::to_owned),
            title: String::new(),
            profile: "1.0",
            spec_versions: semver::VersionReq::STAR,
            verdict,
            findings: Vec::new(),
            is_about_reading: code.is_none(),
            profiles: Vec::new(),
        }
    }

    #[test]
    fn what_cannot_be_read_has_no_code() {
        let unreadable = item(CaseKind::Invalid, Verdict::Unreadable, None);
        let near_miss = item(CaseKind::NearMiss, Verdict::Accept, None);
        let rejected = item(CaseKind::Invalid, Verdict::Reject, Some("DOF003"));
        let none = BTreeSet::new();
        let one = BTreeSet::from([Code::DOF003]);
        let score = |printed: &BTreeSet<Code>| {
            let ran = [(&unreadable, printed), (&near_miss, printed), (&rejected, &one)];
            let score = score(ran.into_iter()).expect("a code was printed");
            (score.of, score.right, score.missing, score.extra)
        };
        let [one_case, two_cases] = [1, 2].map(Count::saturating);
        assert_eq!(score(&none), (two_cases, two_cases, vec![], vec![]));
        assert_eq!(score(&one), (two_cases, one_case, vec![], vec![unreadable.id.clone()]));
    }

    #[test]
    fn finds_codes_that_are_words_of_their_own() {
        for (pieces, found) in [
            (&["DOF003"][..], &[Code::DOF003][..]),
            (&["error[DO", "F00", "3]: x"], &[Code::DOF003]),
            (&["{\"code\":\"DOF003\"},", "CHN001,"], &[Code::DOF003, Code::CHN001]),
            (&["/tmp/invalid/DOF003", "/of-two/robot: fine"], &[]),
            (&["C:\\invalid\\DOF003\\of-two"], &[]),
            (&["DOF0031 XDOF003 DOF003_ dof003 DOF999"], &[]),
            (&["", "\u{e9}DOF003\u{e9}"], &[Code::DOF003]),
        ] {
            let mut scan = Scan::default();
            for piece in pieces {
                scan.read(piece.as_bytes());
            }
            assert_eq!(scan.finish(), found.iter().copied().collect(), "{pieces:?}");
        }
    }
}
