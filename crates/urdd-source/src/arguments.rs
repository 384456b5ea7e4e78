//! The arguments that a xacro file takes, and the values that its package suggests. Texts and names of files say it:
//! nothing is expanded.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};

use thiserror::Error;
use urdd_directory::account::{Account, AccountError};
use urdd_directory::listing::ReadError;
use urdd_directory::position::{LineIndex, Position};
use urdd_xml::Node;
use urdd_xml::element::{attribute, name};

use crate::files::MAX_SOURCE_BYTES;
use crate::gate::Gate;
use crate::launched;
use crate::resolve::FoundMesh;
use crate::roots::Place;
use crate::settings::Settings;
use crate::suggested::{MAX_VALUES, Side, asked, is_given, whole_argument};

pub use crate::error::XacroArgument;

/// Maximum number of names of a folder that are looked at.
const MAX_NAMES: usize = 1000;
/// Charged for a path that is looked for.
const LOOK_UP: usize = 1 << 10;
/// The elements of xacro itself: all others call macros.
const OWN: [&str; 9] =
    ["arg", "attribute", "element", "if", "include", "insert_block", "macro", "property", "unless"];

/// How the names of arguments end that are names of files.
const FILES: [&str; 3] = ["file", "path", "yaml"];

/// The values of an argument that conditions ask for and nothing else.
const FLAGS: [&str; 6] = ["true", "false", "True", "False", "1", "0"];

/// Why the arguments of a file are not known.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum ArgumentsError {
    #[error("cannot be read: {0}")]
    Read(#[from] ReadError),
    #[error("it is not UTF-8")]
    NotUtf8,
    #[error("{0}")]
    Xml(String),
    #[error(transparent)]
    Account(#[from] AccountError),
}

/// The arguments of a file, in the order of their names: those that it and the files that it includes declare or use.
///
/// # Errors
/// If the file cannot be read, or its files are more than the account of the run allows.
pub fn arguments(file: &Path, settings: &Settings) -> Result<Vec<XacroArgument>, ArgumentsError> {
    let path = settings.files.canonicalize(file).map_err(ReadError::from)?;
    let folder = path.parent().unwrap_or(&path);
    let gate = Gate::of_project(folder, settings);
    let mut texts = Texts::new(&gate);
    let own = FoundMesh { file: path.clone(), place: Place::Own, assumed: None };
    let mut waiting = texts.read(&own, true)?;
    let mut read = BTreeSet::from([path.clone()]);
    while let Some(found) = waiting.pop() {
        if read.insert(found.file.clone()) {
            // What is wrong with one that is included, xacro says.
            match texts.read(&found, false) {
                Ok(more) => waiting.extend(more),
                Err(ArgumentsError::Account(why)) => return Err(why.into()),
                Err(_) => {}
            }
        }
    }
    texts.resolve()?;
    texts.arguments(&path)
}

/// The arguments that a file which cannot be expanded needs, without those that are given as `name:=value`; none if they are
/// not known. One that is called a file, and is nothing by default, is needed: it is opened.
pub fn needed(file: &Path, settings: &Settings) -> Vec<XacroArgument> {
    let mut all = arguments(file, settings).unwrap_or_default();
    let is_no_file = |argument: &XacroArgument| {
        argument.default.as_deref() == Some("")
            && FILES.iter().any(|ending| argument.name.ends_with(ending))
    };
    all.retain(|one| (one.is_needed || is_no_file(one)) && !is_given(&one.name, settings));
    all
}

/// The arguments that conditions of a file ask for, with the values that decide these, without those that are given.
pub fn conditions(file: &Path, settings: &Settings) -> Vec<XacroArgument> {
    let mut all = arguments(file, settings).unwrap_or_default();
    all.retain(|one| one.is_condition && !one.values.is_empty() && !is_given(&one.name, settings));
    all
}

/// The lines of a settings file that declare the robots of a file, with each value of these arguments.
pub fn declaration(file: &str, needed: &[XacroArgument]) -> String {
    let quoted = |text: &str| toml::Value::from(text).to_string();
    let value = |argument: &XacroArgument| match argument.values.as_slice() {
        [] => quoted("VALUE"),
        [one] => quoted(one),
        several => {
            format!("[{}]", several.iter().map(|one| quoted(one)).collect::<Vec<_>>().join(", "))
        }
    };
    let mut lines = format!("\n[[robot]]\npath = {}\n", quoted(&file.replace('\\', "/")));
    let all = needed.iter().map(|argument| format!("{} = {}", argument.name, value(argument)));
    let _ = writeln!(lines, "args = {{ {} }}", all.collect::<Vec<_>>().join(", "));
    lines
}

/// What texts say of an argument.
#[derive(Default)]
struct Found {
    default: Option<String>,
    at: Option<Position>,
    /// Whether an attribute of the root has it: xacro reads those before any default.
    is_of_root: bool,
    /// The texts that use it, by their places in the list of all.
    texts: Vec<usize>,
    /// The values that conditions ask for.
    asked: Vec<String>,
}

/// The texts of a file and of those that it includes.
struct Texts<'a> {
    gate: &'a Gate,
    found: BTreeMap<String, Found>,
    /// Texts of attributes with arguments, each with the folder of its file.
    named: Vec<(String, PathBuf)>,
    /// The argument that a property or a parameter of a macro is given; `None` where there are several.
    aliases: BTreeMap<String, Option<String>>,
    /// Names of included files with properties or parameters, outside of conditions, each with the folder of its file.
    computed: Vec<(String, PathBuf)>,
    /// The conditions.
    conditions: Vec<String>,
}

