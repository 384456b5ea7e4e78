//! An element of an SDF, and the values in it.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use urdd_xml::{Mended, Node, element};

use crate::fault::{ImportFault, SdfFault};
use crate::features::Tally;
use crate::place::{Fallible, Place, at};

/// The last minor version in which `relative_to` may be called `frame`.
const RENAMED: u32 = 6;

#[derive(Clone, Copy)]
pub struct Tag<'a> {
    pub node: Node<'a, 'a>,
    pub file: usize,
    /// What was made of its text.
    pub mended: &'a Mended,
    /// The minor version of SDF of the file.
    pub version: u32,
}

impl<'a> Tag<'a> {
    pub fn name(self) -> &'a str {
        element::name(self.node)
    }

    pub fn place(self) -> Place {
        let offset = self.mended.original(self.node.range().start);
        Place { file: self.file, offset }
    }

    /// The value of an attribute that is not empty.
    pub fn attribute(self, name: &str) -> Option<&'a str> {
        let found = element::attribute(self.node, name)?;
        Some(found.value()).filter(|value| !value.trim().is_empty())
    }

    /// Whether an attribute says yes.
    pub fn says(self, attribute: &str) -> bool {
        self.attribute(attribute).is_some_and(is_true)
    }

    pub fn own_name(self) -> Fallible<String> {
        match self.attribute("name") {
            Some(name) => Ok(name.to_owned()),
            None => Err(at(self.place(), SdfFault::NoName(self.name().to_owned()))),
        }
    }

    pub fn children(self) -> impl Iterator<Item = Tag<'a>> {
        element::children(self.node).map(move |(_, node)| Tag { node, ..self })
    }

    /// The first child element of a name.
    pub fn child(self, name: &str) -> Option<Tag<'a>> {
        self.children().find(|child| child.name() == name)
    }

    /// The child element at a path of names.
    pub fn descendant(self, path: &[&str]) -> Option<Tag<'a>> {
        path.iter().try_fold(self, |tag, name| tag.child(name))
    }

    /// Its characters, without white space around them.
    pub fn text(self) -> String {
        let texts = self.node.children().filter(Node::is_text).filter_map(|node| node.text());
        texts.collect::<String>().trim().to_owned()
    }

    /// The characters of a child element that is there and not empty.
    pub fn words(self, child: &str) -> Option<String> {
        self.child(child).map(Tag::text).filter(|text| !text.is_empty())
    }

    pub fn refuse<T>(self, value: &str, wanted: &'static str) -> Fallible<T> {
        let (element, value) = (self.name().to_owned(), value.to_owned());
        let attribute = "text".to_owned();
        Err(at(self.place(), ImportFault::Value { element, attribute, value, wanted }))
    }

    /// Its numbers; none if it is empty.
    fn values(self) -> Fallible<Option<Vec<f64>>> {
        let text = self.text();
        let values = text.split_whitespace().map(|word| {
            let value = word.parse::<f64>().ok().filter(|value| !value.is_nan());
            value.map_or_else(|| self.refuse(word, "a number"), Ok)
        });
        let values = values.collect::<Fallible<Vec<f64>>>()?;
        Ok((!values.is_empty()).then_some(values))
    }

    /// Its finite numbers, which are as many as `N`; none if it is empty.
    pub fn numbers<const N: usize>(self, wanted: &'static str) -> Fallible<Option<[f64; N]>> {
        let Some(values) = self.values()? else { return Ok(None) };
        match <[f64; N]>::try_from(values) {
            Ok(values) if values.iter().all(|value| value.is_finite()) => Ok(Some(values)),
            _ => self.refuse(&self.text(), wanted),
        }
    }

    /// The finite number in a child element.
    pub fn number(self, child: &str) -> Fallible<Option<f64>> {
        let Some(tag) = self.child(child) else { return Ok(None) };
        Ok(tag.numbers::<1>("a finite number")?.map(|[value]| value))
    }

    /// The number in a child element, which may be infinite.
    pub fn any_number(self, child: &str) -> Fallible<Option<f64>> {
        let Some(tag) = self.child(child) else { return Ok(None) };
        match tag.values()?.as_deref() {
            None => Ok(None),
            Some([value]) => Ok(Some(*value)),
            Some(_) => tag.refuse(&tag.text(), "a number"),
        }
    }

    /// Whether a child element says so.
    pub fn flag(self, child: &str) -> bool {
        self.words(child).is_some_and(|text| is_true(&text))
    }

    /// Refuses an element for what is not in it.
    pub fn lacks<T>(self, child: &'static str) -> Fallible<T> {
        Err(at(self.place(), SdfFault::Missing { element: self.name().to_owned(), child }))
    }

    /// The size that SDF gives a shape without this child element, m.
    pub fn default_size(self, child: &str) -> f64 {
        if (self.name(), child) == ("capsule", "radius") { 0.5 } else { 1.0 }
    }

    /// The number in a child element, which must not be less than 0; the size that SDF gives without it.
    pub fn size(self, child: &'static str) -> Fallible<f64> {
        match self.number(child)? {
            None if self.child(child).is_none() => Ok(self.default_size(child)),
            Some(value) if value >= 0.0 => Ok(value),
            Some(value) => self.refuse(&value.to_string(), "at least 0"),
            None => self.lacks(child),
        }
    }

    /// The pose in its `<pose>`, and the frame that it is relative to.
    pub fn pose(self) -> Fallible<(Isometry3<f64>, Option<String>)> {
        let Some(tag) = self.child("pose") else { return Ok((Isometry3::identity(), None)) };
        let older = element::attribute(tag.node, "frame").filter(|_| tag.version <= RENAMED);
        // One that is empty counts too: libsdformat moves it over the newer name.
        let relative = older.or_else(|| element::attribute(tag.node, "relative_to"));
        let relative = relative.map(|name| name.value().trim().to_owned());
        let relative = relative.filter(|name| !name.is_empty());
        let is_quaternion = tag.attribute("rotation_format") == Some("quat_xyzw");
        let pose = match is_quaternion {
            true => {
                let wanted = "seven finite numbers: a position and a quaternion x, y, z, w";
                let Some([x, y, z, i, j, k, w]) = tag.numbers::<7>(wanted)? else {
                    return Ok((Isometry3::identity(), relative));
                };
                let quaternion = Quaternion::new(w, i, j, k);
                let Some(rotation) = UnitQuaternion::try_new(quaternion, 0.0) else {
                    return tag.refuse(&tag.text(), wanted);
                };
                Isometry3::from_parts(Translation3::new(x, y, z), rotation)
            }
            false => {
                let wanted = "six finite numbers: a position, and roll, pitch and yaw";
                let Some([x, y, z, r, p, yaw]) = tag.numbers::<6>(wanted)? else {
                    return Ok((Isometry3::identity(), relative));
                };
                let is_degrees = tag.says("degrees");
                let [r, p, yaw] =
                    if is_degrees { [r, p, yaw].map(f64::to_radians) } else { [r, p, yaw] };
                let rotation = UnitQuaternion::from_euler_angles(r, p, yaw);
                Isometry3::from_parts(Translation3::new(x, y, z), rotation)
            }
        };
        Ok((pose, relative))
    }

    /// The vector in a child element.
    pub fn vector(self, child: &str) -> Fallible<Option<Vector3<f64>>> {
        let Some(tag) = self.child(child) else { return Ok(None) };
        Ok(tag.numbers::<3>("three finite numbers")?.map(Vector3::from))
    }

    /// Counts each child element that is not one of these as lost.
    pub fn unread(self, known: &[&str], tally: &mut Tally) {
        for child in self.children().filter(|child| !known.contains(&child.name())) {
            tally.unread(format!("`<{}>` of `<{}>`", child.name(), self.name()));
        }
    }
}

/// Whether a text says yes.
pub fn is_true(text: &str) -> bool {
    let text = text.trim();
    text == "1" || text.eq_ignore_ascii_case("true")
}
