//! Compares a URDF by meaning with another text of the robot: where it says something else. Formatting, comments, the order of
//! attributes and parts, and how a number is written make no difference; what is absent is URDF's default.

use std::collections::{BTreeSet, HashMap, VecDeque};

use urdd_format::short::Short;
use urdd_xml::Node;
use urdd_xml::element::{attribute, children, name};

use crate::rounding::half_unit;

/// Numbers are the same up to this part of the largest beside them.
const SAME: f64 = 1e-6;
/// So are numbers that are rounded to fewer digits, from five on: the largest part that rounding to five digits takes away.
const ROUNDED: f64 = 5e-5;
/// Numbers up to this are 0.
const ZERO: f64 = 1e-12;

/// What attributes are where they are absent, by their elements.
const DEFAULTS: [(&str, &str, &str); 11] = [
    ("axis", "xyz", "1 0 0"),
    ("dynamics", "damping", "0"),
    ("dynamics", "friction", "0"),
    ("limit", "lower", "0"),
    ("limit", "upper", "0"),
    ("mesh", "scale", "1 1 1"),
    ("mimic", "multiplier", "1"),
    ("mimic", "offset", "0"),
    ("origin", "rpy", "0 0 0"),
    ("origin", "xyz", "0 0 0"),
    ("robot", "version", "1.0"),
];
/// Elements that say nothing where all that they say is the default.
const OPTIONAL: [&str; 3] = ["axis", "dynamics", "origin"];
/// Elements that are told apart by their order.
const ORDERED: [&str; 2] = ["visual", "collision"];

/// What a material says.
const LOOKS: [(&str, &str); 2] = [("color", "rgba"), ("texture", "filename")];

/// The differences of a URDF.
#[derive(Default)]
pub struct Differences<'a> {
    /// The element of the first, its attribute, and what is said of it. Looks, and what only some programs read, come last.
    pub first: Option<(Node<'a, 'a>, Option<&'a str>, String)>,
    is_last: bool,
    /// Their number.
    pub count: usize,
}

/// Elements whose differences are named where there are no others.
const LAST: [&str; 4] = ["material", "gazebo", "transmission", "ros2_control"];

/// Compares two elements `<robot>`. `is_same_file` says of two names that differ whether both are those of one file.
pub fn differences<'a, 'b>(
    urdf: Node<'a, 'a>,
    made: Node<'b, 'b>,
    is_same_file: &dyn Fn(&str, &str) -> bool,
) -> Differences<'a> {
    let looks = (Looks::of(urdf), Looks::of(made));
    let mut comparison = Comparison { looks, is_same_file, found: Differences::default() };
    comparison.compare(urdf, made);
    comparison.found
}

struct Comparison<'a, 'b, 'f> {
    looks: (Looks<'a>, Looks<'b>),
    is_same_file: &'f dyn Fn(&str, &str) -> bool,
    found: Differences<'a>,
}

