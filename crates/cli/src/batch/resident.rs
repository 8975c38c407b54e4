//! How much memory a process takes.

use sysinfo::{Pid, ProcessRefreshKind, ProcessesToUpdate, System};

/// Bytes of a GiB.
const GIB: f64 = (1 << 30) as f64;

/// Looks at the memory of one process again and again.
pub(super) struct Resident {
    system: System,
    process: Pid,
}

impl Resident {
    /// Of the process with this id.
    pub(super) fn of(process: u32) -> Self {
        Self { system: System::new(), process: Pid::from_u32(process) }
    }

    /// Its resident size in GiB; 0 when it has ended, or where the system does not tell.
    pub(super) fn gib(&mut self) -> f64 {
        let what = ProcessRefreshKind::nothing().with_memory().without_tasks();
        self.system.refresh_processes_specifics(ProcessesToUpdate::Some(&[self.process]), true, what);
        self.system.process(self.process).map_or(0.0, |process| process.memory() as f64 / GIB)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_that_is_used_is_seen() {
        let mut resident = Resident::of(std::process::id());
        let before = resident.gib();
        // Written to, as memory that nobody has touched is not resident.
        let block = std::hint::black_box(vec![1_u8; 1 << 26]);
        let after = resident.gib();
        assert!(before > 0.0 && after > before + block.len() as f64 / GIB / 2.0, "{before} {after}");
    }
}
