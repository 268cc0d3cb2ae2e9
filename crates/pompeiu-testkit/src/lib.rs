//! Oracles and reference cases for the tests.
