//! The sections of a crate file, but that of specs.

use std::collections::HashMap;
use std::sync::Arc;

use super::cursor::{Cursor, integers, unpacked};
use crate::door::Door;
use crate::error::{Fault, Place, Wrong};
use crate::layer::{MAX_LEVELS, Name, Value};

/// The first bytes of a crate file.
pub const START: &[u8] = b"PXR-USDC";

/// The oldest version, whose sections are packed as they are today.
const OLDEST: u8 = 4;
/// The newest version: what it adds are types of values, and these are told by their numbers.
const NEWEST: u8 = 13;
/// Bytes of the entry of a section: 16 of its name, where it begins, its size.
const SECTION: usize = 32;

pub struct Crate<'b> {
    pub bytes: &'b [u8],
    pub door: &'b mut dyn Door,
    /// The second number of the version.
    pub version: u8,
    pub tokens: Vec<Name>,
    /// Tokens by the numbers of strings.
    strings: Vec<u32>,
    /// Tokens, and where the value is.
    pub fields: Vec<(u32, u64)>,
    pub field_sets: Vec<u32>,
    pub paths: Paths,
    /// The values that were read, by where they are.
    pub known: HashMap<u64, Value>,
    sections: HashMap<&'b [u8], usize>,
}

impl<'b> Crate<'b> {
    /// Reads all but paths and specs.
    pub fn open(bytes: &'b [u8], door: &'b mut dyn Door) -> Result<Self, Wrong> {
        let mut cursor = Cursor::new(bytes, 0);
        if cursor.take(START.len())? != START {
            return Err((Place::Byte(0), Fault::Kind));
        }
        let version = cursor.take(8)?;
        let (major, minor) = (version[0], version[1]);
        if major != 0 || !(OLDEST..=NEWEST).contains(&minor) {
            return Err((Place::Byte(8), Fault::Version(major, minor)));
        }
        let start =
            usize::try_from(cursor.i64()?).map_err(|_| cursor.damaged("no table of contents"))?;
        let mut cursor = Cursor::new(bytes, start);
        let count = cursor.count(SECTION)?;
        let mut sections = HashMap::new();
        for _ in 0..count {
            let name = cursor.take(16)?;
            let name = name.split(|byte| *byte == 0).next().unwrap_or(name);
            let start = usize::try_from(cursor.i64()?).map_err(|_| cursor.damaged("a section"))?;
            cursor.i64()?;
            sections.insert(name, start);
        }
        let mut file = Crate {
            bytes,
            door,
            version: minor,
            tokens: Vec::new(),
            strings: Vec::new(),
            fields: Vec::new(),
            field_sets: Vec::new(),
            paths: Paths::default(),
            known: HashMap::new(),
            sections,
        };
        file.read_tokens()?;
        file.read_strings()?;
        file.read_fields()?;
        let mut cursor = file.section(b"FIELDSETS")?;
        let count = file.entries(&mut cursor)?;
        let sets = file.integers(&mut cursor, count, false)?;
        file.field_sets = sets.into_iter().map(|index| index as u32).collect();
        Ok(file)
    }

    pub fn charge(&self, cursor: &Cursor<'_>, bytes: usize) -> Result<(), Wrong> {
        let charged = self.door.charge(bytes);
        charged.map_err(|why| (Place::Byte(cursor.at as u64), why.into()))
    }

    pub fn section(&self, name: &[u8]) -> Result<Cursor<'b>, Wrong> {
        match self.sections.get(name) {
            Some(start) => Ok(Cursor::new(self.bytes, *start)),
            None => Err((Place::Layer, Fault::Damaged("a section is missing"))),
        }
    }

    /// A number of packed entries, which may be more than the bytes of the file.
    pub fn entries(&mut self, cursor: &mut Cursor<'_>) -> Result<usize, Wrong> {
        let before = *cursor;
        let count = usize::try_from(cursor.u64()?);
        count.map_err(|_| before.damaged("a count is larger than the file"))
    }

    /// A list of integers, packed.
    pub fn integers(
        &mut self,
        cursor: &mut Cursor<'_>,
        count: usize,
        is_long: bool,
    ) -> Result<Vec<i64>, Wrong> {
        // What is unpacked, and the list.
        self.charge(cursor, count.saturating_mul(17))?;
        integers(cursor, count, is_long)
    }

    fn read_tokens(&mut self) -> Result<(), Wrong> {
        let mut cursor = self.section(b"TOKENS")?;
        let count = self.entries(&mut cursor)?;
        let size = self.entries(&mut cursor)?;
        let packed = cursor.count(1)?;
        self.charge(&cursor, size.saturating_mul(2).saturating_add(count.saturating_mul(40)))?;
        let at = cursor;
        let text = unpacked(&mut cursor, packed, size)?;
        let mut parts = text.split(|byte| *byte == 0);
        let few = || at.damaged("there are fewer tokens than it says");
        if count > text.len() {
            return Err(few());
        }
        for _ in 0..count {
            let part = parts.next().ok_or_else(few)?;
            let part = std::str::from_utf8(part);
            let part = part.map_err(|_| (Place::Byte(at.at as u64), Fault::Encoding))?;
            self.tokens.push(Arc::from(part));
        }
        Ok(())
    }

    fn read_strings(&mut self) -> Result<(), Wrong> {
        let mut cursor = self.section(b"STRINGS")?;
        let count = cursor.count(4)?;
        self.charge(&cursor, 4 * count)?;
        for _ in 0..count {
            self.strings.push(cursor.u32()?);
        }
        Ok(())
    }

    fn read_fields(&mut self) -> Result<(), Wrong> {
        let mut cursor = self.section(b"FIELDS")?;
        let count = self.entries(&mut cursor)?;
        let names = self.integers(&mut cursor, count, false)?;
        let packed = cursor.count(1)?;
        let size = count.saturating_mul(8);
        self.charge(&cursor, size.saturating_mul(3))?;
        let at = cursor;
        let places = unpacked(&mut cursor, packed, size)?;
        if places.len() != size {
            return Err(at.damaged("there are fewer values than fields"));
        }
        let mut places = Cursor::new(&places, 0);
        for name in names {
            self.fields.push((name as u32, places.u64()?));
        }
        Ok(())
    }

    pub fn token(&self, cursor: &Cursor<'_>, index: u32) -> Result<Name, Wrong> {
        let token = self.tokens.get(index as usize);
        token.cloned().ok_or_else(|| cursor.damaged("a token is missing"))
    }

    pub fn string(&self, cursor: &Cursor<'_>, index: u32) -> Result<Name, Wrong> {
        let token = self.strings.get(index as usize);
        self.token(cursor, *token.ok_or_else(|| cursor.damaged("a string is missing"))?)
    }
}

