//! Folders, files and links that lie on no disk.

use std::collections::{BTreeMap, BTreeSet};

use crate::directory::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use crate::directory::listing::{Entry, EntryKind, Listing};
use crate::directory::read_error::ReadError;

/// Most symbolic links that one path is followed through, as on Linux.
const MAX_LINKS: usize = 40;

/// What lies at a path.
#[derive(Debug)]
pub enum Node<T> {
    Folder,
    File { size: u64, data: T },
    Link(String),
    Other,
}

/// What lies below a root, by path.
#[derive(Debug)]
pub struct Tree<T> {
    nodes: BTreeMap<String, Node<T>>,
    not_utf8: BTreeSet<String>,
}

impl<T> Default for Tree<T> {
    fn default() -> Self {
        Tree {
            nodes: BTreeMap::new(),
            not_utf8: BTreeSet::new(),
        }
    }
}

impl<T> Tree<T> {
    /// Puts a node at a path, and the folders above it. `false` where something else is there.
    pub fn insert(&mut self, path: &str, node: Node<T>, utf8: bool) -> bool {
        for (slash, _) in path.match_indices('/') {
            let above = self.nodes.entry(path[..slash].to_owned());
            if !matches!(above.or_insert(Node::Folder), Node::Folder) {
                return false;
            }
        }
        if !utf8 {
            self.not_utf8.insert(path.to_owned());
        }
        let is_folder = matches!(node, Node::Folder);
        match self.nodes.get(path) {
            Some(Node::Folder) => is_folder,
            Some(_) => false,
            None => {
                self.nodes.insert(path.to_owned(), node);
                true
            }
        }
    }

    /// The file at a path, links followed.
    pub fn file(&self, path: &str) -> Result<(&T, u64), ReadError> {
        match self.follow(path)? {
            Node::File { size, data } => Ok((data, *size)),
            _ => Err(ReadError::NotAFile),
        }
    }

    /// All of it, as of a folder on disk.
    pub fn listing(&self) -> Listing {
        let mut listing = Listing::default();
        for (path, node) in &self.nodes {
            let depth = path.matches('/').count();
            if listing.entries.len() >= MAX_FILES {
                listing.cut = true;
                break;
            }
            if depth >= MAX_FOLDER_DEPTH {
                continue;
            }
            let (kind, size) = match node {
                Node::Folder => (EntryKind::Folder, 0),
                Node::File { size, .. } => (EntryKind::File, *size),
                Node::Other => (EntryKind::Other, 0),
                Node::Link(_) => match self.follow(path) {
                    Ok(Node::File { size, .. }) => (EntryKind::File, *size),
                    Err(ReadError::LeavesRoot) => (EntryKind::LinkOut, 0),
                    _ => (EntryKind::Link, 0),
                },
            };
            listing.cut |= kind == EntryKind::Folder && depth + 1 >= MAX_FOLDER_DEPTH;
            listing.entries.push(Entry {
                path: path.clone(),
                kind,
                size,
                utf8: !self.not_utf8.contains(path),
            });
        }
        listing
    }

    /// What a path leads to.
    fn follow(&self, path: &str) -> Result<&Node<T>, ReadError> {
        let mut ahead: Vec<&str> = path.split('/').rev().collect();
        let mut at = String::new();
        let mut node = &Node::Folder;
        let mut links = 0;
        while let Some(part) = ahead.pop() {
            match part {
                "" | "." => continue,
                ".." if at.is_empty() => return Err(ReadError::LeavesRoot),
                ".." => {
                    at.truncate(at.rfind('/').unwrap_or(0));
                    node = &Node::Folder;
                    continue;
                }
                _ => {}
            }
            if !matches!(node, Node::Folder) {
                return Err(ReadError::Missing);
            }
            let folder = at.len();
            if folder > 0 {
                at.push('/');
            }
            at.push_str(part);
            node = self.nodes.get(&at).ok_or(ReadError::Missing)?;
            if let Node::Link(target) = node {
                links += 1;
                if target.starts_with('/') {
                    return Err(ReadError::LeavesRoot);
                }
                if links > MAX_LINKS {
                    return Err(ReadError::Io(
                        "too many links lead to each other".to_owned(),
                    ));
                }
                at.truncate(folder);
                node = &Node::Folder;
                ahead.extend(target.split('/').rev());
            }
        }
        Ok(node)
    }
}
