//! Gains of joints by name, and by patterns: `*_hip_*` stands for all joints whose names have it.

use std::collections::BTreeMap;

use toml::Spanned;

use super::file::{Placed, wrong};
use urdd_directory::export_toml::{JointGains, Name};
use urdd_directory::range::Range;

/// The frequency below which a joint follows its actuator.
pub(crate) const BANDWIDTH: Range = Range::real("bandwidth", 0.01, 1000.0, "Hz");

/// It where nobody chose it, Hz.
pub(crate) const USUAL_BANDWIDTH: f64 = 10.0;

/// Whether a name is a pattern, if no joint has it.
pub(super) fn is_pattern(name: &str) -> bool {
    name.contains('*')
}

/// Whether a pattern stands for a name: `*` stands for any letters, or none.
pub(super) fn stands_for(pattern: &str, name: &str) -> bool {
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else { return false };
    let Some(last) = parts.next_back() else { return rest.is_empty() };
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

/// The tables of joints: what says more about a joint comes later, and counts. That is a name, or the longer pattern.
pub(super) fn by_breadth(
    all: &BTreeMap<Name, Spanned<JointGains>>,
) -> Vec<(&Name, &Spanned<JointGains>)> {
    let mut all: Vec<_> = all.iter().collect();
    all.sort_by_key(|(name, _)| breadth(name.get_ref()));
    all
}

/// The number of letters of a pattern; that of a name is above all.
fn breadth(name: &str) -> usize {
    if is_pattern(name) { name.replace('*', "").len() } else { usize::MAX }
}

/// The gains of joints, and for each of their words what set it.
#[derive(Default)]
pub(super) struct Chosen<'a> {
    pub gains: BTreeMap<usize, JointGains>,
    by: BTreeMap<(usize, &'static str), &'a str>,
}

impl<'a> Chosen<'a> {
    /// Adds what a table says of a joint, over what others said.
    pub fn add(&mut self, joint: usize, name: &'a Name, own: JointGains) -> Placed<()> {
        let JointGains { kp, kv, armature, name: called, kind, ctrlrange, forcerange } = own;
        let mut all = self.gains.remove(&joint).unwrap_or_default();
        self.set((joint, "kp"), name, kp, &mut all.kp)?;
        self.set((joint, "kv"), name, kv, &mut all.kv)?;
        self.set((joint, "armature"), name, armature, &mut all.armature)?;
        self.set((joint, "name"), name, called, &mut all.name)?;
        self.set((joint, "kind"), name, kind, &mut all.kind)?;
        self.set((joint, "ctrlrange"), name, ctrlrange, &mut all.ctrlrange)?;
        self.set((joint, "forcerange"), name, forcerange, &mut all.forcerange)?;
        self.gains.insert(joint, all);
        Ok(())
    }

    fn set<T>(
        &mut self,
        place: (usize, &'static str),
        name: &'a Name,
        from: Option<T>,
        to: &mut Option<T>,
    ) -> Placed<()> {
        let Some(value) = from else { return Ok(()) };
        let other = self.by.insert(place, name.get_ref());
        let is_even = |other: &&str| breadth(other) == breadth(name.get_ref());
        if let Some(other) = other.filter(is_even) {
            let [one, other] = [name.get_ref().as_str(), other].map(str::escape_debug);
            let word = place.1;
            let why = format!(
                "`{other}` and `{one}` say `{word}` of one joint, and neither is longer: say it in a table of the joint"
            );
            return wrong(name, why);
        }
        *to = Some(value);
        Ok(())
    }

    /// Whether two actuators have this name.
    pub fn is_given_twice(&self, name: &str) -> bool {
        self.gains.values().filter(|of| of.name.as_deref() == Some(name)).nth(1).is_some()
    }
}
