//! The names of the robots of a batch.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Component, Path};

use urdd_directory::{file_type, path};

use crate::settings::Declared;

/// A name for each robot, by as many of its folders as tell it apart from the others.
pub fn names(sources: &[Declared]) -> Vec<String> {
    let parts: Vec<Vec<String>> = sources.iter().map(parts).collect();
    let mut used = vec![1; sources.len()];
    let name = |idx: usize, used: usize| {
        path::file_name(&parts[idx][parts[idx].len() - used..].join("-"), "")
    };
    loop {
        let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (idx, used) in used.iter().enumerate() {
            let name = name(idx, *used).to_lowercase();
            groups.entry(name).or_default().push(idx);
        }
        let mut grown = false;
        for idx in groups.into_values().filter(|group| group.len() > 1).flatten() {
            if used[idx] < parts[idx].len() {
                used[idx] += 1;
                grown = true;
            }
        }
        if !grown {
            break;
        }
    }
    let mut taken = BTreeSet::new();
    let mut last: HashMap<String, usize> = HashMap::new();
    let names = (0..sources.len()).map(|idx| {
        let name = name(idx, used[idx]);
        let mut candidate = name.clone();
        let number = last.entry(name.to_lowercase()).or_insert(1);
        while !taken.insert(candidate.to_lowercase()) {
            *number += 1;
            candidate = format!("{name}_{number}");
        }
        candidate
    });
    names.collect()
}

/// The names of a robot's folders, and its own name, or its file's without extension; none of them hidden.
fn parts(Declared { source, name, .. }: &Declared) -> Vec<String> {
    let folders = source.parent().into_iter().flat_map(Path::components);
    let folders = folders.filter_map(|component| match component {
        Component::Normal(name) => Some(name.to_string_lossy().into_owned()),
        _ => None,
    });
    let plain = |name: String| match name.trim_start_matches('.') {
        "" => "robot".to_owned(),
        name => name.to_owned(),
    };
    folders.chain([name.clone().unwrap_or_else(|| file_type::stem(source))]).map(plain).collect()
}
