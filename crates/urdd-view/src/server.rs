//! The server on 127.0.0.1, for browsers on this machine.

use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use thiserror::Error;

use crate::cards;
use crate::collection::{Collection, take};
use crate::guard::{Caller, Connection, Connections, Guard};
use crate::http::{Reply, Request, converse};
use crate::route::{Asked, Route, answer, answer_about, cannot_be_done, unread};
use urdd_directory::cancellation::Cancellation;
use urdd_format::hexadecimal::hexadecimal;

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
                let admit = |request: &Request| answers.admit(request, &connection);
                let _ = converse(stream, admit, |request, is_gone| {
                    answers.reply(request, is_gone, &ended)
                });
            });
        }
    }
}

impl Answers {
    /// The maximum size of the request body, or the response that refuses the request.
    fn admit(&self, request: &Request, connection: &Connection) -> Result<u64, Reply> {
        let caller = Caller {
            host: request.header("Host"),
            origin: request.header("Origin"),
            site: request.header("Sec-Fetch-Site"),
            mode: request.header("Sec-Fetch-Mode"),
            destination: request.header("Sec-Fetch-Dest"),
            token: request.header("X-Urdd-Token"),
        };
        let route = Route::of(&request.url);
        let allowed = match (&route, &*request.method) {
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
    fn reply(&self, request: &Request, is_gone: &dyn Fn() -> bool, ended: &Cancellation) -> Reply {
        let (all, body) = (&self.collection, &request.body);
        match (&*request.method, Route::of(&request.url)) {
            (method @ ("GET" | "HEAD" | "POST"), Route::Robot(id, asked)) => match all.find(&id) {
                Some(robot) if asked == Asked::Picture && method != "POST" && !robot.is_ready() => {
                    cards::answer(&robot, &|| is_gone() || ended.is_cancelled())
                }
                Some(robot) => {
                    answer_about(all, &robot, (method, &asked), body, ended).unwrap_or_else(unread)
                }
                None => Reply::failure(404, "there is no such robot\n"),
            },
            ("GET" | "HEAD", route) => answer(all, &route, takes_brotli(request)),
            ("POST", Route::Drops) => take(all, body, is_gone),
            _ => cannot_be_done(),
        }
    }
}

fn takes_brotli(request: &Request) -> bool {
    let words = request.header("Accept-Encoding").unwrap_or_default();
    let mut words = words.split(',').map(|word| word.split(';').next().unwrap_or_default());
    words.any(|word| word.trim() == "br")
}
