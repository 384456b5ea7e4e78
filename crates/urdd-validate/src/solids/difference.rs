//! The difference of two meshes in words.

use urdd_findings::finding::point;
use urdd_format::readable::metres;
use urdd_geometry::surface::Difference;

pub fn in_words(difference: &Difference) -> String {
    let counts = [
        (difference.missing, "missing"),
        (difference.extra.len(), "too many"),
        (difference.turned, "turned round"),
    ];
    let parts = counts.into_iter().filter_map(|(count, what)| match count {
        0 => None,
        1 => Some(format!("1 triangle {what}")),
        _ => Some(format!("{count} triangles {what}")),
    });
    let mut text = parts.collect::<Vec<_>>().join(", ");
    if difference.distance > 0.0 {
        text += &format!(", corners {} apart", metres(difference.distance));
    }
    text + &format!(", first at {}", point(difference.place))
}
