//! One target of `pompeiu-fuzz`, which the environment variable `POMPEIU_TARGET` names, with libFuzzer.

#![no_main]

use libfuzzer_sys::fuzz_target;
use pompeiu_fuzz::Target;
use std::sync::LazyLock;

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let name = std::env::var("POMPEIU_TARGET").expect("POMPEIU_TARGET names a target");
    pompeiu_fuzz::target(&name).expect("POMPEIU_TARGET is the name of a target")
});

fuzz_target!(|bytes: &[u8]| (TARGET.run)(bytes));
