//! Inputs that are nearly right: kept ones with some bytes changed, the same in every run.

use std::env;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

/// Seconds that each call of [`attack`] takes instead of its number of mutations.
const VARIABLE: &str = "POMPEIU_FUZZ_SECONDS";
/// Bytes of an input, at most.
const LONGEST: usize = 1 << 14;

/// Words that readers of text look for, and numbers at the ends of ranges.
const WORDS: [&str; 24] = [
    "-1",
    "0",
    "1e999",
    "-1e-999",
    "nan",
    "inf",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "-9223372036854775808",
    "0x",
    "//",
    "/",
    "\"",
    "'",
    "\\\n",
    "#",
    "\r",
    "\0",
    "\u{feff}",
    "<",
    ">",
    "[[",
    "}",
];

/// A generator of numbers that are random enough (xorshift).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The same numbers for the same seed.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// All bits.
    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number below `n`, which is not 0.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.bits() >> 11) % n as u64) as usize
    }
}

/// An input made from one of some others by a few changes.
pub fn mutated(inputs: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut bytes = inputs[random.below(inputs.len())].clone();
    for _ in 0..=random.below(4) {
        change(&mut bytes, inputs, random);
    }
    bytes.truncate(LONGEST);
    bytes
}

fn change(bytes: &mut Vec<u8>, inputs: &[Vec<u8>], random: &mut Random) {
    let at = random.below(bytes.len() + 1);
    let length = random.below(16).min(bytes.len() - at);
    match random.below(9) {
        0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
        1 if at < bytes.len() => bytes[at] = [0, 1, 0x7f, 0x80, 0xff, b'0', b' ', b'\n'][random.below(8)],
        2 => drop(bytes.splice(at..at, (0..length).map(|_| random.bits() as u8).collect::<Vec<_>>())),
        3 => drop(bytes.drain(at..at + length)),
        4 => {
            let copied = bytes[at..at + length].to_vec();
            drop(bytes.splice(at..at, copied));
        }
        5 => drop(bytes.splice(at..at + length, WORDS[random.below(WORDS.len())].bytes())),
        // A number in the file replaced or set between others.
        6 => {
            let number = random.bits() >> random.below(64);
            drop(bytes.splice(at..at, number.to_string().into_bytes()));
        }
        7 => {
            let number = [u64::MAX, 0, 1 << 31, 1 << 32, random.bits()][random.below(5)].to_le_bytes();
            let end = bytes.len().min(at + [1, 2, 4, 8][random.below(4)]);
            bytes[at..end].copy_from_slice(&number[..end - at]);
        }
        8 => {
            let other = &inputs[random.below(inputs.len())];
            let from = random.below(other.len() + 1);
            bytes.truncate(at);
            bytes.extend_from_slice(&other[from..]);
        }
        _ => bytes.truncate(at),
    }
}

/// The files of a folder, in order of their names.
pub fn kept(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = entries
        .map(|entry| entry.expect("a folder is read").path())
        .filter(|path| path.is_file())
        .map(|path| {
            let name = path.file_name().expect("a file has a name").to_string_lossy().into_owned();
            (name, fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
        })
        .collect();
    files.sort();
    files
}

/// Runs a function on all files of a folder, and on so many mutations of them: as many as [`crate::effort::cases`] says, or for as many
/// seconds as `POMPEIU_FUZZ_SECONDS` says, then another seed in every call.
///
/// # Panics
/// If the function does; the input is printed and, with `POMPEIU_FUZZ_KEEP`, written to the folder that this names.
#[allow(clippy::print_stdout, reason = "the input on which a test fails is what one needs")]
pub fn attack(folder: &Path, usual: u32, mut run: impl FnMut(&[u8])) {
    let mut run_one = |name: &str, bytes: &[u8]| {
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| run(bytes))) {
            println!("{}: {name}: fails on b\"{}\"", folder.display(), bytes.escape_ascii());
            if let Some(keep) = env::var_os("POMPEIU_FUZZ_KEEP") {
                let (path, title) =
                    (Path::new(&keep), folder.file_name().unwrap_or_default().to_string_lossy());
                fs::write(path.join(format!("{title}-{}", bytes.len())), bytes).expect("the folder is there");
            }
            resume_unwind(panic);
        }
    };
    let files = kept(folder);
    assert!(!files.is_empty(), "{} has no inputs", folder.display());
    for (name, bytes) in &files {
        run_one(name, bytes);
    }
    let inputs: Vec<Vec<u8>> = files.into_iter().map(|(_, bytes)| bytes).collect();
    let seconds = env::var(VARIABLE).ok().map(|text| text.parse().expect("POMPEIU_FUZZ_SECONDS is a number"));
    let Some(seconds) = seconds else {
        let mut random = Random::new(1);
        for _ in 0..crate::effort::cases(usual) {
            run_one("a mutation", &mutated(&inputs, &mut random));
        }
        return;
    };
    let now = std::time::SystemTime::UNIX_EPOCH.elapsed().unwrap_or_default();
    let (mut random, started, mut count) = (Random::new(now.as_nanos() as u64), Instant::now(), 0_u64);
    while started.elapsed() < Duration::from_secs(seconds) {
        run_one("a mutation", &mutated(&inputs, &mut random));
        count += 1;
    }
    println!("fuzzed {} with {count} mutations in {seconds} s", folder.display());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mutations_differ_and_are_the_same_in_every_run() {
        let inputs = vec![b"v 0 0 1\nf 1 1 1\n".to_vec(), vec![7; 40]];
        let all = |seed| {
            let mut random = Random::new(seed);
            (0..200).map(|_| mutated(&inputs, &mut random)).collect::<Vec<_>>()
        };
        let (first, mut different) = (all(1), all(1));
        assert_eq!(first, different);
        assert_ne!(first, all(2));
        different.sort();
        different.dedup();
        assert!(different.len() > 150, "{}", different.len());
    }

    #[test]
    #[should_panic(expected = "seven")]
    fn what_fails_fails_the_test() {
        let folder = std::env::temp_dir().join(format!("pompeiu-mutate-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("input"), [3, 4, 5]).unwrap();
        attack(&folder, 10_000, |bytes| assert!(!bytes.contains(&7), "seven"));
    }
}
