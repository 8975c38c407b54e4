//! The options of `batch` that are those of `remesh`.

use crate::args::{Args, MakingArgs, ResultArgs};
use clap::{ArgMatches, Args as _, CommandFactory as _};
use std::ffi::OsString;

/// What the children of this program are given of its command line: `--option=value`, with the defaults where nothing was typed.
pub(super) fn handed_on() -> Vec<OsString> {
    Args::command().get_matches().subcommand_matches("batch").map(of).unwrap_or_default()
}

/// Every option that is shared is here by itself, as the two structs that share them say what they are.
fn of(typed: &ArgMatches) -> Vec<OsString> {
    let shared = ResultArgs::augment_args(MakingArgs::augment_args(clap::Command::new("shared")));
    let mut options = Vec::new();
    for option in shared.get_arguments() {
        let (id, Some(long)) = (option.get_id().as_str(), option.get_long()) else { continue };
        let name = OsString::from(format!("--{long}"));
        if !option.get_action().takes_values() {
            options.extend(typed.get_flag(id).then_some(name));
            continue;
        }
        for value in typed.get_raw(id).into_iter().flatten() {
            let parts = [name.as_os_str(), "=".as_ref(), value];
            options.push(parts.into_iter().collect());
        }
    }
    options
}

#[cfg(test)]
mod tests {
    use super::*;

    fn handed(line: &str) -> Vec<OsString> {
        let typed = Args::command().get_matches_from(line.split(' '));
        of(typed.subcommand_matches("batch").unwrap())
    }

    #[test]
    fn what_remesh_knows_is_handed_on_and_the_rest_is_not() {
        let defaults = handed("semireg batch in --out out --jobs 3 --resume --format ply");
        assert_eq!(defaults, ["--features=creases", "--method=best", "--seed=0"]);
        let typed = handed("semireg batch in --out out --no-fit --seed 7 --keep seams,materials --base-vertices 50 --levels 3");
        let [seams, materials, features] = ["--keep=seams", "--keep=materials", "--features=creases"];
        assert_eq!(
            typed,
            ["--base-vertices=50", features, seams, materials, "--method=best", "--seed=7", "--levels=3", "--no-fit"]
        );
    }
}
