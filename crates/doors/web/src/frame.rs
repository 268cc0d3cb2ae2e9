//! Arrays of bytes in one body of a request or a response: a line with their lengths as a list in JSON, then the arrays.

/// Longest line of lengths.
const MOST_LINE: usize = 4096;

/// The arrays of a body; `None` where it is none.
pub(crate) fn unframed(body: &[u8]) -> Option<Vec<Vec<u8>>> {
    let end = body.iter().take(MOST_LINE).position(|byte| *byte == b'\n')?;
    let lengths: Vec<usize> = serde_json::from_slice(&body[..end]).ok()?;
    let mut rest = &body[end + 1..];
    let mut arrays = Vec::new();
    for length in lengths {
        let (array, after) = rest.split_at_checked(length)?;
        arrays.push(array.to_vec());
        rest = after;
    }
    rest.is_empty().then_some(arrays)
}

/// A body of arrays.
pub(crate) fn framed(arrays: &[Vec<u8>]) -> Vec<u8> {
    let lengths: Vec<String> = arrays.iter().map(|array| array.len().to_string()).collect();
    let mut body = format!("[{}]\n", lengths.join(",")).into_bytes();
    for array in arrays {
        body.extend_from_slice(array);
    }
    body
}
