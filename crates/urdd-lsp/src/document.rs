//! Versions of documents: what they are, and the robots that they describe.

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use lsp_types::Uri;
use nalgebra::Isometry3;
use serde_json::Value;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::file_type::FileType;
use urdd_directory::file_type::{HEAD, RobotFile};
use urdd_directory::limits::MAX_VERSION_BYTES;
use urdd_directory::regular;
use urdd_document::load::{find_spec, metadata_of};
use urdd_document::robot::{Robot, of_urdf};
use urdd_document::schema_check::{self, SchemaViolation};
use urdd_document::tree::Tree;
use urdd_format::registry::{ModuleKind, modules};
use urdd_format::schema::Subject;
use urdd_lint::pose::at_default;
use urdd_source::{Settings, SourceMeshes};
use urdd_xml::Xml;

use crate::markup::Markup;
use crate::options::Options;
use crate::outline::Outline;
use crate::text::Text;
use crate::uri;

/// Maximum size of a text, bytes: that of a URDF of several thousand links. `urdd lint` takes larger ones.
pub const MAX_TEXT_BYTES: usize = 16 << 20;
/// Maximum number of elements, and of links and joints among them. Each symbol of an outline takes 8 kB.
const MAX_ELEMENTS: usize = 100_000;
const MAX_PARTS: usize = 20_000;

pub struct Snapshot {
    /// Its address, as the editor writes it.
    pub uri: Uri,
    /// Its file, if it is one.
    pub path: Option<PathBuf>,
    /// The folder that relative names refer to.
    pub folder: PathBuf,
    pub kind: FileKind,
    /// What the editor calls it.
    language: String,
    /// The editor's number of the version.
    pub version: i32,
    pub text: Text,
    /// What the user set.
    pub options: Options,
    earlier: Option<Earlier>,
    computed: Computed,
}

/// What is computed of a version on first use.
#[derive(Default)]
struct Computed {
    robot: OnceLock<Option<Arc<RobotModel>>>,
    markup: OnceLock<Markup>,
    outline: OnceLock<Outline>,
    excess: OnceLock<Option<String>>,
}

/// What described a robot before.
#[derive(Clone)]
enum Earlier {
    /// The robot of the last version that described one.
    Robot(Arc<RobotModel>),
    /// A version whose robot was not asked for yet. It has no such version before it: at most one is kept.
    Version(Arc<Snapshot>),
}

impl Snapshot {
    /// The first version of a document. Relative names in a text that is not a file refer to `root`.
    pub fn new(
        uri: Uri,
        language: &str,
        version: i32,
        text: Text,
        root: Option<&Path>,
        options: &Options,
    ) -> Self {
        let path = uri::path(uri.as_str());
        let folder = path.as_deref().and_then(Path::parent).or(root);
        let folder = folder.map_or_else(|| PathBuf::from("."), Path::to_owned);
        Snapshot {
            kind: FileKind::of(uri.as_str(), path.as_deref(), language, text.as_str()),
            language: language.to_owned(),
            uri,
            path,
            folder,
            version,
            text,
            options: options.clone(),
            earlier: None,
            computed: Computed::default(),
        }
    }

    pub fn next(self: &Arc<Self>, version: i32, text: Text, options: &Options) -> Self {
        let earlier = match self.computed.robot.get() {
            Some(Some(robot)) => Some(Earlier::Robot(Arc::clone(robot))),
            Some(None) => self.earlier.clone(),
            None => {
                let this = || Earlier::Version(Arc::clone(self));
                self.earlier.clone().or_else(|| Some(this()))
            }
        };
        let of_text =
            || FileKind::of(self.uri.as_str(), self.path.as_deref(), &self.language, text.as_str());
        Snapshot {
            uri: self.uri.clone(),
            path: self.path.clone(),
            folder: self.folder.clone(),
            kind: if matches!(self.kind, FileKind::Urdd { .. }) { self.kind } else { of_text() },
            language: self.language.clone(),
            version,
            text,
            options: options.clone(),
            earlier,
            computed: Computed::default(),
        }
    }

    pub fn name(&self) -> String {
        uri::file_name(self.uri.as_str())
    }

    /// Whether the text is too large to be read.
    pub fn is_too_large(&self) -> bool {
        self.excess().is_some()
    }

    /// What the text has too much of to be read, and how much it may have.
    pub fn excess(&self) -> Option<&str> {
        let measure = || excess(self.text.as_str(), self.kind.is_xml());
        self.computed.excess.get_or_init(measure).as_deref()
    }

    /// The elements of the text, also where it is half typed. None if it is too large, or is not XML.
    pub fn markup(&self) -> &Markup {
        self.computed.markup.get_or_init(|| {
            let is_read = self.kind.is_xml() && !self.is_too_large();
            Markup::new(if is_read { self.text.as_str() } else { "" })
        })
    }

    pub fn outline(&self) -> &Outline {
        let make = || Outline::new(self.text.as_str(), self.markup());
        self.computed.outline.get_or_init(make)
    }

    /// The robot: of this version, or of the last one that described one.
    pub fn robot(&self) -> Option<Arc<RobotModel>> {
        let of_this = self.computed.robot.get_or_init(|| {
            if !matches!(self.kind, FileKind::Urdf) || self.is_too_large() {
                return None;
            }
            let settings = self.options.lint_settings(&Cancellation::default());
            let text = self.text.content();
            RobotModel::new(text, &self.name(), &self.folder, &settings.source).map(Arc::new)
        });
        of_this.clone().or_else(|| match &self.earlier {
            Some(Earlier::Robot(robot)) => Some(Arc::clone(robot)),
            Some(Earlier::Version(version)) => version.robot(),
            None => None,
        })
    }
}

