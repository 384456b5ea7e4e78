//! The page's own files, from `dist/`, which `page/build.mjs` builds.

use std::io::{self, Read};

use brotli_decompressor::Decompressor;

#[derive(Debug, Clone, Copy)]
pub struct Asset {
    pub name: &'static str,
    pub media_type: &'static str,
    /// Its content, compressed with Brotli.
    pub brotli: &'static [u8],
}

macro_rules! asset {
    ($name:literal, $type:literal) => {
        Asset {
            name: $name,
            media_type: $type,
            brotli: include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/dist/", $name, ".br")),
        }
    };
}

pub const ASSETS: &[Asset] = &[
    asset!("index.html", "text/html; charset=utf-8"),
    asset!("app.js", "text/javascript; charset=utf-8"),
    asset!("editor.js", "text/javascript; charset=utf-8"),
    asset!("worker.js", "text/javascript; charset=utf-8"),
    asset!("make.js", "text/javascript; charset=utf-8"),
    asset!("style.css", "text/css; charset=utf-8"),
    asset!("urdd.wasm", "application/wasm"),
    asset!("make.wasm", "application/wasm"),
];

/// The module without the validator, for a page in one file, which includes the report.
pub const ROBOT_MODULE: Asset = asset!("robot.wasm", "application/wasm");

pub fn find(name: &str) -> Option<&'static Asset> {
    ASSETS.iter().find(|asset| asset.name == name)
}

impl Asset {
    pub fn bytes(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        Decompressor::new(self.brotli, 1 << 16).read_to_end(&mut bytes)?;
        Ok(bytes)
    }
}

/// The page for `urdd view`'s own server, instead of a static one.
pub fn live_page() -> io::Result<String> {
    let index = find("index.html").map_or_else(|| Ok(Vec::new()), Asset::bytes)?;
    let text = String::from_utf8(index).map_err(io::Error::other)?;
    Ok(text.replace(
        r#"<meta name="urdd-mode" content="static" />"#,
        r#"<meta name="urdd-mode" content="live" />"#,
    ))
}

/// The page with its files renamed: each name with its replacement path; and with the view that it shows first.
pub fn page_of(page: &str, names: &[(&str, String)], opens: Option<&str>) -> String {
    let mut text = page.to_owned();
    let mut said = String::new();
    for (name, path) in names {
        text = text.replace(&format!("\"{name}\""), &format!("\"{path}\""));
        said.push_str(&format!("{name} {path} "));
    }
    let mode = r#"<meta name="urdd-mode" content="static" />"#;
    let mut head = format!("{mode}\n    {}", meta("urdd-files", said.trim_end()));
    if let Some(view) = opens {
        head.push_str(&format!("\n    {}", meta("urdd-opens", view)));
    }
    text.replace(mode, &head)
}

fn meta(name: &str, content: &str) -> String {
    let content = content.replace('&', "&amp;").replace('"', "&quot;");
    format!(r#"<meta name="{name}" content="{content}" />"#)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_whole() {
        for asset in ASSETS {
            let bytes = asset.bytes().expect(asset.name);
            assert!(bytes.len() > asset.brotli.len() / 2, "{}", asset.name);
        }
        let page = live_page().expect("a page");
        assert!(page.contains(r#"content="live""#), "{page}");
        assert!(page.contains("wasm-unsafe-eval"), "{page}");
        // A hash of the page's sources (`page/build.mjs`).
        assert_eq!(include_str!("../dist/stamp").trim().len(), 64);
    }
}
