//! What materials look like.

use crate::effect::Effects;
use crate::fault::Fault;
use crate::number::{pieces, strtod};
use crate::tree::Node;

/// What a material has itself, as far as it can be read.
pub(crate) struct Look {
    rgba: Vec<f64>,
    texture: String,
    /// The colour, or else the file of the texture, as it is written.
    words: String,
}

impl Look {
    /// None where it has nothing: a visual's material is then the name of another.
    pub fn of(material: Node<'_>) -> Option<Look> {
        let of = |element: &str, name: &str| material.child(element)?.value(name);
        let (rgba, texture) = (of("color", "rgba"), of("texture", "filename"));
        let words = rgba.or(texture)?.to_owned();
        let number = |piece: &str| strtod(piece).map(|(number, _)| number);
        let rgba = pieces(rgba.unwrap_or_default()).map(number).collect::<Option<_>>()?;
        Some(Look { rgba, texture: texture.unwrap_or_default().to_owned(), words })
    }

    /// Says that a material is read as another one of its name, if that looks otherwise.
    pub fn compare(read: Option<&Look>, material: Node<'_>, part: &str, effects: &mut Effects) {
        let (Some(read), Some(own)) = (read, Look::of(material)) else { return };
        if read.rgba != own.rgba || read.texture != own.texture {
            let name = material.value("name").unwrap_or_default();
            effects.read_as(material, part, Fault::not_unique("material", name), &*read.words);
        }
    }
}
