//! Why a zip archive cannot be used as a URDD.

use thiserror::Error;

/// Why a zip archive cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ArchiveFault {
    /// Not a zip archive, or damaged.
    #[error("it is not a complete zip archive ({reason}); pack the URDD again")]
    Broken {
        /// What is wrong.
        reason: String,
    },
    /// An archive with more than 65,535 entries or 4 GiB.
    #[error(
        "it is a zip64 archive, of more than 65,535 entries or 4 GiB; unpack it, and give the folder"
    )]
    Zip64,
    /// The number of entries differs from the stated one.
    #[error("it states {stated} entries, but lists {listed}; pack the URDD again")]
    Count {
        /// Stated number of entries.
        stated: usize,
        /// Number of listed entries.
        listed: usize,
    },
    /// Bytes that belong to no entry or to two: other programs may extract different files.
    #[error(
        "it contains bytes that belong to no entry or to two entries, as if two archives were in one file; pack the URDD again"
    )]
    OtherBytes,
    /// The archive inflates to more than the limit.
    #[error(
        "its files have {size} bytes in total; the limit for an archive of its size is {limit}; unpack it, and give the folder"
    )]
    Inflates {
        /// Inflated size by the archive's own statement, bytes.
        size: u64,
        /// The limit, bytes.
        limit: u64,
    },
    /// An entry cannot be used.
    #[error("its entry `{}` {fault}", start(name).escape_debug())]
    Entry {
        /// The entry's name.
        name: String,
        /// What is wrong with it.
        fault: EntryFault,
    },
    /// The archive does not contain a URDD.
    #[error(
        "it contains no URDD: neither its root nor a top-level folder contains urdd.json or a module folder such as urdf_module"
    )]
    NoUrdd,
    /// The archive contains several URDDs.
    #[error(
        "it contains several URDDs ({} and {}); unpack it, and give the folder, or pack each one separately",
        first.escape_debug(), second.escape_debug()
    )]
    ManyUrdds {
        /// A folder with a URDD.
        first: String,
        /// Another folder with a URDD.
        second: String,
    },
}

/// The first 200 characters of a name: it may have 65,535 bytes.
fn start(name: &str) -> &str {
    const LONGEST: usize = 200;
    let end = name.char_indices().nth(LONGEST).map_or(name.len(), |(at, _)| at);
    &name[..end]
}

/// Why an entry of a zip archive cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum EntryFault {
    /// A name that leads out of the archive, or is not a relative path.
    #[error("has a name that is not a path inside the archive")]
    Path,
    /// A name longer than file systems allow.
    #[error(
        "has a name of {length} bytes; the limit is {limit}, and {part} between two slashes; rename it"
    )]
    LongName {
        /// Its length, bytes.
        length: usize,
        /// The limit, bytes.
        limit: usize,
        /// The limit of each part of the path, bytes.
        part: usize,
    },
    /// The central directory disagrees with the entry's local header.
    #[error(
        "is described differently in its own header and in the archive's list; pack the URDD again"
    )]
    Header,
    /// Two entries have the same name, or a file has the name of a folder.
    #[error("occurs twice")]
    Duplicate,
    /// Encrypted.
    #[error("is encrypted; pack the URDD without a password")]
    Encrypted,
    /// Unsupported compression method.
    #[error("is compressed by method {method} of zip; pack the URDD with deflate")]
    Method {
        /// Its number in the zip format.
        method: u16,
    },
    /// Larger than the limit.
    #[error("is {size} bytes long; the limit is {limit}")]
    TooLarge {
        /// Its size, bytes.
        size: u64,
        /// The limit, bytes.
        limit: u64,
    },
    /// The data does not match the archive's statement.
    #[error("is damaged ({reason}); pack the URDD again")]
    Damaged {
        /// What is wrong.
        reason: String,
    },
}
