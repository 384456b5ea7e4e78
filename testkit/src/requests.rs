//! Raw requests to the server of `urdd view`, as its page and others send them.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use serde_json::Value;

/// Longest wait for something that has to come.
pub const PATIENCE: Duration = Duration::from_secs(120);

/// A server to ask, in this process or another one.
pub struct Requests {
    /// Its port on this machine.
    pub port: u16,
    /// The token of its page.
    pub token: String,
}

impl Requests {
    /// To the server of this address, as it prints it.
    pub fn to(address: &str) -> Self {
        let rest = address.strip_prefix("http://127.0.0.1:").expect("loopback");
        let (port, token) = rest.split_once("/#token=").expect("a token");
        Self { port: port.parse().expect("a port"), token: token.to_owned() }
    }

    /// Sends a request with exactly these headers, and returns the whole response.
    pub fn raw(&self, first_line: &str, headers: &[(&str, &str)], body: &[u8]) -> Answer {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a connection");
        let mut text = format!("{first_line} HTTP/1.1\r\nConnection: close\r\n");
        for (name, value) in headers {
            text.push_str(&format!("{name}: {value}\r\n"));
        }
        text.push_str(&format!("Content-Length: {}\r\n\r\n", body.len()));
        stream.write_all(text.as_bytes()).expect("sent");
        stream.write_all(body).expect("sent");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("an answer");
        Answer::of(&answer)
    }

    /// The value of the header `Host`.
    pub fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    /// Asks as the page does.
    pub fn get(&self, path: &str) -> Answer {
        let headers = [("Host", &*self.host()), ("X-Urdd-Token", &*self.token)];
        self.raw(&format!("GET {path}"), &headers, b"")
    }

    /// A JSON document that is served.
    pub fn json(&self, path: &str) -> Value {
        let answer = self.get(path);
        assert_eq!(answer.status, 200, "{path}: {}", answer.text());
        serde_json::from_slice(&answer.body).expect("JSON")
    }

    /// Sends a JSON document as the page does.
    pub fn post(&self, path: &str, body: &Value) -> Answer {
        self.send(path, body.to_string().as_bytes())
    }

    /// Sends bytes as the page does.
    pub fn send(&self, path: &str, body: &[u8]) -> Answer {
        let headers = [
            ("Host", &*self.host()),
            ("Origin", &*format!("http://{}", self.host())),
            ("X-Urdd-Token", &*self.token),
        ];
        self.raw(&format!("POST {path}"), &headers, body)
    }

    /// The lines that a page gets, and the headers before them.
    pub fn listen(&self, path: &str, token: &str) -> BufReader<TcpStream> {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a connection");
        let time = Some(Duration::from_secs(30));
        stream.set_read_timeout(time).expect("a time limit");
        let request = format!(
            "GET {path} HTTP/1.1\r\nHost: {}\r\nX-Urdd-Token: {token}\r\n\r\n",
            self.host()
        );
        stream.write_all(request.as_bytes()).expect("sent");
        BufReader::new(stream)
    }

    /// The first answer about a robot that is as wanted. Asks as the page does that shows it.
    pub fn until(&self, id: &str, wanted: impl Fn(&Value) -> bool) -> Value {
        let begun = Instant::now();
        loop {
            let answer = self.json(&format!("/robots/{id}/revision.json"));
            if wanted(&answer) {
                return answer;
            }
            assert!(begun.elapsed() < PATIENCE, "it stays {answer}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

/// Whether an answer of [`Requests::until`] is about a robot that was made without a failure.
pub fn is_whole(answer: &Value) -> bool {
    let is_broken = !answer["entry"]["failure"].is_null();
    answer["entry"]["ready"] == true && answer["entry"]["making"].is_null() && !is_broken
}

/// The status line of an answer, after which its headers are read.
pub fn status(reader: &mut impl BufRead) -> String {
    let mut first = String::new();
    reader.read_line(&mut first).expect("a line");
    loop {
        let mut line = String::new();
        reader.read_line(&mut line).expect("a line");
        if line.trim().is_empty() {
            return first;
        }
    }
}

/// The next configuration.
pub fn next(reader: &mut impl BufRead) -> Value {
    loop {
        let mut line = String::new();
        assert!(reader.read_line(&mut line).expect("a line") > 0, "it ended");
        if !line.trim().is_empty() {
            return serde_json::from_str(&line).expect("JSON");
        }
    }
}

/// The response.
pub struct Answer {
    /// The number that says how it went.
    pub status: u16,
    /// Names in lower case, and values.
    pub headers: Vec<(String, String)>,
    /// The content.
    pub body: Vec<u8>,
}

impl Answer {
    fn of(bytes: &[u8]) -> Self {
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").expect("headers");
        let head = String::from_utf8(bytes[..end].to_vec()).expect("text");
        let mut lines = head.lines();
        let status = lines.next().and_then(|line| line.split(' ').nth(1)).expect("a status");
        let headers: Vec<(String, String)> = lines
            .filter_map(|line| line.split_once(": "))
            .map(|(name, value)| (name.to_ascii_lowercase(), value.to_owned()))
            .collect();
        let mut answer = Answer {
            status: status.parse().expect("a number"),
            headers,
            body: bytes[end + 4..].to_vec(),
        };
        if answer.header("transfer-encoding") == Some("chunked") {
            answer.body = unchunked(&answer.body);
        }
        answer
    }

    /// The first value of a header.
    pub fn header(&self, name: &str) -> Option<&str> {
        let found = self.headers.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| value.as_str())
    }

    /// The content as text.
    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }
}

fn unchunked(mut rest: &[u8]) -> Vec<u8> {
    let mut body = Vec::new();
    loop {
        let end = rest.windows(2).position(|two| two == b"\r\n").expect("a size");
        let size = std::str::from_utf8(&rest[..end]).expect("a size");
        let size = usize::from_str_radix(size.trim(), 16).expect("a size");
        if size == 0 {
            return body;
        }
        body.extend_from_slice(&rest[end + 2..end + 2 + size]);
        rest = &rest[end + 2 + size + 2..];
    }
}