fn excess(text: &str, is_xml: bool) -> Option<String> {
    if text.len() > MAX_TEXT_BYTES {
        let (size, limit) = (text.len() >> 20, MAX_TEXT_BYTES >> 20);
        return Some(format!("{size} MiB, at most {limit} MiB"));
    }
    if !is_xml {
        return None;
    }
    let (mut elements, mut parts) = (0, 0);
    for (at, _) in text.match_indices('<') {
        let name = &text[at + 1..];
        elements += usize::from(!name.starts_with(['/', '!', '?']));
        parts += usize::from(name.starts_with("link") || name.starts_with("joint"));
    }
    if elements > MAX_ELEMENTS {
        return Some(format!("{elements} elements, at most {MAX_ELEMENTS}"));
    }
    let words = || format!("{parts} links and joints, at most {MAX_PARTS}");
    (parts > MAX_PARTS).then(words)
}

/// The robot that a URDF describes: where its links are, and its mesh files.
pub struct RobotModel {
    pub source: SourceMeshes,
    /// Its links and joints, with URDF's defaults.
    pub robot: Robot,
    /// Its tree; `None` if the joints form none.
    pub tree: Option<Tree>,
    /// The pose of each link in the root link's frame, in the default configuration; empty without a tree.
    pub poses: Vec<Isometry3<f64>>,
}

impl RobotModel {
    /// The robot of a URDF; `None` if it describes none.
    pub fn new(text: &str, name: &str, folder: &Path, settings: &Settings) -> Option<Self> {
        let source = SourceMeshes::of_xml(&Xml::new(text), name, folder, settings).ok()?;
        let robot = of_urdf(&source.robot);
        let tree = Tree::new(&robot);
        let poses = tree.as_ref().map(|tree| at_default(&robot, tree));
        Some(RobotModel { source, robot, tree, poses: poses.unwrap_or_default() })
    }
}

#[derive(Clone, Copy)]
pub enum FileKind {
    Urdf,
    Xacro,
    /// `urdd.json`, or the document of a module, as JSON or YAML.
    Urdd {
        /// Its schema; `None` for an extension.
        schema: Option<Schema>,
        is_yaml: bool,
    },
    /// Nothing that is known here.
    Other,
}

impl FileKind {
    /// What a document is: by its text, by its name where that does not say, and then by its language.
    pub fn of(uri: &str, path: Option<&Path>, language: &str, text: &str) -> FileKind {
        let name = uri::file_name(uri);
        let language = language.to_lowercase();
        let most = usize::try_from(HEAD).unwrap_or(usize::MAX);
        let head = text.as_bytes().get(..most).unwrap_or(text.as_bytes());
        match RobotFile::of(Path::new(&name), head) {
            Some(RobotFile::Imported(_)) => return FileKind::Other,
            Some(RobotFile::Xacro) => return FileKind::Xacro,
            Some(RobotFile::Urdf) if FileType::Urdf.is_of(Path::new(&name)) => {
                return FileKind::Urdf;
            }
            Some(RobotFile::Urdf) if language != "xacro" => return FileKind::Urdf,
            _ => {}
        }
        if let Some(found) = path.and_then(Schema::of_file) {
            return found;
        }
        match language.as_str() {
            "urdf" => FileKind::Urdf,
            "xacro" => FileKind::Xacro,
            // A text that is not saved yet.
            "xml" if path.is_none() && !name.contains('.') => FileKind::Urdf,
            _ => FileKind::Other,
        }
    }

    pub fn is_xml(self) -> bool {
        matches!(self, FileKind::Urdf | FileKind::Xacro)
    }
}

#[derive(Clone, Copy)]
pub struct Schema {
    /// The document that it is of.
    pub subject: Subject,
    /// Whether the document is a module of a later minor version.
    pub is_newer: bool,
}

impl Schema {
    /// What a file of a URDD is; `None` for other files.
    pub fn of_file(path: &Path) -> Option<FileKind> {
        let name = path.file_name()?.to_str()?;
        if name == ROOT_METADATA {
            let schema = Schema { subject: Subject::RootMetadata, is_newer: false };
            return Some(FileKind::Urdd { schema: Some(schema), is_yaml: false });
        }
        let is_yaml = match name {
            "module.json" => false,
            "module.yaml" => true,
            _ => return None,
        };
        let folder = path.parent()?;
        let module = folder.file_name()?.to_str()?;
        if !module.ends_with("_module") {
            return None;
        }
        let mut kinds = ModuleKind::ALL.iter().copied();
        let kind = kinds.find(|kind| kind.name() == module);
        Some(FileKind::Urdd {
            schema: kind.and_then(|kind| Schema::of_module(kind, folder)),
            is_yaml,
        })
    }

    /// The schema of a module in a folder, by its `VERSION`.
    fn of_module(kind: ModuleKind, folder: &Path) -> Option<Schema> {
        let text = regular::read(&folder.join("VERSION"), MAX_VERSION_BYTES).unwrap_or_default();
        let text = str::from_utf8(&text).unwrap_or_default().trim_end();
        let (spec, is_newer) = find_spec(kind, Some(text));
        // A module that somebody begins to write.
        let newest = || modules().iter().find(|spec| spec.kind == kind && text.is_empty());
        Some(Schema { subject: Subject::Module(spec.or_else(newest)?), is_newer })
    }

    /// How a document breaks it.
    pub fn violations(self, document: &Value) -> Vec<SchemaViolation> {
        match self.subject {
            Subject::Module(spec) => schema_check::read(spec, document, self.is_newer).1,
            _ => metadata_of(document).1,
        }
    }
}
