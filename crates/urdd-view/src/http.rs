//! One HTTP/1.1 request and response per connection, which is then closed. Local browsers reconnect immediately, and no
//! idle connection holds resources.
//!
//! `tiny_http` 0.12 is unsuitable: if a browser keeps several connections open, its thread pool leaves some requests
//! unanswered until they close.

use std::fmt::Display;
use std::io::{self, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde::de::DeserializeOwned;
use serde_json::Value;

use urdd_directory::source::OpenFile;

/// Maximum size of a request's first line and headers, in bytes, and maximum number of headers.
const MAX_HEAD: usize = 16 << 10;
const MAX_HEADERS: usize = 64;
/// Maximum idle time of a connection.
const SILENCE: Duration = Duration::from_secs(10);
/// Maximum total time to receive the first line and headers, and a body.
const MAX_HEAD_TIME: Duration = Duration::from_secs(5);
const MAX_BODY_TIME: Duration = Duration::from_secs(60);
/// Maximum time to send a response: this, plus one second per [`BYTES_A_SECOND`] bytes.
const MAX_ANSWER_TIME: Duration = Duration::from_secs(60);
const BYTES_A_SECOND: u64 = 1 << 20;
/// Limits for reading and discarding unread input before closing. Closing earlier resets the connection, and the
/// response may be lost.
const LINGER: Duration = Duration::from_secs(1);
const MAX_LINGER: u64 = 1 << 20;

#[derive(Debug, Default)]
pub struct Request {
    pub method: String,
    pub url: String,
    /// Its headers. Values that are not text are empty.
    headers: Vec<(String, String)>,
    pub body: Vec<u8>,
}

impl Request {
    /// The value of a header; empty if the header is repeated.
    pub fn header(&self, name: &str) -> Option<&str> {
        let mut found = self.headers.iter().filter(|(known, _)| known.eq_ignore_ascii_case(name));
        match (found.next(), found.next()) {
            (Some((_, value)), None) => Some(value),
            // Repeated, so ambiguous.
            (Some(_), Some(_)) => Some(""),
            _ => None,
        }
    }
}

/// A connection with a deadline, even if it is active.
struct Timed {
    stream: TcpStream,
    until: Instant,
}

impl Timed {
    fn for_another(&mut self, time: Duration) {
        self.until = Instant::now() + time;
    }

    /// The time left for the next step.
    fn left(&self) -> io::Result<Duration> {
        let left = self.until.saturating_duration_since(Instant::now());
        if left.is_zero() { Err(io::ErrorKind::TimedOut.into()) } else { Ok(left.min(SILENCE)) }
    }
}

impl Read for Timed {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.stream.set_read_timeout(Some(self.left()?))?;
        self.stream.read(buffer)
    }
}

impl Write for Timed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.stream.set_write_timeout(Some(self.left()?))?;
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

/// Serves one request of a connection. `admit` receives the request without its body, and returns the maximum size of
/// the body, or refuses the request. `answer` also receives a question to ask during long work: whether the client has
/// closed the connection.
pub fn converse(
    stream: TcpStream,
    admit: impl FnOnce(&Request) -> Result<u64, Reply>,
    answer: impl FnOnce(&Request, &dyn Fn() -> bool) -> Reply,
) -> io::Result<()> {
    stream.set_nodelay(true)?;
    let until = Instant::now() + MAX_HEAD_TIME;
    let mut reader = BufReader::new(Timed { stream, until });
    let (reply, head_only) = match head(&mut reader)? {
        Err(refused) => (refused, false),
        Ok(mut request) => {
            let admitted = admit(&request).and_then(|limit| length(&request, limit));
            let received = match admitted {
                Err(refused) => Err(refused),
                Ok(length) => {
                    reader.get_mut().for_another(MAX_BODY_TIME);
                    body(&mut reader, length, &mut request.body)?
                }
            };
            let reply = match received {
                Ok(()) => answer(&request, &|| is_closed(&reader.get_ref().stream)),
                Err(refused) => refused,
            };
            (reply, request.method == "HEAD")
        }
    };
    let seconds = Duration::from_secs(reply.body.size().unwrap_or_default() / BYTES_A_SECOND);
    reader.get_mut().for_another(MAX_ANSWER_TIME + seconds);
    write(reader.get_mut(), reply, head_only)?;
    reader.get_ref().stream.shutdown(Shutdown::Write)?;
    reader.get_mut().for_another(LINGER);
    io::copy(&mut reader.take(MAX_LINGER), &mut io::sink())?;
    Ok(())
}

