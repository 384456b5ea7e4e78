//! The macros that declare the format's types, each as the source of its schema. See [`object`](super::object).

/// Declares a whole document, the first type, and types in it as [`types!`] does.
macro_rules! module {
    ($(#[$meta:meta])* pub struct $name:ident $fields:tt $($rest:tt)*) => {
        $crate::object::object! {
            true, $crate::object::close_document, $(#[$meta])* pub struct $name $fields
        }
        $crate::types::types! { $($rest)* }
    };
}

/// Declares objects, enumerations that are written as strings, and choices between kinds. A field's annotations (SPEC
/// 11.3) are behind its type: `pub radius: f64 where { unit: "m" },`.
macro_rules! types {
    () => {};
    ($(#[$meta:meta])* pub struct $name:ident $fields:tt $($rest:tt)*) => {
        $crate::object::object! {
            false, $crate::object::close, $(#[$meta])* pub struct $name $fields
        }
        $crate::types::types! { $($rest)* }
    };
    ($(#[doc = $doc:literal])* pub enum $name:ident {
        $($(#[doc = $vdoc:literal])* $variant:ident $(= $word:literal)?,)*
    } $($rest:tt)*) => {
        $crate::object::string_enum! {
            $(#[doc = $doc])* pub enum $name { $($(#[doc = $vdoc])* $variant $(= $word)?,)* }
        }
        $crate::types::types! { $($rest)* }
    };
    ($(#[doc = $doc:literal])* pub enum $name:ident $kinds:tt $($rest:tt)*) => {
        $crate::tagged::tagged! { $(#[doc = $doc])* pub enum $name $kinds }
        $crate::types::types! { $($rest)* }
    };
}

pub(crate) use {module, types};
