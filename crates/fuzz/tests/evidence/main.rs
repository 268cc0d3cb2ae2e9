//! What holds of every target on its kept inputs and on mutations of them.

mod short;
