//! The `pompeiu` command.

fn main() {}
