//! The modules of the new URDD. Each is built and written, or kept from the URDD that is replaced. What a stage returns is
//! dropped as soon as it is written, except its product, which later stages use.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use crate::context::Context;
use crate::donor::Donor;
use crate::error::{GenerateError, Result};
use crate::made::{Digests, Made, MadeFile};
use crate::metadata::{Entry, MODULE_VERSION};
use crate::settings::Settings;
use crate::{inputs, metadata};
use urdd_directory::root::Root;
use urdd_directory::writer::Document;
use urdd_directory::writer::Writer;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::FileEntry;
use urdd_source::note::Note;

/// A module of a generated URDD.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MadeModule {
    /// Which module.
    pub kind: ModuleKind,
    /// Whether it was kept from the replaced URDD because none of its inputs changed.
    pub kept: bool,
}

struct Begun {
    kind: ModuleKind,
    /// Digest of its inputs, if it can be kept later.
    inputs: Option<String>,
}

pub(super) struct Modules<'a> {
    context: &'a Context<'a>,
    selected: BTreeSet<ModuleKind>,
    replaced: Option<&'a Donor>,
    writer: &'a Writer,
    root: Root,
    num_started: usize,
    digests: Digests,
    pub entries: Vec<Entry>,
    pub made: Vec<MadeModule>,
    pub notes: Vec<Note>,
}

impl<'a> Modules<'a> {
    /// No modules yet. `writer` writes into the folder `root`.
    pub fn new(
        context: &'a Context<'a>,
        replaced: Option<&'a Donor>,
        writer: &'a Writer,
        root: Root,
    ) -> Self {
        let composition = context.composition.map(|_| ModuleKind::Composition);
        let has_named = !context.named.configurations.is_empty();
        let named = has_named.then_some(ModuleKind::NamedConfigurations);
        let loops = context.loops.as_ref().map(|_| ModuleKind::Loops);
        Modules {
            context,
            selected: context
                .settings
                .selection
                .kinds()
                .chain(composition)
                .chain(named)
                .chain(loops)
                .collect(),
            replaced,
            writer,
            root,
            num_started: 0,
            digests: Digests::new(),
            entries: Vec::new(),
            made: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Adds a module, if it is selected. Returns the product of its stage; `None` if the stage did not run.
    pub fn add<T>(
        &mut self,
        kind: ModuleKind,
        stage: impl FnOnce(&Digests) -> Result<Made<T>>,
    ) -> Result<Option<T>> {
        let Some(begun) = self.begin(kind)? else { return Ok(None) };
        let Made { document, files, notes, product } = stage(&self.digests)?;
        self.end(begun, document, files, notes)?;
        Ok(Some(product))
    }

    /// Whether there is such a module, built or kept.
    pub fn has(&self, kind: ModuleKind) -> bool {
        self.made.iter().any(|module| module.kind == kind)
    }

    pub fn root(&self) -> &Root {
        &self.root
    }

    /// Begins a module. `None` if it is not selected, or is kept.
    fn begin(&mut self, kind: ModuleKind) -> Result<Option<Begun>> {
        if !self.selected.contains(&kind) {
            return Ok(None);
        }
        let cancellation = &self.context.settings.source.cancellation;
        cancellation.check()?;
        self.context.progress.module(kind, self.num_started, self.selected.len());
        self.num_started += 1;
        let inputs = inputs::text(kind, self.context).map(|text| {
            let modules = self.entries.iter().map(|entry| &entry.module);
            metadata::inputs(kind, &text, modules)
        });
        let kept = inputs.as_deref().and_then(|inputs| self.replaced?.kept(kind, inputs));
        if let Some((folder, files)) = kept {
            for file in files {
                self.writer.keep(&folder.join(&file.path), &file.path)?;
            }
            self.enter(kind, files.to_vec(), inputs, true);
            return Ok(None);
        }
        Ok(Some(Begun { kind, inputs }))
    }

    fn end(
        &mut self,
        Begun { kind, inputs }: Begun,
        document: Option<Document>,
        files: Vec<MadeFile>,
        notes: Vec<Note>,
    ) -> Result<()> {
        if let Some(document) = document {
            let mut written = self.writer.module(kind, MODULE_VERSION, &document)?;
            for file in files {
                written.push(self.writer.file(&file.path, &file.bytes)?);
            }
            self.enter(kind, written, inputs, false);
        }
        self.notes.extend(notes);
        check_assumptions(&self.notes, self.context.settings)
    }

    /// As [`Modules::add`], for a product that `load` can read from the files of a kept module.
    pub fn product<T>(
        &mut self,
        kind: ModuleKind,
        load: Load<T>,
        stage: impl FnOnce(&Digests) -> Result<Made<T>>,
    ) -> Result<Product<T>> {
        let made = self.add(kind, stage)?;
        Ok(Product::new(made, kind, self.root.clone(), load))
    }

    fn enter(
        &mut self,
        kind: ModuleKind,
        files: Vec<FileEntry>,
        inputs: Option<String>,
        kept: bool,
    ) {
        let digests = files.iter().map(|file| (file.path.clone(), file.sha256.as_str().to_owned()));
        self.digests.extend(digests);
        self.entries.push(metadata::entry(kind, files, inputs));
        self.made.push(MadeModule { kind, kept });
    }
}

/// Returns an error if something was assumed and the settings are strict.
pub(super) fn check_assumptions(notes: &[Note], settings: &Settings) -> Result<()> {
    let notes = notes.iter().filter(|note| note.kind.changes_robot());
    let notes: Vec<Note> = notes.filter(|_| settings.strict).cloned().collect();
    if notes.is_empty() { Ok(()) } else { Err(GenerateError::Strict { notes }) }
}

/// Reads the product of a stage from the files of its module.
pub(super) type Load<T> = fn(&Root, ModuleKind) -> Result<T>;

pub(super) struct Product<T> {
    known: OnceLock<T>,
    kind: ModuleKind,
    root: Root,
    load: Load<T>,
}

impl<T> Product<T> {
    /// What a stage returned. Without it, `load` reads it from the URDD in `root`.
    fn new(made: Option<T>, kind: ModuleKind, root: Root, load: Load<T>) -> Self {
        let known = made.map_or_else(OnceLock::new, OnceLock::from);
        Product { known, kind, root, load }
    }

    /// Returns the product; the first call reads it if this run did not build it.
    pub fn get(&self) -> Result<&T> {
        match self.known.get() {
            Some(known) => Ok(known),
            None => {
                let loaded = (self.load)(&self.root, self.kind)?;
                Ok(self.known.get_or_init(|| loaded))
            }
        }
    }
}
