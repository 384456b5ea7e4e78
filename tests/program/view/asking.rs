//! A server, and raw requests to it.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;

use serde_json::Value;
use urdd_directory::cancellation::Cancellation;
use urdd_view::{Collection, Server};

/// A URDD of one of our robots, in a folder of its own.
pub fn made(robot: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = testkit::temporary::folder();
    let target = folder.path().join(robot);
    let urdf =
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("conformance/robots/{robot}.urdf"));
    urdd_generate::generate(&urdf, &target, &Default::default(), &()).expect("a URDD");
    (folder, target)
}

fn port_and_token(address: &str) -> (u16, String) {
    let rest = address.strip_prefix("http://127.0.0.1:").expect("loopback");
    let (port, token) = rest.split_once("/#token=").expect("a token");
    (port.parse().expect("a port"), token.to_owned())
}

/// A server at work, until it is dropped.
pub struct Running {
    pub port: u16,
    pub token: String,
    cancellation: Cancellation,
    thread: Option<JoinHandle<()>>,
}

impl Running {
    pub fn on(path: &Path) -> Self {
        let collection = Collection::default();
        collection.add(path).expect("a URDD");
        Self::with(collection)
    }

    pub fn with(collection: impl Into<Arc<Collection>>) -> Self {
        let server = Server::bind(collection, None).expect("a port");
        let (port, token) = port_and_token(&server.address());
        let cancellation = Cancellation::default();
        let wish = cancellation.clone();
        let thread = Some(std::thread::spawn(move || server.run(&wish)));
        Self { port, token, cancellation, thread }
    }

    /// A server of another process, by the address that it printed.
    pub fn at(address: &str) -> Self {
        let (port, token) = port_and_token(address);
        Self { port, token, cancellation: Cancellation::default(), thread: None }
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

    pub fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    pub fn get(&self, path: &str) -> Answer {
        let headers = [("Host", &*self.host()), ("X-Urdd-Token", &*self.token)];
        self.raw(&format!("GET {path}"), &headers, b"")
    }

    pub fn json(&self, path: &str) -> Value {
        let answer = self.get(path);
        assert_eq!(answer.status, 200, "{path}: {}", answer.text());
        serde_json::from_slice(&answer.body).expect("JSON")
    }

    pub fn post(&self, path: &str, body: &Value) -> Answer {
        self.send(path, body.to_string().as_bytes())
    }

    pub fn send(&self, path: &str, body: &[u8]) -> Answer {
        let headers = [
            ("Host", &*self.host()),
            ("Origin", &*format!("http://{}", self.host())),
            ("X-Urdd-Token", &*self.token),
        ];
        self.raw(&format!("POST {path}"), &headers, body)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.cancellation.cancel();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// The response.
pub struct Answer {
    pub status: u16,
    pub headers: Vec<(String, String)>,
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

    pub fn header(&self, name: &str) -> Option<&str> {
        let found = self.headers.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| value.as_str())
    }

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
