//! Where in a text programs find something in its file.

/// How the bytes of a file become its text.
pub enum Encoding {
    /// They are the text, behind so many bytes of a mark.
    Utf8 { mark: usize },
    /// Each is a character: where it begins in the text.
    Bytes(Vec<usize>),
    /// Several are a character.
    Other,
}

impl Encoding {
    pub fn of(bytes: &[u8], text: &str) -> Self {
        if bytes.ends_with(text.as_bytes()) {
            return Encoding::Utf8 { mark: bytes.len() - text.len() };
        }
        let offsets: Vec<usize> = text.char_indices().map(|(offset, _)| offset).collect();
        if offsets.len() == bytes.len() { Encoding::Bytes(offsets) } else { Encoding::Other }
    }

    /// The offset in the text of a byte of the file, if it is known.
    pub fn in_text(&self, at: usize) -> Option<usize> {
        match self {
            Encoding::Utf8 { mark } => Some(at.saturating_sub(*mark)),
            Encoding::Bytes(offsets) => offsets.get(at).or(offsets.last()).copied(),
            Encoding::Other => None,
        }
    }
}
