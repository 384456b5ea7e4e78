//! A virtual tree of folders, files and links.

use std::cmp::Ordering;

use crate::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use crate::listing::{Entry, EntryKind, Listing};
use crate::read_error::ReadError;

/// Maximum number of symbolic links followed for one path, as on Linux.
const MAX_LINKS: usize = 40;

/// The node at a path.
#[derive(Debug)]
pub enum Node<T> {
    Folder,
    File { size: u64, data: T },
    Link(String),
    Other,
}

/// A path and its node.
#[derive(Debug)]
pub struct Item<T> {
    pub path: String,
    pub utf8: bool,
    pub node: Node<T>,
}

/// All nodes below a root. Stores each path once: the folders above it are implied.
#[derive(Debug)]
pub struct Tree<T> {
    /// Sorted part by part, so that a folder's contents directly follow it.
    items: Vec<Item<T>>,
}

impl<T> Tree<T> {
    /// A tree of items in any order.
    ///
    /// # Errors
    /// A duplicate path, or one that is both a file and a folder.
    pub fn new(mut items: Vec<Item<T>>) -> Result<Self, String> {
        items.sort_by(|a, b| in_parts(&a.path, &b.path));
        for pair in items.windows(2) {
            let [first, second] = pair else { continue };
            let is_folder = |item: &Item<T>| matches!(item.node, Node::Folder);
            let clash = match second.path.strip_prefix(&*first.path) {
                Some("") => !(is_folder(first) && is_folder(second)),
                Some(rest) => rest.starts_with('/') && !is_folder(first),
                None => false,
            };
            if clash {
                return Err(second.path.clone());
            }
        }
        items.dedup_by(|second, first| second.path == first.path);
        Ok(Tree { items })
    }

    /// The file at a path. Follows links.
    pub fn file(&self, path: &str) -> Result<(&T, u64), ReadError> {
        match self.follow(path)? {
            Node::File { size, data } => Ok((data, *size)),
            _ => Err(ReadError::NotAFile),
        }
    }

    /// Lists the whole tree, like a folder on disk.
    pub fn listing(&self) -> Listing {
        let mut listing = Listing::default();
        let mut before = "";
        for item in &self.items {
            let known = shared_parts(before, &item.path);
            let slashes = item.path.match_indices('/').map(|(slash, _)| slash);
            for (depth, slash) in slashes.enumerate().take(MAX_FOLDER_DEPTH).skip(known) {
                listing.cut |= depth + 1 >= MAX_FOLDER_DEPTH;
                listing.entries.push(Entry {
                    path: item.path[..slash].to_owned(),
                    kind: EntryKind::Folder,
                    size: 0,
                    utf8: true,
                });
            }
            before = &item.path;
            let depth = item.path.matches('/').count();
            if depth < MAX_FOLDER_DEPTH {
                let (kind, size) = self.kind(item);
                listing.cut |= kind == EntryKind::Folder && depth + 1 >= MAX_FOLDER_DEPTH;
                listing.entries.push(Entry {
                    path: item.path.clone(),
                    kind,
                    size,
                    utf8: item.utf8,
                });
            }
            if listing.entries.len() > MAX_FILES {
                listing.cut = true;
                listing.entries.truncate(MAX_FILES);
                break;
            }
        }
        listing.entries.sort_by(|a, b| a.path.cmp(&b.path));
        listing
    }

    fn kind(&self, item: &Item<T>) -> (EntryKind, u64) {
        match &item.node {
            Node::Folder => (EntryKind::Folder, 0),
            Node::File { size, .. } => (EntryKind::File, *size),
            Node::Other => (EntryKind::Other, 0),
            Node::Link(_) => match self.follow(&item.path) {
                Ok(Node::File { size, .. }) => (EntryKind::File, *size),
                Err(ReadError::LeavesRoot) => (EntryKind::LinkOut, 0),
                _ => (EntryKind::Link, 0),
            },
        }
    }

    /// The node at a path, without following links.
    fn get(&self, path: &str) -> Option<&Node<T>> {
        let place = self.items.partition_point(|item| in_parts(&item.path, path).is_lt());
        let rest = self.items.get(place)?.path.strip_prefix(path)?;
        match rest {
            "" => Some(&self.items[place].node),
            _ => rest.starts_with('/').then_some(&Node::Folder),
        }
    }

    /// The node at a path, following links.
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
            node = self.get(&at).ok_or(ReadError::Missing)?;
            if let Node::Link(target) = node {
                links += 1;
                if target.starts_with('/') {
                    return Err(ReadError::LeavesRoot);
                }
                if links > MAX_LINKS {
                    return Err(ReadError::Io("too many links lead to each other".to_owned()));
                }
                at.truncate(folder);
                node = &Node::Folder;
                ahead.extend(target.split('/').rev());
            }
        }
        Ok(node)
    }
}

/// Orders paths part by part, so that a folder's contents directly follow it.
fn in_parts(a: &str, b: &str) -> Ordering {
    a.split('/').cmp(b.split('/'))
}

/// Number of folders above `path` that are also above `before`, or are `before` itself.
fn shared_parts(before: &str, path: &str) -> usize {
    let folders = path.matches('/').count();
    let pairs = before.split('/').zip(path.split('/')).take(folders);
    pairs.take_while(|(a, b)| a == b).count()
}
