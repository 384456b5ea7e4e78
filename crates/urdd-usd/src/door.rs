//! The way to files and to memory, about which whoever has a stage read decides; and packages: zip archives whose entries are
//! stored as they are.

use std::io::{Cursor, Read};
use std::sync::Arc;

use urdd_directory::account::AccountError;
use zip::result::ZipError;
use zip::{CompressionMethod, ZipArchive};

use crate::error::Fault;

/// Gives out files, and keeps the account of what is made of them.
pub trait Door {
    /// The content of a file, by its path relative to the folder of the root layer: with `/`, without `.`, and with `..`
    /// at the start only.
    ///
    /// # Errors
    /// If there is none, or it must not be read: why.
    fn read(&mut self, path: &str) -> Result<Arc<[u8]>, String>;

    /// Charges bytes of memory that are about to be made, or steps of work that is about to be done.
    ///
    /// # Errors
    /// If that is too much. They are not made then, and it is not done.
    fn charge(&self, cost: usize) -> Result<(), AccountError>;
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

/// An entry of a package in memory, bytes: its name is in the package, too.
const ENTRY: usize = 300;

pub const PACKAGE_START: &[u8] = b"PK\x03\x04";

pub struct Package {
    archive: ZipArchive<Cursor<Arc<[u8]>>>,
    size: u64,
}

impl Package {
    /// Reads the list of entries.
    pub fn open(bytes: Arc<[u8]>, door: &dyn Door) -> Result<Self, Fault> {
        let size = bytes.len() as u64;
        let archive = ZipArchive::new(Cursor::new(bytes));
        let archive = archive.map_err(|why| Fault::Zip(why.to_string()))?;
        door.charge(ENTRY * archive.len())?;
        Ok(Package { archive, size })
    }

    /// The name of the first entry, which is the layer that all begins with.
    pub fn root(&mut self) -> Result<String, Fault> {
        let first = self.archive.by_index_raw(0).map_err(|why| Fault::Zip(why.to_string()))?;
        Ok(first.name().to_owned())
    }

    pub fn read(&mut self, name: &str, door: &dyn Door) -> Result<Arc<[u8]>, Fault> {
        let entry = self.archive.by_name(name).map_err(|why| match why {
            ZipError::FileNotFound => {
                Fault::File { asset: name.to_owned(), why: "it is not in the package".to_owned() }
            }
            why => Fault::Zip(format!("`{name}`: {why}")),
        })?;
        // Stored entries are not larger than the package, whatever they say.
        if entry.compression() != CompressionMethod::Stored || entry.size() > self.size {
            return Err(Fault::Zip(format!("`{name}` is compressed, or longer than the package")));
        }
        let size = entry.size();
        door.charge(size as usize)?;
        let mut bytes = Vec::new();
        let read = entry.take(size).read_to_end(&mut bytes);
        read.map_err(|why| Fault::Zip(format!("`{name}`: {why}")))?;
        Ok(bytes.into())
    }
}
