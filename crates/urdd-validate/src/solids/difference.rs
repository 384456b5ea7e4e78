//! The difference of two meshes in words.

use urdd_geometry::surface::Difference;

/// The difference in words.
pub fn in_words(difference: &Difference) -> String {
    let mut parts = Vec::new();
    let count = |n: usize, what: &str| match n {
        1 => format!("1 triangle {what}"),
        n => format!("{n} triangles {what}"),
    };
    if difference.missing > 0 {
        parts.push(count(difference.missing, "missing"));
    }
    if !difference.extra.is_empty() {
        parts.push(count(difference.extra.len(), "too many"));
    }
    if difference.turned > 0 {
        parts.push(count(difference.turned, "turned round"));
    }
    let mut text = parts.join(", ");
    if difference.distance > 0.0 {
        text.push_str(&format!(
            ", corners {} apart",
            urdd_format::readable::metres(difference.distance)
        ));
    }
    text.push_str(&format!(", first at {}", urdd_findings::finding::point(difference.place)));
    text
}
