//! Elements of an MJCF, and their attributes, with what default classes say of them.

use std::collections::HashMap;

use urdd_directory::account::Account;
use urdd_format::short::Short;

use crate::fault::{ImportFault, MjcfFault};
use crate::place::{Fallible, Place, Placing, Refusal, at};

#[derive(Debug, Clone)]
pub struct Element {
    pub tag: String,
    /// By name, in order.
    attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
    pub place: Place,
}

impl Element {
    /// An element without children. Of attributes of one name, the first counts.
    pub fn new(tag: String, mut attributes: Vec<(String, String)>, place: Place) -> Self {
        attributes.sort_by(|one, other| one.0.cmp(&other.0));
        attributes.dedup_by(|later, first| later.0 == first.0);
        Element { tag, attributes, children: Vec::new(), place }
    }

    pub fn set(&mut self, name: &str, value: String) {
        match self.attributes.binary_search_by(|(key, _)| key.as_str().cmp(name)) {
            Ok(at) => self.attributes[at].1 = value,
            Err(at) => self.attributes.insert(at, (name.to_owned(), value)),
        }
    }

    pub fn get(&self, name: &str) -> Option<&str> {
        let found = self.attributes.binary_search_by(|(key, _)| key.as_str().cmp(name));
        found.ok().map(|at| self.attributes[at].1.as_str())
    }

    /// The bytes of its attributes.
    pub fn length(&self) -> usize {
        self.attributes.iter().map(|(name, value)| name.len() + value.len()).sum()
    }

    pub fn attribute_names(&self) -> impl Iterator<Item = &str> {
        self.attributes.iter().map(|(name, _)| name.as_str())
    }

    /// The text of an attribute, unless it is empty.
    pub fn text(&self, name: &str) -> Option<&str> {
        self.get(name).filter(|text| !text.is_empty())
    }

    /// The name of its file, without folders and ending: what an asset is called that has no name.
    pub fn stem(&self) -> Option<&str> {
        let file = self.text("file")?;
        let base = file.rsplit(['/', '\\']).next().unwrap_or(file);
        Some(base.rsplit_once('.').map_or(base, |(stem, _)| stem))
    }

    /// The children of a tag.
    pub fn all(&self, tag: &str) -> impl Iterator<Item = &Element> {
        self.children.iter().filter(move |child| child.tag == tag)
    }

    /// What the sections of a tag hold, in order.
    pub fn sections(&self, tag: &str) -> impl Iterator<Item = &Element> {
        self.all(tag).flat_map(|section| &section.children)
    }
}

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

    fn flag(&self, name: &str) -> Fallible<Option<bool>> {
        let found = self.word(name, &["false", "true"], "`true` or `false`")?;
        Ok(found.map(|which| which == 1))
    }

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

pub fn required<'e>(element: &'e Element, attribute: &'static str) -> Fallible<&'e str> {
    element.text(attribute).ok_or_else(|| missing(element, attribute))
}

pub fn missing(element: &Element, attribute: &'static str) -> Refusal {
    at(element.place, MjcfFault::Missing { element: element.tag.clone(), attribute })
}

pub fn unknown(element: &Element, what: &'static str, name: &str) -> Refusal {
    let (element_name, name) = (element.tag.clone(), name.into());
    at(element.place, MjcfFault::Unknown { element: element_name, what, name })
}

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

/// The tag of the default classes of a model that is attached. No element of XML has it.
pub const CLASSES: &str = "default classes of a model";

/// The class that all others are in.
pub const MAIN: usize = 0;
/// Outermost `<default>`s: one a file. Each look-up passes all of them.
const MOST: usize = 64;
/// Classes in one another; each look-up passes all of them. Robots have up to 5.
const DEEPEST: usize = 32;

pub struct Defaults<'d> {
    classes: Vec<Class<'d>>,
    by_name: HashMap<&'d str, usize>,
    account: Account,
}

/// What looking up the attributes of an element costs for each element of its class that has some.
const LOOK_UP: usize = 100;
/// What a byte of these costs each time that it is passed: it is copied, compared, read as a number.
pub const PASSED: usize = 4;

#[derive(Default)]
struct Class<'d> {
    /// The elements of each tag, in the order in which they apply.
    elements: HashMap<&'d str, Vec<&'d Element>>,
    /// The class around it, and how many elements of each tag it had when this one began.
    around: Option<(usize, usize)>,
    /// How many sections it has.
    sections: Vec<HashMap<&'d str, usize>>,
}

