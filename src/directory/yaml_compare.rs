//! The events of a YAML file in step with a JSON value.

use std::borrow::Cow;
use std::collections::HashSet;
use std::ops::ControlFlow;

use saphyr_parser::{Event, Marker, Parser, ScalarStyle, ScanError, Span, Tag};
use serde_json::{Map, Value, map};

use super::json::DEPTH_LIMIT;
use super::json_scan::push_segment;
use super::position::Position;
use super::text_fault::{TextFault, TextFaultKind, TextFaults};
use super::yaml_message as message;
use super::yaml_scalar::{self, Reading};
use super::yaml_tabs::Tabs;

/// Reports how the YAML in `text` differs from `json`, and what is in it that JSON has not.
pub fn compare(text: &str, json: &Value, faults: &mut TextFaults) {
    let mut comparison = Comparison {
        root: json,
        open: Vec::new(),
        documents: 0,
        tabs: Tabs::find(text),
        faults,
    };
    let mut parser = Parser::new_from_str(text);
    while let Some(next) = parser.next_event() {
        match next {
            Ok((event, span)) => {
                if comparison.event(event, span).is_break() {
                    return;
                }
            }
            Err(error) => return comparison.stop(text, &error),
        }
    }
}

struct Comparison<'j, 'y, 'f> {
    root: &'j Value,
    open: Vec<Open<'j, 'y>>,
    documents: usize,
    tabs: Tabs<'y>,
    faults: &'f mut TextFaults,
}

/// A list or mapping that has begun and not ended.
struct Open<'j, 'y> {
    start: Position,
    /// Whether it is written with brackets.
    flow: bool,
    /// The name of the tag that stands for a key which the JSON has.
    variant: Option<String>,
    shape: Shape<'j, 'y>,
}

enum Shape<'j, 'y> {
    List {
        json: Option<&'j [Value]>,
        begun: usize,
    },
    Mapping(Mapping<'j, 'y>),
}

struct Mapping<'j, 'y> {
    json: Option<&'j Map<String, Value>>,
    /// The JSON's members that are still to come, as long as the keys come in the same order.
    rest: Option<map::Iter<'j>>,
    in_order: usize,
    /// The keys so far, once they have left the JSON's order.
    names: Option<HashSet<String>>,
    key: Option<Cow<'y, str>>,
    /// Set while a value is due: what it should be, if that is known.
    due: Option<Option<&'j Value>>,
    merging: bool,
    /// Whether keys come from elsewhere (merge keys, aliases), so that absent ones mean nothing.
    incomplete: bool,
}

/// What the JSON has to say of a key.
enum Member<'j> {
    Expected(&'j Value),
    Unknown,
    Extra,
    Repeated,
}

impl<'j, 'y> Mapping<'j, 'y> {
    fn new(json: Option<&'j Map<String, Value>>) -> Self {
        Self {
            json,
            rest: json.map(Map::iter),
            in_order: 0,
            names: None,
            key: None,
            due: None,
            merging: false,
            incomplete: false,
        }
    }

    fn find(&mut self, name: &str) -> Member<'j> {
        if self.names.is_none()
            && let Some(rest) = &mut self.rest
        {
            let mut ahead = rest.clone();
            if let Some((key, value)) = ahead.next()
                && key == name
            {
                *rest = ahead;
                self.in_order += 1;
                return Member::Expected(value);
            }
        }
        let (json, in_order) = (self.json, self.in_order);
        let names = self.names.get_or_insert_with(|| {
            let before = json.into_iter().flat_map(Map::keys).take(in_order);
            before.cloned().collect()
        });
        if !names.insert(name.to_owned()) {
            return Member::Repeated;
        }
        match json.map(|map| map.get(name)) {
            Some(Some(value)) => Member::Expected(value),
            Some(None) => Member::Extra,
            None => Member::Unknown,
        }
    }

    fn missing(&self) -> impl Iterator<Item = (&'j str, &'j Value)> {
        let json = self.json.filter(|_| !self.incomplete);
        let skip = if self.names.is_none() {
            self.in_order
        } else {
            0
        };
        json.into_iter()
            .flat_map(Map::iter)
            .skip(skip)
            .filter(|(key, _)| {
                !self
                    .names
                    .as_ref()
                    .is_some_and(|names| names.contains(*key))
            })
            .map(|(key, value)| (key.as_str(), value))
    }
}

/// What the next node is.
enum Slot<'j> {
    Key,
    /// A value, and what the JSON has there, if that is known.
    Value(Option<&'j Value>),
}