impl<'a> Texts<'a> {
    fn new(gate: &'a Gate) -> Self {
        Texts {
            gate,
            found: BTreeMap::new(),
            named: Vec::new(),
            aliases: BTreeMap::new(),
            computed: Vec::new(),
            conditions: Vec::new(),
        }
    }

    /// A property or a parameter, and what it is given.
    fn alias(&mut self, name: &str, text: &str) -> Result<(), ArgumentsError> {
        let Some(argument) = whole_argument(text) else { return Ok(()) };
        self.gate.account().charge(name.len() + argument.len() + size_of::<Found>())?;
        let known = self.aliases.entry(name.to_owned());
        let known = known.or_insert_with(|| Some(argument.to_owned()));
        known.take_if(|known| *known != argument);
        Ok(())
    }

    /// Takes names of included files whose properties and parameters are arguments for texts with these arguments.
    fn resolve(&mut self) -> Result<(), ArgumentsError> {
        for (text, folder) in std::mem::take(&mut self.computed) {
            let account = self.gate.account();
            account.charge(folder.as_os_str().len())?;
            let Some(whole) = with_arguments(&text, &self.aliases, account)? else { continue };
            for name in used(&whole) {
                let found = self.found.entry(name.to_owned()).or_default();
                found.texts.push(self.named.len());
            }
            self.named.push((whole, folder));
        }
        for condition in std::mem::take(&mut self.conditions) {
            for (side, value) in asked(&condition) {
                let name = match side {
                    Side::Argument(name) => Some(name),
                    Side::Property(name) => self.aliases.get(name).and_then(Option::as_deref),
                };
                let Some(found) = name.and_then(|name| self.found.get_mut(name)) else { continue };
                if found.asked.len() < MAX_VALUES && !found.asked.iter().any(|one| one == value) {
                    self.gate.account().charge(value.len() + size_of::<String>())?;
                    found.asked.push(value.to_owned());
                }
            }
        }
        Ok(())
    }

