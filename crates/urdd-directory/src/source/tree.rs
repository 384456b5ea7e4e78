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
            if listing.entries.len() >= MAX_FILES {
                listing.cut |= listing.entries.len() > MAX_FILES;
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

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(paths: &[&str]) -> Result<Tree<()>, String> {
        let item = |path: &&str| {
            let node = match path.strip_suffix('/') {
                Some(_) => Node::Folder,
                None => Node::File { size: 1, data: () },
            };
            let path = path.trim_end_matches('/').to_owned();
            let utf8 = true;
            Item { path, utf8, node }
        };
        Tree::new(paths.iter().map(item).collect())
    }

    #[test]
    fn folders_follow_from_paths() {
        let tree = tree(&["a/b/c", "a.b", "a/b.c", "a-/x", "d/", "d/"]).expect("a tree");
        let listing = tree.listing();
        let paths: Vec<&str> = listing.entries.iter().map(|entry| &*entry.path).collect();
        let expected = ["a", "a-", "a-/x", "a.b", "a/b", "a/b.c", "a/b/c", "d"];
        assert_eq!(paths, expected);
        for path in ["a", "a-", "a/b", "d"] {
            assert!(listing.has_folder(path), "{path}");
            assert_eq!(tree.file(path), Err(ReadError::NotAFile));
        }
        for path in ["a.b", "a/b.c", "a/b/c", "a-/x"] {
            assert!(listing.has_file(path), "{path}");
            assert!(tree.file(path).is_ok(), "{path}");
        }
        for path in ["b", "a/c", "a/b/c/d", "a/b/", "a/b/cc"] {
            assert!(tree.file(path).is_err(), "{path}");
        }
    }

    #[test]
    fn a_path_has_one_meaning() {
        for (paths, clash) in [
            (&["a", "a"][..], "a"),
            (&["a", "a.b", "a/b"], "a/b"),
            (&["a", "a/"], "a"),
            (&["x/a/b/c", "x/a"], "x/a/b/c"),
        ] {
            assert_eq!(tree(paths).err().as_deref(), Some(clash), "{paths:?}");
        }
        assert!(tree(&["a/", "a/b", "a.b", "ab"]).is_ok());
    }

    #[test]
    fn levels_beyond_the_limit_are_not_listed() {
        let deep = vec!["d"; 40].join("/");
        let listing = tree(&["d/x", &deep]).expect("a tree").listing();
        assert!(listing.cut);
        let folders = listing.entries.iter().filter(|e| e.path.ends_with('d'));
        assert_eq!(folders.count(), MAX_FOLDER_DEPTH);
        assert!(tree(&[&deep]).expect("a tree").file(&deep).is_ok());
    }
}
