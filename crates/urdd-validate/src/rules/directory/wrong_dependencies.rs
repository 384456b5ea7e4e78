use crate::rules::prelude::*;

declare_rule! {
    /// `depends_on` does not name the modules that the module is derived from.
    ///
    /// By it programs decide what to write again after a change, and what to load with a module. Where
    /// a name is missing, a module stays stale.
    ///
    /// Write the names of the table in SPEC §12, each once. (An extension names whatever it was
    /// derived from.)
    DIR018 "wrong-dependencies", Error, clause "2.10", since "0.1.0",
    phase Files, needs [Version1, RootMetadata, NotFailed(DIR021), NotFailed(DIR030)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for entry in listed_modules(context)? {
        let stated: Vec<&str> = entry.entry.depends_on.iter().map(String::as_str).collect();
        let names = |kind: Kind| kind.depends_on().iter().map(|kind| kind.name()).collect();
        let right: Option<Vec<&str>> = entry.kind.map(names);
        let set: BTreeSet<&str> = stated.iter().copied().collect();
        let twice = set.len() < stated.len();
        let is_right = |right: &Vec<&str>| set == right.iter().copied().collect();
        if !twice && right.as_ref().is_none_or(is_right) {
            continue;
        }
        let message = match twice {
            true => "a module is named twice: name each once".to_owned(),
            false => format!("these are not the modules that {} is derived from", entry.entry.name),
        };
        let mut finding = finding_in(&entry, "depends_on", message).actual(words(&stated));
        finding.place.expected = right.as_deref().map(words);
        findings.report(finding);
    }
    Some(())
}

fn words(names: &[&str]) -> String {
    match names {
        [] => "none".to_owned(),
        _ => names[..names.len().min(20)].join(", "),
    }
}
