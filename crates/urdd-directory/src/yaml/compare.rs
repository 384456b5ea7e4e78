//! Compares the events of a YAML file with a JSON value.

use std::borrow::Cow;
use std::ops::ControlFlow;

use saphyr_parser::{Event, Marker, Parser, ScalarStyle, ScanError, Span, Tag};
use serde_json::Value;

use super::open::{
    self, Forced, Mapping, Member, Node, Open, Shape, Target, apply_tag, pointer, tag_fault,
};
use super::scalar::{self, End, Keys, OUTDENTED, Outdents, Reading, TORN, Tabs};
use crate::json_scan::push_segment;
use crate::limits::DEPTH_LIMIT;
use crate::position::{Position, TextFault, TextFaultKind, TextFaults};

/// Reports how the YAML in `text` differs from `json`, and every construct that JSON lacks.
pub fn compare(text: &str, json: &Value, faults: &mut TextFaults) {
    let mut comparison = Comparison {
        root: json,
        open: Vec::new(),
        documents: 0,
        tabs: Tabs::find(text),
        keys: Keys::new(text),
        outdents: Outdents::new(text),
        end: End::new(text),
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
    tabs: Tabs,
    keys: Keys<'y>,
    outdents: Outdents<'y>,
    end: End<'y>,
    faults: &'f mut TextFaults,
}

/// The role of the next node.
enum Slot<'j> {
    Key,
    /// A value, with the corresponding JSON value, if known.
    Value(Option<&'j Value>),
}

impl<'j, 'y> Comparison<'j, 'y, '_> {
    fn event(&mut self, event: Event<'y>, span: Span) -> ControlFlow<()> {
        let at = place(span.start);
        let style = match &event {
            Event::Scalar(_, style, ..) => Some(*style),
            _ => None,
        };
        self.tabs.pass(span, style, self.faults);
        match event {
            Event::StreamEnd if self.documents == 0 => {
                let json = self.root;
                self.differs(at, || open::differs("nothing", json));
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
            Event::Scalar(text, style, anchor, tag) => {
                let is_disputed = self.end.is_disputed(&text, style, span);
                match self.slot() {
                    Slot::Key => {
                        self.target(tag.as_deref(), anchor, None, Node::Scalar, at);
                        self.key(text, style, at);
                        if self.is_flow() && self.keys.is_torn(span) {
                            self.report(at, TextFaultKind::YamlSyntax, TORN);
                        }
                    }
                    Slot::Value(json) => {
                        let is_empty = text.is_empty() && style == ScalarStyle::Plain;
                        let node = if is_empty { Node::Empty } else { Node::Scalar };
                        let target = self.target(tag.as_deref(), anchor, json, node, at);
                        // Readers differ about its last line break: with or without is right (SPEC 3.2.3).
                        let shorter = text.strip_suffix('\n').filter(|shorter| {
                            is_disputed && json.is_some_and(|json| json == *shorter)
                        });
                        let text = shorter.unwrap_or(&text);
                        self.scalar(text, style, &target, tag.is_some(), at);
                    }
                }
            }
            Event::SequenceStart(anchor, tag) => {
                return self.begin(Node::List, anchor, tag.as_deref(), span);
            }
            Event::MappingStart(anchor, tag) => {
                return self.begin(Node::Mapping, anchor, tag.as_deref(), span);
            }
            Event::SequenceEnd | Event::MappingEnd => self.end(span),
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

    /// The open mapping, if the next node is in one.
    fn mapping(&mut self) -> Option<&mut Mapping<'j, 'y>> {
        match &mut self.open.last_mut()?.shape {
            Shape::Mapping(mapping) => Some(mapping),
            Shape::List { .. } => None,
        }
    }

    fn is_flow(&self) -> bool {
        self.open.last().is_some_and(|open| open.flow)
    }

    fn alias(&mut self, at: Position) {
        let is_key = matches!(self.slot(), Slot::Key);
        match self.mapping() {
            Some(mapping) if is_key => mapping.skip_key(),
            // The merge key is already reported.
            Some(Mapping { merging: true, .. }) => return,
            _ => {}
        }
        let text = "an alias refers to a value written elsewhere: write the value itself";
        self.report(at, TextFaultKind::YamlAnchorOrAlias, text);
    }

    fn key(&mut self, text: Cow<'y, str>, style: ScalarStyle, at: Position) {
        let flow = self.is_flow();
        let Some(mapping) = self.mapping() else {
            return;
        };
        let plain = style == ScalarStyle::Plain;
        mapping.merging = plain && text == "<<";
        if mapping.merging {
            mapping.skip_key();
            mapping.key = Some(text);
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
            self.plain_key(&text, flow, at);
        }
        match member {
            Member::Extra => self.differs(at, || open::extra_key(&text)),
            Member::Repeated => {
                let kind = TextFaultKind::YamlDuplicateKey;
                self.add(at, kind, || open::repeated_key(&text));
            }
            Member::Expected(_) | Member::Unknown => {}
        }
    }

    /// Reports ambiguous and non-string plain keys.
    fn plain_key(&mut self, text: &str, flow: bool, at: Position) {
        let readings = scalar::classify(text);
        let kind = TextFaultKind::YamlAmbiguousScalar;
        if readings.ambiguous {
            self.add(at, kind, || open::ambiguous(text, readings, None));
        } else if readings.yaml12 != Reading::Text {
            let kind = TextFaultKind::YamlNonStringKey;
            self.add(at, kind, || open::not_a_string(text, readings.yaml12));
        } else if flow && text.contains('?') {
            self.add(at, kind, || open::question_mark(text));
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
                let readings = scalar::classify(text);
                if readings.ambiguous && plain && !tagged {
                    let fault = || open::ambiguous(text, readings, target.json);
                    self.add(at, TextFaultKind::YamlAmbiguousScalar, fault);
                }
                readings.yaml12
            }
        };
        if plain && reading == Reading::Text && self.is_flow() && text.contains('?') {
            self.add(at, TextFaultKind::YamlAmbiguousScalar, || open::question_mark(text));
        }
        if let Some(json) = target.json
            && !scalar::agrees(reading, text, json)
        {
            self.differs(at, || open::differs(&open::found(text, reading), json));
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
                if let Some(mapping) = self.mapping() {
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
        let (list, object) = (json.and_then(Value::as_array), json.and_then(Value::as_object));
        let (found, fits, shape) = if node == Node::List {
            let shape = Shape::List { json: list.map(Vec::as_slice), begun: 0 };
            ("a list", list.is_some(), shape)
        } else {
            ("a mapping", object.is_some(), Shape::Mapping(Mapping::new(object)))
        };
        if let Some(json) = json.filter(|_| !fits) {
            self.differs(at, || open::differs(found, json));
        }
        // In block style, the start event of a list or mapping has an empty span.
        let flow = self.is_flow() || (tag.is_none() && anchor == 0 && !span.is_empty());
        self.open.push(Open { start: at, flow, variant, shape });
        ControlFlow::Continue(())
    }

    fn end(&mut self, span: Span) {
        let Some(open) = self.open.pop() else {
            return;
        };
        if open.flow
            && let Some(around) = self.open.last().filter(|around| !around.flow)
            && let Some(at) = {
                let lines = open.start.line as usize + 1..=span.start.line();
                self.outdents.find(lines, around.start.column as usize)
            }
        {
            self.report(at, TextFaultKind::YamlSyntax, OUTDENTED);
        }
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
                self.faults.add(TextFaultKind::YamlDiffers, || {
                    open::length(*begun, expected)
                        .at(open.start)
                        .of(with_variant(pointer(&self.open)))
                });
            }
            Shape::Mapping(mapping) => {
                for (key, value) in mapping.missing() {
                    self.faults.add(TextFaultKind::YamlDiffers, || {
                        let mut pointer = with_variant(pointer(&self.open));
                        push_segment(&mut pointer, key);
                        open::missing_key(key, value).at(open.start).of(pointer)
                    });
                }
            }
        }
    }

    /// Reports a node's anchor and tag, and returns what to compare the node with.
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
        let mut target = Target { json, variant: None, forced: None };
        let Some(tag) = tag else {
            return target;
        };
        let instead = apply_tag(tag, node, &mut target);
        self.add(at, TextFaultKind::YamlTag, || tag_fault(tag, &instead));
        target
    }

    fn stop(&mut self, text: &str, error: &ScanError) {
        let at = place(*error.marker());
        // The scanner looks ahead inside brackets, and has its own nesting limit there.
        if error.info() == "recursion limit exceeded" {
            return self.too_deep(at);
        }
        let message = open::unparsed(text, error);
        self.report(at, TextFaultKind::YamlSyntax, &message);
    }

    fn too_deep(&mut self, at: Position) {
        let message = format!("the nesting is deeper than {DEPTH_LIMIT} levels: flatten it");
        // No pointer: it would have a hundred segments.
        self.faults
            .push(TextFault::new(TextFaultKind::YamlTooDeep, message).at(self.end.at_most(at)));
    }

    fn report(&mut self, at: Position, kind: TextFaultKind, message: &str) {
        self.add(at, kind, || TextFault::new(kind, message));
    }

    fn differs(&mut self, at: Position, fault: impl FnOnce() -> TextFault) {
        self.add(at, TextFaultKind::YamlDiffers, fault);
    }

    /// Adds a fault of the current node.
    fn add(&mut self, at: Position, kind: TextFaultKind, fault: impl FnOnce() -> TextFault) {
        let (open, end) = (&self.open, &self.end);
        self.faults.add(kind, || fault().at(end.at_most(at)).of(pointer(open)));
    }
}

fn place(marker: Marker) -> Position {
    Position::of(marker.line(), marker.col() + 1)
}
