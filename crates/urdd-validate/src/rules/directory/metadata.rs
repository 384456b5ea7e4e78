use std::path::Path;

use crate::rules::prelude::*;
use urdd_directory::file_type::FileType;
use urdd_format::registry::FIRST_SPEC_VERSION;
use urdd_format::root_metadata::Source;

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
    /// Write the names of the table in SPEC 2.2.1, each once. (An extension names whatever it was
    /// derived from.)
    DIR018 "wrong-dependencies", Error, clause "2.10", since "0.1.0",
    phase Files, needs [Version1, RootMetadata, NotFailed(DIR021), NotFailed(DIR030)], check wrong_dependencies,

    /// An entry of `modules` has a name and a path that do not belong together, or is there twice.
    ///
    /// Some programs look a module up by its name, others by its folder. Every module has one folder
    /// that the specification gives it, and its name is the last part of that.
    ///
    /// Give each module one entry, with the name and the folder of the table in SPEC 2.2.1.
    DIR021 "module-entry-wrong", Error, clause "2.6", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check module_entry_wrong,

    /// `modules` or a `files` list of `urdd.json` is not in order, or names a file twice.
    ///
    /// One order for all makes the same URDD the same bytes, whoever writes it: differences between
    /// two versions show what changed and nothing else.
    ///
    /// Put modules in the order of the table in SPEC 2.2.1, extensions after them by name; sort files
    /// by path, byte by byte, each once.
    DIR026 "list-out-of-order", Error, clause "2.6", since "0.1.0",
    phase Files, needs [Version1, RootMetadata, Passed(DIR021)], check list_out_of_order,

    /// The source URDF is in a folder below the root.
    ///
    /// It must lie in the root folder itself: there people and programs look for the one URDF that a
    /// URDD was made from, and there no module's folder can claim it.
    ///
    /// Move it next to `urdd.json`, and change `source` to its new path.
    DIR028 "source-not-in-root", Error, clause "2.12", since "0.2.0",
    phase Files, needs [Version1, RootMetadata], check source_not_in_root,

    /// The root folder holds a URDF, and `source` is null.
    ///
    /// The modules are compared with the URDF that `source` names. With null there, they are compared
    /// with nothing: the robot in the modules may be another one than that of the URDF beside them.
    ///
    /// Name the URDF as the source, with its size and SHA-256; or move it out of the folder, where the
    /// URDD was not made from it.
    DIR029 "source-not-named", Warning, clause "2.12", since "0.2.0",
    phase Files, needs [Version1, RootMetadata], check source_not_named,

    /// `urdd.json` and `urdf_module` name different robots.
    ///
    /// `robot_name` is what a collection of URDDs is searched by; it must be the name that the robot
    /// has in its URDF.
    ///
    /// Write `name` of `urdf_module` as `robot_name`.
    DIR020 "robot-name-differs", Error, clause "2.11", since "0.1.0",
    phase References, needs [Version1, RootMetadata, Module(Kind::Urdf)], check robot_name_differs,
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

fn module_entry_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let (mut names, mut paths) = (HashSet::new(), HashSet::new());
    for entry in listed_modules(context)? {
        let (name, path) = (entry.entry.name.as_str(), entry.entry.path.as_str());
        // DIR015 reports an invalid path.
        if path::check(path).is_err() {
            continue;
        }
        let twice = !names.insert(name) || !paths.insert(path);
        let last = path.rsplit('/').next().unwrap_or(path);
        let (key, message, expected) = match entry.kind {
            Some(kind) if kind.name() != name => {
                let message = "this is not the name of the module in this folder";
                ("name", message, kind.name())
            }
            Some(kind) if kind.folder() != path => {
                let message = "this is not the folder that the module has";
                ("path", message, kind.folder())
            }
            _ if last != name => ("name", "the name is not the last part of the path", last),
            _ if twice => ("name", "the module is listed twice", "one entry"),
            _ => continue,
        };
        let actual = if key == "path" { path } else { name };
        finding_in(&entry, key, message).values(expected, format!("{actual:?}")).report(findings);
    }
    Some(())
}

fn list_out_of_order(context: &Context, findings: &mut Findings) -> Option<()> {
    let entries = listed_modules(context)?;
    // Modules of 1.0 first, in the table's order; all others by name, those of later versions too.
    let place = |index: usize| {
        let entry = entries.get(index)?;
        let first = entry.kind.filter(|kind| kind.since() == FIRST_SPEC_VERSION);
        let name = first.is_none().then_some(entry.entry.name.as_str());
        Some((first.is_none(), first, name))
    };
    if let Some(index) = (1..entries.len()).find(|index| place(*index) < place(index - 1)) {
        let (before, name) = (&entries[index - 1].entry.name, &entries[index].entry.name);
        let message = "the modules are not in the order of the specification's table";
        Finding::at(ROOT_METADATA, format!("/modules/{index}"), message)
            .values(format!("{name} before {before}"), format!("{name} after {before}"))
            .report(findings);
    }
    for entry in &entries {
        let files = &entry.entry.files;
        let Some(place) = (1..files.len()).find(|i| files[*i].path <= files[i - 1].path) else {
            continue;
        };
        // A file with another fault is out of order because of that fault.
        let faulty = |path: &str| !entry.holds(path) || entries::look(context, path).is_err();
        if files.iter().any(|file| faulty(&file.path)) {
            continue;
        }
        let (before, path) = (&files[place - 1].path, &files[place].path);
        let message = match before == path {
            true => "the file is listed twice: list each once",
            false => "the files are not sorted by path, byte by byte",
        };
        let finding = finding_in(entry, format!("files/{place}/path"), message);
        findings.report(finding.values(format!("a path after {before}"), path));
    }
    Some(())
}

fn source_not_in_root(context: &Context, findings: &mut Findings) -> Option<()> {
    // DIR015 reports an invalid path.
    if let Some(Source::Urdf(file)) = &context.metadata()?.source
        && path::check(&file.path).is_ok()
        && file.path.contains('/')
    {
        let message = "the source URDF is not in the root folder: move it there";
        let finding = Finding::at(ROOT_METADATA, "/source/Urdf/path", message);
        findings.report(finding.actual(&file.path));
    }
    Some(())
}

fn source_not_named(context: &Context, findings: &mut Findings) -> Option<()> {
    let is_urdf = |path: &str| !path.contains('/') && FileType::Urdf.is_of(Path::new(path));
    let mut entries = context.listing().entries.iter();
    let urdf = entries.find(|entry| entry.kind == EntryKind::File && is_urdf(&entry.path));
    if let (None, Some(urdf)) = (&context.metadata()?.source, urdf) {
        let path = &urdf.path;
        let message = format!(
            "`{path}` is in the root folder, but no source is named, so the modules were not compared with it: name it as the source"
        );
        Finding::at(ROOT_METADATA, "/source", message)
            .values(format!("{{\"Urdf\": {{\"path\": \"{path}\", …}}}}"), "null")
            .report(findings);
    }
    Some(())
}

fn robot_name_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let stated = &context.metadata()?.robot_name;
    let name = &context.robot()?.name;
    // If the carried URDF agrees with urdd.json, urdf_module is wrong, and URD013 reports it.
    let carried = context.urdf_text().and_then(|urdf| urdf.robot.as_ref());
    if stated != name && carried.is_none_or(|carried| carried.name != *stated) {
        let message = "this is not the name in urdf_module: write that one here";
        Finding::at(ROOT_METADATA, "/robot_name", message).literals(name, stated).report(findings);
    }
    Some(())
}
