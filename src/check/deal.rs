//! Replicas dealt to threads, in chunks whose sums come back in order: what they add up to does not depend on the threads.

use super::CheckError;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

/// Runs `work` for every number below `chunks`, on `threads` threads, each with what `build` makes for it. `done` hears of
/// every chunk.
pub(super) fn deal<W, S: Send>(
    threads: usize,
    chunks: u32,
    interrupt: &AtomicBool,
    done: &(dyn Fn() + Sync),
    build: impl Fn() -> Result<W, CheckError> + Sync,
    work: impl Fn(&mut W, u32) -> S + Sync,
) -> Result<Vec<S>, CheckError> {
    let threads = threads.clamp(1, chunks.max(1) as usize);
    let next = AtomicU32::new(0);
    let results = Mutex::new(Vec::new());
    let one_thread = || -> Result<(), CheckError> {
        let mut workplace = build()?;
        loop {
            let chunk = next.fetch_add(1, Ordering::Relaxed);
            if chunk >= chunks {
                return Ok(());
            }
            if interrupt.load(Ordering::Relaxed) {
                return Err(CheckError::Interrupted);
            }
            let result = work(&mut workplace, chunk);
            results
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .push((chunk, result));
            done();
        }
    };
    std::thread::scope(|scope| {
        let mut handles = Vec::new();
        for _ in 1..threads {
            let handle = std::thread::Builder::new().spawn_scoped(scope, one_thread);
            handles.push(handle.map_err(|source| CheckError::Threads { threads, source })?);
        }
        let mut outcome = one_thread();
        for handle in handles {
            let other = handle.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            outcome = outcome.and(other);
        }
        outcome
    })?;
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_unstable_by_key(|(chunk, _)| *chunk);
    Ok(results.into_iter().map(|(_, result)| result).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_come_back_in_order_from_any_number_of_threads() {
        for threads in [1, 3] {
            let results = deal(
                threads,
                20,
                &AtomicBool::new(false),
                &|| {},
                || Ok(()),
                |(), chunk| chunk * 2,
            );
            assert_eq!(results.expect("threads"), (0..20).map(|c| c * 2).collect::<Vec<_>>());
        }
    }

    #[test]
    fn an_interrupt_stops_it() {
        let results = deal(2, 20, &AtomicBool::new(true), &|| {}, || Ok(()), |(), chunk| chunk);
        assert!(matches!(results, Err(CheckError::Interrupted)));
    }
}
