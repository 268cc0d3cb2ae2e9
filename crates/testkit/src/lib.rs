//! Oracles and reference cases for the tests.
//!
//! Nothing here shares code with the engine: a judge of accepted [`certificate`]s, [`exact`] numbers and an [`oracle`] that proves its enclosures in them,
//! [`plain`] arithmetic, [`sampling`] with a covering radius, [`cases`] with closed forms, [`strategies`] for random
//! meshes, [`mod@mutate`]: inputs that are nearly right, [`effort`]: how many of them are tried, and [`data`]: where real meshes are.

#![allow(clippy::missing_panics_doc, reason = "a test kit panics to fail a test")]

pub mod cases;
pub mod certificate;
pub mod data;
pub mod effort;
pub mod exact;
pub mod mutate;
pub mod oracle;
pub mod plain;
pub mod sampling;
pub mod strategies;