impl<'d> Defaults<'d> {
    pub fn of(root: &'d Element, account: &Account) -> Fallible<Self> {
        let (classes, by_name) = (vec![Class::default()], HashMap::new());
        let mut defaults = Defaults { classes, by_name, account: account.clone() };
        defaults.by_name.insert("main", MAIN);
        for (number, section) in root.all("default").enumerate() {
            if number == MOST {
                return Err(at(section.place, MjcfFault::TooManyDefaults(MOST)));
            }
            if let Some(name) = section.text("class").filter(|name| *name != "main") {
                return Err(at(section.place, MjcfFault::MainRenamed(name.to_owned())));
            }
            defaults.section(section, MAIN, 0)?;
        }
        for section in root.all(CLASSES) {
            let main =
                defaults.new_class(section, section.text("class").unwrap_or_default(), None)?;
            for class in &section.children {
                defaults.section(class, main, 0)?;
            }
        }
        Ok(defaults)
    }

    fn section(&mut self, section: &'d Element, class: usize, depth: usize) -> Fallible<()> {
        if depth > DEEPEST {
            return Err(at(section.place, MjcfFault::DeepDefaults(DEEPEST)));
        }
        let mut seen = HashMap::new();
        for element in section.children.iter().filter(|child| child.tag != "default") {
            if seen.insert(element.tag.as_str(), ()).is_some() {
                return Err(at(element.place, MjcfFault::DefaultTwice(element.tag.clone())));
            }
            self.classes[class].elements.entry(&element.tag).or_default().push(element);
        }
        let counts =
            self.classes[class].elements.iter().map(|(tag, of)| (*tag, of.len())).collect();
        let number = self.classes[class].sections.len();
        self.classes[class].sections.push(counts);
        for nested in section.all("default") {
            let name = nested.text("class");
            let name = name.ok_or_else(|| at(nested.place, MjcfFault::DefaultWithoutClass))?;
            let inner = self.new_class(nested, name, Some((class, number)))?;
            self.section(nested, inner, depth + 1)?;
        }
        Ok(())
    }

    fn new_class(
        &mut self,
        section: &Element,
        name: &'d str,
        around: Option<(usize, usize)>,
    ) -> Fallible<usize> {
        let class = self.classes.len();
        if self.by_name.insert(name, class).is_some() {
            return Err(at(section.place, MjcfFault::ClassTwice(name.to_owned())));
        }
        self.classes.push(Class { around, ..Class::default() });
        Ok(class)
    }

    pub fn class(&self, name: &str, place: Place) -> Fallible<usize> {
        let found = self.by_name.get(name).copied();
        found.ok_or_else(|| at(place, MjcfFault::UnknownClass(name.to_owned())))
    }

    /// The class in which the children of an element are.
    pub fn scope(&self, element: &Element, around: usize) -> Fallible<usize> {
        let name = element.text("childclass");
        name.map_or(Ok(around), |name| self.class(name, element.place))
    }

    /// What a class and those around it say of a tag, the innermost first.
    pub fn chain<'s>(
        &'s self,
        class: usize,
        tag: &'s str,
    ) -> impl Iterator<Item = &'d Element> + 's {
        self.levels(class).flat_map(move |level| level.of(tag).iter().rev().copied())
    }

    /// Charges what looking up the attributes of an element costs.
    pub fn charge(&self, element: &Element, class: usize, tag: &str) -> Fallible<()> {
        let own = |of: &&Element| LOOK_UP + PASSED * of.length();
        let level = |level: Level<'_, 'd>| LOOK_UP + level.of(tag).iter().map(own).sum::<usize>();
        let passed = self.levels(class).map(level).sum();
        self.account.charge(passed).at(element.place)
    }

    /// What a class and those around it say of some tags: by class, the outermost first, in the order in which it applies.
    pub fn applied(
        &self,
        element: &Element,
        class: usize,
        tags: &[&str],
    ) -> Fallible<Vec<Vec<&'d Element>>> {
        tags.iter().try_for_each(|tag| self.charge(element, class, tag))?;
        let own = |level: Level<'_, 'd>| {
            let mut own: Vec<&Element> =
                tags.iter().flat_map(|tag| level.of(tag)).copied().collect();
            own.sort_by_key(|element| element.place);
            own
        };
        let mut applied: Vec<Vec<&Element>> = self.levels(class).map(own).collect();
        applied.reverse();
        Ok(applied)
    }

    /// A class and those around it, the innermost first.
    fn levels(&self, class: usize) -> impl Iterator<Item = Level<'_, 'd>> {
        let level =
            |class: usize, section| Some(Level { class: self.classes.get(class)?, section });
        std::iter::successors(level(class, None), move |inner| {
            let (around, section) = inner.class.around?;
            level(around, Some(section))
        })
    }
}

/// A class as one inside it sees it: up to the section that the other one is in.
struct Level<'s, 'd> {
    class: &'s Class<'d>,
    section: Option<usize>,
}

impl<'s, 'd> Level<'s, 'd> {
    fn of(&self, tag: &str) -> &'s [&'d Element] {
        let elements = self.class.elements.get(tag).map_or(&[][..], Vec::as_slice);
        let counts = self.section.and_then(|section| self.class.sections.get(section));
        let count = counts.map(|counts| counts.get(tag).copied().unwrap_or(0));
        &elements[..count.unwrap_or(elements.len()).min(elements.len())]
    }
}
