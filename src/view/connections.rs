//! The connections that are open. Who does not know the token gives way to who comes later, so that nobody can keep the
//! page out by opening connections and saying nothing.

use std::io;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Most connections at once.
const MAX_CONNECTIONS: usize = 32;

/// All connections, the oldest first.
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
    /// Whether it showed the token.
    is_known: bool,
}

impl Connections {
    /// Whether another one may come: there is a place, or one that is not known has one.
    pub fn has_room(&self) -> bool {
        let state = self.state();
        state.open.len() < MAX_CONNECTIONS || state.open.iter().any(|open| !open.is_known)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A connection, which has a place until it is dropped, by a panic too.
#[derive(Debug)]
pub struct Connection {
    number: u64,
    all: Arc<Connections>,
}

impl Connection {
    /// Takes a place. Where there is none, the oldest connection that is not known ends.
    ///
    /// # Errors
    /// Where the stream cannot be shared.
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
        state.open.push(Open {
            number,
            stream,
            is_known: false,
        });
        let all = Arc::clone(all);
        Ok(Connection { number, all })
    }

    /// It showed the token: it keeps its place.
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
