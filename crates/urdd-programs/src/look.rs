//! What materials look like.

use crate::effect::Effects;
use crate::fault::Fault;
use crate::number::{pieces, strtod, whole};
use crate::part::Part;
use crate::tree::Node;

/// What a material has itself.
pub(crate) struct Look {
    rgba: String,
    texture: String,
}

impl Look {
    /// None where it has nothing: a visual's material is then the name of another.
    pub fn of(material: Node<'_>) -> Option<Look> {
        let of = |element: &str, name: &str| material.child(element)?.value(name);
        let (rgba, texture) = (of("color", "rgba"), of("texture", "filename"));
        let text = |value: Option<&str>| value.unwrap_or_default().to_owned();
        rgba.or(texture).map(|_| Look { rgba: text(rgba), texture: text(texture) })
    }

    /// Says that a material is read as another one of its name, if that looks otherwise.
    pub fn compare(read: Option<&Look>, material: Node<'_>, part: &Part, effects: &mut Effects) {
        let (Some(read), Some(own)) = (read, Look::of(material)) else { return };
        if read.texture != own.texture || !is_same(&read.rgba, &own.rgba) {
            let name = material.value("name").unwrap_or_default();
            let words = if read.rgba.is_empty() { &read.texture } else { &read.rgba };
            effects.read_as(material, part, Fault::not_unique("material", name), &**words);
        }
    }
}

/// Whether nobody sees a difference of two colours: of half a step of 8 bits, as texts are rounded.
pub(crate) fn is_same(one: &str, other: &str) -> bool {
    const LEAST: f64 = 0.5 / 255.0;
    let numbers = |text| pieces(text).map(|piece| whole(strtod(piece))).collect::<Option<Vec<_>>>();
    let (Some(a), Some(b)) = (numbers(one), numbers(other)) else { return one == other };
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| (a - b).abs() <= LEAST)
}
