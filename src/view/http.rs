//! One request and one answer of HTTP/1.1 over a connection, which is closed afterwards: browsers of this machine open
//! another one at once, and none that is idle holds anything.
//!
//! `tiny_http` 0.12 was tried: with several connections that a browser keeps open, its pool of threads leaves some requests
//! without an answer for as long as they stay open.

use std::io::{self, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

use super::reply::{HEADERS, Reply};

/// Most bytes of a request's first line and headers, most headers.
const MAX_HEAD: usize = 16 << 10;
const MAX_HEADERS: usize = 64;
/// Most bytes of what is sent to be saved.
const MAX_BODY: u64 = 64 << 20;
/// How long a connection may be silent.
const SILENCE: Duration = Duration::from_secs(10);

/// A request.
#[derive(Debug, Default)]
pub struct Asked {
    /// Its method.
    pub method: String,
    /// Its address, as it was sent.
    pub url: String,
    /// Its headers; values that are no text are empty.
    headers: Vec<(String, String)>,
    /// Its body.
    pub body: Vec<u8>,
}

impl Asked {
    /// The value of a header, where there is exactly one of that name.
    pub fn header(&self, name: &str) -> Option<&str> {
        let mut found = self
            .headers
            .iter()
            .filter(|(known, _)| known.eq_ignore_ascii_case(name));
        match (found.next(), found.next()) {
            (Some((_, value)), None) => Some(value),
            // Said twice: nobody can tell which counts.
            (Some(_), Some(_)) => Some(""),
            _ => None,
        }
    }
}

/// Answers what is asked over a connection.
pub fn converse(stream: TcpStream, answer: impl FnOnce(&Asked) -> Reply) -> io::Result<()> {
    stream.set_read_timeout(Some(SILENCE))?;
    stream.set_write_timeout(Some(SILENCE))?;
    stream.set_nodelay(true)?;
    let mut reader = BufReader::new(stream);
    let (reply, head_only) = match read(&mut reader)? {
        Ok(asked) => (answer(&asked), asked.method == "HEAD"),
        Err(refused) => (refused, false),
    };
    write(reader.get_mut(), &reply, head_only)
}

/// A request, or the answer to what is none.
fn read(reader: &mut impl Read) -> io::Result<Result<Asked, Reply>> {
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
    let mut asked = Asked {
        method: parsed.method.unwrap_or_default().to_owned(),
        url: parsed.path.unwrap_or_default().to_owned(),
        headers: parsed
            .headers
            .iter()
            .map(|header| (header.name.to_owned(), text(header.value)))
            .collect(),
        body: Vec::new(),
    };
    if asked.header("Transfer-Encoding").is_some() {
        return Ok(Err(Reply::failure(411, "say the length of the body\n")));
    }
    let length = match asked.header("Content-Length").map(str::parse::<u64>) {
        None => 0,
        Some(Ok(length)) if length <= MAX_BODY => length,
        Some(Ok(_)) => return Ok(Err(Reply::failure(413, "that is too much to save\n"))),
        Some(Err(_)) => return Ok(Err(Reply::failure(400, "this is no request\n"))),
    };
    reader.take(length).read_to_end(&mut asked.body)?;
    if asked.body.len() as u64 != length {
        return Ok(Err(Reply::failure(400, "the body is cut off\n")));
    }
    Ok(Ok(asked))
}

fn write(stream: &mut impl Write, reply: &Reply, head_only: bool) -> io::Result<()> {
    let mut head = format!("HTTP/1.1 {} {}\r\n", reply.status, word(reply.status));
    let mut add = |name: &str, value: &str| {
        head.push_str(name);
        head.push_str(": ");
        head.push_str(value);
        head.push_str("\r\n");
    };
    for (name, value) in HEADERS {
        add(name, value);
    }
    add("Content-Type", reply.media_type);
    if reply.brotli {
        add("Content-Encoding", "br");
    }
    add("Content-Length", &reply.body.len().to_string());
    add("Connection", "close");
    head.push_str("\r\n");
    stream.write_all(head.as_bytes())?;
    if !head_only {
        stream.write_all(&reply.body)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    fn status(text: &[u8]) -> u16 {
        match read(&mut &*text).expect("an answer") {
            Ok(_) => 200,
            Err(reply) => reply.status,
        }
    }

    #[test]
    fn a_request_is_read() {
        let text = b"POST /a?b HTTP/1.1\r\nHost: x\r\ncontent-length: 3\r\n\r\nabcdef";
        let asked = read(&mut &text[..]).expect("read").expect("a request");
        assert_eq!((&*asked.method, &*asked.url), ("POST", "/a?b"));
        assert_eq!(asked.header("host"), Some("x"));
        assert_eq!(asked.header("origin"), None);
        assert_eq!(asked.body, b"abc");
    }

    #[test]
    fn what_is_no_request_is_refused() {
        assert_eq!(status(b"nonsense\r\n\r\n"), 400);
        assert_eq!(status(b"GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"), 400);
        assert_eq!(
            status(b"GET / HTTP/1.1\r\nContent-Length: 5\r\n\r\nabc"),
            400
        );
        assert_eq!(
            status(b"GET / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n"),
            413
        );
        assert_eq!(
            status(b"GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"),
            411
        );
        let twice = b"GET / HTTP/1.1\r\nContent-Length: 0\r\nContent-Length: 3\r\n\r\nabc";
        assert_eq!(status(twice), 400);
        let mut long = b"GET / HTTP/1.1\r\nA: ".to_vec();
        long.extend(vec![b'a'; MAX_HEAD]);
        assert_eq!(status(&long), 431);
        assert!(read(&mut &b"GET / HTT"[..]).is_err(), "cut off");
    }
}
