//! Text layers, `#usda 1.0`: prims, variants and properties.

mod lexer;
mod values;

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use crate::error::{Fault, Place, Wrong};
use crate::layer::{Item, Layer, MAX_LEVELS, Name, PropertySpec, Value, put};
use lexer::{Lexer, Token};
use values::{Edit, Reader, items, typed};

/// The first words of a layer of text.
const START: &str = "#usda 1.";

/// Reads a layer.
///
/// What is made of a text is at most some 60 times its size: `int a`, six bytes, becomes a property with a field.
///
/// # Errors
/// Where it is not USD.
pub fn read(bytes: &[u8]) -> Result<Layer, Wrong> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if !bytes.starts_with(START.as_bytes()) {
        return Err((Place::Layer, Fault::Kind));
    }
    let text = std::str::from_utf8(bytes);
    let text = text.map_err(|fault| (Place::Byte(fault.valid_up_to() as u64), Fault::Encoding))?;
    let mut reader = Reader {
        lexer: Lexer::new(text),
        layer: Layer::new(),
        names: HashSet::new(),
        properties: HashMap::new(),
    };
    reader.layer()?;
    Ok(reader.layer)
}

enum Open {
    /// A prim or a variant.
    Spec(u32),
    /// A set of variants of a prim.
    Set(u32, Name),
}

