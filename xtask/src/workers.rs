//! The same work on many things, as many at a time as there are processors.

use anyhow::{Result, anyhow};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// What comes of each thing, in their order. They are begun in that order, too. Fails where work on one of them fails.
pub(crate) fn on_all_processors<T: Sync, R: Send>(things: &[T], work: impl Fn(&T) -> Result<R> + Sync) -> Result<Vec<R>> {
    let next = AtomicUsize::new(0);
    let worker = || -> Result<Vec<(usize, R)>> {
        let mut done = Vec::new();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(thing) = things.get(i) else { return Ok(done) };
            done.push((i, work(thing)?));
        }
    };
    let processors = thread::available_parallelism().map_or(1, |n| n.get());
    let mut done = thread::scope(|scope| -> Result<Vec<(usize, R)>> {
        let workers: Vec<_> = (0..processors).map(|_| scope.spawn(worker)).collect();
        let mut done = Vec::new();
        for worker in workers {
            done.extend(worker.join().map_err(|_| anyhow!("a worker panicked"))??);
        }
        Ok(done)
    })?;
    done.sort_by_key(|(i, _)| *i);
    Ok(done.into_iter().map(|(_, result)| result).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_and_one_failure_fails_all() {
        let numbers: Vec<u32> = (0..100).collect();
        assert_eq!(on_all_processors(&numbers, |n| Ok(2 * n)).unwrap(), (0..200).step_by(2).collect::<Vec<u32>>());
        let failing = on_all_processors(&numbers, |n| if *n == 70 { Err(anyhow!("seventy")) } else { Ok(()) });
        assert_eq!(failing.unwrap_err().to_string(), "seventy");
    }
}
