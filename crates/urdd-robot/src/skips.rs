//! Which pairs of shapes need no look, and why.

use super::Robot;
use super::error::RobotError;
use super::parts::usable;
use super::shapes::ShapeKind;
use urdd_document::shape_matrices::{at, reasons, shape_lists, skips};
use urdd_document::shapes::Shapes;
use urdd_document::urdd::Urdd;
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::link_shapes_skips::{LinkShapesSkipsModule, SkipEdit, SkippedReason};
use urdd_format::registry::{ModuleDocument, ModuleKind};

const SKIPS: ModuleKind = ModuleKind::LinkShapesSkips;
const SIMPLE: ModuleKind = ModuleKind::LinkShapesSimpleSkips;

/// The skips between the shapes of one kind.
#[derive(Debug, Clone)]
pub struct Skips {
    /// Of each shape its link and its piece.
    places: Vec<(usize, usize)>,
    skipped: Matrix<bool>,
    reasons: Option<Matrix<SkipReason>>,
    edits: Vec<SkipEdit>,
    skipped_reasons: Option<Vec<SkippedReason>>,
}

/// Rows over the shapes themselves, or over hulls where those of pieces are left out (SPEC 8.4).
#[derive(Debug, Clone)]
struct Matrix<T> {
    rows: Vec<Vec<T>>,
    /// For each shape its row.
    row_of: Vec<Option<usize>>,
}

impl<T: Copy> Matrix<T> {
    fn at(&self, i: usize, j: usize) -> Option<T> {
        at(
            &self.rows,
            self.row_of.get(i).copied()??,
            self.row_of.get(j).copied()??,
        )
    }
}

impl Robot {
    /// The skips between the shapes of a kind: those of `link_shapes_skips_module`, or of
    /// `link_shapes_simple_skips_module` where the former is not there.
    ///
    /// # Errors
    /// Where both are missing or one is of no use, or a module of meshes is.
    pub fn skips(&self, kind: ShapeKind) -> Result<Skips, RobotError> {
        let meshes = [
            ModuleKind::ConvexHullMeshes,
            ModuleKind::ConvexDecompositionMeshes,
        ];
        let part = self.part_as_it_is(&[SKIPS, SIMPLE, meshes[0], meshes[1]])?;
        let from = match part.module(SKIPS) {
            None if part.module(SIMPLE).is_some() => SIMPLE,
            _ => SKIPS,
        };
        usable(&part, from)?;
        if from != SIMPLE && part.module(SIMPLE).is_some() {
            usable(&part, SIMPLE)?;
        }
        let shapes = shapes(&part, from, &meshes)?;
        let document = part.document(from).ok_or(RobotError::Missing(from))?;
        let six = skips(document).ok_or(RobotError::Missing(from))?;
        let own = kind.of_document();
        let places = (0..shapes.count(own)).filter_map(|shape| shapes.place(own, shape));
        let rows = Rows::new(kind, places.collect(), &shapes.full);
        let module = match document {
            ModuleDocument::LinkShapesSkips(module) => Some(&**module),
            _ => None,
        };
        Ok(Skips {
            skipped: rows.matrix(&six),
            reasons: part
                .document(SIMPLE)
                .and_then(reasons)
                .map(|six| rows.matrix(&six)),
            edits: module.map_or_else(Vec::new, |module| module.edits.clone()),
            skipped_reasons: module.map(|module| module.skipped_reasons.clone()),
            places: rows.places,
        })
    }
}

/// How the shapes of a kind find their rows in the six matrices of a module.
struct Rows {
    kind: ShapeKind,
    /// Of each shape its link and its piece.
    places: Vec<(usize, usize)>,
    /// For each shape the row of its link's hull.
    of_hulls: Vec<Option<usize>>,
}

impl Rows {
    /// `full` are the links that have a hull, in the order of its rows.
    fn new(kind: ShapeKind, places: Vec<(usize, usize)>, full: &[usize]) -> Self {
        let row = |link: usize| full.iter().position(|full| *full == link);
        Rows {
            kind,
            of_hulls: places.iter().map(|(link, _)| row(*link)).collect(),
            places,
        }
    }

    /// The matrix of the kind; that of the hulls where it is left out (SPEC 8.4).
    fn matrix<T: Copy>(&self, six: &[Option<&[Vec<T>]>; 6]) -> Matrix<T> {
        match six[self.kind as usize] {
            Some(rows) => Matrix {
                rows: rows.to_vec(),
                row_of: (0..self.places.len()).map(Some).collect(),
            },
            None => Matrix {
                rows: six[ShapeKind::Hulls as usize].unwrap_or_default().to_vec(),
                row_of: self.of_hulls.clone(),
            },
        }
    }
}

/// What the rows stand for: as the module lists it, or, for a legacy module, as the meshes have it.
fn shapes(part: &Urdd, from: ModuleKind, meshes: &[ModuleKind]) -> Result<Shapes, RobotError> {
    let document = part.document(from).ok_or(RobotError::Missing(from))?;
    if let Some((full, pieces)) = shape_lists(document) {
        return Ok(Shapes {
            full: full.iter().map(|link| link.get()).collect(),
            pieces: pieces
                .iter()
                .map(|shape| (shape.link_idx.get(), shape.piece_idx.get()))
                .collect(),
        });
    }
    for kind in meshes {
        usable(part, *kind)?;
    }
    Shapes::new(part).ok_or(RobotError::Missing(meshes[0]))
}

impl Skips {
    /// Number of shapes.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there are no shapes.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The link and the piece of each shape.
    pub fn places(&self) -> &[(usize, usize)] {
        &self.places
    }

    /// Whether a pair of shapes is skipped. One is not that the module says nothing of.
    pub fn is_skipped(&self, i: usize, j: usize) -> bool {
        self.skipped.at(i, j).unwrap_or(i == j)
    }

    /// Why a pair is what it is, by `link_shapes_simple_skips_module`: of two shapes on one link, of two that always or
    /// never touch, and so on. Edits may decide otherwise. `None` for legacy URDDs, or without that module.
    pub fn reason(&self, i: usize, j: usize) -> Option<SkipReason> {
        self.reasons.as_ref()?.at(i, j)
    }

    /// A person's edits, in order. None where `link_shapes_skips_module` is not there, or in a legacy URDD.
    pub fn edits(&self) -> &[SkipEdit] {
        &self.edits
    }

    /// The reasons for which pairs are skipped, before the edits. `None` where `link_shapes_skips_module` is not there,
    /// or in a legacy URDD.
    pub fn skipped_reasons(&self) -> Option<&[SkippedReason]> {
        self.skipped_reasons.as_deref()
    }

    /// The same shapes and reasons with the skips of another `link_shapes_skips_module` of the same URDD. `kind` is
    /// theirs.
    pub(super) fn of_module(&self, kind: ShapeKind, module: LinkShapesSkipsModule) -> Self {
        let full: Vec<usize> = module.full_shapes.iter().map(|link| link.get()).collect();
        let rows = Rows::new(kind, self.places.clone(), &full);
        let (edits, skipped_reasons) = (module.edits.clone(), module.skipped_reasons.clone());
        let document = ModuleDocument::LinkShapesSkips(Box::new(module));
        Skips {
            skipped: skips(&document).map_or_else(|| self.skipped.clone(), |six| rows.matrix(&six)),
            reasons: self.reasons.clone(),
            edits,
            skipped_reasons: Some(skipped_reasons),
            places: rows.places,
        }
    }
}
