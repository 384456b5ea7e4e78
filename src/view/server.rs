//! The server: on 127.0.0.1, for the browser of this machine.

use std::io::Read;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use thiserror::Error;
use tiny_http::{Header, Method, Request, Response};

use super::collection::Collection;
use super::guard::{Caller, Guard};
use super::reply::{HEADERS, Reply};
use super::route::{Route, answer};
use super::save;
use crate::cancellation::Cancellation;
use crate::format::hexadecimal::hexadecimal;

/// The port that is asked for first.
const USUAL_PORT: u16 = 8642;
/// Requests that are answered at once.
const THREADS: usize = 4;
/// Most bytes of what is sent to be saved.
const MAX_BODY_BYTES: u64 = 64 << 20;
/// How often it is looked whether to stop.
const PAUSE: Duration = Duration::from_millis(100);

/// Why there is no server.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ServerError {
    /// The port is taken, or may not be used.
    #[error("port {port} of 127.0.0.1 cannot be used: {reason}; give another one with --port")]
    Port {
        /// The port that was asked for.
        port: u16,
        /// What the operating system said.
        reason: String,
    },
    /// No random numbers.
    #[error("the operating system gives no random numbers: {0}")]
    Random(String),
}

/// A server.
pub struct Server {
    http: tiny_http::Server,
    guard: Guard,
    collection: Collection,
}

impl Server {
    /// Takes a port; without one, the usual one or any that is free. Nothing is answered before [`Server::run`].
    ///
    /// # Errors
    /// Where the port cannot be had.
    pub fn bind(collection: Collection, port: Option<u16>) -> Result<Self, ServerError> {
        let at = |port: u16| {
            tiny_http::Server::http(("127.0.0.1", port)).map_err(|error| ServerError::Port {
                port,
                reason: error.to_string(),
            })
        };
        let http = match port {
            Some(port) => at(port)?,
            None => at(USUAL_PORT).or_else(|_| at(0))?,
        };
        let port = http
            .server_addr()
            .to_ip()
            .map_or(0, |address| address.port());
        let mut random = [0; 24];
        getrandom::fill(&mut random).map_err(|error| ServerError::Random(error.to_string()))?;
        let token = hexadecimal(&random);
        Ok(Self {
            http,
            guard: Guard { port, token },
            collection,
        })
    }

    /// The address to open, with the token.
    pub fn address(&self) -> String {
        let Guard { port, token } = &self.guard;
        format!("http://127.0.0.1:{port}/#token={token}")
    }

    /// Answers until it is told to stop.
    pub fn run(self, cancellation: &Cancellation) {
        let server = Arc::new(self);
        let threads: Vec<_> = (0..THREADS)
            .map(|_| {
                let (server, cancellation) = (Arc::clone(&server), cancellation.clone());
                thread::spawn(move || {
                    while !cancellation.is_cancelled() {
                        if let Ok(Some(request)) = server.http.recv_timeout(PAUSE) {
                            server.answer(request);
                        }
                    }
                })
            })
            .collect();
        for thread in threads {
            let _ = thread.join();
        }
    }

    fn answer(&self, mut request: Request) {
        let reply = self.reply(&mut request);
        let mut response = Response::from_data(reply.body).with_status_code(reply.status);
        let mut add = |name: &str, value: &str| {
            if let Ok(header) = Header::from_bytes(name, value) {
                response.add_header(header);
            }
        };
        for (name, value) in HEADERS {
            add(name, value);
        }
        add("Content-Type", reply.media_type);
        if reply.brotli {
            add("Content-Encoding", "br");
        }
        // Whoever asked may be gone.
        let _ = request.respond(response);
    }

    fn reply(&self, request: &mut Request) -> Reply {
        let header = |name: &'static str| {
            let mut headers = request.headers().iter();
            let found = headers.find(|header| header.field.equiv(name))?;
            Some(found.value.as_str())
        };
        let caller = Caller {
            host: header("Host"),
            origin: header("Origin"),
            site: header("Sec-Fetch-Site"),
            token: header("X-Urdd-Token"),
        };
        let brotli = header("Accept-Encoding").is_some_and(|words| {
            let mut words = words
                .split(',')
                .map(|word| word.split(';').next().unwrap_or_default());
            words.any(|word| word.trim() == "br")
        });
        let route = Route::of(request.url());
        let allowed = match route.is_public() {
            true => self.guard.page(&caller),
            false => self.guard.robots(&caller),
        };
        if let Err(refusal) = allowed {
            return Reply::failure(403, refusal.message());
        }
        match (request.method(), &route) {
            (Method::Get | Method::Head, _) => answer(&self.collection, &route, brotli),
            (Method::Post, Route::Skips(id)) => {
                let Some(robot) = self.collection.find(id) else {
                    return Reply::failure(404, "there is no such robot\n");
                };
                let mut body = Vec::new();
                let limited = &mut request.as_reader().take(MAX_BODY_BYTES + 1);
                if limited.read_to_end(&mut body).is_err() || body.len() as u64 > MAX_BODY_BYTES {
                    return Reply::failure(413, "that is too much to save\n");
                }
                save::skips(robot, &body)
            }
            _ => Reply::failure(405, "this cannot be done here\n"),
        }
    }
}
