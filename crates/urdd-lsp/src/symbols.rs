//! The kinematic tree as an outline: joints below the links that they sit on, links below the joints that move them.

use lsp_types::{DocumentSymbol, DocumentSymbolResponse, SymbolInformation, SymbolKind};

use crate::document::{FileKind, Snapshot};
use crate::outline::Outline;

/// The deepest level. What is below is listed beside it: editors read nested data by recursion.
const DEEPEST: usize = 100;

/// The outline of a text. `is_nested` states whether the editor shows trees.
pub fn symbols(snapshot: &Snapshot, is_nested: bool) -> Option<DocumentSymbolResponse> {
    if !snapshot.kind.is_xml() || snapshot.is_too_large() {
        return None;
    }
    let (outline, mut found) = (snapshot.outline(), Vec::new());
    if matches!(snapshot.kind, FileKind::Xacro) {
        found = macros(snapshot);
    }
    let mut tree = Tree::new(snapshot, outline);
    found.extend(tree.all());
    if is_nested {
        return Some(DocumentSymbolResponse::Nested(found));
    }
    let mut flat = Vec::new();
    flatten(snapshot, found, None, &mut flat);
    Some(DocumentSymbolResponse::Flat(flat))
}

fn symbol(
    snapshot: &Snapshot,
    element: usize,
    name: &str,
    kind: SymbolKind,
    detail: &str,
) -> DocumentSymbol {
    let markup = snapshot.markup();
    let one = &markup.elements[element];
    let own_name = markup.attribute(snapshot.text.as_str(), element, "name");
    let selection = own_name.map_or(one.tag.clone(), |attribute| attribute.value.clone());
    // Editors refuse an empty name.
    let name = if name.trim().is_empty() { "?" } else { name };
    #[expect(deprecated, reason = "the type has a field that the protocol has replaced by `tags`")]
    DocumentSymbol {
        name: name.to_owned(),
        detail: (!detail.is_empty()).then(|| detail.to_owned()),
        kind,
        tags: None,
        deprecated: None,
        range: snapshot.text.range(one.tag.start..one.end.max(selection.end)),
        selection_range: snapshot.text.range(selection),
        children: None,
    }
}

/// Macros, properties, arguments and included files of a xacro file.
fn macros(snapshot: &Snapshot) -> Vec<DocumentSymbol> {
    let text = snapshot.text.as_str();
    let markup = snapshot.markup();
    let one = |element: usize| {
        let (attribute, kind) = match markup.name(text, element) {
            "xacro:macro" => ("name", SymbolKind::FUNCTION),
            "xacro:property" => ("name", SymbolKind::CONSTANT),
            "xacro:arg" => ("name", SymbolKind::VARIABLE),
            "xacro:include" => ("filename", SymbolKind::FILE),
            _ => return None,
        };
        let name = markup.value(text, element, attribute)?;
        let detail = markup.value(text, element, "params").unwrap_or_default();
        Some(symbol(snapshot, element, &name, kind, &detail))
    };
    (0..markup.elements.len()).filter_map(one).collect()
}

struct Tree<'s> {
    snapshot: &'s Snapshot,
    outline: &'s Outline,
    /// The joints that sit on each link.
    joints_on: Vec<Vec<usize>>,
    seen_links: Vec<bool>,
    seen_joints: Vec<bool>,
}

impl<'s> Tree<'s> {
    fn new(snapshot: &'s Snapshot, outline: &'s Outline) -> Self {
        let mut joints_on = vec![Vec::new(); outline.links.len()];
        for (index, joint) in outline.joints.iter().enumerate() {
            if let Some(link) = outline.link_index(&joint.parent) {
                joints_on[link].push(index);
            }
        }
        Tree {
            snapshot,
            outline,
            joints_on,
            seen_links: vec![false; outline.links.len()],
            seen_joints: vec![false; outline.joints.len()],
        }
    }

    /// The roots with what is below them, then what no root leads to: circles, joints without a link.
    fn all(&mut self) -> Vec<DocumentSymbol> {
        let children: std::collections::HashSet<&str> =
            self.outline.joints.iter().map(|joint| joint.child.as_str()).collect();
        let links = 0..self.outline.links.len();
        let is_root = |link: &usize| !children.contains(self.outline.links[*link].name.as_str());
        let roots: Vec<usize> = links.clone().filter(is_root).collect();
        let mut found = Vec::new();
        for link in roots.into_iter().chain(links) {
            // What is too deep is left, and begins anew here.
            found.extend(self.link(link, 0));
        }
        for joint in 0..self.outline.joints.len() {
            found.extend(self.joint(joint, 0));
        }
        found
    }

    fn link(&mut self, index: usize, depth: usize) -> Option<DocumentSymbol> {
        if depth > DEEPEST || std::mem::replace(&mut self.seen_links[index], true) {
            return None;
        }
        let link = &self.outline.links[index];
        let mut symbol = symbol(self.snapshot, link.element, &link.name, SymbolKind::OBJECT, "");
        let joints = std::mem::take(&mut self.joints_on[index]);
        let below = joints.into_iter().filter_map(|joint| self.joint(joint, depth + 1));
        symbol.children = Some(below.collect());
        Some(symbol)
    }

    fn joint(&mut self, index: usize, depth: usize) -> Option<DocumentSymbol> {
        if depth > DEEPEST || std::mem::replace(&mut self.seen_joints[index], true) {
            return None;
        }
        let joint = &self.outline.joints[index];
        let mut symbol =
            symbol(self.snapshot, joint.element, &joint.name, SymbolKind::METHOD, &joint.kind);
        let child = self.outline.link_index(&joint.child);
        let below = child.and_then(|child| self.link(child, depth + 1));
        symbol.children = Some(below.into_iter().collect());
        Some(symbol)
    }
}

/// The list for editors that show no trees.
fn flatten(
    snapshot: &Snapshot,
    symbols: Vec<DocumentSymbol>,
    container: Option<&str>,
    flat: &mut Vec<SymbolInformation>,
) {
    for symbol in symbols {
        #[expect(deprecated, reason = "as above")]
        flat.push(SymbolInformation {
            name: symbol.name.clone(),
            kind: symbol.kind,
            tags: None,
            deprecated: None,
            location: lsp_types::Location { uri: snapshot.uri.clone(), range: symbol.range },
            container_name: container.map(str::to_owned),
        });
        flatten(snapshot, symbol.children.unwrap_or_default(), Some(&symbol.name), flat);
    }
}
