//! Options of the completions command.

use clap::Args;

/// Print a completion script for a shell
#[derive(Args)]
#[command(after_help = "\
Examples:
  pompeiu completions bash > ~/.local/share/bash-completion/completions/pompeiu
  pompeiu completions zsh > ~/.zfunc/_pompeiu
  pompeiu completions fish > ~/.config/fish/completions/pompeiu.fish")]
pub(crate) struct Completions {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}
