//! Checked-in pictures are what the examples draw.

#[allow(dead_code, reason = "only its main function is not called")]
#[path = "../../examples/what_is_left.rs"]
mod what_is_left;

use std::fs::read_to_string;
use std::path::Path;

#[test]
fn what_is_left_is_drawn_by_the_command_in_it() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let picture = read_to_string(repository.join("docs/what-is-left.svg")).unwrap();
    let (_, command) = picture.split_once("Made by: ").unwrap();
    let (command, _) = command.split_once("</desc>").unwrap();
    let files: Vec<_> = command.rsplitn(4, ' ').collect();
    let ["docs/what-is-left.svg", b, a, "cargo run --release --example what_is_left"] = files[..] else {
        panic!("not the command expected: {command}");
    };
    let [a, b] = [a, b].map(|file| pompeiu::io::read(repository.join(file)).unwrap().mesh);
    let drawn = what_is_left::draw(&a, &b, command).unwrap();
    assert!(drawn == picture, "the picture is out of date; run `{command}`");
}
