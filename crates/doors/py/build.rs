//! Tells the linker of macOS that the interpreter which loads the module has what is missing.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
