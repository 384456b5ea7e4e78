use crate::rules::prelude::*;

declare_rule! {
    /// A module is derived from one that is not in the URDD.
    ///
    /// Its numbers mean nothing without the other: matrices over shapes are of no use to a program
    /// that cannot know the shapes. Nor can anybody check it.
    ///
    /// Write the missing module, or leave out the one that needs it.
    DIR017 "dependency-missing", Error, clause "2.10", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check dependency_missing,

    /// `depends_on` does not name the modules that the module is derived from.
    ///
    /// By it programs decide what to write again after a change, and what to load with a module. Where
    /// a name is missing, a module stays stale.
    ///
    /// Write the names of the table in SPEC §12, each once. (An extension names whatever it was
    /// derived from.)
    DIR018 "wrong-dependencies", Error, clause "2.10", since "0.1.0",
    phase Files, needs [Version1, RootMetadata, NotFailed(DIR021), NotFailed(DIR030)], check wrong_dependencies,
}

fn dependency_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    let entries = listed_modules(context)?;
    let mut names: HashSet<&str> = context.modules().map(|module| module.name()).collect();
    for entry in &entries {
        names.insert(&entry.entry.name);
        names.extend(entry.kind.map(Kind::name));
    }
    for entry in &entries {
        for (place, name) in entry.entry.depends_on.iter().enumerate() {
            let needed = entries::version_1_kinds().find(|kind| kind.name() == name);
            let is_right =
                |kind: Kind| needed.is_some_and(|needed| kind.depends_on().contains(&needed));
            let reported_elsewhere = match entry.kind {
                // DIR018 reports a name that should not be there at all.
                Some(kind) if !is_right(kind) => true,
                // DIR019 reports a module that the conformance class requires.
                _ => needed
                    .and_then(|needed| needed.class())
                    .is_some_and(|class| Some(class) <= context.class()),
            };
            if names.contains(name.as_str()) || reported_elsewhere {
                continue;
            }
            let message = format!(
                "{} is derived from {name}, which is not in the URDD: write that too, or leave this one out",
                entry.entry.name
            );
            let finding = finding_in(entry, format!("depends_on/{place}"), message);
            findings.report(finding.values(format!("a module {name}"), "none"));
        }
    }
    Some(())
}

fn wrong_dependencies(context: &Context, findings: &mut Findings) -> Option<()> {
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