    /// Reads a file. Returns those that it includes, as far as the text says which.
    fn read(&mut self, file: &FoundMesh, is_own: bool) -> Result<Vec<FoundMesh>, ArgumentsError> {
        let text = self.gate.bytes(file, MAX_SOURCE_BYTES)?;
        let text = String::from_utf8(text).map_err(|_| ArgumentsError::NotUtf8)?;
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Robot)
            .map_err(|error| ArgumentsError::Xml(error.sentence(&text)))?;
        let lines = LineIndex::new(&text);
        let folder = file.file.parent().unwrap_or(&file.file);
        let mut included = Vec::new();
        for node in document.descendants().filter(|node| node.is_element()) {
            let at = || is_own.then(|| lines.position(node.range().start));
            let value = |key| attribute(node, key).map(|one| one.value());
            match (name(node), value("name"), value("filename")) {
                ("xacro:arg", Some(name), _) => {
                    self.gate.account().charge(name.len() + size_of::<Found>())?;
                    let found = self.found.entry(name.to_owned()).or_default();
                    found.at = at().or(found.at);
                    // The first counts, as in xacro.
                    found.default = found.default.take().or(value("default").map(str::to_owned));
                }
                ("xacro:include", _, Some(file)) if !file.contains("$(arg") => {
                    self.gate.account().charge(LOOK_UP + file.len())?;
                    included.extend(self.gate.find_from(file, folder));
                    if file.contains("${") && !is_conditional(node) {
                        self.computed.push((file.to_owned(), folder.to_owned()));
                    }
                }
                ("xacro:if" | "xacro:unless", ..) => {
                    let condition = value("value").unwrap_or_default();
                    self.gate.account().charge(condition.len() + size_of::<String>())?;
                    self.conditions.push(condition.to_owned());
                }
                ("xacro:property", Some(name), _) => {
                    self.alias(name, value("value").unwrap_or_default())?;
                }
                (called, ..) if is_call(called) => {
                    for given in node.attributes() {
                        self.alias(given.name(), given.value())?;
                    }
                }
                _ => {}
            }
            let attributes = node.attributes().map(|one| (one.name(), one.value()));
            let texts = node.children().filter(|node| node.is_text());
            let inside = texts.filter_map(|node| Some(("", node.text()?)));
            for (key, text) in attributes.chain(inside).filter(|(_, text)| text.contains("$(arg")) {
                self.gate.account().charge(text.len() + folder.as_os_str().len())?;
                self.named.push((text.to_owned(), folder.to_owned()));
                for name in used(text) {
                    self.gate.account().charge(name.len() + size_of::<Found>())?;
                    let found = self.found.entry(name.to_owned()).or_default();
                    found.texts.push(self.named.len() - 1);
                    found.at = found.at.or_else(at);
                    found.is_of_root |=
                        is_own && !key.is_empty() && node == document.root_element();
                }
            }
        }
        Ok(included)
    }

    fn arguments(self, file: &Path) -> Result<Vec<XacroArgument>, ArgumentsError> {
        let listed = launched::values(file, self.gate, |name| self.found.contains_key(name));
        let mut all = Vec::new();
        for (name, found) in &self.found {
            let mut values = self.values(name, found)?;
            let mut asked = found.asked.clone();
            // A text that is empty or not is no flag.
            let is_flag = found.default.as_deref().is_none_or(|default| FLAGS.contains(&default));
            asked.retain(|value| is_flag || !FLAGS.contains(&value.as_str()));
            let is_number = |text: &String| text.parse::<f64>().is_ok();
            if found.default.as_ref().is_some_and(is_number) {
                // `arm_gripper.yaml` beside `arm6.yaml` and `arm7.yaml`.
                values.retain(is_number);
            }
            let literal = found.default.as_ref().filter(|default| !default.contains('$'));
            let has_no_files = |default| !values.is_empty() && !values.contains(default);
            let is_needed =
                found.is_of_root || found.default.is_none() || literal.is_some_and(has_no_files);
            if values.is_empty() {
                values = listed.get(name).unwrap_or(&asked).clone();
            }
            if values.is_empty() && found.is_of_root {
                let stem = file.file_name().unwrap_or_default().to_string_lossy();
                let stem = || stem.split('.').next().unwrap_or_default().to_owned();
                values.push(literal.cloned().unwrap_or_else(stem));
            }
            let (name, default) = (name.clone(), found.default.clone());
            let is_condition = !asked.is_empty();
            all.push(XacroArgument {
                name,
                default,
                values,
                is_condition,
                is_needed,
                at: found.at,
            });
        }
        Ok(all)
    }

    /// The values of an argument for which there are all files that are named by it.
    fn values(&self, name: &str, found: &Found) -> Result<Vec<String>, ArgumentsError> {
        let mark = format!("$(arg {name})");
        let mut values: Option<Vec<String>> = None;
        let texts = found.texts.iter().filter_map(|place| self.named.get(*place));
        for (text, folder) in texts {
            self.gate.account().charge(text.len())?;
            for path in text.split(['\'', '"']).filter(|path| path.contains(&mark)) {
                self.gate.account().charge(LOOK_UP + text.len())?;
                let found = self.fitting(path.trim(), folder, &mark)?;
                let both = |known: &Vec<String>| -> Vec<String> {
                    known.iter().filter(|value| found.contains(value)).cloned().collect()
                };
                match values.as_ref().map(both) {
                    _ if found.is_empty() => {}
                    Some(both) if both.is_empty() => {}
                    Some(both) => values = Some(both),
                    None => values = Some(found),
                }
            }
        }
        Ok(values.unwrap_or_default())
    }

    /// The values with which a path is that of a file.
    fn fitting(
        &self,
        path: &str,
        folder: &Path,
        mark: &str,
    ) -> Result<Vec<String>, ArgumentsError> {
        let Some((base, rest)) = self.base(path, folder) else { return Ok(Vec::new()) };
        let mut rest = rest.to_owned();
        let others: Vec<String> = used(&rest).map(str::to_owned).collect();
        for other in others.iter().filter(|other| format!("$(arg {other})") != *mark) {
            let default = self.found.get(other).and_then(|found| found.default.as_deref());
            let Some(default) = default.filter(|default| default.len() < MAX_VALUES) else {
                return Ok(Vec::new());
            };
            let mark = format!("$(arg {other})");
            let uses = rest.matches(&mark).count();
            self.gate.account().charge(rest.len() + uses * default.len())?;
            rest = rest.replace(&mark, default);
        }
        if !rest.contains('/') && base == folder || rest.replace(mark, "").contains('$') {
            return Ok(Vec::new());
        }
        let parts: Vec<&str> = rest.split('/').collect();
        let Some(at) = parts.iter().position(|part| part.contains(mark)) else {
            return Ok(Vec::new());
        };
        let Some((before, behind)) = parts[at].split_once(mark) else { return Ok(Vec::new()) };
        let above = base.join(parts[..at].join("/"));
        // The names of a folder are read only where its files may be.
        let Ok(above) = self.gate.at(&above) else { return Ok(Vec::new()) };
        let mut values = Vec::new();
        for name in self.gate.files().names(&above.file).into_iter().take(MAX_NAMES) {
            let name = name.to_string_lossy();
            self.gate.account().charge(LOOK_UP + rest.len())?;
            let value = name.strip_prefix(before).and_then(|name| name.strip_suffix(behind));
            let Some(value) = value.filter(|value| !value.is_empty()) else { continue };
            let is_there = || self.gate.files().is_file(&base.join(rest.replace(mark, value)));
            if !value.starts_with('.') && is_there() {
                values.push(value.to_owned());
            }
        }
        values.sort();
        values.truncate(MAX_VALUES);
        Ok(values)
    }

    /// The folder that a path begins in, and the rest; `None` if only xacro can tell.
    fn base<'p>(&self, path: &'p str, folder: &Path) -> Option<(PathBuf, &'p str)> {
        let path = path.strip_prefix("file://").unwrap_or(path);
        let (package, rest) = match path.strip_prefix("$(find ") {
            Some(rest) => rest.split_once(")/")?,
            None => match path.strip_prefix("package://") {
                Some(rest) => rest.split_once('/')?,
                None if path.starts_with(['/', '$']) || path.contains("://") => return None,
                None => return Some((folder.to_owned(), path)),
            },
        };
        let manifest = format!("package://{}/package.xml", package.trim());
        let manifest = self.gate.find_from(&manifest, folder).ok()?;
        Some((manifest.file.parent()?.to_owned(), rest))
    }
}

