//! Default classes: what elements have that do not say it themselves.

use std::collections::HashMap;

use urdd_directory::account::Account;

use super::super::place::Place;
use super::super::refusal::{Fallible, Placing, at};
use super::element::Element;
use super::fault::MjcfFault;

/// The tag of the default classes of a model that is attached. No element of XML has it.
pub const CLASSES: &str = "default classes of a model";

/// The class that all others are in.
pub const MAIN: usize = 0;
/// Outermost `<default>`s: one a file. Each look-up passes all of them.
const MOST: usize = 64;
/// Classes in one another; each look-up passes all of them. Robots have up to 5.
const DEEPEST: usize = 32;

/// The classes of a model.
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
    /// The classes that the `<default>`s of a model define.
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

    /// A class by name.
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
