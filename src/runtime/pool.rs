//! Threads that wait close at hand: a step of ten thousand grains is too short to wake a sleeping one.
//!
//! Work is cut by index, so the number of threads cannot change a result. A thread that waits spins for some
//! microseconds, then yields, then sleeps.
#![allow(unsafe_code, reason = "threads that outlive a borrow cannot be had from the safe ones of std")]

use std::cell::UnsafeCell;
use std::fmt;
use std::ops::Range;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::{self, JoinHandle};

/// Iterations of a loop before a waiting thread lets others run, and before it sleeps.
const SPINS: u32 = 4_000;
const YIELDS: u32 = 2_000;

type Job = *const (dyn Fn(usize) + Sync);

struct Shared {
    /// counts jobs; a worker has a new one when it changes
    epoch: AtomicUsize,
    /// workers that have finished the present job
    done: AtomicUsize,
    job: UnsafeCell<Option<Job>>,
    leave: AtomicBool,
    broken: AtomicBool,
    sleepers: AtomicUsize,
    bed: Mutex<()>,
    wake: Condvar,
}

// SAFETY: the job is written only while no worker reads it: before the epoch changes, after all have finished.
unsafe impl Sync for Shared {}
// SAFETY: as above; what it points to is `Sync`.
unsafe impl Send for Shared {}

/// A number of threads, the calling one included.
pub struct Pool {
    shared: Arc<Shared>,
    workers: Vec<JoinHandle<()>>,
}

impl fmt::Debug for Pool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Pool({} threads)", self.threads())
    }
}

impl Pool {
    /// A pool of `threads` threads, at least one. Threads that the system refuses are done without.
    #[must_use]
    pub fn new(threads: usize) -> Self {
        let shared = Arc::new(Shared {
            epoch: AtomicUsize::new(0),
            done: AtomicUsize::new(0),
            job: UnsafeCell::new(None),
            leave: AtomicBool::new(false),
            broken: AtomicBool::new(false),
            sleepers: AtomicUsize::new(0),
            bed: Mutex::new(()),
            wake: Condvar::new(),
        });
        let mut workers = Vec::new();
        for index in 1..threads.max(1) {
            let shared = Arc::clone(&shared);
            match thread::Builder::new().name(format!("grains-{index}")).spawn(move || work(&shared, index)) {
                Ok(worker) => workers.push(worker),
                Err(_) => break,
            }
        }
        Self { shared, workers }
    }

    /// Number of threads.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.workers.len() + 1
    }

    /// Calls `job` once on each thread with its number, and waits for all.
    pub fn run(&self, job: &(dyn Fn(usize) + Sync)) {
        if self.workers.is_empty() {
            job(0);
            return;
        }
        let shared = &*self.shared;
        // SAFETY: no worker reads the job now; the pointer is not used after this call, which waits for all of them.
        unsafe {
            let lasting: &'static (dyn Fn(usize) + Sync) = std::mem::transmute(job);
            *shared.job.get() = Some(lasting);
        }
        shared.done.store(0, Ordering::Relaxed);
        shared.epoch.fetch_add(1, Ordering::SeqCst);
        if shared.sleepers.load(Ordering::SeqCst) > 0 {
            drop(shared.bed.lock().unwrap_or_else(PoisonError::into_inner));
            shared.wake.notify_all();
        }
        let own = panic::catch_unwind(AssertUnwindSafe(|| job(0)));
        let mut iterations = 0;
        while shared.done.load(Ordering::Acquire) < self.workers.len() {
            iterations += 1;
            if iterations < SPINS { std::hint::spin_loop() } else { thread::yield_now() }
        }
        match own {
            Err(payload) => panic::resume_unwind(payload),
            Ok(()) if shared.broken.load(Ordering::Relaxed) => {
                panic::resume_unwind(Box::new("a thread of the pool panicked"))
            }
            Ok(()) => {}
        }
    }

    /// Calls `job` with the thread and each index below `bounds.last()`; thread k takes those from `bounds[k]` to `bounds[k + 1]`.
    pub fn each(&self, bounds: &[usize], job: impl Fn(usize, usize) + Sync) {
        self.run(&|thread| {
            let from = bounds.get(thread).copied().unwrap_or_default();
            for index in from..bounds.get(thread + 1).copied().unwrap_or(from) {
                job(thread, index);
            }
        });
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        self.shared.leave.store(true, Ordering::SeqCst);
        self.shared.epoch.fetch_add(1, Ordering::SeqCst);
        drop(self.shared.bed.lock().unwrap_or_else(PoisonError::into_inner));
        self.shared.wake.notify_all();
        for worker in self.workers.drain(..) {
            // A worker catches its own panics.
            let _ = worker.join();
        }
    }
}

