//! Why a command failed: one line for people, an object for programs.

use semireg::Error;
use serde::{Deserialize, Serialize};
use std::fmt::{self, Display, Formatter};
use std::io;

/// What a program may want to tell apart. The names are a part of the contract of `--json`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Kind {
    /// A file or folder cannot be read or written.
    Io,
    /// The contents of a file break the rules of its format.
    Parse,
    /// The extension names no format, or the file uses a part of its format that is not read or written.
    Format,
    /// Nothing is left of the input that could be remeshed or measured.
    Empty,
    /// Marked edges are none of the input.
    Marks,
    /// The result did not pass the certificate, or could not be made.
    NotCertified,
    /// The result would have too many triangles.
    TooLarge,
    /// The base mesh of the user's cannot be used.
    Base,
    /// A file that is read would be written over.
    Overwrite,
    /// `check` found the file not to be what was asked.
    CheckFailed,
    /// Options are wrong, or do not fit together.
    Usage,
    /// A file of a batch took longer than it was given.
    Timeout,
    /// A file of a batch took more memory than it was given.
    Memory,
    /// The process of a file of a batch ended without a report.
    Crash,
    /// Some files of a batch did not come out.
    SomeFailed,
    /// The user ended the run.
    Cancelled,
    /// A fault of ours.
    Internal,
}

/// The name that it has in JSON.
impl Display for Kind {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        self.serialize(f)
    }
}

/// Why a command failed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Failure {
    /// What is wrong, and where.
    error: String,
    kind: Kind,
    /// What to do; may be empty.
    hint: String,
    /// Whether it is in the JSON that the command has printed.
    #[serde(skip)]
    pub(crate) told: bool,
}

impl Failure {
    /// `message` says what is wrong and where; after its last `"; "`, if there is one, what to do.
    pub(crate) fn new(kind: Kind, message: impl Display) -> Self {
        let message = one_line(&message.to_string());
        let (error, hint) = message.rsplit_once("; ").unwrap_or((&message, ""));
        Self { error: error.to_owned(), kind, hint: hint.to_owned(), told: false }
    }

    /// The user has ended the run.
    pub(crate) fn cancelled() -> Self {
        Self::new(Kind::Cancelled, "cancelled")
    }

    /// Takes any error apart: what its causes say one after the other, and the last remedy that one of them names.
    pub(crate) fn of(error: anyhow::Error) -> Self {
        let error = match error.downcast::<Self>() {
            Ok(failure) => return failure,
            Err(other) => other,
        };
        if error.chain().any(|cause| matches!(cause.downcast_ref(), Some(Error::Cancelled))) {
            return Self::cancelled();
        }
        let mut joined = Self::new(kind(&error), "");
        for cause in error.chain() {
            let part = Self::new(joined.kind, cause);
            // Some errors repeat their cause in their own text.
            if !joined.error.contains(&part.error) {
                joined.error += if joined.error.is_empty() { "" } else { ": " };
                joined.error += &part.error;
            }
            if !part.hint.is_empty() {
                joined.hint = part.hint;
            }
        }
        if error.chain().any(|cause| cause.is::<Error>()) {
            joined.hint = with_flags(&joined.hint);
        }
        joined
    }

    /// What kind of failure it is.
    pub(crate) fn kind(&self) -> Kind {
        self.kind
    }

    /// The exit code of the program.
    pub(crate) fn exit_code(&self) -> u8 {
        match self.kind {
            Kind::Usage => 2,
            Kind::Cancelled => 130,
            _ => 1,
        }
    }
}

impl Display for Failure {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { error, hint, .. } = self;
        if hint.is_empty() { f.write_str(error) } else { write!(f, "{error}; {hint}") }
    }
}

impl std::error::Error for Failure {}

/// The kind that the causes of an error tell.
fn kind(error: &anyhow::Error) -> Kind {
    // What a library calls a fault of ours is one, whatever its type.
    if error.chain().any(|cause| ["internal error", "please report"].iter().any(|word| cause.to_string().contains(word))) {
        return Kind::Internal;
    }
    error.chain().find_map(of_cause).unwrap_or(Kind::Internal)
}

