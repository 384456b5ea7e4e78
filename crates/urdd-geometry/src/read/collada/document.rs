//! Elements of a COLLADA document: their lookup, their text, and the transforms of a node.

use std::borrow::Cow;
use std::collections::HashMap;

use nalgebra::{Matrix4, Rotation3, Unit, Vector3};
use percent_encoding::percent_decode_str;
use urdd_xml::Node;

use crate::read::bytes::Words;
use crate::read::scene::{Failure, Fault};

/// A document, or a part of one.
pub(super) struct Document<'a> {
    pub(super) root: Node<'a, 'a>,
    /// Elements by tag and id. Of those with the same tag and id, the first counts. The tag is part of the key because real
    /// files reuse ids across tags.
    by_id: HashMap<(&'a str, &'a str), Node<'a, 'a>>,
}

impl<'a> Document<'a> {
    /// With the ids of these elements.
    pub(super) fn new(root: Node<'a, 'a>, nodes: impl Iterator<Item = Node<'a, 'a>>) -> Self {
        let mut by_id = HashMap::new();
        for node in nodes.filter(Node::is_element) {
            if let Some(id) = node.attribute("id") {
                by_id.entry((node.tag_name().name(), id)).or_insert(node);
            }
        }
        Self { root, by_id }
    }

    /// The element with this tag that a document-internal URL references.
    pub(super) fn find(&self, tag: &str, url: &str) -> Option<Node<'a, 'a>> {
        let url = url.trim();
        let id = url.strip_prefix('#').unwrap_or(url);
        // The keys have the document's lifetime; look up with a shorter one.
        self.by_id.get(&(tag, id) as &(&str, &str)).copied()
    }

    /// The names of all image files, relative to the document.
    pub(super) fn images(&self) -> Vec<String> {
        children(self.root, "library_images")
            .flat_map(|library| children(library, "image"))
            .filter_map(file_of_image)
            .collect()
    }
}

/// The name of an image's file, relative to the document.
pub(super) fn file_of_image(image: Node<'_, '_>) -> Option<String> {
    let from = child(image, "init_from")?;
    Some(path_of_url(child(from, "ref").unwrap_or(from).text()?.trim()))
}

/// The children with this tag, in any namespace (1.4 and 1.5 have different ones).
pub(super) fn children<'a>(node: Node<'a, 'a>, tag: &'a str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.is_element() && child.tag_name().name() == tag)
}

pub(super) fn child<'a>(node: Node<'a, 'a>, tag: &'a str) -> Option<Node<'a, 'a>> {
    children(node, tag).next()
}

/// All text of an element; comments may split it.
pub(super) fn text<'a>(node: Node<'a, 'a>) -> Cow<'a, str> {
    let mut texts = node.children().filter(Node::is_text).filter_map(|part| part.text());
    let first = texts.next().unwrap_or("");
    match texts.next() {
        None => Cow::Borrowed(first),
        Some(second) => {
            Cow::Owned([first, second].into_iter().chain(texts).collect::<Vec<_>>().join(" "))
        }
    }
}

/// Converts a relative URL to a file name: decodes `%20` and the like, and replaces backslashes by slashes.
pub(crate) fn path_of_url(url: &str) -> String {
    let path = percent_decode_str(url).decode_utf8();
    path.unwrap_or(url.into()).replace('\\', "/")
}

/// The product of the node's transforms in document order: the first is outermost.
pub(super) fn transform_of(node: Node<'_, '_>) -> Result<Matrix4<f64>, Failure> {
    let mut matrix = Matrix4::identity();
    for element in node.children().filter(Node::is_element) {
        let step = match element.tag_name().name() {
            "matrix" => rows(element)?,
            "translate" => step(element, |by: [f64; 3]| Ok(Matrix4::new_translation(&by.into())))?,
            "scale" => {
                step(element, |by: [f64; 3]| Ok(Matrix4::new_nonuniform_scaling(&by.into())))?
            }
            "rotate" => step(element, |values| Ok(rotation(values)))?,
            "skew" => step(element, |values| Ok(skew(values)))?,
            "lookat" => step(element, |values| {
                let fault = "a `lookat` whose eye, interest and up lie on one line";
                look_at(values).ok_or_else(|| Fault::malformed(fault))
            })?,
            _ => continue,
        };
        matrix *= step;
    }
    Ok(matrix)
}

