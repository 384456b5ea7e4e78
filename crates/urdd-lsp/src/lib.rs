//! Internal to urdd; no stability promise.
//!
//! The language server for URDF and xacro files and for the documents of URDDs: `urdd lsp`. Editors start it and talk
//! to it over standard input and output, by the Language Server Protocol.
//!
//! One feature is one file. `server` receives messages and keeps the open documents; everything else computes
//! something from one version of one document (`document::Snapshot`), in threads of its own, so that a large mesh delays
//! no key stroke. Names and places come from the text as it is, half typed or not (`markup`); poses and meshes from the
//! last version that described a robot (`document`).

// Hidden modules are public for `tests/`.
mod analysis;
mod completion;
mod diagnostics;
mod document;
mod hover;
#[doc(hidden)]
pub mod markup;
#[doc(hidden)]
pub mod options;
mod outline;
mod project;
mod reference;
mod server;
mod symbols;
#[doc(hidden)]
pub mod text;
mod urdd_documents;
#[doc(hidden)]
pub mod uri;
mod xacro;

pub use document::MAX_TEXT_BYTES;
pub use server::run as serve;
pub use server::state::Ended;

use std::io::{self, BufRead, Read, stdin, stdout};
use std::thread::{self, JoinHandle};

use crossbeam_channel::bounded;
use lsp_server::{Connection, Message};

/// Serves one editor on standard input and output, until it ends or asks to.
///
/// # Errors
/// If a message cannot be read or written.
pub fn serve_stdio() -> io::Result<Ended> {
    let (connection, threads) = stdio()?;
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

/// Maximum size of a message, bytes: that of a text of 64 MiB, with its quotes and line ends escaped.
pub const MAX_MESSAGE_BYTES: u64 = 128 << 20;
/// Maximum size of a header, bytes.
const MAX_HEADER_BYTES: u64 = 4096;

/// A connection over standard input and output, and its threads: the first reads, the second writes. lsp-server allocates as
/// many bytes as a header states: headers are read here first.
///
/// # Errors
/// If a thread cannot be started.
fn stdio() -> io::Result<(Connection, [JoinHandle<io::Result<()>>; 2])> {
    let (sender, answers) = bounded::<Message>(0);
    let (messages, receiver) = bounded(0);
    let read = move || {
        let mut input = stdin().lock();
        while let Some(message) = read_message(&mut input)? {
            let is_exit = matches!(&message, Message::Notification(one) if one.method == "exit");
            // The server has ended.
            if messages.send(message).is_err() || is_exit {
                break;
            }
        }
        Ok(())
    };
    let write = move || {
        let mut output = stdout().lock();
        answers.into_iter().try_for_each(|answer| answer.write(&mut output))
    };
    let start = |name: &str| thread::Builder::new().name(name.to_owned());
    let threads = [start("urdd reader").spawn(read)?, start("urdd writer").spawn(write)?];
    Ok((Connection { sender, receiver }, threads))
}

/// The next message; `None` at the end of the input.
fn read_message(input: &mut impl BufRead) -> io::Result<Option<Message>> {
    let mut header = Vec::new();
    let mut size = 0;
    while !header.ends_with(b"\r\n\r\n") {
        let start = header.len();
        let left = MAX_HEADER_BYTES - start as u64;
        if input.by_ref().take(left).read_until(b'\n', &mut header)? == 0 {
            return match left {
                0 => Err(invalid(format!("a header has more than {MAX_HEADER_BYTES} bytes"))),
                _ => Ok(None),
            };
        }
        let line = String::from_utf8_lossy(&header[start..]);
        if let Some((name, value)) = line.split_once(':')
            && name.eq_ignore_ascii_case("Content-Length")
        {
            let value = value.trim();
            let stated = value.parse().ok().filter(|size| *size <= MAX_MESSAGE_BYTES);
            let refused = || {
                invalid(format!("a message of {value} bytes; at most {MAX_MESSAGE_BYTES} are read"))
            };
            size = stated.ok_or_else(refused)?;
        }
    }
    Message::read(&mut header.as_slice().chain(input.take(size)))
}

fn invalid(words: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, words)
}
