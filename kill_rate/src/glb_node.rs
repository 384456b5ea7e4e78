//! Mutations of a node's transform in a .glb file.

use serde_json::{Value, json};

/// A change of the first node with a mesh.
#[derive(Debug, Clone, Copy)]
pub(crate) enum NodeChange {
    /// Translation along x, m.
    Moved(f64),
    /// Rotation about x by 90°.
    Turned,
    /// Scaled.
    Larger(f64),
}

/// Lengths of the file header and of a chunk header, bytes.
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

/// The file with another transform of its first node with a mesh. `None` if the file does not begin like a .glb file.
pub(crate) fn changed(glb: &[u8], change: NodeChange) -> Option<Vec<u8>> {
    let length = glb.get(HEADER..HEADER + 4)?.try_into().ok()?;
    let start = HEADER + CHUNK_HEADER;
    let end = start.checked_add(usize::try_from(u32::from_le_bytes(length)).ok()?)?;
    let mut document: Value = serde_json::from_slice(glb.get(start..end)?).ok()?;
    let nodes = document.get_mut("nodes")?.as_array_mut()?;
    let node = nodes.iter_mut().find(|node| node.get("mesh").is_some())?;
    let (key, value) = match change {
        NodeChange::Moved(by) => ("translation", json!([by, 0.0, 0.0])),
        NodeChange::Turned => {
            let half = std::f64::consts::FRAC_1_SQRT_2;
            ("rotation", json!([half, 0.0, 0.0, half]))
        }
        NodeChange::Larger(factor) => ("scale", json!([factor, factor, factor])),
    };
    node[key] = value;
    let mut text = serde_json::to_vec(&document).ok()?;
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut out = glb[..HEADER].to_vec();
    out.extend(u32::try_from(text.len()).ok()?.to_le_bytes());
    out.extend(&glb[HEADER + 4..start]);
    out.extend(text);
    out.extend(&glb[end..]);
    let whole = u32::try_from(out.len()).ok()?.to_le_bytes();
    out[8..HEADER].copy_from_slice(&whole);
    Some(out)
}
