//! The engine as a WebAssembly module: a handful of functions with pointers and lengths, for which no tool is needed beside the
//! compiler.
//!
//! The caller allocates arrays with `array`, the first one with the JSON of a call, fills them, and calls `call`; the arrays of the
//! reply, the first one again with JSON, are at `pointer` and have `length` until the next call. Imported are `now`, in milliseconds,
//! and `told`, which gets JSON while an answer is computed.

use crate::{Engine, Told, Watcher};
use pompeiu::core::run::set_clock;
use std::cell::RefCell;
use std::ops::ControlFlow;
use std::time::Duration;

#[allow(unsafe_code, reason = "what is imported from JavaScript has no other form")]
mod imported {
    #[link(wasm_import_module = "pompeiu")]
    unsafe extern "C" {
        pub(super) safe fn now() -> f64;
        pub(super) safe fn told(json: *const u8, length: usize);
    }
}

#[derive(Default)]
struct State {
    engine: Engine,
    given: Vec<Vec<u8>>,
    reply: Vec<Vec<u8>>,
}

thread_local! {
    static STATE: RefCell<State> = RefCell::default();
}

struct Page;

impl Watcher for Page {
    fn told(&self, told: &Told<'_>) -> ControlFlow<()> {
        if let Ok(json) = serde_json::to_string(told) {
            imported::told(json.as_ptr(), json.len());
        }
        ControlFlow::Continue(())
    }
}

fn clock() -> Duration {
    Duration::try_from_secs_f64(imported::now() / 1000.0).unwrap_or_default()
}

/// Room for an array of the next call; null where there is no memory for it.
#[allow(unsafe_code, reason = "the name by which JavaScript finds the function")]
#[unsafe(no_mangle)]
extern "C" fn array(length: usize) -> *mut u8 {
    let mut bytes = Vec::new();
    if bytes.try_reserve_exact(length).is_err() {
        return std::ptr::null_mut();
    }
    bytes.resize(length, 0);
    STATE.with_borrow_mut(|state| {
        state.given.push(bytes);
        state.given.last_mut().map_or(std::ptr::null_mut(), |bytes| bytes.as_mut_ptr())
    })
}

/// Answers a call; returns the number of arrays of the reply.
#[allow(unsafe_code, reason = "the name by which JavaScript finds the function")]
#[unsafe(no_mangle)]
extern "C" fn call() -> usize {
    set_clock(clock);
    STATE.with_borrow_mut(|state| {
        let mut given = std::mem::take(&mut state.given).into_iter();
        let json = given.next().unwrap_or_default();
        state.reply.clear();
        let reply = state.engine.call(&String::from_utf8_lossy(&json), given.collect(), &Page);
        state.reply.push(reply.json.into_bytes());
        state.reply.extend(reply.arrays);
        state.reply.len()
    })
}

/// Where an array of the reply is.
#[allow(unsafe_code, reason = "the name by which JavaScript finds the function")]
#[unsafe(no_mangle)]
extern "C" fn pointer(index: usize) -> *const u8 {
    STATE.with_borrow(|state| state.reply.get(index).map_or(std::ptr::null(), |bytes| bytes.as_ptr()))
}

/// How many bytes an array of the reply has.
#[allow(unsafe_code, reason = "the name by which JavaScript finds the function")]
#[unsafe(no_mangle)]
extern "C" fn length(index: usize) -> usize {
    STATE.with_borrow(|state| state.reply.get(index).map_or(0, Vec::len))
}