fn is_call(name: &str) -> bool {
    name.strip_prefix("xacro:").is_some_and(|own| !OWN.contains(&own))
}

/// Whether a condition of xacro is around an element.
fn is_conditional(node: Node) -> bool {
    node.ancestors().any(|one| matches!(name(one), "xacro:if" | "xacro:unless"))
}

/// A text with the arguments that its properties and parameters are given; `None` if one is given something else.
fn with_arguments(
    text: &str,
    aliases: &BTreeMap<String, Option<String>>,
    account: &Account,
) -> Result<Option<String>, AccountError> {
    let mut parts = text.split("${");
    let mut whole = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let argument =
            |(alias, rest): (&str, _)| Some((aliases.get(alias.trim())?.as_ref()?, rest));
        let Some((argument, rest)) = part.split_once('}').and_then(argument) else {
            return Ok(None);
        };
        // A long name may be used often.
        account.charge(argument.len() + part.len())?;
        whole += &format!("$(arg {argument}){rest}");
    }
    Ok(Some(whole))
}

/// The arguments that a text uses.
fn used(text: &str) -> impl Iterator<Item = &str> {
    let names = text.split("$(arg ").skip(1).filter_map(|rest| rest.split_once(')'));
    names.map(|(name, _)| name.trim()).filter(|name| !name.is_empty())
}
