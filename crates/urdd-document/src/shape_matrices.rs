//! Version-independent view of matrices over link shapes: distances, skips, reasons, error models.

use urdd_format::index::LinkIdx;
use urdd_format::legacy::shapes::ErrorBounds;
use urdd_format::link_shapes_simple_skips::{LinkShapesSimpleSkipsModule, SkipReason};
use urdd_format::link_shapes_skips::LinkShapesSkipsModule;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::shape_kind::{OfKinds, ShapeKind};
use urdd_format::shapes::PieceShape;

/// The modules with matrices over shapes.
pub const MATRIX_MODULES: &[ModuleKind] = &[
    ModuleKind::LinkShapesDistanceStatistics,
    ModuleKind::LinkShapesSimpleSkips,
    ModuleKind::LinkShapesSkips,
    ModuleKind::LinkShapesLieAlgErrorModels,
];

/// The modules of version 1 with matrices over shapes.
pub const V1_MATRIX_MODULES: &[ModuleKind] = &[
    ModuleKind::LinkShapesDistanceStatistics,
    ModuleKind::LinkShapesSimpleSkips,
    ModuleKind::LinkShapesSkips,
];

/// The rows of a matrix, or `None` for null.
pub type Rows<'a, T> = Option<&'a [Vec<T>]>;

/// An element of a matrix, if it exists.
pub fn at<T: Copy>(rows: &[Vec<T>], i: usize, j: usize) -> Option<T> {
    rows.get(i)?.get(j).copied()
}

/// Distance statistics of one kind of shape.
#[derive(Debug, Clone, Copy)]
pub struct Statistics<'a> {
    /// Keys of the mean, minimum and maximum distances.
    pub keys: [&'static str; 3],
    /// Mean distances.
    pub mean: &'a [Vec<f64>],
    /// Minimum distances.
    pub min: &'a [Vec<f64>],
    /// Maximum distances.
    pub max: &'a [Vec<f64>],
    /// Number of sampled configurations; `None` if not stated.
    pub num_samples: Option<u32>,
}

/// Keys of the mean, minimum and maximum distances in version 1.
const V1_KEYS: [&str; 3] = ["mean_distances", "min_distances", "max_distances"];
const LEGACY_KEYS: [&str; 3] = ["averages", "minimums", "maximums"];

/// The six statistics of `link_shapes_distance_statistics_module`, in the order of [`ShapeKind::ALL`].
pub fn statistics(document: &ModuleDocument) -> Option<[Option<Statistics<'_>>; 6]> {
    match document {
        ModuleDocument::LinkShapesDistanceStatistics(m) => Some(m.of_kinds().map(|one| {
            one.map(|one| Statistics {
                keys: V1_KEYS,
                mean: &one.mean_distances,
                min: &one.min_distances,
                max: &one.max_distances,
                num_samples: Some(m.num_samples.0),
            })
        })),
        ModuleDocument::LegacyLinkShapesDistanceStatistics(m) => Some(m.of_kinds().map(|one| {
            one.map(|one| Statistics {
                keys: LEGACY_KEYS,
                mean: &one.averages,
                min: &one.minimums,
                max: &one.maximums,
                num_samples: None,
            })
        })),
        _ => None,
    }
}

/// The six matrices of `link_shapes_simple_skips_module` or `link_shapes_skips_module`, in the order
/// of [`ShapeKind::ALL`].
pub fn skips(document: &ModuleDocument) -> Option<[Rows<'_, bool>; 6]> {
    let six = match document {
        ModuleDocument::LinkShapesSimpleSkips(m) => m.of_kinds(),
        ModuleDocument::LegacyLinkShapesSimpleSkips(m) => m.of_kinds(),
        ModuleDocument::LinkShapesSkips(m) => m.of_kinds(),
        ModuleDocument::LegacyLinkShapesSkips(m) => m.of_kinds(),
        _ => return None,
    };
    Some(six.map(|rows| rows.map(Vec::as_slice)))
}

/// JSON Pointer to a skip matrix.
pub fn skips_pointer(document: &ModuleDocument, kind: ShapeKind) -> String {
    let keys = match document {
        ModuleDocument::LinkShapesSkips(_) | ModuleDocument::LegacyLinkShapesSkips(_) => {
            LinkShapesSkipsModule::KEYS
        }
        _ => LinkShapesSimpleSkipsModule::KEYS,
    };
    format!("/{}", keys[kind as usize])
}

/// The six matrices of reasons of `link_shapes_simple_skips_module` of version 1.
pub fn reasons(document: &ModuleDocument) -> Option<[Rows<'_, SkipReason>; 6]> {
    match document {
        ModuleDocument::LinkShapesSimpleSkips(m) => {
            Some(m.reasons.of_kinds().map(|rows| rows.map(Vec::as_slice)))
        }
        _ => None,
    }
}

