//! The paths of a crate file: a tree, of which each node has its parent.

use std::sync::Arc;

use super::super::error::{Fault, Place, Wrong};
use super::super::layer::MAX_LEVELS;
use super::super::value::Name;
use super::cursor::Cursor;
use super::path_tree::PathNode;
use super::sections::Crate;

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
        let mut parts = Vec::new();
        let mut next = Some(index);
        while let Some(at) = next {
            // An empty path: a reference to the default prim has one.
            let Some(node) = self.paths.node(at) else { return Ok(Arc::from("")) };
            parts.push(node);
            next = node.parent;
        }
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
        self.charge(cursor, text.len() + 16)?;
        let text: Name = Arc::from(text);
        self.paths.texts[at] = Some(text.clone());
        Ok(text)
    }
}
