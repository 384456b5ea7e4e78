//! Reads attributes, with what default classes say of them.

use super::super::fault::ImportFault;
use super::super::refusal::{Fallible, Refusal, at};
use super::defaults::Defaults;
use super::element::Element;
use super::fault::MjcfFault;
use urdd_format::short::Short;

/// An element with its default class.
#[derive(Clone, Copy)]
pub struct View<'d> {
    pub element: &'d Element,
    defaults: &'d Defaults<'d>,
    class: usize,
}

impl<'d> View<'d> {
    /// An element in the scope of a class; its own class goes first.
    pub fn new(element: &'d Element, defaults: &'d Defaults<'d>, scope: usize) -> Fallible<Self> {
        let class = match element.get("class") {
            Some(name) => defaults.class(name, element.place)?,
            None => scope,
        };
        defaults.charge(element, class, &element.tag)?;
        Ok(View { element, defaults, class })
    }

    /// The element, then what its class and the classes around it say of its tag.
    pub fn chain(&self) -> impl Iterator<Item = &'d Element> {
        let of_class = self.defaults.chain(self.class, &self.element.tag);
        std::iter::once(self.element).chain(of_class)
    }

    /// What its class says of equalities.
    pub fn equality_default(&self) -> Option<&'d Element> {
        self.defaults.chain(self.class, "equality").find(|of| of.get("active").is_some())
    }

    /// A text that is not empty.
    pub fn text(&self, name: &str) -> Option<&'d str> {
        self.chain().find_map(|element| element.get(name)).filter(|text| !text.is_empty())
    }

    /// Up to `N` numbers: each from the first of the chain that has it.
    pub fn up_to<const N: usize>(&self, name: &'static str) -> Fallible<[Option<f64>; N]> {
        let mut found = [None; N];
        for element in self.chain().filter(|element| element.get(name).is_some()) {
            let numbers = list(element, name, N)?;
            for (slot, number) in found.iter_mut().zip(numbers) {
                slot.get_or_insert(number);
            }
        }
        Ok(found)
    }
}

/// What has attributes: an element, or one with its default class.
pub trait Attributes {
    /// The first element that has an attribute.
    fn find(&self, name: &str) -> Option<&Element>;

    /// Exactly `N` finite numbers.
    fn numbers<const N: usize>(&self, name: &str) -> Fallible<Option<[f64; N]>> {
        let Some(element) = self.find(name) else { return Ok(None) };
        let found = list(element, name, N)?;
        let wanted = match N {
            1 => "one number",
            2 => "two numbers",
            3 => "three numbers",
            4 => "four numbers",
            _ => "six numbers",
        };
        <[f64; N]>::try_from(found).map(Some).map_err(|_| wrong(element, name, wanted))
    }

    /// One finite number.
    fn number(&self, name: &str) -> Fallible<Option<f64>> {
        Ok(self.numbers::<1>(name)?.map(|[number]| number))
    }

    /// One of some words, by its place among them.
    fn word(&self, name: &str, words: &[&str], wanted: &'static str) -> Fallible<Option<usize>> {
        let Some(element) = self.find(name) else { return Ok(None) };
        let found = words.iter().position(|word| element.get(name) == Some(word));
        found.map(Some).ok_or_else(|| wrong(element, name, wanted))
    }

    /// `true` or `false`.
    fn flag(&self, name: &str) -> Fallible<Option<bool>> {
        let found = self.word(name, &["false", "true"], "`true` or `false`")?;
        Ok(found.map(|which| which == 1))
    }

    /// A whole number.
    fn integer(&self, name: &str) -> Fallible<Option<i64>> {
        let Some(element) = self.find(name) else { return Ok(None) };
        let number = element.get(name).unwrap_or_default().trim().parse();
        number.map(Some).map_err(|_| wrong(element, name, "a whole number"))
    }
}

impl Attributes for Element {
    fn find(&self, name: &str) -> Option<&Element> {
        self.get(name).map(|_| self)
    }
}

impl Attributes for View<'_> {
    fn find(&self, name: &str) -> Option<&Element> {
        self.chain().find(|element| element.get(name).is_some())
    }
}

/// No length, mass or angle is larger; products of a few numbers stay finite.
const LARGEST: f64 = 1e60;

/// Finite numbers, at most `most` of them.
pub fn list(element: &Element, name: &str, most: usize) -> Fallible<Vec<f64>> {
    let text = element.get(name).unwrap_or_default();
    let mut numbers = Vec::new();
    for word in text.split_ascii_whitespace() {
        match word.parse::<f64>() {
            Ok(number) if number.abs() <= LARGEST && numbers.len() < most => numbers.push(number),
            Ok(number) if number.abs() <= LARGEST => {
                return Err(wrong(element, name, "that short: it has too many numbers"));
            }
            _ => return Err(wrong(element, name, "a list of finite numbers")),
        }
    }
    Ok(numbers)
}

/// A text that must be there.
pub fn required<'e>(element: &'e Element, attribute: &'static str) -> Fallible<&'e str> {
    element.text(attribute).ok_or_else(|| missing(element, attribute))
}

/// An attribute that is not there.
pub fn missing(element: &Element, attribute: &'static str) -> Refusal {
    at(element.place, MjcfFault::Missing { element: element.tag.clone(), attribute })
}

/// A name of what the model does not have.
pub fn unknown(element: &Element, what: &'static str, name: &str) -> Refusal {
    let (element_name, name) = (element.tag.clone(), name.into());
    at(element.place, MjcfFault::Unknown { element: element_name, what, name })
}

/// A value that is wrong.
pub fn wrong(element: &Element, attribute: &str, wanted: &'static str) -> Refusal {
    let value = Short::of(element.get(attribute).unwrap_or_default());
    let fault = ImportFault::Value {
        element: element.tag.clone(),
        attribute: attribute.to_owned(),
        value: value.replace(char::is_control, " "),
        wanted,
    };
    at(element.place, fault)
}
