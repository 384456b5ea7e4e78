//! Internal to urdd; no stability promise.
//!
//! The language server for URDF and xacro files and for the documents of URDDs: `urdd lsp`. Editors start it and talk
//! to it over standard input and output, by the Language Server Protocol.
//!
//! One feature is one file. `server` receives messages and keeps the open documents; everything else computes
//! something from one version of one document (`document::Snapshot`), in threads of its own (`pool`), so that a
//! large mesh delays no key stroke. Names and places come from the text as it is, half typed or not (`markup`); poses
//! and meshes from the last version that described a robot (`document`).

// Hidden modules are public for `tests/`.
mod analysis;
mod capabilities;
mod code_actions;
mod completion;
mod definition;
mod diagnostics;
mod document;
mod hover;
mod kept;
mod kind;
#[doc(hidden)]
pub mod markup;
#[doc(hidden)]
pub mod options;
mod outline;
mod pool;
mod project;
mod reference;
mod server;
mod shown;
mod symbols;
#[doc(hidden)]
pub mod text;
mod transport;
mod urdd_documents;
#[doc(hidden)]
pub mod uri;
mod xacro;

pub use document::MAX_TEXT_BYTES;
pub use server::Ended;
pub use transport::MAX_MESSAGE_BYTES;

use std::io;

use lsp_server::Connection;

/// Serves one editor on standard input and output, until it ends or asks to.
///
/// # Errors
/// If a message cannot be read or written.
pub fn serve_stdio() -> io::Result<Ended> {
    let (connection, threads) = transport::stdio()?;
    let ended = serve(connection);
    // The reader waits for an editor that is gone.
    if ended != Ended::ParentGone {
        for thread in threads {
            let crashed = |_| Err(io::Error::other("a thread of the connection crashed"));
            thread.join().unwrap_or_else(crashed)?;
        }
    }
    Ok(ended)
}

/// Serves one editor on a connection, until it ends or asks to.
pub fn serve(connection: Connection) -> Ended {
    server::run(connection)
}
