//! Responses of the server.

use std::sync::Arc;

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
     connect-src 'self' blob: data:; img-src 'self' blob: data:; worker-src 'self'; base-uri 'none'; form-action 'none'; \
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
    /// A text response with an error message.
    pub fn failure(status: u16, message: impl Into<String>) -> Self {
        Self {
            status,
            media_type: "text/plain; charset=utf-8",
            brotli: false,
            body: Body::Bytes(message.into().into_bytes()),
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
        Self {
            status: 200,
            media_type: "application/json",
            brotli: false,
            body: Body::Bytes(text.into_bytes()),
        }
    }

    /// A picture.
    pub fn picture(body: Vec<u8>) -> Self {
        Self { status: 200, media_type: "image/png", brotli: false, body: Body::Bytes(body) }
    }

    /// A file of a robot: never displayed as a page.
    pub fn file(file: OpenFile, size: u64) -> Self {
        Self {
            status: 200,
            media_type: "application/octet-stream",
            brotli: false,
            body: Body::File(file, size),
        }
    }
}
