//! Access control: only the page itself, in a browser on this machine, opened with the printed address.

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

/// Why a request is refused.
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

/// The access rules of one server.
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
