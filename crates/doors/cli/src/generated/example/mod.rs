//! Adding an option is one edit in one file: the example in CONTRIBUTING.md is a request before and after, and everything that follows
//! from a request has the new option.

mod after;
mod before;

use super::options::options;
use super::{python, repository};
use crate::door::{Invocation, ReportOf, Session, System};
use clap::{Args, Command, FromArgMatches};
use pompeiu::options::request_from;

/// The files of the example: none.
#[derive(Args)]
struct Files {}

macro_rules! example {
    ($($module:ident),*) => {
        $(impl System for Example<$module::RoundRequest> {
            type Request = $module::RoundRequest;

            fn check(&self, _: bool) -> anyhow::Result<()> {
                Ok(())
            }

            fn run(&self, _: &mut Self::Request, _: &mut Session<'_>) -> anyhow::Result<ReportOf<Self>> {
                Ok($module::RoundReport { moved: 0 })
            }

            fn text(&self, answer: &crate::door::AnswerOf<Self>) -> String {
                answer.report.moved.to_string()
            }
        })*
    };
}

/// A command with the request of the example.
#[derive(Args)]
struct Example<Q: Send + Sync + Clone + 'static> {
    #[command(flatten)]
    files: Files,
    #[arg(skip = std::marker::PhantomData)]
    request: std::marker::PhantomData<Q>,
}

example!(before, after);

/// The help of the example, and what a call means.
fn help<S: System>() -> String {
    Invocation::<S>::augment_args(Command::new("round")).render_long_help().to_string()
}

const PYTHON: &str = "
def round(
    mesh: MeshLike,
    *,
    progress: ProgressLike = None,
) -> Mesh:
    \"\"\"Rounds the coordinates of a mesh.

    Parameters
    ----------
    mesh : MeshLike
        Any mesh.
    progress : callable, optional
        Told the share.

    Returns
    -------
    Mesh
    \"\"\"
";

type Old = Example<before::RoundRequest>;
type New = Example<after::RoundRequest>;

#[test]
fn adding_an_option_is_one_edit_in_one_file() {
    let [before, after] = [include_str!("before.rs"), include_str!("after.rs")];
    let guide = std::fs::read_to_string(repository().join("CONTRIBUTING.md")).unwrap();
    let start = guide.find("```diff\n").expect("CONTRIBUTING.md shows a difference") + "```diff\n".len();
    let shown = &guide[start..start + guide[start..].find("```").unwrap()];
    assert_eq!(applied(before, shown), after, "the difference in CONTRIBUTING.md is not that of the example");

    let [old, new] = [help::<Old>(), help::<New>()];
    assert!(!old.contains("--keep-boundary") && new.contains("--keep-boundary"), "{new}");
    assert!(new.contains("--digits <N>") && new.contains("[default: 3]"), "{new}");
    assert!(new.contains("--time-limit") && !new.contains("--memory-limit"), "{new}");
    let given = pompeiu::options::options_of_toml("keep_boundary = true").unwrap();
    assert!(request_from::<before::RoundRequest>(given.clone()).is_err());
    assert!(request_from::<after::RoundRequest>(given).unwrap().keep_boundary);
    let described = options::<after::RoundRequest>();
    let limits = <after::RoundRequest as pompeiu::core::request::Request>::LIMITS;
    let function = python::function_of(PYTHON, &described, limits).unwrap();
    assert!(
        function.contains("    keep_boundary: bool = False,\n    time_limit: Optional[float] = None,\n"),
        "{function}"
    );
    assert!(function.contains("        Leave vertices of boundary edges where they are.\n"), "{function}");
    let matches =
        Invocation::<New>::augment_args(Command::new("round")).get_matches_from(["round", "--keep-boundary"]);
    let request = Invocation::<New>::from_arg_matches(&matches).unwrap().request().unwrap();
    assert_eq!(request, after::RoundRequest { digits: 3, keep_boundary: true });
}

/// A text after a difference of whole lines.
fn applied(text: &str, difference: &str) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let mut at = 0;
    for change in difference
        .lines()
        .filter(|line| !line.starts_with("@@") && !line.starts_with("---") && !line.starts_with("+++"))
    {
        let (kind, line) = change.split_at(1);
        if kind == "+" {
            lines.insert(at, line);
            at += 1;
            continue;
        }
        let found = lines[at..].iter().position(|one| *one == line);
        at += found.unwrap_or_else(|| panic!("`{line}` is not in the example"));
        if kind == "-" {
            lines.remove(at);
        } else {
            at += 1;
        }
    }
    lines.join("\n") + "\n"
}
