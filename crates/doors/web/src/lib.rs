//! The engine behind a page and a JavaScript package.
//!
//! An [`Engine`] holds meshes and answers calls: a line of JSON with arrays of bytes beside it, in both directions. The same calls are
//! answered in a WebAssembly module (`wasm32-unknown-unknown`, see `module.rs`) and by a native program, [`App`], which serves the page. Requests and answers are
//! those of the command and of Python.
//!
//! # Example
//! ```
//! use pompeiu_web::{Engine, Silent};
//!
//! let mut engine = Engine::default();
//! let square = b"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n".to_vec();
//! let reply = engine.call(r#"{"call": "read", "name": "square.off"}"#, vec![square], &Silent);
//! assert!(reply.json.contains(r#""faces":2"#));
//! let reply = engine.call(r#"{"call": "ask", "command": "info", "meshes": [1]}"#, vec![], &Silent);
//! assert!(reply.json.contains(r#""area":1.0"#));
//! ```

mod ask;
mod call;
mod engine;
mod error;
#[cfg(not(target_family = "wasm"))]
mod frame;
mod meshes;
#[cfg(all(target_family = "wasm", target_os = "unknown"))]
mod module;
mod outputs;
mod pages;
#[cfg(not(target_family = "wasm"))]
mod server;
mod watch;

pub use engine::{Engine, Reply};
pub use error::CallError;
#[cfg(not(target_family = "wasm"))]
pub use server::{App, AppError};
pub use watch::{Silent, Told, Watcher};