impl<'a, 'b> Comparison<'a, 'b, '_> {
    fn add(&mut self, node: Node<'a, 'a>, attribute: Option<&'a str>, words: String) {
        let found = &mut self.found;
        found.count += 1;
        let is_last = node.ancestors().any(|above| LAST.contains(&above.tag_name().name()));
        if found.first.is_none() || found.is_last && !is_last {
            (found.first, found.is_last) = (Some((node, attribute, words)), is_last);
        }
    }

    fn compare(&mut self, urdf: Node<'a, 'a>, made: Node<'b, 'b>) {
        let element = name(urdf);
        if element == "material" {
            let values = self.looks.0.values(urdf).into_iter().zip(self.looks.1.values(made));
            for ((element, key), (a, b)) in LOOKS.into_iter().zip(values) {
                if !is_same_value(element, key, a, b, self.is_same_file) {
                    self.add(urdf, None, words(element, key, a, b));
                }
            }
            return;
        }
        let keys = |node: Node| {
            let own = node.attributes().filter(|one| one.namespace().is_none());
            own.map(|one| one.name().to_owned()).collect::<BTreeSet<String>>()
        };
        for key in keys(urdf).union(&keys(made)) {
            let own = attribute(urdf, key);
            let value = own.map(|one| one.value());
            let other = attribute(made, key).map(|one| one.value());
            if !is_same_value(element, key, value, other, self.is_same_file) {
                self.add(urdf, own.map(|one| one.name()), words(element, key, value, other));
            }
        }
        let (own, other) = (parts(urdf), parts(made));
        if own.is_empty() && other.is_empty() {
            let (a, b) = (text(urdf), text(made));
            if !is_same_value("", "", Some(a), Some(b), self.is_same_file) {
                let [a, b] = [a, b].map(Short::of);
                self.add(urdf, None, format!("the text is `{a}`, and xacro makes `{b}`"));
            }
        }
        let partners = partners(&own, &other, urdf.parent_element().is_none());
        for (node, partner) in own.iter().zip(&partners) {
            match partner {
                Some(partner) => self.compare(*node, other[*partner]),
                None if is_default(*node) => {}
                None => self.add(*node, None, format!("xacro makes no such `<{}>`", name(*node))),
            }
        }
        let taken: BTreeSet<usize> = partners.into_iter().flatten().collect();
        let missing = other.iter().enumerate();
        let missing = missing.filter(|(at, node)| !taken.contains(at) && !is_default(**node));
        for (_, node) in missing {
            let of = Some(label(*node)).filter(|label| !label.is_empty());
            let of = of.map(|label| format!(" `{}`", Short::of(label))).unwrap_or_default();
            let element = Short::of(node.tag_name().name());
            self.add(urdf, None, format!("`<{element}>`{of} is missing"));
        }
    }
}

fn text<'d>(node: Node<'d, 'd>) -> &'d str {
    node.text().map(str::trim).unwrap_or_default()
}

/// The materials at the top, by their names.
struct Looks<'d>(HashMap<&'d str, [Option<&'d str>; 2]>);

impl<'d> Looks<'d> {
    fn of(robot: Node<'d, 'd>) -> Self {
        let mut all: HashMap<&str, [Option<&str>; 2]> = HashMap::new();
        for (_, top) in children(robot).filter(|(name, _)| *name == "material") {
            let known = all.entry(top.attribute("name").unwrap_or_default()).or_default();
            let own = own_looks(top);
            *known = [known[0].or(own[0]), known[1].or(own[1])];
        }
        Looks(all)
    }

    /// The colour and the texture of a material; what it does not state is that of the one of its name at the top.
    fn values(&self, material: Node<'d, 'd>) -> [Option<&'d str>; 2] {
        let name = material.attribute("name").unwrap_or_default();
        let (own, top) = (own_looks(material), self.0.get(name).copied().unwrap_or_default());
        [own[0].or(top[0]), own[1].or(top[1])]
    }
}

fn own_looks<'d>(material: Node<'d, 'd>) -> [Option<&'d str>; 2] {
    LOOKS.map(|(element, key)| {
        let found = children(material).find(|(name, _)| *name == element);
        found.and_then(|(_, found)| found.attribute(key))
    })
}

fn words(element: &str, key: &str, own: Option<&str>, other: Option<&str>) -> String {
    let words = match (own, other) {
        (Some(a), Some(b)) => format!("is `{}`, and xacro makes `{}`", Short::of(a), Short::of(b)),
        (Some(a), None) => format!("is `{}`, and xacro makes none", Short::of(a)),
        (None, other) => {
            format!("is missing, and xacro makes `{}`", Short::of(other.unwrap_or_default()))
        }
    };
    format!("`{}` of `<{}>` {words}", Short::of(key), Short::of(element))
}

/// The elements in one that mean something. Materials at the top do where links use them.
fn parts<'d>(node: Node<'d, 'd>) -> Vec<Node<'d, 'd>> {
    let turns = !matches!(node.attribute("type"), Some("fixed" | "floating"));
    let is_top = node.parent_element().is_none();
    let is_some = |(name, _): &(&str, Node)| match *name {
        "axis" => turns,
        "material" => !is_top,
        _ => true,
    };
    children(node).filter(is_some).map(|(_, child)| child).collect()
}

