//! The open connections. The oldest give way to newer ones: those without the token, so that idle connections of other
//! programs cannot lock out the page; and those with it only to others with it.

use std::io;
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;

use parking_lot::Mutex;

/// Maximum number of simultaneous connections, and of those that have sent the token. The difference is left for new
/// ones.
const MAX_CONNECTIONS: usize = 32;
const MAX_KNOWN: usize = 24;

/// All connections, oldest first.
#[derive(Debug, Default)]
pub struct Connections(Mutex<State>);

#[derive(Debug, Default)]
struct State {
    open: Vec<Open>,
    next: u64,
}

#[derive(Debug)]
struct Open {
    number: u64,
    stream: TcpStream,
    /// Whether it has sent the token.
    is_known: bool,
}

impl State {
    /// Closes the oldest connection that has, or has not, sent the token.
    fn close_oldest(&mut self, is_known: bool) {
        if let Some(oldest) = self.open.iter().position(|open| open.is_known == is_known) {
            let _ = self.open.remove(oldest).stream.shutdown(Shutdown::Both);
        }
    }
}

/// A connection. It holds its slot until it is dropped, even by a panic.
#[derive(Debug)]
pub struct Connection {
    number: u64,
    all: Arc<Connections>,
}

impl Connection {
    /// Takes a slot. If none is free, closes the oldest connection without the token.
    pub fn begin(stream: &TcpStream, all: &Arc<Connections>) -> io::Result<Self> {
        let stream = stream.try_clone()?;
        let mut state = all.0.lock();
        if state.open.len() >= MAX_CONNECTIONS {
            state.close_oldest(false);
        }
        let number = state.next;
        state.next += 1;
        state.open.push(Open { number, stream, is_known: false });
        Ok(Connection { number, all: Arc::clone(all) })
    }

    /// Marks the connection as having sent the token. If too many have, closes the oldest of them.
    pub fn keep(&self) {
        let mut state = self.all.0.lock();
        if state.open.iter().filter(|open| open.is_known).count() >= MAX_KNOWN {
            state.close_oldest(true);
        }
        if let Some(own) = state.open.iter_mut().find(|open| open.number == self.number) {
            own.is_known = true;
        }
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        self.all.0.lock().open.retain(|open| open.number != self.number);
    }
}
