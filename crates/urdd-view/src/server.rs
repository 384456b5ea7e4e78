//! The server on 127.0.0.1, for browsers on this machine.

use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use thiserror::Error;

use crate::collection::{Collection, Shown};
use crate::connections::{Connection, Connections};
use crate::drops;
use crate::guard::{Caller, Guard};
use crate::http::{Asked, converse};
use crate::keep;
use crate::reply::Reply;
use crate::route::{Route, answer};
use crate::save;
use crate::sent_states;
use urdd_directory::cancellation::Cancellation;
use urdd_format::hexadecimal::hexadecimal;

/// The preferred port.
const USUAL_PORT: u16 = 8642;
/// Polling interval for connections and cancellation.
const PAUSE: Duration = Duration::from_millis(2);

/// Why the server cannot start.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ServerError {
    /// The port is in use, or not permitted.
    #[error("port {port} of 127.0.0.1 cannot be used: {reason}; give another one with --port")]
    Port {
        /// The requested port.
        port: u16,
        /// The operating system's message.
        reason: String,
    },
    /// No random numbers.
    #[error("the operating system provides no random numbers: {0}")]
    Random(String),
}

/// A server.
pub struct Server {
    listener: TcpListener,
    answers: Answers,
}

/// What a request is answered from.
struct Answers {
    guard: Guard,
    collection: Arc<Collection>,
}

impl Server {
    /// Binds a port: the given one, or else the preferred one or any free port. Serves nothing before [`Server::run`].
    ///
    /// # Errors
    /// If the port cannot be bound.
    pub fn bind(
        collection: impl Into<Arc<Collection>>,
        port: Option<u16>,
    ) -> Result<Self, ServerError> {
        let at = |port: u16| {
            let bound = TcpListener::bind((Ipv4Addr::LOCALHOST, port));
            let ready = bound.and_then(|listener| {
                listener.set_nonblocking(true)?;
                let port = listener.local_addr()?.port();
                Ok((listener, port))
            });
            ready.map_err(|error| ServerError::Port { port, reason: error.to_string() })
        };
        let (listener, port) = match port {
            Some(port) => at(port)?,
            None => at(USUAL_PORT).or_else(|_| at(0))?,
        };
        let mut random = [0; 24];
        getrandom::fill(&mut random).map_err(|error| ServerError::Random(error.to_string()))?;
        let token = hexadecimal(&random);
        let answers = Answers { guard: Guard { port, token }, collection: collection.into() };
        Ok(Self { listener, answers })
    }

    /// The address to open, with the token.
    pub fn address(&self) -> String {
        let Guard { port, token } = &self.answers.guard;
        format!("http://127.0.0.1:{port}/#token={token}")
    }

    /// Serves requests until cancelled. Responses in progress may then be cut off. When it returns, no connection is
    /// accepted any more, even if some are still open.
    pub fn run(self, cancellation: &Cancellation) {
        let Self { listener, answers } = self;
        let answers = Arc::new(answers);
        let connections = Arc::new(Connections::default());
        while !cancellation.is_cancelled() {
            let Ok((stream, _)) = listener.accept() else {
                thread::sleep(PAUSE);
                continue;
            };
            // Some systems pass on the listener's non-blocking mode. The client may already have disconnected.
            let Ok(connection) = stream
                .set_nonblocking(false)
                .and_then(|()| Connection::begin(&stream, &connections))
            else {
                continue;
            };
            let (answers, ended) = (Arc::clone(&answers), cancellation.clone());
            // If no thread can be started, the connection is closed.
            let _ = thread::Builder::new().spawn(move || {
                let admit = |asked: &Asked| answers.admit(asked, &connection);
                let _ =
                    converse(stream, admit, |asked, is_gone| answers.reply(asked, is_gone, &ended));
            });
        }
    }
}

impl Answers {
    /// The maximum size of the request body, or the response that refuses the request.
    fn admit(&self, asked: &Asked, connection: &Connection) -> Result<u64, Reply> {
        let caller = Caller {
            host: asked.header("Host"),
            origin: asked.header("Origin"),
            site: asked.header("Sec-Fetch-Site"),
            mode: asked.header("Sec-Fetch-Mode"),
            destination: asked.header("Sec-Fetch-Dest"),
            token: asked.header("X-Urdd-Token"),
        };
        let route = Route::of(&asked.url);
        let allowed = match (&route, &*asked.method) {
            (route, "GET" | "HEAD") if route.is_entrance() => self.guard.entrance(&caller),
            (route, _) if route.is_public() => self.guard.page(&caller),
            _ => self.guard.robots(&caller).map(|()| connection.keep()),
        };
        match allowed {
            Ok(()) => Ok(route.max_body()),
            Err(refusal) => Err(Reply::failure(403, refusal.message())),
        }
    }

    /// The response to an admitted request. `is_gone` says whether the client has closed the connection.
    fn reply(&self, asked: &Asked, is_gone: &dyn Fn() -> bool, ended: &Cancellation) -> Reply {
        let route = Route::of(&asked.url);
        let with = |id: &str, reply: &dyn Fn(&Shown) -> Reply| match self.collection.find(id) {
            Some(robot) => reply(&robot),
            None => Reply::failure(404, "there is no such robot\n"),
        };
        let body = &asked.body;
        match (&*asked.method, &route) {
            ("GET", Route::States(id)) => with(id, &|robot| robot.states.stream(ended)),
            ("GET" | "HEAD", _) => answer(&self.collection, &route, takes_brotli(asked)),
            ("POST", Route::Skips(id)) => with(id, &|robot| save::skips(robot, body)),
            ("POST", Route::Configurations(id)) => {
                with(id, &|robot| save::configuration(robot, body))
            }
            ("POST", Route::States(id)) => with(id, &|robot| sent_states::take(robot, body)),
            ("POST", Route::Drops) => drops::take(&self.collection, body, is_gone),
            ("POST", Route::Keep(id)) => with(id, &|robot| keep::keep(robot, body)),
            _ => Reply::failure(405, "this cannot be done here\n"),
        }
    }
}

fn takes_brotli(asked: &Asked) -> bool {
    let words = asked.header("Accept-Encoding").unwrap_or_default();
    let mut words = words.split(',').map(|word| word.split(';').next().unwrap_or_default());
    words.any(|word| word.trim() == "br")
}
