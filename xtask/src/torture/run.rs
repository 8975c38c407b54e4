//! One solid remeshed, with its processor time limited.

use super::judgement::End;
use super::solid::Solid;
use crate::cost::measured;
use crate::process::within;
use anyhow::{Context, Result};
use serde_json::Value;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// The program, and where its results go.
pub(super) struct Runner {
    pub(super) binary: PathBuf,
    pub(super) folder: PathBuf,
    /// Processor seconds that a run may take.
    pub(super) limit: u64,
    /// Keep the files of solids that came out right, too.
    pub(super) keep_all: bool,
}

/// The system's limit counts in ticks, the measure is exact: on a busy machine a run was ended at 60 s that had taken 56.5.
const MOSTLY: f64 = 0.9;

impl Runner {
    /// Remeshes at the defaults and checks the result. Returns how it ended and the processor seconds that it took. The result is left
    /// beside the solid as `SEED_KIND.out.obj`, its report as `SEED_KIND.json`.
    pub(super) fn run(&self, solid: &Solid) -> Result<(End, f64)> {
        let output = solid.input.with_extension("out.obj");
        if output.exists() {
            fs::remove_file(&output)?;
        }
        let work = self.folder.join(format!("run_{}", solid.seed));
        fs::create_dir_all(&work).with_context(|| format!("cannot make {}", work.display()))?;
        let mut args: Vec<OsString> = vec!["remesh".into(), solid.input.clone().into(), "-o".into(), output.clone().into()];
        args.extend(["--json", "--threads=1"].map(OsString::from));
        let (ended, cost) = measured(self.limit, &self.binary, &args, &work)?;
        let seconds = cost.processor_seconds;
        let end = match ended.code {
            Some(0) => {
                fs::write(solid.input.with_extension("json"), &ended.stdout)?;
                match serde_json::from_str::<Value>(&ended.stdout) {
                    Err(_) => End::Invalid("the report is not JSON".to_owned()),
                    Ok(report) => self.checked(&report, &output, &work)?,
                }
            }
            code => End::without(code, &ended.last_error, seconds > MOSTLY * self.limit as f64),
        };
        fs::remove_dir_all(&work)?;
        if end == End::Right && !self.keep_all {
            for file in [solid.input.clone(), output, solid.input.with_extension("json")] {
                fs::remove_file(file)?;
            }
        }
        Ok((end, seconds))
    }

    /// The judgement of a report, where the file says by itself that it is what the report promises.
    fn checked(&self, report: &Value, output: &Path, work: &Path) -> Result<End> {
        let levels = report["levels"].as_array().map_or(0, |levels| levels.len().saturating_sub(1));
        let mut check = Command::new(&self.binary);
        let check = within(Duration::MAX, check.arg("check").arg(output).arg(format!("--levels={levels}")), work)?;
        Ok(match check.code {
            Some(0) => End::of(report),
            _ => End::Invalid(format!("the result does not check: {}", check.last_error)),
        })
    }
}
