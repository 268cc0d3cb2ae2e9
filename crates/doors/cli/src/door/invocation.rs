//! The command line of a system: its files, the options of its request, the limits that it obeys, `--config` and `--json`.

use super::{System, config};
use crate::args::Limits;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, value_parser};
use pompeiu::core::request::Request;
use pompeiu::options::{Options, options_of, request_from};
use serde::Serialize;
use serde_json::Value;
use std::path::PathBuf;

/// A command as it was called.
pub(crate) struct Invocation<S: System> {
    pub(crate) system: S,
    pub(crate) limits: Limits,
    pub(crate) json: bool,
    config: Option<PathBuf>,
    /// The options that were given on the command line.
    given: Options,
}

impl<S: System> Invocation<S> {
    /// What is asked: the command line over files over defaults.
    pub(crate) fn request(&self) -> anyhow::Result<S::Request> {
        let below = self.system.options_below(|name| self.given.contains_key(name))?;
        let mut options = Options::new();
        for path in below.into_iter().chain(self.config.as_deref()) {
            options.extend(config::read::<S>(path)?);
        }
        options.extend(self.given.clone());
        Ok(request_from(options)?)
    }
}

impl<S: System> Args for Invocation<S> {
    fn augment_args(command: Command) -> Command {
        let command = S::Request::augment_args(S::augment_args(command));
        let command = Limits::augment_offered(with_defaults::<S::Request>(command), S::Request::LIMITS);
        let config =
            Arg::new("config").long("config").value_name("FILE").value_parser(value_parser!(PathBuf));
        let json = Arg::new("json").long("json").action(ArgAction::SetTrue);
        command
            .arg(
                config
                    .help("Take options from this TOML file, where they are not given here")
                    .display_order(800),
            )
            .arg(json.help("Print one JSON object").display_order(801))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<S: System> FromArgMatches for Invocation<S> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let request = S::Request::from_arg_matches(matches)?;
        let is_given = |name: &str| {
            matches.ids().any(|id| id == name) && matches.value_source(name) == Some(ValueSource::CommandLine)
        };
        Ok(Self {
            system: S::from_arg_matches(matches)?,
            limits: Limits::from_offered(matches),
            json: matches.get_flag("json"),
            config: matches.get_one("config").cloned(),
            given: options_of(&request).into_iter().filter(|(name, _)| is_given(name)).collect(),
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// Gives the arguments of a request the defaults of the request itself, so that they have one home.
fn with_defaults<Q: Request + Serialize>(mut command: Command) -> Command {
    for (name, value) in options_of(&Q::default()) {
        let takes_value = command.get_arguments().any(|arg| {
            arg.get_id() == name.as_str()
                && arg.get_action().takes_values()
                && arg.get_default_values().is_empty()
        });
        if let Some(text) = text(&value).filter(|_| takes_value) {
            command = command.mut_arg(name, |arg| arg.required(false).default_value(text));
        }
    }
    command
}

/// A default as it would be written on the command line.
fn text(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Number(number) => {
            let text = number.to_string();
            Some(text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned))
        }
        Value::Array(values) if !values.is_empty() => {
            let parts: Option<Vec<String>> = values.iter().map(self::text).collect();
            Some(parts?.join(","))
        }
        _ => None,
    }
}
