//! Parts of the buffer of a file.

use serde_json::{Value, json};

/// The views of the only buffer, one after the other; each begins at a multiple of four bytes.
#[derive(Default)]
pub(super) struct Views {
    pub(super) described: Vec<Value>,
    pub(super) length: u64,
}

impl Views {
    pub(super) fn add(&mut self, bytes: u64, target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.length, "byteLength": bytes });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.described.push(view);
        self.length += bytes.next_multiple_of(4);
        self.described.len() - 1
    }
}
