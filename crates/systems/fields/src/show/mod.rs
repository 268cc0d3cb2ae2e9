//! A tangent field and its parts as a page and as a picture.
//!
//! [`DecompositionPage`] shows a result of this crate; [`FieldsContent`] is the same page from plain data.

mod content;
mod page;

pub use content::{FieldsContent, NamedField, TextTable};
pub use page::DecompositionPage;
