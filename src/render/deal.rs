//! Work dealt to threads.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Calls `run` with every entry of `order`, in that order, on the threads of `pool`: whoever is free takes the next. `run`
/// is also told which thread it is on.
pub(super) fn deal(pool: &rayon::ThreadPool, order: &[usize], run: &(impl Fn(usize, usize) + Sync)) {
    let next = AtomicUsize::new(0);
    pool.broadcast(|context| {
        while let Some(&entry) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
            run(entry, context.index());
        }
    });
}