fn work(shared: &Shared, index: usize) {
    let mut last = 0;
    loop {
        let mut iterations = 0;
        while shared.epoch.load(Ordering::Acquire) == last {
            iterations += 1;
            if iterations < SPINS {
                std::hint::spin_loop();
            } else if iterations < SPINS + YIELDS {
                thread::yield_now();
            } else {
                let mut bed = shared.bed.lock().unwrap_or_else(PoisonError::into_inner);
                shared.sleepers.fetch_add(1, Ordering::SeqCst);
                while shared.epoch.load(Ordering::SeqCst) == last {
                    bed = shared.wake.wait(bed).unwrap_or_else(PoisonError::into_inner);
                }
                shared.sleepers.fetch_sub(1, Ordering::SeqCst);
            }
        }
        last = last.wrapping_add(1);
        if shared.leave.load(Ordering::SeqCst) {
            return;
        }
        // SAFETY: the job was written before the epoch changed, and stays until this worker says that it has finished.
        if let Some(job) = unsafe { *shared.job.get() } {
            // SAFETY: as above.
            let job = unsafe { &*job };
            if panic::catch_unwind(AssertUnwindSafe(|| job(index))).is_err() {
                shared.broken.store(true, Ordering::Relaxed);
            }
        }
        shared.done.fetch_add(1, Ordering::AcqRel);
    }
}

/// A slice whose disjoint parts go to different threads.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'a, T> {
    start: *mut T,
    length: usize,
    lifetime: std::marker::PhantomData<&'a mut [T]>,
}

// SAFETY: it hands out parts that its user promises are disjoint.
unsafe impl<T: Send> Sync for Parts<'_, T> {}
// SAFETY: as above.
unsafe impl<T: Send> Send for Parts<'_, T> {}

impl<'a, T> Parts<'a, T> {
    /// The whole, before it is cut.
    pub fn new(whole: &'a mut [T]) -> Self {
        Self { start: whole.as_mut_ptr(), length: whole.len(), lifetime: std::marker::PhantomData }
    }

    /// One part.
    ///
    /// # Safety
    /// No other part that is in use overlaps it.
    ///
    /// # Panics
    /// If it is not inside the whole.
    #[must_use]
    pub unsafe fn part(&self, range: Range<usize>) -> &'a mut [T] {
        assert!(range.start <= range.end && range.end <= self.length, "a part must be inside the whole");
        // SAFETY: inside the whole by the assertion, disjoint by the promise of the caller.
        unsafe { std::slice::from_raw_parts_mut(self.start.add(range.start), range.end - range.start) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_index_is_done_once_whatever_the_number_of_threads() {
        for threads in [1, 2, 3] {
            let pool = Pool::new(threads);
            let mut numbers = vec![0; 100];
            let bounds: Vec<usize> = (0..=threads).map(|k| k * 100 / threads).collect();
            for _ in 0..2000 {
                let parts = Parts::new(&mut numbers);
                // SAFETY: each index is one part of its own.
                pool.each(&bounds, |_, i| unsafe { parts.part(i..i + 1)[0] += i });
            }
            assert!(numbers.iter().enumerate().all(|(i, &n)| n == 2000 * i), "{threads}");
        }
    }

    #[test]
    fn a_sleeping_thread_wakes_and_a_panic_comes_back() {
        let pool = Pool::new(2);
        thread::sleep(std::time::Duration::from_millis(100));
        let hits = AtomicUsize::new(0);
        pool.run(&|_| {
            hits.fetch_add(1, Ordering::SeqCst);
        });
        assert_eq!(hits.load(Ordering::SeqCst), 2);
        let broken = panic::catch_unwind(AssertUnwindSafe(|| pool.run(&|k| assert!(k == 0, "worker {k}"))));
        assert!(broken.is_err());
    }
}
