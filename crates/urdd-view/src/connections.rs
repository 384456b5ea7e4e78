//! The open connections. Connections without the token give way to newer ones, so that idle connections of other
//! programs cannot lock out the page.

use std::io;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Maximum number of simultaneous connections.
const MAX_CONNECTIONS: usize = 32;

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

impl Connections {
    /// Whether another connection can be accepted: a slot is free, or a connection without the token holds one.
    pub fn has_room(&self) -> bool {
        let state = self.state();
        state.open.len() < MAX_CONNECTIONS || state.open.iter().any(|open| !open.is_known)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
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
    ///
    /// # Errors
    /// If the stream cannot be cloned.
    pub fn begin(stream: &TcpStream, all: &Arc<Connections>) -> io::Result<Self> {
        let stream = stream.try_clone()?;
        let mut state = all.state();
        if state.open.len() >= MAX_CONNECTIONS
            && let Some(oldest) = state.open.iter().position(|open| !open.is_known)
        {
            let gone = state.open.remove(oldest);
            let _ = gone.stream.shutdown(Shutdown::Both);
        }
        let number = state.next;
        state.next += 1;
        state.open.push(Open { number, stream, is_known: false });
        let all = Arc::clone(all);
        Ok(Connection { number, all })
    }

    /// Marks the connection as having sent the token, so that it keeps its slot.
    pub fn keep(&self) {
        let mut state = self.all.state();
        let mut open = state.open.iter_mut();
        if let Some(own) = open.find(|open| open.number == self.number) {
            own.is_known = true;
        }
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        let mut state = self.all.state();
        state.open.retain(|open| open.number != self.number);
    }
}
