//! A process that is given limited time and memory.

use super::resident::Resident;
use std::io;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// Time between two looks at a process.
const BETWEEN_LOOKS: Duration = Duration::from_millis(10);

/// What a process may take; none where there is no limit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Limits {
    pub(super) time: Option<Duration>,
    /// Resident size in GiB.
    pub(super) memory: Option<f64>,
}

/// How a process ended.
#[derive(Debug)]
pub(super) enum Ended {
    ByItself(ExitStatus),
    OverTime,
    OverMemory,
    /// By the wish of the caller.
    Stopped,
}

/// Runs a process to its end, or ends it when it goes over a limit or when `stop` says so. It need not help with that.
///
/// Its standard input is a pipe that ends with this program, however that ends.
pub(super) fn run(command: &mut Command, limits: Limits, stop: impl Fn() -> bool) -> io::Result<Ended> {
    on_its_own(command);
    let mut child = command.stdin(Stdio::piped()).spawn()?;
    let (start, mut resident) = (Instant::now(), Resident::of(child.id()));
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Ended::ByItself(status));
        }
        let over = if stop() {
            Some(Ended::Stopped)
        } else if limits.time.is_some_and(|limit| start.elapsed() > limit) {
            Some(Ended::OverTime)
        } else {
            limits.memory.filter(|&limit| resident.gib() > limit).map(|_| Ended::OverMemory)
        };
        if let Some(ended) = over {
            return kill(&mut child).map(|()| ended);
        }
        thread::sleep(BETWEEN_LOOKS);
    }
}

fn kill(child: &mut Child) -> io::Result<()> {
    child.kill()?;
    child.wait().map(|_| ())
}

/// Ctrl-C in a terminal goes to the parent alone, which ends its children: a file whose process was ended so gets no line.
#[cfg(unix)]
fn on_its_own(command: &mut Command) {
    std::os::unix::process::CommandExt::process_group(command, 0);
}

#[cfg(windows)]
fn on_its_own(command: &mut Command) {
    const CREATE_NEW_PROCESS_GROUP: u32 = 0x200;
    std::os::windows::process::CommandExt::creation_flags(command, CREATE_NEW_PROCESS_GROUP);
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    /// A process that does nothing for a minute.
    fn idle() -> Command {
        let mut command = Command::new("sleep");
        command.arg("60");
        command
    }

    #[test]
    fn a_process_that_does_not_return_is_ended() {
        let time = Limits { time: Some(Duration::from_millis(50)), ..Limits::default() };
        assert!(matches!(run(&mut idle(), time, || false).unwrap(), Ended::OverTime));
        let memory = Limits { memory: Some(1e-6), ..Limits::default() };
        assert!(matches!(run(&mut idle(), memory, || false).unwrap(), Ended::OverMemory));
        assert!(matches!(run(&mut idle(), Limits::default(), || true).unwrap(), Ended::Stopped));
    }

    #[test]
    fn one_that_keeps_to_its_limits_ends_by_itself() {
        let limits = Limits { time: Some(Duration::from_secs(60)), memory: Some(1e3) };
        assert!(matches!(run(&mut Command::new("true"), limits, || false).unwrap(), Ended::ByItself(status) if status.success()));
    }
}
