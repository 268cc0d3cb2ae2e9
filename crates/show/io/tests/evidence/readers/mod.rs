//! Every reader against a second reader, at any number of threads, and on defective files.

mod arbitrary;
mod bad_input;
mod containers;
mod data;
mod meshes;
mod obj;
mod off;
mod ply;
mod stl;
mod threads;