/// A matrix from 16 numbers, row by row.
pub(super) fn rows(element: Node<'_, '_>) -> Result<Matrix4<f64>, Failure> {
    step(element, |values: [f64; 16]| {
        let mut matrix = Matrix4::from_row_slice(&values);
        // The last row is 0 0 0 1 by definition; some files contain rounding errors there.
        matrix.set_row(3, &nalgebra::RowVector4::new(0.0, 0.0, 0.0, 1.0));
        Ok(matrix)
    })
}

/// The transform of exactly `N` numbers; where one of them is not finite, one that leaves nothing finite.
fn step<const N: usize>(
    element: Node<'_, '_>,
    of: impl FnOnce([f64; N]) -> Result<Matrix4<f64>, Failure>,
) -> Result<Matrix4<f64>, Failure> {
    let text = text(element);
    let mut words = Words::new(text.as_bytes());
    let mut values = [0.0_f64; N];
    for value in &mut values {
        let number = words.next().and_then(|word| std::str::from_utf8(word).ok()?.parse().ok());
        *value = number.ok_or_else(|| wrong(element, N))?;
    }
    if words.next().is_some() {
        return Err(wrong(element, N));
    }
    let is_finite = values.iter().all(|value| value.is_finite());
    if is_finite { of(values) } else { Ok(Matrix4::repeat(f64::NAN)) }
}

fn wrong(element: Node<'_, '_>, count: usize) -> Failure {
    Fault::malformed(format!("a `{}` does not have {count} numbers", element.tag_name().name()))
}

/// Rotation about an axis, in degrees; the identity for an axis of length 0.
fn rotation([x, y, z, degrees]: [f64; 4]) -> Matrix4<f64> {
    match Unit::try_new(Vector3::new(x, y, z), 0.0) {
        Some(axis) => Rotation3::from_axis_angle(&axis, degrees.to_radians()).to_homogeneous(),
        None => Matrix4::identity(),
    }
}

/// Shear along the second axis by an angle away from the first, as in RenderMan, whose operator COLLADA cites.
fn skew([degrees, fx, fy, fz, tx, ty, tz]: [f64; 7]) -> Matrix4<f64> {
    let (from, along) = (Vector3::new(fx, fy, fz), Vector3::new(tx, ty, tz));
    let Some(along) = along.try_normalize(0.0) else { return Matrix4::identity() };
    let Some(across) = (from - along * from.dot(&along)).try_normalize(0.0) else {
        return Matrix4::identity();
    };
    // The skew increases the angle of `from` above `across`.
    let angle = from.dot(&along).atan2(from.dot(&across));
    let shear = (angle + degrees.to_radians()).tan() - angle.tan();
    if !shear.is_finite() {
        return Matrix4::identity();
    }
    let mut matrix = Matrix4::identity();
    matrix
        .fixed_view_mut::<3, 3>(0, 0)
        .copy_from(&(nalgebra::Matrix3::identity() + along * across.transpose() * shear));
    matrix
}

/// The pose of a camera at the eye that looks along its -z towards the interest, with +y up.
fn look_at(values: [f64; 9]) -> Option<Matrix4<f64>> {
    let [eye, interest, up] =
        [0, 3, 6].map(|at| Vector3::new(values[at], values[at + 1], values[at + 2]));
    let back = (eye - interest).try_normalize(0.0)?;
    let right = up.cross(&back).try_normalize(0.0)?;
    let rotation = nalgebra::Matrix3::from_columns(&[right, back.cross(&right), back]);
    let mut matrix = rotation.to_homogeneous();
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&eye);
    Some(matrix)
}
