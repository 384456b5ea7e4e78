//! Responses of the server.

use std::sync::Arc;

use serde::de::DeserializeOwned;
use serde_json::Value;

use urdd_directory::source::OpenFile;

/// The body of a response.
pub enum Body {
    /// Bytes.
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

/// A response.
pub struct Reply {
    /// The HTTP status code.
    pub status: u16,
    /// The media type of the body.
    pub media_type: &'static str,
    /// Whether the body is compressed with Brotli.
    pub brotli: bool,
    /// The body.
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

    /// JSON.
    pub fn json(value: &Value) -> Self {
        Self::json_text(value.to_string())
    }

    /// JSON that is already text.
    pub fn json_text(text: String) -> Self {
        Self::ok("application/json", Body::Bytes(text.into_bytes()))
    }
}

/// Why a request was not done: an HTTP status, and the reason.
pub type Failure = (u16, String);

/// Reads the JSON that the page sends; `what` says what it is to be.
///
/// # Errors
/// If it is something else.
pub fn wish<T: DeserializeOwned>(body: &[u8], what: &str) -> Result<T, Failure> {
    serde_json::from_slice(body).map_err(|error| (400, format!("not {what}: {error}")))
}
