//! Shapes and their measures as a page.

mod page;

pub use page::ComplexityPage;
