//! Access control: only the page itself, in a browser on this machine, opened with the printed address; and which
//! connections stay open. The oldest give way to newer ones: those without the token, so that idle connections of other
//! programs cannot lock out the page; and those with it only to others with it.

use std::io;
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;

use parking_lot::Mutex;

/// The headers that identify the origin of a request.
#[derive(Debug, Clone, Copy, Default)]
pub struct Caller<'a> {
    pub host: Option<&'a str>,
    pub origin: Option<&'a str>,
    /// `Sec-Fetch-Site`.
    pub site: Option<&'a str>,
    /// `Sec-Fetch-Mode`.
    pub mode: Option<&'a str>,
    /// `Sec-Fetch-Dest`.
    pub destination: Option<&'a str>,
    /// `X-Urdd-Token`.
    pub token: Option<&'a str>,
}

impl Caller<'_> {
    /// Whether the request is a navigation to the page in a tab, not from a frame, a script or an image.
    fn follows_a_link(&self) -> bool {
        self.origin.is_none()
            && self.mode == Some("navigate")
            && self.destination == Some("document")
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// Sent to another host name, as in DNS rebinding attacks by other pages.
    Host,
    Origin,
    Token,
}

impl Refusal {
    pub fn message(self) -> &'static str {
        match self {
            Refusal::Host => "this server accepts requests only for 127.0.0.1 and localhost\n",
            Refusal::Origin => "this server accepts requests only from its own page\n",
            Refusal::Token => {
                "the token is missing or wrong: open the address that `urdd view` printed\n"
            }
        }
    }
}

#[derive(Debug, Clone)]
pub struct Guard {
    pub port: u16,
    /// The token that a caller must send.
    pub token: String,
}

impl Guard {
    /// Whether to serve the page's HTML: to the page itself, to a typed address, and to a followed link on any page.
    /// The HTML contains no robot and no token, and no other page can frame or read it.
    pub fn entrance(&self, caller: &Caller) -> Result<(), Refusal> {
        let site = if caller.follows_a_link() { Some("none") } else { caller.site };
        self.page(&Caller { site, ..*caller })
    }

    /// Whether to serve the page's other files. Checks the host, and that no other page sends the request.
    pub fn page(&self, caller: &Caller) -> Result<(), Refusal> {
        let port = self.port;
        let hosts = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}"));
        let is_host = |host: &str| hosts.iter().any(|own| own.eq_ignore_ascii_case(host));
        if !caller.host.is_some_and(is_host) {
            return Err(Refusal::Host);
        }
        let own = |origin: &str| origin.strip_prefix("http://").is_some_and(is_host);
        if caller.origin.is_some_and(|origin| !own(origin)) {
            return Err(Refusal::Origin);
        }
        // A typed or externally opened address sends `none`. Other pages cannot even link to these files.
        match caller.site {
            None | Some("same-origin" | "none") => Ok(()),
            Some(_) => Err(Refusal::Origin),
        }
    }

    /// Whether a robot may be read or changed. Also requires the token.
    pub fn robots(&self, caller: &Caller) -> Result<(), Refusal> {
        self.page(caller)?;
        let given = caller.token.unwrap_or_default().as_bytes();
        let own = self.token.as_bytes();
        // Compares every byte, so that timing reveals nothing.
        let differ = own.iter().zip(given).fold(0, |sum, (a, b)| sum | (a ^ b));
        if own.len() == given.len() && differ == 0 { Ok(()) } else { Err(Refusal::Token) }
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    fn guard() -> Guard {
        Guard { port: 8642, token: "abcdef".to_owned() }
    }

    fn own() -> Caller<'static> {
        Caller {
            host: Some("127.0.0.1:8642"),
            origin: Some("http://127.0.0.1:8642"),
            site: Some("same-origin"),
            mode: Some("cors"),
            destination: Some("empty"),
            token: Some("abcdef"),
        }
    }

    #[test]
    fn the_page_itself_may_ask() {
        assert_eq!(guard().robots(&own()), Ok(()));
        let typed =
            Caller { host: Some("LOCALHOST:8642"), site: Some("none"), ..Caller::default() };
        assert_eq!(guard().page(&typed), Ok(()));
        assert_eq!(guard().robots(&typed), Err(Refusal::Token));
    }

    #[test]
    fn a_link_on_another_page_opens_the_page_and_nothing_else() {
        let followed = Caller {
            host: Some("127.0.0.1:8642"),
            site: Some("cross-site"),
            mode: Some("navigate"),
            destination: Some("document"),
            ..Caller::default()
        };
        assert_eq!(guard().entrance(&followed), Ok(()));
        assert_eq!(guard().page(&followed), Err(Refusal::Origin));
        assert_eq!(guard().robots(&followed), Err(Refusal::Origin));
        let origin = Some("http://evil.example");
        let others = [
            Caller { host: Some("evil.example"), ..followed },
            // A posted form, a frame, an image, a script.
            Caller { origin, ..followed },
            Caller { destination: Some("iframe"), ..followed },
            Caller { mode: Some("no-cors"), destination: Some("image"), ..followed },
            Caller { mode: None, destination: None, ..followed },
        ];
        for caller in others {
            assert!(guard().entrance(&caller).is_err(), "{caller:?}");
        }
    }

    #[test]
    fn nobody_else_may() {
        let hosts = [None, Some("evil.example"), Some("127.0.0.1"), Some("127.0.0.1:80")];
        for host in hosts {
            let caller = Caller { host, ..own() };
            assert_eq!(guard().robots(&caller), Err(Refusal::Host), "{host:?}");
        }
        let origins =
            ["null", "http://evil.example", "https://127.0.0.1:8642", "http://127.0.0.1:1"];
        for origin in origins {
            let origin = Some(origin);
            let caller = Caller { origin, ..own() };
            assert_eq!(guard().page(&caller), Err(Refusal::Origin), "{origin:?}");
        }
        for site in ["cross-site", "same-site"] {
            let site = Some(site);
            let caller = Caller { site, ..own() };
            assert_eq!(guard().page(&caller), Err(Refusal::Origin), "{site:?}");
        }
        for token in [None, Some(""), Some("abcde"), Some("abcdeF"), Some("abcdefg")] {
            let caller = Caller { token, ..own() };
            assert_eq!(guard().robots(&caller), Err(Refusal::Token), "{token:?}");
        }
    }
}