impl Reader<'_> {
    fn layer(&mut self) -> Result<(), Wrong> {
        let fields = self.metadata()?;
        self.set_fields(0, fields);
        let mut open = vec![Open::Spec(0)];
        while let Some(last) = open.last() {
            match last {
                Open::Spec(spec) => {
                    let spec = *spec;
                    self.statement(spec, &mut open)?;
                }
                Open::Set(owner, set) => {
                    let (owner, set) = (*owner, set.clone());
                    self.variant(owner, &set, &mut open)?;
                }
            }
        }
        Ok(())
    }

    fn set_fields(&mut self, spec: u32, fields: Vec<(Name, Value)>) {
        let own = &mut self.layer.specs[spec as usize].fields;
        for (name, value) in fields {
            match own.iter_mut().find(|(key, _)| *key == name) {
                Some(known) => known.1 = value,
                None => own.push((name, value)),
            }
        }
    }

    fn statement(&mut self, spec: u32, open: &mut Vec<Open>) -> Result<(), Wrong> {
        let token = self.lexer.next()?;
        let word = match token {
            Token::Mark(';') => return Ok(()),
            Token::Mark('}') if open.len() > 1 => {
                open.pop();
                return self.lexer.ends();
            }
            Token::End if open.len() == 1 => {
                open.pop();
                return Ok(());
            }
            Token::End => return Err(self.lexer.wrong(Fault::Unfinished("a prim"))),
            Token::Name(word) => word,
            other => return Err(self.lexer.expected("a prim, a property or `}`", &other)),
        };
        match word {
            "def" | "over" | "class" => {
                let child = self.prim(spec, word)?;
                open.push(Open::Spec(child));
            }
            "variantSet" => {
                let set = match self.lexer.next()? {
                    Token::Text(set) => self.name(&set),
                    other => return Err(self.lexer.expected("the name of a variant set", &other)),
                };
                self.lexer.take('=', "`=`")?;
                self.lexer.take('{', "`{`")?;
                open.push(Open::Set(spec, set));
            }
            _ => {
                self.property(spec, word)?;
                self.lexer.ends()?;
            }
        }
        Ok(())
    }

    /// The spec of a child or variant.
    fn make(&mut self, above: u32, name: &Name, is_child: bool, line: u32) -> Result<u32, Wrong> {
        let spec = self.layer.make(above, name, is_child, line);
        if self.layer.specs[spec as usize].level as usize > MAX_LEVELS {
            return Err(self.lexer.wrong(Fault::Deep(MAX_LEVELS)));
        }
        Ok(spec)
    }

    fn prim(&mut self, parent: u32, specifier: &str) -> Result<u32, Wrong> {
        let line = self.lexer.word_line();
        let mut token = self.lexer.next()?;
        let mut kind = None;
        if let Token::Name(name) = token {
            kind = Some(self.name(name));
            token = self.lexer.next()?;
        }
        let Token::Text(name) = token else {
            return Err(self.lexer.expected("the name of a prim", &token));
        };
        let name = self.name(&name);
        let spec = self.make(parent, &name, true, line)?;
        let mut fields = vec![(self.name("specifier"), Value::Text(self.name(specifier)))];
        fields.extend(kind.map(|kind| (self.name("typeName"), Value::Text(kind))));
        fields.extend(self.metadata()?);
        self.set_fields(spec, fields);
        self.lexer.take('{', "`{`")?;
        Ok(spec)
    }

    fn variant(&mut self, owner: u32, set: &str, open: &mut Vec<Open>) -> Result<(), Wrong> {
        let name = match self.lexer.next()? {
            Token::Mark('}') => {
                open.pop();
                return self.lexer.ends();
            }
            Token::Mark(';') => return Ok(()),
            Token::Text(name) => name,
            other => return Err(self.lexer.expected("the name of a variant or `}`", &other)),
        };
        let name = self.name(&format!("{{{set}={name}}}"));
        let line = self.lexer.word_line();
        let spec = self.make(owner, &name, false, line)?;
        let fields = self.metadata()?;
        self.set_fields(spec, fields);
        self.lexer.take('{', "`{`")?;
        open.push(Open::Spec(spec));
        Ok(())
    }

    fn property(&mut self, spec: u32, first: &str) -> Result<(), Wrong> {
        let (mut edit, mut word) = (Edit::Explicit, first);
        let mut fields = Vec::new();
        loop {
            match word {
                "custom" => fields.push((self.name("custom"), Value::Bool(true))),
                "uniform" => {
                    fields.push((self.name("variability"), Value::Text(self.name("uniform"))))
                }
                "varying" | "config" => {}
                _ => match Edit::of(word) {
                    Some(of) => edit = of,
                    None => break,
                },
            }
            word = self.lexer.name("a type")?;
        }
        if edit == Edit::Reorder && matches!(word, "nameChildren" | "properties" | "rootPrims") {
            self.lexer.take('=', "`=`")?;
            self.value(0)?;
            return Ok(());
        }
        let (kind, is_array) = (word, self.brackets()?);
        let name = self.lexer.name("the name of a property")?;
        let name = self.name(name);
        let is_relationship = kind == "rel";
        if !is_relationship {
            let full = if is_array { self.name(&format!("{kind}[]")) } else { self.name(kind) };
            fields.push((self.name("typeName"), Value::Text(full)));
        }
        let part = match self.lexer.takes('.')? {
            true => self.lexer.name("`connect` or `timeSamples`")?,
            false => "",
        };
        if self.lexer.takes('=')? {
            fields.extend(self.assigned(kind, is_array, part, edit)?);
        }
        fields.extend(self.metadata()?);
        self.set_property(spec, name, is_relationship, fields);
        Ok(())
    }

    /// What stands after `=`.
    fn assigned(
        &mut self,
        kind: &str,
        is_array: bool,
        part: &str,
        edit: Edit,
    ) -> Result<Option<(Name, Value)>, Wrong> {
        let paths = match (kind, part) {
            ("rel", _) => Some("targetPaths"),
            (_, "connect") => Some("connectionPaths"),
            _ => None,
        };
        if let Some(field) = paths {
            let list = items(&self.value(0)?, Item::Path);
            return Ok(Some((self.name(field), Value::List(Arc::new(edit.list(list))))));
        }
        if part == "timeSamples" {
            return Ok(Some((self.name(part), self.samples(kind, is_array)?)));
        }
        if !part.is_empty() {
            return Err(self.lexer.wrong(Fault::Syntax {
                expected: "`connect` or `timeSamples`",
                found: format!("`{part}`, which is not read"),
            }));
        }
        let value = typed(kind, is_array, self.value(0)?);
        Ok(Some((self.name("default"), value)))
    }

    fn set_property(
        &mut self,
        spec: u32,
        name: Name,
        is_relationship: bool,
        fields: Vec<(Name, Value)>,
    ) {
        let all = &mut self.layer.specs[spec as usize].properties;
        let at = *self.properties.entry((spec, name.clone())).or_insert(all.len());
        if at == all.len() {
            all.push(PropertySpec { name, is_relationship, fields });
            return;
        }
        for (name, value) in fields {
            put(&mut all[at].fields, name, value);
        }
    }
}
