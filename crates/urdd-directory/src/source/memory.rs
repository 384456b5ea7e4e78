//! Files that are not on the disk: a tree of folders, files and links, and files in memory, complete or while they are
//! added.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::io::{self, Cursor};
use std::ops::Bound;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::{OpenFile, Source};
use crate::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use crate::listing::{Entry, EntryKind, Listing, ReadError};
use crate::path::{self, PathFault};

/// Maximum number of symbolic links followed for one path, as on Linux.
const MAX_LINKS: usize = 40;

/// The node at a path.
#[doc(hidden)]
#[derive(Debug)]
pub enum Node<T> {
    Folder,
    File { size: u64, data: T },
    Link(String),
    Other,
}

/// A path and its node.
#[doc(hidden)]
#[derive(Debug)]
pub struct Item<T> {
    pub path: String,
    pub utf8: bool,
    pub node: Node<T>,
}

/// All nodes below a root. Stores each path once: the folders above it are implied.
#[doc(hidden)]
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

/// Gives the bytes of a file that is in memory by its size alone; `None` if they are not there yet.
pub type Lend = fn(&str) -> io::Result<Option<Arc<[u8]>>>;

/// The size and the bytes of each file, by path relative to the root, with forward slashes.
type Files = BTreeMap<String, (u64, Option<Arc<[u8]>>)>;

/// Files in memory, to which others may be added. Copies share them.
#[derive(Debug, Clone)]
pub struct Memory {
    name: String,
    files: Arc<Mutex<Files>>,
    lend: Lend,
}

impl Default for Memory {
    fn default() -> Self {
        Memory::empty("", |_| Ok(None))
    }
}

impl Memory {
    /// A URDD from files by path. `name` names the root folder.
    ///
    /// # Errors
    /// The first path that SPEC 2.8 forbids, or that is both a file and a folder.
    pub fn new(
        name: &str,
        files: BTreeMap<String, Arc<[u8]>>,
    ) -> Result<Self, (String, PathFault)> {
        let mut all = Files::new();
        for (path, bytes) in files {
            path::check(&path).map_err(|fault| (path.clone(), fault))?;
            all.insert(path, (bytes.len() as u64, Some(bytes)));
        }
        if let Some(path) = all.keys().find_map(|path| first_below(&all, path)) {
            return Err((path.clone(), PathFault::Taken));
        }
        let memory = Memory::empty(name, |_| Ok(None));
        *memory.now() = all;
        Ok(memory)
    }

    /// A root folder of this name without files. `lend` gives the bytes of those that are only named.
    pub fn empty(name: &str, lend: Lend) -> Self {
        Memory { name: name.to_owned(), files: Arc::default(), lend }
    }

    /// Adds a file by its size. One that is there stays.
    pub fn name(&self, path: &str, size: u64) {
        self.now().entry(path.to_owned()).or_insert((size, None));
    }

    /// Adds the bytes of a file. One that has bytes keeps them; one of another size than was named cannot be read.
    pub fn give(&self, path: &str, bytes: &[u8]) {
        let mut files = self.now();
        let (_, content) = files.entry(path.to_owned()).or_insert((bytes.len() as u64, None));
        content.get_or_insert_with(|| bytes.into());
    }

    /// Adds a file, or replaces it.
    pub fn put(&self, path: &str, bytes: impl Into<Arc<[u8]>>) {
        let bytes = bytes.into();
        self.now().insert(path.to_owned(), (bytes.len() as u64, Some(bytes)));
    }

    /// The files with bytes so far.
    pub fn files(&self) -> BTreeMap<String, Arc<[u8]>> {
        let files = self.now();
        let with_bytes =
            files.iter().filter_map(|(path, (_, bytes))| Some((path, bytes.as_ref()?)));
        with_bytes.map(|(path, bytes)| (path.clone(), Arc::clone(bytes))).collect()
    }

    fn now(&self) -> MutexGuard<'_, Files> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Source for Memory {
    fn folder_name(&self) -> String {
        self.name.clone()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        let files = self.now();
        // A name that is a folder too is listed as that.
        let all = files.iter().filter(|(path, _)| first_below(&files, path).is_none());
        let item = |(path, (size, _)): (&String, &(u64, _))| Item {
            path: path.clone(),
            utf8: true,
            node: Node::File { size: *size, data: () },
        };
        Ok(Tree::new(all.map(item).collect()).map_err(|_| PathFault::Taken)?.listing())
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        let found = self.now().get(path).cloned();
        let Some((size, bytes)) = found else {
            return Err(match first_below(&self.now(), path) {
                Some(_) => ReadError::NotAFile,
                None => ReadError::Missing,
            });
        };
        // Nothing is locked while somebody else is asked.
        let bytes = bytes.map_or_else(|| (self.lend)(path), |bytes| Ok(Some(bytes)))?;
        match bytes {
            Some(bytes) if bytes.len() as u64 == size => Ok((Box::new(Cursor::new(bytes)), size)),
            Some(_) => Err(ReadError::Changed),
            None => Err(ReadError::Io("its bytes are not there yet".to_owned())),
        }
    }
}

/// The first file in a folder, at any depth.
fn first_below<'a>(files: &'a Files, folder: &str) -> Option<&'a String> {
    let below = format!("{folder}/");
    let mut after = files.range::<str, _>((Bound::Excluded(&*below), Bound::Unbounded));
    after.next().map(|(file, _)| file).filter(|file| file.starts_with(&below))
}