fn of_cause(cause: &(dyn std::error::Error + 'static)) -> Option<Kind> {
    if let Some(error) = cause.downcast_ref() {
        return Some(of_remeshing(error));
    }
    if let Some(error) = cause.downcast_ref() {
        return Some(of_reading(error));
    }
    if let Some(error) = cause.downcast_ref() {
        return Some(of_writing(error));
    }
    if cause.is::<mesh_core::CleanError>() || cause.is::<certify::MeasureError>() {
        return Some(Kind::Empty);
    }
    (cause.is::<io::Error>() || cause.is::<view::ImageError>()).then_some(Kind::Io)
}

fn of_reading(error: &mesh_io::ReadError) -> Kind {
    use mesh_io::ReadError::{Io, Malformed, UnknownFormat, Unsupported};
    match error {
        Io { .. } => Kind::Io,
        Malformed { .. } => Kind::Parse,
        UnknownFormat { .. } | Unsupported { .. } => Kind::Format,
    }
}

fn of_writing(error: &mesh_io::WriteError) -> Kind {
    use mesh_io::WriteError::{
        AttributeCount, ColorCount, Io, NoLevel, NoSuchVertex, NotSinglePrecision, OneLevel, Packed, Points, TooLarge,
        UnknownFormat,
    };
    match error {
        Io { .. } => Kind::Io,
        UnknownFormat { .. } | Packed { .. } | NotSinglePrecision { .. } | OneLevel { .. } => Kind::Format,
        TooLarge { .. } => Kind::TooLarge,
        ColorCount { .. } | AttributeCount { .. } | NoLevel { .. } | NoSuchVertex { .. } | Points(_) => Kind::Internal,
    }
}

fn of_remeshing(error: &Error) -> Kind {
    match error {
        Error::Cancelled => Kind::Cancelled,
        Error::Clean(_) => Kind::Empty,
        Error::MarkedEdge { .. } => Kind::Marks,
        Error::Features(_) | Error::Sizing(_) | Error::NoGoal { .. } | Error::DensityCount { .. } | Error::Density { .. } => {
            Kind::Usage
        }
        Error::TooLarge { .. } => Kind::TooLarge,
        Error::CleanBase(_) | Error::BaseNotManifold { .. } | Error::Trace(_) | Error::BaseNotCertified { .. } => Kind::Base,
        // No stage fails on a cleaned input for any other reason than its shape.
        _ => Kind::NotCertified,
    }
}

/// Libraries speak of options; here they have flags.
fn with_flags(hint: &str) -> String {
    let mut hint = hint.to_owned();
    for (option, flag) in [
        ("base vertices", "--base-vertices"),
        ("greater error", "--max-error"),
        ("levels", "--levels"),
        ("base mesh", "--base"),
        ("crease angle", "--crease-angle"),
        ("marked edges", "--marked-edges"),
    ] {
        let named = hint.split([' ', '(', ')', ',']).any(|word| word == flag);
        if let (false, Some(at)) = (named, hint.find(option)) {
            hint.insert_str(at + option.len(), &format!(" ({flag})"));
        }
    }
    hint
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::Context as _;

    #[test]
    fn causes_are_joined_and_the_remedy_comes_last() {
        let missing = mesh_io::read("no/such.obj".as_ref()).unwrap_err();
        let failure = Failure::of(anyhow::Error::from(missing).context("story"));
        assert!(failure.error.starts_with("story: cannot read no/such.obj: No such file"), "{failure}");
        assert_eq!((failure.kind, failure.hint.as_str()), (Kind::Io, "check the path and its permissions"));
        assert!(failure.to_string().ends_with("; check the path and its permissions"));
    }

    #[test]
    fn a_failure_stays_what_it_is() {
        let failure = Failure::new(Kind::Overwrite, "a\n is b; take\tc");
        assert_eq!(failure.to_string(), "a is b; take c");
        assert_eq!(Failure::of(failure.clone().into()), failure);
        let json = serde_json::to_value(&failure).unwrap();
        assert_eq!(json, serde_json::json!({ "error": "a is b", "kind": "overwrite", "hint": "take c" }));
    }

    #[test]
    fn library_errors_get_their_flags_here() {
        assert_eq!(
            with_flags("ask for more base vertices or fewer levels"),
            "ask for more base vertices (--base-vertices) or fewer levels (--levels)"
        );
        assert_eq!(with_flags("more base vertices (--base-vertices)"), "more base vertices (--base-vertices)");
        let failure = Failure::of(Error::NotCertified("2 faces are degenerate".to_owned()).into());
        assert!(failure.kind == Kind::NotCertified && failure.hint.contains("--base-vertices"), "{failure}");
    }

    #[test]
    fn faults_of_ours_are_internal() {
        let error = anyhow::Result::<()>::Err(anyhow::anyhow!("internal error in x; please report it")).context("y").unwrap_err();
        assert_eq!(Failure::of(error).kind, Kind::Internal);
    }
}