/// The name of an element, or what it refers to.
fn label<'d>(node: Node<'d, 'd>) -> &'d str {
    let of = ["name", "reference"].into_iter().find_map(|key| node.attribute(key));
    of.filter(|_| !ORDERED.contains(&node.tag_name().name())).unwrap_or_default()
}

/// For each element the one that is compared with it: of the same kind and label; inside of links and other parts also of the
/// same kind alone, in order.
fn partners(own: &[Node], other: &[Node], is_top: bool) -> Vec<Option<usize>> {
    let mut partners = vec![None; own.len()];
    let mut taken = vec![false; other.len()];
    for by_label in [true, false] {
        if is_top && !by_label {
            break;
        }
        let key = |node: &Node<'_, '_>| {
            let of = if by_label { label(*node) } else { "" };
            (node.tag_name().name().to_owned(), of.to_owned())
        };
        let mut free: HashMap<(String, String), VecDeque<usize>> = HashMap::new();
        for (at, node) in other.iter().enumerate().filter(|(at, _)| !taken[*at]) {
            free.entry(key(node)).or_default().push_back(at);
        }
        for (partner, node) in partners.iter_mut().zip(own).filter(|(one, _)| one.is_none()) {
            *partner = free.get_mut(&key(node)).and_then(VecDeque::pop_front);
            partner.iter().for_each(|at| taken[*at] = true);
        }
    }
    partners
}

fn default(element: &str, key: &str) -> Option<&'static str> {
    let mut all = DEFAULTS.iter();
    all.find(|(of, name, _)| (*of, *name) == (element, key)).map(|(_, _, value)| *value)
}

fn is_default(node: Node) -> bool {
    let element = node.tag_name().name();
    let is_one = |key: &str, value| {
        let known = default(element, key);
        known.is_some() && is_same_value(element, key, Some(value), known, &|_, _| false)
    };
    OPTIONAL.contains(&element) && node.attributes().all(|one| is_one(one.name(), one.value()))
}

fn is_same_value(
    element: &str,
    key: &str,
    a: Option<&str>,
    b: Option<&str>,
    is_same_file: &dyn Fn(&str, &str) -> bool,
) -> bool {
    let default = default(element, key);
    let (a, b) = match (a.or(default), b.or(default)) {
        (Some(a), Some(b)) => (a.trim(), b.trim()),
        (a, b) => return a == b,
    };
    if let (Some(a), Some(b)) = (numbers(a, element), numbers(b, element)) {
        let largest = a.iter().chain(&b).fold(0.0, |most: f64, (one, _)| most.max(one.abs()));
        let is_near = |((a, of_a), (b, of_b)): (&(f64, f64), &(f64, f64))| {
            let rounding = of_a.max(*of_b).min(ROUNDED * a.abs().max(b.abs()));
            (a - b).abs() <= (SAME * largest + ZERO).max(rounding * (1.0 + SAME))
        };
        return a.len() == b.len() && a.iter().zip(&b).all(is_near);
    }
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    words(a) == words(b)
        || key == "filename" && (is_of_package(a, b) || is_of_package(b, a) || is_same_file(a, b))
}

/// The numbers of a value, each with half a unit in its last place; those of an axis, of length 1.
fn numbers(text: &str, element: &str) -> Option<Vec<(f64, f64)>> {
    let number = |word: &str| Some((word.parse().ok()?, half_unit(word)));
    let numbers: Option<Vec<(f64, f64)>> = text.split_whitespace().map(number).collect();
    let numbers =
        numbers.filter(|all| !all.is_empty() && all.iter().all(|(one, _)| one.is_finite()))?;
    let length = numbers.iter().map(|(one, _)| one * one).sum::<f64>().sqrt();
    let by = if element == "axis" && length > 0.0 { length } else { 1.0 };
    Some(numbers.iter().map(|(one, half)| (one / by, half / by)).collect())
}

/// Whether a path leads to what is called `package://PACKAGE/...`, as that of `$(find PACKAGE)/...` does.
fn is_of_package(name: &str, path: &str) -> bool {
    let inside = name.strip_prefix("package://").and_then(|inside| path.strip_suffix(inside));
    inside.is_some_and(|above| above.ends_with('/'))
}
