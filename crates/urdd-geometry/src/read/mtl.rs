//! The material library of OBJ (.mtl): diffuse colours and opacity.

use super::number::float;

/// A material of the library.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) name: String,
    color: Option<[f64; 3]>,
    opacity: f64,
    /// The image of its diffuse colour, relative to the library.
    pub(super) texture: Option<String>,
}

impl Entry {
    /// Colour and opacity; `None` with a texture.
    pub(super) fn color(&self) -> Option<[f64; 4]> {
        let [red, green, blue] = self.color.filter(|_| self.texture.is_none())?;
        Some([red, green, blue, self.opacity])
    }
}

/// The materials of a library in order, and the textures that it references.
pub(super) fn read(bytes: &[u8]) -> (Vec<Entry>, Vec<String>) {
    let mut entries: Vec<Entry> = Vec::new();
    let mut textures = Vec::new();
    let text = String::from_utf8_lossy(bytes);
    for line in text.lines() {
        let line = line.trim();
        let (keyword, rest) =
            line.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((line, ""));
        let rest = rest.trim();
        let keyword = keyword.to_ascii_lowercase();
        if keyword == "newmtl" {
            entries.push(Entry { name: rest.to_owned(), color: None, opacity: 1.0, texture: None });
            continue;
        }
        let Some(entry) = entries.last_mut() else {
            continue;
        };
        match keyword.as_str() {
            "kd" => entry.color = color(rest),
            "d" => entry.opacity = opacity(rest).unwrap_or(1.0),
            "tr" => entry.opacity = opacity(rest).map_or(1.0, |transparency| 1.0 - transparency),
            _ if keyword.starts_with("map_")
                || matches!(keyword.as_str(), "bump" | "disp" | "decal" | "norm" | "refl") =>
            {
                // Options such as `-bm 0.2` precede the name, which is last.
                let is_last = |c: char| rest.starts_with('-') && c.is_whitespace();
                let name = rest.rsplit(is_last).next().unwrap_or(rest).replace('\\', "/");
                if keyword == "map_kd" {
                    entry.texture = Some(name.clone());
                }
                textures.push(name);
            }
            _ => {}
        }
    }
    (entries, textures)
}

/// `r g b`, or `r` for all three; `None` for `spectral` and `xyz`.
fn color(text: &str) -> Option<[f64; 3]> {
    let values: Vec<f64> =
        text.split_ascii_whitespace().take(3).map(|word| float(word.as_bytes())).collect();
    let color = match *values {
        [gray] => [gray; 3],
        [red, green, blue] => [red, green, blue],
        _ => return None,
    };
    color.iter().all(|value| value.is_finite()).then(|| color.map(|value| value.clamp(0.0, 1.0)))
}

/// The first number of a `d` or `Tr` line; `-halo` may precede it.
fn opacity(text: &str) -> Option<f64> {
    let word = text.split_ascii_whitespace().find(|word| *word != "-halo")?;
    let value = float(word.as_bytes());
    value.is_finite().then(|| value.clamp(0.0, 1.0))
}
