//! Responses of the server.

use std::fmt::Display;
use std::sync::Arc;

use serde::de::DeserializeOwned;
use serde_json::Value;

use urdd_directory::source::OpenFile;

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
pub const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
     connect-src 'self' blob: data:; img-src 'self' blob: data:; worker-src blob:; base-uri 'none'; form-action 'none'; \
     frame-ancestors 'none'";

/// The headers of every response, in addition to those of its body.
pub const HEADERS: &[(&str, &str)] = &[
    ("Content-Security-Policy", POLICY),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cache-Control", "no-store"),
];

impl Reply {
    /// A response of a media type, without an error.
    pub fn ok(media_type: &'static str, body: Body) -> Self {
        Self { status: 200, media_type, brotli: false, body }
    }

    /// A text response with an error message.
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

/// What requests that do something return.
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
