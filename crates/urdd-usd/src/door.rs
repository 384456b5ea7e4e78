//! The way to files and to memory: whoever has a stage read decides about both.

use std::sync::Arc;

/// Gives out files, and keeps the account of what is made of them.
pub trait Door {
    /// The content of a file, by its path relative to the folder of the root layer: with `/`, without `.`, and with `..`
    /// at the start only.
    ///
    /// # Errors
    /// If there is none, or it must not be read: why.
    fn read(&mut self, path: &str) -> Result<Arc<[u8]>, String>;

    /// Charges bytes of memory that are about to be made.
    ///
    /// # Errors
    /// If that is too much: why. They are not made then.
    fn charge(&mut self, bytes: usize) -> Result<(), String>;
}

/// A path relative to that of a layer, normalised; absolute ones stay.
///
/// A file in a package is `PACKAGE.usdz[FILE]`; what it names is in the package.
pub fn beside(layer: &str, asset: &str) -> String {
    if let Some((package, inside)) = layer.strip_suffix(']').and_then(|path| path.split_once('[')) {
        return format!("{package}[{}]", beside(inside, asset));
    }
    let asset = asset.replace('\\', "/");
    let is_absolute = asset.starts_with('/') || asset.get(1..3) == Some(":/");
    let folder = layer.rsplit_once('/').map_or("", |(folder, _)| folder);
    let whole = if is_absolute { asset } else { format!("{folder}/{asset}") };
    let start =
        if whole.starts_with('/') && (is_absolute || layer.starts_with('/')) { "/" } else { "" };
    let mut parts: Vec<&str> = Vec::new();
    for part in whole.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    format!("{start}{}", parts.join("/"))
}

/// Whether a path of an asset names a protocol, such as `https://`.
pub fn is_remote(asset: &str) -> bool {
    asset.split_once("://").is_some_and(|(scheme, _)| {
        scheme.len() > 1
            && scheme.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"+-.".contains(&byte))
    })
}
