//! What is answered, whoever asks.

use serde_json::Value;

use urdd_directory::source::OpenFile;

/// What is sent.
pub enum Body {
    /// Bytes.
    Bytes(Vec<u8>),
    /// A file of this size, read while it is sent.
    File(OpenFile, u64),
}

impl Body {
    /// Its size, bytes.
    pub fn size(&self) -> u64 {
        match self {
            Body::Bytes(bytes) => bytes.len() as u64,
            Body::File(_, size) => *size,
        }
    }
}

/// An answer.
pub struct Reply {
    /// Status.
    pub status: u16,
    /// Type of the body.
    pub media_type: &'static str,
    /// Whether the body is compressed by brotli.
    pub brotli: bool,
    /// The body.
    pub body: Body,
}

/// What the page may do: run its own code and the module, read from where it came, and nothing else. Pictures in glTF
/// become blobs; glTF as JSON has `data:` in it.
pub const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
     connect-src 'self' blob: data:; img-src 'self' blob: data:; worker-src 'self'; base-uri 'none'; form-action 'none'; \
     frame-ancestors 'none'";

/// The headers of every answer, besides those of its body.
pub const HEADERS: &[(&str, &str)] = &[
    ("Content-Security-Policy", POLICY),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cache-Control", "no-store"),
];

impl Reply {
    /// Text that says what is wrong.
    pub fn failure(status: u16, message: impl Into<String>) -> Self {
        Self {
            status,
            media_type: "text/plain; charset=utf-8",
            brotli: false,
            body: Body::Bytes(message.into().into_bytes()),
        }
    }

    /// There is nothing, and nothing is wrong.
    pub fn nothing() -> Self {
        Self::failure(204, "")
    }

    /// JSON.
    pub fn json(value: &Value) -> Self {
        Self::json_text(value.to_string())
    }

    /// JSON that is text already.
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
        Self {
            status: 200,
            media_type: "image/png",
            brotli: false,
            body: Body::Bytes(body),
        }
    }

    /// A file of a robot: never shown as a page of its own.
    pub fn file(file: OpenFile, size: u64) -> Self {
        Self {
            status: 200,
            media_type: "application/octet-stream",
            brotli: false,
            body: Body::File(file, size),
        }
    }
}