/// What a node is held against, once its tag is taken into account.
struct Target<'j> {
    json: Option<&'j Value>,
    variant: Option<String>,
    /// How a tag says that a scalar is to be read.
    forced: Option<Forced>,
}

#[derive(Clone, Copy)]
enum Forced {
    Text,
    Plain,
}

/// What kind of node a tag stands on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Node {
    Empty,
    Scalar,
    List,
    Mapping,
}

impl<'j, 'y> Comparison<'j, 'y, '_> {
    fn event(&mut self, event: Event<'y>, span: Span) -> ControlFlow<()> {
        let (at, kind) = (place(span.start), scalar_kind(&event));
        self.tabs.pass(span, kind, self.faults);
        match event {
            Event::StreamEnd if self.documents == 0 => {
                let json = self.root;
                self.differs(at, || message::differs("nothing", json));
            }
            Event::DocumentStart(_) => {
                self.documents += 1;
                if self.documents > 1 {
                    let text = "a second document begins here: keep one document in a file";
                    let fault = TextFault::new(TextFaultKind::YamlSeveralDocuments, text);
                    self.faults.push(fault.at(at));
                    return ControlFlow::Break(());
                }
            }
            Event::Alias(_) => self.alias(at),
            Event::Scalar(text, style, anchor, tag) => match self.slot() {
                Slot::Key => {
                    self.target(tag.as_deref(), anchor, None, Node::Scalar, at);
                    self.key(text, style, at);
                }
                Slot::Value(json) => {
                    let is_empty = text.is_empty() && style == ScalarStyle::Plain;
                    let node = if is_empty { Node::Empty } else { Node::Scalar };
                    let target = self.target(tag.as_deref(), anchor, json, node, at);
                    self.scalar(&text, style, &target, tag.is_some(), at);
                }
            },
            Event::SequenceStart(anchor, tag) => {
                return self.begin(Node::List, anchor, tag.as_deref(), span);
            }
            Event::MappingStart(anchor, tag) => {
                return self.begin(Node::Mapping, anchor, tag.as_deref(), span);
            }
            Event::SequenceEnd | Event::MappingEnd => self.end(),
            Event::Nothing | Event::StreamStart | Event::StreamEnd | Event::DocumentEnd => {}
        }
        ControlFlow::Continue(())
    }

    fn slot(&mut self) -> Slot<'j> {
        match self.open.last_mut().map(|open| &mut open.shape) {
            None => Slot::Value(Some(self.root)),
            Some(Shape::List { json, begun }) => {
                *begun += 1;
                Slot::Value(json.and_then(|list| list.get(*begun - 1)))
            }
            Some(Shape::Mapping(mapping)) => match mapping.due.take() {
                Some(json) => Slot::Value(json),
                None => Slot::Key,
            },
        }
    }

    fn alias(&mut self, at: Position) {
        if let Slot::Key = self.slot()
            && let Some(Shape::Mapping(mapping)) = self.open.last_mut().map(|open| &mut open.shape)
        {
            mapping.key = None;
            mapping.due = Some(None);
            mapping.incomplete = true;
        } else if let Some(Shape::Mapping(Mapping { merging: true, .. })) =
            self.open.last().map(|open| &open.shape)
        {
            // The merge key has been reported.
            return;
        }
        let text = "an alias stands for a value written elsewhere: write the value itself";
        self.report(at, TextFaultKind::YamlAnchorOrAlias, text);
    }

    fn key(&mut self, text: Cow<'y, str>, style: ScalarStyle, at: Position) {
        let Some(open) = self.open.last_mut() else {
            return;
        };
        let flow = open.flow;
        let Shape::Mapping(mapping) = &mut open.shape else {
            return;
        };
        let plain = style == ScalarStyle::Plain;
        mapping.merging = plain && text == "<<";
        if mapping.merging {
            mapping.key = Some(text);
            mapping.due = Some(None);
            mapping.incomplete = true;
            let text =
                "a merge key takes members from elsewhere: write them here (or quote the key)";
            return self.report(at, TextFaultKind::YamlMergeKey, text);
        }
        let member = mapping.find(&text);
        mapping.due = Some(match member {
            Member::Expected(value) => Some(value),
            Member::Unknown | Member::Extra | Member::Repeated => None,
        });
        mapping.key = Some(text.clone());
        if plain {
            let readings = yaml_scalar::classify(&text);
            if readings.ambiguous {
                let fault = || message::ambiguous(&text, readings, None);
                self.add(at, TextFaultKind::YamlAmbiguousScalar, fault);
            } else if readings.yaml12 != Reading::Text {
                let fault = || message::not_a_string(&text, readings.yaml12);
                self.add(at, TextFaultKind::YamlNonStringKey, fault);
            } else if flow && text.contains('?') {
                let fault = || message::question_mark(&text);
                self.add(at, TextFaultKind::YamlAmbiguousScalar, fault);
            }
        }
        let name = || message::excerpt(&text);
        match member {
            Member::Extra => self.differs(at, || TextFault {
                found: Some(name()),
                ..TextFault::new(
                    TextFaultKind::YamlDiffers,
                    format!("the YAML has a key `{}` that the JSON has not", name()),
                )
            }),
            Member::Repeated => {
                let message = format!(
                    "`{}` is named a second time in its mapping: readers differ in which they keep; remove one",
                    name()
                );
                self.report(at, TextFaultKind::YamlDuplicateKey, &message);
            }
            Member::Expected(_) | Member::Unknown => {}
        }
    }

    fn scalar(
        &mut self,
        text: &str,
        style: ScalarStyle,
        target: &Target<'j>,
        tagged: bool,
        at: Position,
    ) {
        let plain = style == ScalarStyle::Plain;
        let reading = match target.forced {
            Some(Forced::Text) => Reading::Text,
            None if !plain => Reading::Text,
            _ => {
                let readings = yaml_scalar::classify(text);
                if readings.ambiguous && plain && !tagged {
                    let fault = || message::ambiguous(text, readings, target.json);
                    self.add(at, TextFaultKind::YamlAmbiguousScalar, fault);
                }
                readings.yaml12
            }
        };
        if plain
            && reading == Reading::Text
            && self.open.last().is_some_and(|open| open.flow)
            && text.contains('?')
        {
            self.add(at, TextFaultKind::YamlAmbiguousScalar, || {
                message::question_mark(text)
            });
        }
        if let Some(json) = target.json
            && !yaml_scalar::agrees(reading, text, json)
        {
            self.differs(at, || {
                message::differs(&message::found(text, reading), json)
            });
        }
    }

    fn begin(
        &mut self,
        node: Node,
        anchor: usize,
        tag: Option<&Tag>,
        span: Span,
    ) -> ControlFlow<()> {
        let at = place(span.start);
        let json = match self.slot() {
            Slot::Value(json) => json,
            Slot::Key => {
                let text = "a list or mapping as a key: keys are strings";
                self.report(at, TextFaultKind::YamlNonStringKey, text);
                if let Some(Shape::Mapping(mapping)) =
                    self.open.last_mut().map(|open| &mut open.shape)
                {
                    mapping.key = None;
                    mapping.due = Some(None);
                }
                None
            }
        };
        let Target { json, variant, .. } = self.target(tag, anchor, json, node, at);
        if self.open.len() >= DEPTH_LIMIT {
            self.too_deep(at);
            return ControlFlow::Break(());
        }
        let fits = |json: &Value| match node {
            Node::List => json.is_array(),
            _ => json.is_object(),
        };
        if let Some(json) = json.filter(|json| !fits(json)) {
            let found = if node == Node::List {
                "a list"
            } else {
                "a mapping"
            };
            self.differs(at, || message::differs(found, json));
        }
        let shape = match node {
            Node::List => Shape::List {
                json: json.and_then(Value::as_array).map(Vec::as_slice),
                begun: 0,
            },
            _ => Shape::Mapping(Mapping::new(json.and_then(Value::as_object))),
        };
        // In block style nothing is read at the start of a list or mapping.
        let flow = self.open.last().is_some_and(|open| open.flow)
            || (tag.is_none() && anchor == 0 && !span.is_empty());
        self.open.push(Open {
            start: at,
            flow,
            variant,
            shape,
        });
        ControlFlow::Continue(())
    }

    fn end(&mut self) {
        let Some(open) = self.open.pop() else {
            return;
        };
        let with_variant = |mut pointer: String| {
            if let Some(variant) = &open.variant {
                push_segment(&mut pointer, variant);
            }
            pointer
        };
        match &open.shape {
            Shape::List { json, begun } => {
                let Some(expected) = json.map(<[Value]>::len).filter(|n| n != begun) else {
                    return;
                };
                self.faults.add(TextFaultKind::YamlDiffers, || TextFault {
                    expected: Some(expected.to_string()),
                    found: Some(begun.to_string()),
                    ..TextFault::new(
                        TextFaultKind::YamlDiffers,
                        format!(
                            "the YAML has a list of {begun} where the JSON has a list of {expected}"
                        ),
                    )
                    .at(open.start)
                    .of(with_variant(pointer(&self.open)))
                });
            }
            Shape::Mapping(mapping) => {
                for (key, value) in mapping.missing() {
                    self.faults.add(TextFaultKind::YamlDiffers, || {
                        let mut pointer = with_variant(pointer(&self.open));
                        push_segment(&mut pointer, key);
                        TextFault {
                            expected: Some(message::describe(value)),
                            ..TextFault::new(
                                TextFaultKind::YamlDiffers,
                                format!("the YAML lacks the key `{}`", message::excerpt(key)),
                            )
                            .at(open.start)
                            .of(pointer)
                        }
                    });
                }
            }
        }
    }

    /// Reports what stands before a node, and finds out what the node is to be compared with.
    fn target(
        &mut self,
        tag: Option<&Tag>,
        anchor: usize,
        json: Option<&'j Value>,
        node: Node,
        at: Position,
    ) -> Target<'j> {
        if anchor > 0 {
            let text = "an anchor names a value for use elsewhere: remove it";
            self.report(at, TextFaultKind::YamlAnchorOrAlias, text);
        }
        let mut target = Target {
            json,
            variant: None,
            forced: None,
        };
        let Some(tag) = tag else {
            return target;
        };
        let name = tag.suffix.as_str();
        let inner = match json {
            Some(Value::Object(map)) if map.len() == 1 => map.get(name),
            _ => None,
        };
        let unit = node == Node::Empty && json.and_then(Value::as_str) == Some(name);
        if tag.is_yaml_core_schema() {
            target.forced = Some(if name == "str" {
                Forced::Text
            } else {
                Forced::Plain
            });
        } else if inner.is_some() {
            target.json = inner;
            target.variant = Some(name.to_owned());
        } else if name.is_empty() || name == "!" {
            target.forced = Some(Forced::Text);
        } else {
            // The tag is the difference; one more message about it would not help.
            target.json = json.filter(|json| match node {
                Node::List => json.is_array(),
                Node::Mapping => json.is_object(),
                Node::Empty | Node::Scalar => false,
            });
        }
        let variant = target.variant.is_some();
        let written = || {
            if tag.is_yaml_core_schema() {
                format!("!!{name}")
            } else {
                format!("!{}", name.trim_start_matches('!'))
            }
        };
        let fault = || message::tag(&written(), name, unit, variant);
        self.add(at, TextFaultKind::YamlTag, fault);
        target
    }

    fn stop(&mut self, text: &str, error: &ScanError) {
        let at = place(*error.marker());
        // The scanner looks ahead in brackets, and has a limit of its own there.
        if error.info() == "recursion limit exceeded" {
            return self.too_deep(at);
        }
        let last = text.lines().count().max(1);
        let message =
            if error.marker().line() >= last && text.chars().count() <= error.marker().index() {
                format!(
                    "the file ends early, before its YAML is complete: {}",
                    error.info()
                )
            } else {
                format!("not YAML: {}", error.info())
            };
        self.report(at, TextFaultKind::YamlSyntax, &message);
    }

    fn too_deep(&mut self, at: Position) {
        let message = format!("the nesting is deeper than {DEPTH_LIMIT} levels: flatten it");
        // A pointer of a hundred segments helps nobody.
        self.faults
            .push(TextFault::new(TextFaultKind::YamlTooDeep, message).at(at));
    }

    fn report(&mut self, at: Position, kind: TextFaultKind, message: &str) {
        self.add(at, kind, || TextFault::new(kind, message));
    }

    fn differs(&mut self, at: Position, fault: impl FnOnce() -> TextFault) {
        self.add(at, TextFaultKind::YamlDiffers, fault);
    }

    /// Adds a fault of the node that is being read.
    fn add(&mut self, at: Position, kind: TextFaultKind, fault: impl FnOnce() -> TextFault) {
        let open = &self.open;
        self.faults.add(kind, || fault().at(at).of(pointer(open)));
    }
}

/// The pointer to the node that is being read, in terms of the JSON.
fn pointer(open: &[Open<'_, '_>]) -> String {
    let mut pointer = String::new();
    for open in open {
        if let Some(variant) = &open.variant {
            push_segment(&mut pointer, variant);
        }
        match &open.shape {
            Shape::List { begun, .. } => {
                push_segment(&mut pointer, &begun.saturating_sub(1).to_string());
            }
            Shape::Mapping(Mapping { key: Some(key), .. }) => push_segment(&mut pointer, key),
            Shape::Mapping(_) => {}
        }
    }
    pointer
}

fn scalar_kind(event: &Event<'_>) -> Option<ScalarStyle> {
    match event {
        Event::Scalar(_, style, ..) => Some(*style),
        _ => None,
    }
}

fn place(marker: Marker) -> Position {
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    Position {
        line: count(marker.line()),
        column: count(marker.col() + 1),
    }
}