/// Whether the client has closed the connection. Does not wait.
fn is_closed(stream: &TcpStream) -> bool {
    if stream.set_nonblocking(true).is_err() {
        return true;
    }
    let closed = match stream.peek(&mut [0]) {
        Ok(read) => read == 0,
        Err(error) => error.kind() != io::ErrorKind::WouldBlock,
    };
    closed || stream.set_nonblocking(false).is_err()
}

/// Reads a request up to its body; an invalid request gives the response to send.
fn head(reader: &mut impl Read) -> io::Result<Result<Request, Reply>> {
    let mut head = Vec::new();
    while !head.ends_with(b"\r\n\r\n") {
        if head.len() >= MAX_HEAD {
            return Ok(Err(Reply::failure(431, "the headers are too long\n")));
        }
        let mut byte = [0];
        reader.read_exact(&mut byte)?;
        head.push(byte[0]);
    }
    let mut headers = [httparse::EMPTY_HEADER; MAX_HEADERS];
    let mut parsed = httparse::Request::new(&mut headers);
    if !matches!(parsed.parse(&head), Ok(httparse::Status::Complete(_))) {
        return Ok(Err(Reply::failure(400, "this is no request\n")));
    }
    let text = |value: &[u8]| std::str::from_utf8(value).unwrap_or_default().to_owned();
    Ok(Ok(Request {
        method: parsed.method.unwrap_or_default().to_owned(),
        url: parsed.path.unwrap_or_default().to_owned(),
        headers: parsed
            .headers
            .iter()
            .map(|header| (header.name.to_owned(), text(header.value)))
            .collect(),
        body: Vec::new(),
    }))
}

/// The length of a request's body, or the response that rejects it.
fn length(request: &Request, limit: u64) -> Result<u64, Reply> {
    if request.header("Transfer-Encoding").is_some() {
        return Err(Reply::failure(411, "the length of the body is missing\n"));
    }
    match request.header("Content-Length").map(str::parse::<u64>) {
        None => Ok(0),
        Some(Ok(length)) if length <= limit => Ok(length),
        Some(Ok(_)) => Err(Reply::failure(413, "the body is too long\n")),
        Some(Err(_)) => Err(Reply::failure(400, "this is no request\n")),
    }
}

fn body(reader: &mut impl Read, length: u64, body: &mut Vec<u8>) -> io::Result<Result<(), Reply>> {
    reader.take(length).read_to_end(body)?;
    Ok(match body.len() as u64 == length {
        true => Ok(()),
        false => Err(Reply::failure(400, "the body is incomplete\n")),
    })
}

fn write(stream: &mut Timed, reply: Reply, head_only: bool) -> io::Result<()> {
    let mut head = format!("HTTP/1.1 {} {}\r\n", reply.status, word(reply.status));
    for (name, value) in HEADERS {
        head += &format!("{name}: {value}\r\n");
    }
    head += &format!("Content-Type: {}\r\n", reply.media_type);
    if reply.brotli {
        head += "Content-Encoding: br\r\n";
    }
    if let Some(size) = reply.body.size() {
        head += &format!("Content-Length: {size}\r\n");
    }
    head += "Connection: close\r\n\r\n";
    stream.write_all(head.as_bytes())?;
    if !head_only {
        match reply.body {
            Body::Bytes(bytes) => stream.write_all(&bytes)?,
            // If the file is shorter than announced, the connection ends early, so the client detects the truncation.
            Body::File(file, size) => {
                io::copy(&mut file.take(size), stream)?;
            }
            // A client that no longer reads fills its buffers, and is left after a while.
            Body::Lines(mut next) => {
                while let Some(line) = next() {
                    stream.for_another(SILENCE);
                    stream.write_all(line.as_bytes())?;
                }
            }
        }
    }
    stream.flush()
}

fn word(status: u16) -> &'static str {
    match status {
        200 => "OK",
        204 => "No Content",
        400 => "Bad Request",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        409 => "Conflict",
        411 => "Length Required",
        413 => "Content Too Large",
        431 => "Request Header Fields Too Large",
        _ => "Internal Server Error",
    }
}

pub enum Body {
    Bytes(Vec<u8>),
    /// A file of this size, streamed.
    File(OpenFile, u64),
    /// Lines, each sent when it is there, until there are no more.
    Lines(Box<dyn FnMut() -> Option<Arc<str>>>),
}

impl Body {
    /// Its size in bytes; `None` if it ends with the connection.
    pub fn size(&self) -> Option<u64> {
        match self {
            Body::Bytes(bytes) => Some(bytes.len() as u64),
            Body::File(_, size) => Some(*size),
            Body::Lines(_) => None,
        }
    }
}

