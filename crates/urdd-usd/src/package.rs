//! Packages: zip archives whose entries are stored as they are.

use std::io::{Cursor, Read};
use std::sync::Arc;

use zip::result::ZipError;
use zip::{CompressionMethod, ZipArchive};

use super::door::Door;
use super::error::Fault;

/// The first bytes of a package.
pub const START: &[u8] = b"PK\x03\x04";

/// A package.
pub struct Package {
    archive: ZipArchive<Cursor<Arc<[u8]>>>,
    size: u64,
}

impl Package {
    /// Reads the list of entries.
    pub fn open(bytes: Arc<[u8]>) -> Result<Self, Fault> {
        let size = bytes.len() as u64;
        let archive = ZipArchive::new(Cursor::new(bytes));
        archive.map(|archive| Package { archive, size }).map_err(|why| Fault::Zip(why.to_string()))
    }

    /// The name of the first entry, which is the layer that all begins with.
    pub fn root(&mut self) -> Result<String, Fault> {
        let first = self.archive.by_index_raw(0).map_err(|why| Fault::Zip(why.to_string()))?;
        Ok(first.name().to_owned())
    }

    /// The content of an entry.
    pub fn read(&mut self, name: &str, door: &mut dyn Door) -> Result<Arc<[u8]>, Fault> {
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
        door.charge(size as usize).map_err(Fault::TooMuch)?;
        let mut bytes = Vec::new();
        let read = entry.take(size).read_to_end(&mut bytes);
        read.map_err(|why| Fault::Zip(format!("`{name}`: {why}")))?;
        Ok(bytes.into())
    }
}