#[derive(Debug, Clone)]
pub struct PathNode {
    /// The path that it is inside of.
    pub parent: Option<u32>,
    pub name: Name,
    pub is_property: bool,
    pub level: u32,
}

/// All paths, by their numbers.
#[derive(Debug, Default)]
pub struct Paths {
    pub nodes: Vec<Option<PathNode>>,
    /// Texts that were made.
    pub texts: Vec<Option<Name>>,
}

impl Paths {
    /// The path of a number.
    pub fn node(&self, index: u32) -> Option<&PathNode> {
        self.nodes.get(index as usize)?.as_ref()
    }
}

/// Bytes of a path in memory, about: of the tables, and of what is read for them.
const PATH: usize = 100;

impl Crate<'_> {
    pub fn read_paths(&mut self) -> Result<(), Wrong> {
        let mut cursor = self.section(b"PATHS")?;
        let all = self.entries(&mut cursor)?;
        let count = self.entries(&mut cursor)?;
        if all < count {
            return Err(cursor.damaged("there are more paths than it says"));
        }
        self.charge(&cursor, all.saturating_mul(PATH))?;
        let indices = self.integers(&mut cursor, count, false)?;
        let names = self.integers(&mut cursor, count, false)?;
        let jumps = self.integers(&mut cursor, count, false)?;
        // More than are encoded are empty.
        if all > 2 * count + 64 {
            return Err(cursor.damaged("most paths are missing"));
        }
        self.paths.nodes = vec![None; all];
        self.paths.texts = vec![None; all];
        let mut is_seen = vec![false; count];
        let mut open = if count > 0 { vec![(0, None)] } else { Vec::new() };
        while let Some((at, parent)) = open.pop() {
            if is_seen.get(at) != Some(&false) {
                return Err(cursor.damaged("paths are no tree"));
            }
            is_seen[at] = true;
            let node = self.path(&cursor, parent, names[at])?;
            let index = indices[at] as u32;
            match self.paths.nodes.get_mut(index as usize) {
                Some(free @ None) => *free = Some(node),
                _ => return Err(cursor.damaged("a path is there twice, or out of range")),
            }
            let jump = jumps[at];
            let (has_child, has_sibling) = (jump > 0 || jump == -1, jump >= 0);
            // The root has no siblings.
            let above = if parent.is_none() { Some(index) } else { parent };
            if has_sibling {
                open.push((at + if has_child { jump as usize } else { 1 }, above));
            }
            if has_child {
                open.push((at + 1, Some(index)));
            }
        }
        Ok(())
    }

    fn path(&self, cursor: &Cursor<'_>, parent: Option<u32>, name: i64) -> Result<PathNode, Wrong> {
        let Some(parent) = parent else {
            return Ok(PathNode { parent, name: Arc::from(""), is_property: false, level: 0 });
        };
        let level = self.paths.node(parent).map_or(0, |above| above.level) + 1;
        // Properties and variants are levels, too.
        if level as usize > MAX_LEVELS + 2 {
            return Err((Place::Layer, Fault::Deep(MAX_LEVELS)));
        }
        let token = self.token(cursor, name.unsigned_abs() as u32)?;
        Ok(PathNode { parent: Some(parent), name: token, is_property: name < 0, level })
    }

    /// The text of a path, without variants.
    pub fn path_text(&mut self, cursor: &Cursor<'_>, index: u32) -> Result<Name, Wrong> {
        let at = index as usize;
        let known = self.paths.texts.get(at);
        if let Some(Some(text)) = known {
            return Ok(text.clone());
        }
        let (mut parts, mut length) = (Vec::new(), PATH);
        let mut next = Some(index);
        while let Some(at) = next {
            // An empty path: a reference to the default prim has one.
            let Some(node) = self.paths.node(at) else { return Ok(Arc::from("")) };
            length += 1 + node.name.len();
            parts.push(node);
            next = node.parent;
        }
        self.charge(cursor, length)?;
        let mut text = String::new();
        for node in parts.iter().rev().skip(1) {
            let mark = match node.is_property {
                _ if node.name.starts_with('{') => continue,
                _ if node.name.starts_with('[') => "",
                true => ".",
                false => "/",
            };
            text.push_str(mark);
            text.push_str(&node.name);
        }
        if text.is_empty() {
            text.push('/');
        }
        let text: Name = Arc::from(text);
        self.paths.texts[at] = Some(text.clone());
        Ok(text)
    }
}