pub struct Reply {
    pub status: u16,
    pub media_type: &'static str,
    pub brotli: bool,
    pub body: Body,
}

/// The page may only run its own code and the module, and fetch from its origin. Images in glTF become blobs; JSON glTF
/// contains `data:` URIs.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
     connect-src 'self' blob: data:; img-src 'self' blob: data:; worker-src blob:; base-uri 'none'; form-action 'none'; \
     frame-ancestors 'none'";

/// The headers of every response, in addition to those of its body.
const HEADERS: &[(&str, &str)] = &[
    ("Content-Security-Policy", POLICY),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cache-Control", "no-store"),
];

impl Reply {
    pub fn ok(media_type: &'static str, body: Body) -> Self {
        Self { status: 200, media_type, brotli: false, body }
    }

    pub fn failure(status: u16, message: impl Into<String>) -> Self {
        let body = Body::Bytes(message.into().into_bytes());
        Self { status, ..Self::ok("text/plain; charset=utf-8", body) }
    }

    /// What was done, as JSON, or why it was not.
    pub fn of(result: Result<Value, Failure>) -> Self {
        match result {
            Ok(value) => Self::json(&value),
            Err((status, message)) => Self::failure(status, format!("{message}\n")),
        }
    }

    /// An empty response without an error.
    pub fn nothing() -> Self {
        Self::failure(204, "")
    }

    pub fn json(value: &Value) -> Self {
        Self::json_text(value.to_string())
    }

    pub fn json_text(text: String) -> Self {
        Self::ok("application/json", Body::Bytes(text.into_bytes()))
    }
}

/// Why a request was not done: an HTTP status, and the reason.
pub type Failure = (u16, String);

pub type Result<T, E = Failure> = std::result::Result<T, E>;

/// An error as a failure of this status.
pub fn failed<E: Display>(status: u16) -> impl Fn(E) -> Failure {
    move |error| (status, error.to_string())
}

/// A failure of our own.
pub fn refused<T>(status: u16, why: impl Into<String>) -> Result<T, Failure> {
    Err((status, why.into()))
}

/// Reads the JSON that the page sends; `what` says what it is to be.
pub fn wish<T: DeserializeOwned>(body: &[u8], what: &str) -> Result<T, Failure> {
    serde_json::from_slice(body).map_err(|error| (400, format!("not {what}: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads a request whose body may have up to 10 bytes.
    fn read(mut text: &[u8]) -> io::Result<Result<Request, Reply>> {
        let mut request = match head(&mut text)? {
            Ok(request) => request,
            Err(refused) => return Ok(Err(refused)),
        };
        let length = match length(&request, 10) {
            Ok(length) => length,
            Err(refused) => return Ok(Err(refused)),
        };
        Ok(body(&mut text, length, &mut request.body)?.map(|()| request))
    }

    fn status(text: &[u8]) -> u16 {
        match read(text).expect("an answer") {
            Ok(_) => 200,
            Err(reply) => reply.status,
        }
    }

    #[test]
    fn a_request_is_read() {
        let text = b"POST /a?b HTTP/1.1\r\nHost: x\r\ncontent-length: 3\r\n\r\nabcdef";
        let request = read(text).expect("read").ok().expect("a request");
        assert_eq!((&*request.method, &*request.url), ("POST", "/a?b"));
        assert_eq!(request.header("host"), Some("x"));
        assert_eq!(request.header("origin"), None);
        assert_eq!(request.body, b"abc");
    }

    #[test]
    fn what_is_no_request_is_refused() {
        assert_eq!(status(b"nonsense\r\n\r\n"), 400);
        assert_eq!(status(b"GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"), 400);
        assert_eq!(status(b"GET / HTTP/1.1\r\nContent-Length: 5\r\n\r\nabc"), 400);
        assert_eq!(status(b"GET / HTTP/1.1\r\nContent-Length: 11\r\n\r\n"), 413);
        assert_eq!(status(b"GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"), 411);
        let twice = b"GET / HTTP/1.1\r\nContent-Length: 0\r\nContent-Length: 3\r\n\r\nabc";
        assert_eq!(status(twice), 400);
        let mut long = b"GET / HTTP/1.1\r\nA: ".to_vec();
        long.extend(vec![b'a'; MAX_HEAD]);
        assert_eq!(status(&long), 431);
        assert!(read(b"GET / HTT").is_err(), "cut off");
    }
}