/// Suffix after the name of a kind in the key of a model matrix, and the matrices of the six kinds.
type Models<'a> = (&'static str, [&'a [Vec<ErrorBounds>]; 6]);

/// The twelve matrices of `link_shapes_lie_alg_error_models_module`: the standard models, then the
/// pseudo models.
fn models(document: &ModuleDocument) -> Option<[Models<'_>; 2]> {
    let ModuleDocument::LegacyLinkShapesLieAlgErrorModels(m) = document else {
        return None;
    };
    Some([
        (
            "_standard_models",
            [
                &m.full_convex_hulls_standard_models,
                &m.full_obbs_standard_models,
                &m.full_bounding_spheres_standard_models,
                &m.decomposition_convex_hulls_standard_models,
                &m.decomposition_obbs_standard_models,
                &m.decomposition_bounding_spheres_standard_models,
            ],
        ),
        (
            "_pseudo_models",
            [
                &m.full_convex_hulls_pseudo_models,
                &m.full_obbs_pseudo_models,
                &m.full_bounding_spheres_pseudo_models,
                &m.decomposition_convex_hulls_pseudo_models,
                &m.decomposition_obbs_pseudo_models,
                &m.decomposition_bounding_spheres_pseudo_models,
            ],
        ),
    ])
}

/// `full_shapes` and `decomposition_shapes` of a module of version 1.
pub fn shape_lists(document: &ModuleDocument) -> Option<(&[LinkIdx], &[PieceShape])> {
    match document {
        ModuleDocument::LinkShapesDistanceStatistics(m) => {
            Some((&m.full_shapes, &m.decomposition_shapes))
        }
        ModuleDocument::LinkShapesSimpleSkips(m) => Some((&m.full_shapes, &m.decomposition_shapes)),
        ModuleDocument::LinkShapesSkips(m) => Some((&m.full_shapes, &m.decomposition_shapes)),
        _ => None,
    }
}

/// The elements of a matrix.
#[derive(Debug, Clone, Copy)]
pub enum Elements<'a> {
    /// Distances, m.
    Distances(&'a [Vec<f64>]),
    /// Skips.
    Skips(&'a [Vec<bool>]),
    /// Reasons of skips.
    Reasons(&'a [Vec<SkipReason>]),
    /// Error models.
    Models(&'a [Vec<ErrorBounds>]),
}

/// What is true of rows of any elements.
macro_rules! of_rows {
    ($elements:expr, $rows:ident => $value:expr) => {
        match $elements {
            Elements::Distances($rows) => $value,
            Elements::Skips($rows) => $value,
            Elements::Reasons($rows) => $value,
            Elements::Models($rows) => $value,
        }
    };
}

impl Elements<'_> {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        of_rows!(self, rows => rows.len())
    }

    /// Number of elements of each row.
    pub fn row_lengths(&self) -> Vec<usize> {
        of_rows!(self, rows => rows.iter().map(Vec::len).collect())
    }

    /// An element as text.
    pub fn text(&self, i: usize, j: usize) -> String {
        of_rows!(self, rows => at(rows, i, j).map_or_else(String::new, |one| format!("{one:?}")))
    }
}

/// A matrix over shapes.
#[derive(Debug, Clone)]
pub struct Matrix<'a> {
    /// The kind of shape that its indices refer to.
    pub kind: ShapeKind,
    /// JSON Pointer in the document.
    pub pointer: String,
    /// Its elements; `None` if the document has null.
    pub elements: Option<Elements<'a>>,
}

/// Every matrix of a module, kind by kind.
pub fn matrices(document: &ModuleDocument) -> Vec<Matrix<'_>> {
    let mut matrices = Vec::new();
    let mut add = |kind: ShapeKind, pointer, elements| {
        matrices.push(Matrix { kind, pointer, elements });
    };
    for (kind, one) in of_each(statistics(document)) {
        match one {
            None => add(kind, format!("/{}", kind.key()), None),
            Some(one) => {
                for (key, rows) in one.keys.into_iter().zip([one.mean, one.min, one.max]) {
                    let pointer = format!("/{}/{key}", kind.key());
                    add(kind, pointer, Some(Elements::Distances(rows)));
                }
            }
        }
    }
    for (kind, rows) in of_each(skips(document)) {
        let pointer = skips_pointer(document, kind);
        add(kind, pointer, rows.map(Elements::Skips));
    }
    for (kind, rows) in of_each(reasons(document)) {
        let pointer = format!("/reasons/{}", kind.key());
        add(kind, pointer, rows.map(Elements::Reasons));
    }
    for (suffix, six) in models(document).into_iter().flatten() {
        for (kind, rows) in of_each(Some(six)) {
            let pointer = format!("/{}{suffix}", kind.key());
            add(kind, pointer, Some(Elements::Models(rows)));
        }
    }
    matrices
}

fn of_each<T>(six: Option<[T; 6]>) -> impl Iterator<Item = (ShapeKind, T)> {
    ShapeKind::ALL.into_iter().zip(six.into_iter().flatten())
}
